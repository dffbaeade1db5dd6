# Texts of the game. Comments begin with a hash; `{ $name }` is a value; a plural is chosen by its category.

## Menus

menu-on = on
menu-off = off
menu-stars = { $stars ->
    [one] { $stars } star
   *[other] { $stars } stars
}
back = Back
title = Title
settings = Settings
percent = { $number } %

## Title

title-motto = a cell under the microscope
title-new = New here? The first slides take a minute each.
title-goal = Food chain, next goal: { $what }, { $done } of { $least }
title-version = version { $version }
title-play = Play
title-slides = Slides
title-food-chain = Food chain
title-two-players = Two players
title-network = Over the network
title-simulation = Simulation
title-watch = Watch the last game
title-guide = Field guide
title-scores = High scores
title-quit = Quit
quit-heading = Quit?
quit-stay = Stay

## Settings

settings-language = Language
settings-optics = Optics
settings-drawn-about = *: drawn for now, because this computer is slow with the optics. Quality says otherwise.
settings-quality = Quality
settings-text-size = Text size
settings-motion = Reduced motion
settings-digestion = Hold to digest
settings-crawl = Click to crawl
settings-pace = Speed of rounds
settings-sound = Sound
settings-captions = Captions
settings-arrows = Classic arrows
settings-full-screen = Full screen
settings-keys = Keys
settings-name = Name
settings-quality-about = How much work goes into the picture. Automatic: as much as this machine can do.
settings-motion-about = On: nothing moves or blinks for decoration.
settings-digestion-about = On: you digest only while you hold a key.
settings-crawl-about = On: one click starts your crawl, the next one stops it.
settings-pace-about = How fast time passes in a round: slower is easier.
settings-captions-about = On: what you hear is written at the right, too.
settings-arrows-about = On: the green arrow is shown even when you are full.
settings-unknown-language = The settings have an unknown language, { $language }.
effort-automatic = automatic
effort-high = high
effort-medium = medium
effort-low = low

## Keys

keys-press = press a key
keys-letters = WASD steers
keys-usual = Usual keys
keys-refused = This key cannot be used. Escape leaves it as it was.
action-consume = Digest (hold)
action-zoom-in = Zoom in
action-zoom-out = Zoom out
action-lunge = Lunge
action-divide = Divide (food chain)
action-pause = Pause
action-step = Single step
action-slower = Slower
action-faster = Faster
action-restart = Restart
action-optics = Next optics
action-debug-view = Debug view
action-plots = Plots
action-panel = Panel
action-undo = Undo (simulation)
action-screenshot = Picture
action-full-screen = Full screen

## Pause

pause-heading = Paused
pause-go-on = Go on
pause-restart = Restart
pause-photo = Photo

## During a round

hud-score = Score { $points }
hud-places = Places { $counts }
hud-digested = Digested { $counts }
hud-lived = Lived { $time } s   Size { $size }, new body at { $next }
hud-starves = until you starve
hud-second-life = second life: { $sisters }
hud-bitten = Bitten: get away!
hud-undivided = Your cell cannot divide now: it is too small, or is taking something in.
hud-eaten-by-rival = A rival ate you
hud-eaten-by-giant = A giant ate you
hud-starved = You starved
hud-lunge-early = Not yet: your cell has to recover from its lunge.
hud-lunge-price = A lunge costs a little of your size.
hud-lunge-small = Your cell cannot lunge now: it is too small, or divides.
hud-full = full
hud-replay = Replay
hud-replay-differs = Replay, not as it was played
hint-finger = a finger on the picture
hint-mouse = the left mouse button or an arrow key
hint-digest-button = Digest
hint-digest = Hold { $key } to digest what you have taken in
hint-task = { $task } Hold { $what } to crawl.
hint-begin = Time starts then.
hint-tempo = { $slower }: slower. { $faster }: faster. { $stop }: stop.
hint-crawl = Hold { $what } to crawl.
hint-eat = Crawl against food, and go on until it is inside.
hint-last = Only what you digest in time counts.
hint-place = The middle of your cell counts: bring the cross into the place.
hint-two-players = Player 1: hold the left mouse button to crawl. Player 2: arrow keys or a gamepad.
hint-taken = A larger amoeba is taking you in. You cannot move, and it will digest you.
hint-chain-clock = Without food you shrink and starve. The clock shows how long you can last.
hint-chain-rivals = Rivals follow your scent. A ring: you can eat it. A warning sign: it eats you. "=": neither.
hint-chain-giant = Giants follow your scent. Flee through a gap: rivals fit through, giants do not.
hint-chain-ghost = The pale outline is your longest life in this water.
hint-chain-divide = { $key } divides your cell: the sister is a second life.
hint-chain-button = The button
lesson-ready = A green arrow: you are large enough to take this cell in.
lesson-too-large = Ciliates are the best food. Eat small food to grow: box and percentage show how much of the size needed you have.
lesson-no-room = "full": you have room for one such cell. Digest it first.
lesson-lunge = { $what }: twice as fast for a moment. It costs a little of your body.
hint-lunge-key = { $key } or the right mouse button
lesson-optics = { $key } changes the optics: the same cells look different in each.

## Captions of what is heard

caption-engulf = food goes in
caption-ingest = food is inside
caption-release = food is lost
caption-digest = food is digested
caption-lunge = a lunge
caption-danger = danger is near
caption-divide = a cell divides
caption-fuse = two cells become one
caption-second = the clock ticks
caption-end = the end

## Ends

end-again = Play again
end-watch = Watch it again
end-points = { $points ->
    [one] { $points } point
   *[other] { $points } points
}
end-doubt = , not as it was played
end-best = The best so far!
end-rank = Number { $place } so far
kind-agar = agar
kind-cocci = cocci
kind-rods = rods
kind-rigid-cells = ciliates
missed-undigested = { $count ->
    [one] One thing was still inside: only what you digest counts.
   *[other] { $count } things were still inside: only what you digest counts.
}
missed-all = You took nothing in. Crawl against food, and go on until it is inside.
missed-rigid = You took in no ciliate. Take one under a green arrow.
missed-rigid-most = You took in no ciliate, and they count most. Grow on small food until a green arrow is over one.
goal-better = Next: more than { $points }
goal-first = Next: the first points
goal-own-best = Next: { $points } points

## High scores

scores-heading = High scores: { $game }, { $time } s
scores-none = None yet. Play!
scores-leave = Enter or a click: back
scores-points = points
scores-small = small
scores-cells = ciliates
scores-seconds = seconds
scores-next = Enter or a click: next. Escape: back

## Slides

slides-best = Best: { $time } s, all stars. { $fact } ({ $source })
slides-next = Best: { $time } s. One more star within { $next } s. { $task }
slide-end-next = Next slide
slide-end-again = Again
slide-end-late = Time is up
slide-end-taken = A larger amoeba took you in
slide-end-done = Done in { $time } s
slide-end-more = One more star within { $time } s
slide-end-left = { $task } So far: { $done }

## Food chain

chain-about = Eat or starve. Flee from giants through gaps. As you grow, you change your body.
chain-best = { $about } Best: { $time } s.
chain-today = Today's water
chain-other = Other water
chain-same = Again: same water
chain-today-best = Everybody has this water today. Lives { $lives }, best { $time } s. { $days }
chain-today-new = Everybody has this water today. { $goal }. { $days }
chain-days = Days before: { $days } s.
chain-water = Water { $seed }: the same for all who play this number.
chain-done = Small food { $small }, ciliates { $cells }, bites out of amoebae { $bites }, changes of the body { $changes }
chain-goals = Food chain goals: { $done } of { $all }
chain-goals-new = New food chain goals: { $new }, in all { $done } of { $all }
chain-next = Next goal: { $what }, { $done } of { $least } in one life
goals-title = Goals
goals-heading = Goals reached: { $done } of { $all }
goals-chain = *: in one life of the food chain. { $leave }
goals-most = best { $most }
goal-points = points in one game
goal-ciliates = ciliates in one game
goal-stars = stars on slides
goal-together = points of two together
feat-changes = changes of the body
feat-time = seconds alive
feat-small = small food
feat-cells = ciliates
feat-divisions = divisions
feat-bites = bites out of amoebae
chain-wins = { $name } lived longest, { $best } s to { $others } s
chain-draw = A draw, all lived { $points } s
chain-draw-best = A draw of the best, { $points } s each
chain-lived = You lived { $time } s
chain-starved = You starved. Go where small food is dense, and take ciliates under a green arrow.
chain-starved-fact = An amoeba that finds no food rounds up into a cyst or dies; yours looked for food to the end.
chain-eaten = A larger amoeba ate you. At a warning sign crawl away at once, through a gap; grown cells eat rivals.
chain-eaten-alone = A larger amoeba ate you. Flee at a warning sign, and divide in time ({ $key }): a sister is a second life.
chain-eaten-fact = Entamoeba histolytica kills living cells bite by bite: trogocytosis (Ralston and others, 2014, Nature 508).
change-heading = You have grown: choose
change-speed = Quick body
change-speed-about = 12 % faster
change-sticky-front = Sticky front
change-sticky-front-about = food goes in sooner, also from the side
change-stomach = Second stomach
change-stomach-about = digests sooner, grows 6 % more
change-thrift = Thrifty body
change-thrift-about = a tenth less hunger
change-coat = Thick coat
change-coat-about = seems twice as large, bites take less
change-wide-mouth = Wide mouth
change-wide-mouth-about = larger prey, bites equal amoebae

## Field guide

guide-heading = Field guide { $found }/{ $all }
guide-read = Enter or a click: read
guide-ask = Not found yet. Ask "What is this?" about it in the simulation "{ $scene }".
guide-eat = Not found yet. Digest one in a round or on a slide.
guide-take = Not found yet. Take food in with your front, and digest it.
guide-divide = Not found yet. Divide your cell in the food chain.
guide-look = Not found yet. Look in this way: { $key } changes the optics.
guide-own = Not found yet. Ask "What is this?" about a body in a scenario of your own.
guide-unkept = What you found cannot be kept: { $error }

## Two players

two-about = { $what } Player 1: mouse. Player 2: arrow keys or a gamepad.
two-versus-about = Who eats more in 90 seconds?
two-together-about = How much do you eat together in 90 seconds?
two-bot-about = You and a cell that the program steers: who eats more in 90 seconds?
two-versus = Against each other
two-together = Together
two-bot = Against the program
two-sum = Together { $points }
two-you = You
two-program = Program
two-won = Rounds won: { $first } to { $second }
two-player = Player { $number }
two-wins = { $name } wins, { $best } to { $others }
two-you-win = You win, { $best } to { $others }
two-bot-wins = The program wins, { $best } to { $others }
two-together-end = { $points ->
    [one] { $points } point together
   *[other] { $points } points together
}
two-draw = { $points ->
    [one] A draw, { $points } point each
   *[other] A draw, { $points } points each
}
two-draw-best = { $points ->
    [one] A draw of the best, { $points } point each
   *[other] A draw of the best, { $points } points each
}

## The way into a room

join-how = Type the code of a room: 4 to 12 letters and digits. Enter goes there, Escape back.
join-who = Two to four who type the same code are in the same room.
name-how = Type your name for high scores and rooms: up to 12 letters and digits. Enter keeps it, Escape goes back.

## Players

colour-blue = blue
colour-orange = orange
colour-green = green
colour-purple = purple

## The room

room-heading = The room
room-ready = Ready
room-play = Play
room-rate = Frames
room-seed = Seed
room-any-seed = by chance
room-leave = Leave
room-seat = { $number } { $name }, { $colour }: { $note }
room-own-name = { $name } (you)
room-coming = is coming
room-other-version = another version
room-plays = plays
room-is-ready = ready
room-not-ready = not ready
room-again = { $news } Whoever is ready plays again.
room-match-on = Code { $code }. A match is on: whoever is ready takes a cell without a player, or watches.
room-waits = Code { $code }. The match begins when two to four are here and all are ready.
room-entering = Code { $code }. On the way to the server ...
room-cut = the connection to the server is cut
room-unreachable = cannot reach { $host }: { $error }
room-none = { $host } has no rooms
room-strange = the server gives a strange answer
room-code = a code has 4 to 12 letters and digits

## A match over a network

match-player = player { $number }, { $colour }
match-you-are = You are { $player }. Hold the mouse button or a finger to crawl.
match-watch = You watch.
match-waiting = Waiting for the others ...
match-cut = The connection is cut. Coming back ...
match-leave = Escape again: leave the match
match-net = { $ping } ms, { $loss } % lost, back { $back }, frames at most { $frames } of { $window }
match-end = { $verdict }. You were { $player }.
match-watched = { $verdict }. You watched.
match-slide-done = { $stars } in { $time } s
match-slide-late = Time is up: { $done }
match-over = The match is over.
match-silent = Somebody does not answer, so it is a draw.
match-differs = The worlds of the players differ before step { $step }, so it is a draw.
match-kept = { $record } and { $world } are beside the settings.
match-given = { $record } and { $world } are among the downloads.
match-nobody = nobody goes on with the match

## Simulations

pick-file = a file
scene-absorb-agar = A first meal
scene-absorb-rigid = A large meal
scene-crawl = A cell crawls
scene-crowd = Many cells
scene-dam-break = A dam breaks
scene-demo = A bit of everything
scene-divide = A cell divides
scene-empty = An empty room
scene-game = The game
scene-grow = A cell grows
scene-hunt = A neutrophil hunts
scene-leak-stress = Does a cell leak?
scene-platelets = A field of platelets
scene-pond = A pond
scene-ram-stress = Rammed from all sides
scene-squeeze = Through a narrow gap
tool-steer = Steer
tool-drag = Drag
tool-push = Push away
tool-spawn = Put in
tool-remove = Remove
tool-follow = Follow
tool-ask = What is this?
tool-look = Look around
tool-join = Join
tool-wall = Wall
tool-field = Field
field-vortex = vortex
field-stream = stream
panel-move = Move
panel-bodies = Bodies
panel-look = Look
panel-build = Build
panel-time = Time
panel-scene = Scene
panel-undo = Undo
panel-speed = Speed
panel-scenarios = Scenarios
panel-menu = Menu
spawn-coccus = coccus
spawn-bacillus = bacillus
spawn-rigid-cell = ciliate
spawn-amoeboid = amoeboid
spawn-platelet = platelet
spawn-red-cell = red cell
spawn-probe = probe
spawn-fluid = fluid
sandbox-panel = { $key } shows the panel again.
sandbox-paused = PAUSED
sandbox-bodies = { $count ->
    [one] { $count } body
   *[other] { $count } bodies
}
sandbox-particles = { $count ->
    [one] { $count } particle
   *[other] { $count } particles
}
sandbox-step = step { $time } ms
sandbox-area = area { $area } µm²
sandbox-top = top { $value }
sandbox-legend =
    circle: particle
    thin: distance, rope
    bold: anchor, membrane, joint
    square: front  bar: rear
    dot: left  ring: right
    tint: chemical
    amber: contact
sandbox-stopped = Time is stopped. Let it go on first.
sandbox-no-undo = There is nothing to undo.
sandbox-nobody = You follow nobody: click on a cell to follow it.
sandbox-immobile = What you follow cannot crawl.
sandbox-nothing = There is nothing here.
sandbox-short = Drag from one end to the other.
sandbox-occupied = Something is in the way here.
sandbox-whole = You see the whole room. Zoom in first.
sandbox-free = You follow nobody now.
sandbox-overlap = No room here: { $what }
sandbox-outside = Outside the walls: { $what }
sandbox-crowded = The room is full.
sandbox-refused = Cannot be put here: { $what }

## Photos, files and messages

photo-how = Drag or arrow keys: move. Wheel, { $out } or { $in }: zoom. { $optics }: optics. { $picture }: save a picture. Escape: back.
waiting = The microscope is being set up ...
quality-lowered = Quality is { $quality } now, so that the picture moves smoothly (Settings).
quality-drawn = that of the drawn view
file-written = Saved as { $file }
file-unwritable = cannot write { $file }: { $error }
file-unreadable = cannot read { $file }: { $error }
file-not-text = it is not text in UTF-8
file-senseless = { $file } makes no sense
file-unfit = { $file } does not work as a simulation: { $problem }
error-missing = it is not there
error-forbidden = access is denied
error-full = there is no room left
error-no-file = it is not a file
error-too-long = it is too long
error-silent = nobody answers there
error-other = the system refuses it
file-put-aside = { $told }; kept as { $aside }
file-added = { $file } is in the list of simulations now.
files-added = { $count ->
    [one] { $count } file is in the list of simulations now.
   *[other] { $count } files are in the list of simulations now.
}
last-game-none = No game has been played yet.
last-game-broken = The last game cannot be played again: its record is damaged or of another version.
last-game-unkept = cannot keep the game: { $error }
settings-unkept = cannot keep the settings: { $error }

## Ways of looking

sight-bright-field = bright field
sight-classic = classic
sight-dark-field = dark field
sight-dic = DIC
sight-drawn = drawn
sight-fluorescence = fluorescence
sight-negative-phase-contrast = negative phase contrast
sight-phase-contrast = phase contrast
sight-stained = stained

## The page around the game: what its own files say, for other languages

page-title = microsim - a cell under the microscope
page-heading = microsim: a cell under the microscope
page-canvas = The game. Arrow keys, Enter and Escape move through its menus.
page-loading = Loading
page-stopped = The game has stopped
page-reload = Start again
page-menu = Menu
page-zoom-out = Zoom out
page-zoom-in = Zoom in
page-lunge = Lunge
page-divide = Divide
page-digest = Digest
page-more = Files, links and privacy
page-open = Open a file
page-share = Copy a link to the last game
page-share-water = Copy a link to the last water
page-share-scenario = Copy a link to the scenario
page-privacy = Settings, scores and games stay in this browser. Only in a room is something sent: your name and what your cell does.
page-licences = Licences
page-copied = The link is copied.
page-in-address = The link is in the address bar.
page-scene = Scene
page-no-graphics = The graphics were taken away, as after sleep.
