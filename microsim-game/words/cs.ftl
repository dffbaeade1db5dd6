# Texty hry v češtině.

## Nabídky

menu-on = zapnuto
menu-off = vypnuto
menu-stars = { $stars ->
    [one] { $stars } hvězda
    [few] { $stars } hvězdy
    [many] { $stars } hvězdy
   *[other] { $stars } hvězd
}
back = Zpět
title = Úvod
settings = Nastavení
percent = { $number } %

## Úvod

title-motto = buňka pod mikroskopem
title-new = Jsi tu poprvé? První preparáty trvají minutu.
title-goal = Potravní řetězec, další cíl: { $what }, { $done } z { $least }
title-version = verze { $version }
title-play = Hrát
title-slides = Preparáty
title-food-chain = Potravní řetězec
title-two-players = Dva hráči
title-network = Po síti
title-simulation = Simulace
title-watch = Přehrát poslední hru
title-guide = Průvodce
title-scores = Nejlepší výsledky
title-quit = Ukončit
quit-heading = Ukončit hru?
quit-stay = Zůstat

## Nastavení

settings-language = Jazyk
settings-optics = Optika
settings-drawn-about = *: teď jen kresba, protože optiku tento počítač nestíhá. Jinak: Kvalita.
settings-quality = Kvalita
settings-text-size = Velikost písma
settings-motion = Méně pohybu
settings-digestion = Trávit podržením
settings-crawl = Lézt kliknutím
settings-pace = Rychlost kol
settings-sound = Zvuk
settings-captions = Titulky
settings-arrows = Původní šipky
settings-full-screen = Celá obrazovka
settings-keys = Klávesy
settings-name = Jméno
settings-quality-about = Kolik práce dá obraz. Automatická: tolik, kolik tento počítač zvládne.
settings-motion-about = Zapnuto: nic se nehýbe ani nebliká jen pro ozdobu.
settings-digestion-about = Zapnuto: co je uvnitř, se tráví jen při držení klávesy.
settings-crawl-about = Zapnuto: kliknutím začneš lézt, dalším přestaneš.
settings-pace-about = Jak rychle v kole běží čas: pomaleji je to snazší.
settings-captions-about = Zapnuto: co je slyšet, je vpravo i napsáno.
settings-arrows-about = Zapnuto: zelená šipka je i tam, kde uvnitř není místo.
settings-unknown-language = V nastavení je neznámý jazyk: { $language }.
effort-automatic = automatická
effort-high = vysoká
effort-medium = střední
effort-low = nízká

## Klávesy

keys-press = stiskni klávesu
keys-letters = WASD řídí
keys-usual = Obvyklé klávesy
keys-refused = Tuto klávesu nelze použít. Escape ponechá původní.
action-consume = Trávit (držet)
action-zoom-in = Přiblížit
action-zoom-out = Oddálit
action-lunge = Výpad
action-divide = Rozdělit se (řetězec)
action-pause = Pauza
action-step = Jeden krok
action-slower = Pomaleji
action-faster = Rychleji
action-restart = Znovu od začátku
action-optics = Další optika
action-debug-view = Ladicí pohled
action-plots = Grafy
action-panel = Panel
action-undo = Vzít zpět (simulace)
action-screenshot = Snímek
action-full-screen = Celá obrazovka

## Pauza

pause-heading = Pauza
pause-go-on = Pokračovat
pause-restart = Od začátku
pause-photo = Fotografie

## Během kola

hud-score = Body { $points }
hud-places = Místa { $counts }
hud-digested = Stráveno { $counts }
hud-lived = Život { $time } s   Velikost { $size }, nové tělo při { $next }
hud-starves = do vyhladovění
hud-second-life = druhý život: { $sisters }
hud-bitten = Někdo tě okusuje: uteč!
hud-undivided = Buňka se teď nemůže dělit: je příliš malá, nebo něco přijímá.
hud-eaten-by-rival = Snědl tě soupeř
hud-eaten-by-giant = Snědl tě obr
hud-starved = Umíráš hladem
hud-lunge-early = Ještě ne: buňka si musí po výpadu odpočinout.
hud-lunge-price = Výpad stojí trochu velikosti.
hud-lunge-small = Buňka teď nemůže vyrazit: je příliš malá, nebo se dělí.
hud-full = plno
hud-replay = Záznam
hud-replay-differs = Záznam, jiný než odehraná hra
hint-finger = prst na obraze
hint-mouse = levé tlačítko myši nebo šipku
hint-digest-button = Trávit
hint-digest = Co je uvnitř, strávíš podržením: { $key }
hint-task = { $task } Drž { $what } a lez.
hint-begin = Pak začne běžet čas.
hint-tempo = { $slower }: pomaleji. { $faster }: rychleji. { $stop }: zastavit.
hint-crawl = Drž { $what } a lez.
hint-eat = Lez proti potravě, dokud není uvnitř.
hint-last = Počítá se jen to, co je strávené včas.
hint-place = Počítá se střed buňky: dostaň na místo křížek.
hint-two-players = Hráč 1: drž levé tlačítko myši a lez. Hráč 2: šipky nebo gamepad.
hint-taken = Pohlcuje tě větší améba: nemůžeš se hýbat a ona tě stráví.
hint-chain-clock = Bez potravy se zmenšuješ a zahyneš hladem: hodiny ukazují, jak dlouho ti vystačí.
hint-chain-rivals = Blíží se soupeři, jdou po pachu. Kroužek: můžeš ho sníst. Výstražná značka: sní tebe. "=": ani jedno.
hint-chain-giant = Blíží se obři, jdou po pachu. Uteč: soupeři mezerami projdou, obři ne.
hint-chain-ghost = Bledý obrys je tvůj nejdelší život v této vodě.
hint-chain-divide = { $key }: buňka se rozdělí a sestra je druhý život.
hint-chain-button = Tlačítko
lesson-ready = Zelená šipka: na pohlcení této buňky už máš dost velké tělo.
lesson-too-large = Nálevníci jsou nejlepší potrava. Políčko a procenta: kolik máš z potřebné velikosti. Vyrosteš po drobné potravě.
lesson-no-room = Nápis "plno": uvnitř je místo jen pro jednu takovou buňku. Nejdřív ji stráv.
lesson-lunge = { $what }: na chvíli dvakrát rychlejší. Stojí to kousek těla.
hint-lunge-key = { $key } nebo pravé tlačítko myši
lesson-optics = { $key } mění optiku: stejné buňky v každé vypadají jinak.

## Titulky k tomu, co je slyšet

caption-engulf = potrava jde dovnitř
caption-ingest = potrava je uvnitř
caption-release = potrava je zase venku
caption-digest = potrava je strávená
caption-lunge = výpad
caption-danger = blíží se nebezpečí
caption-divide = buňka se dělí
caption-fuse = dvě buňky splynuly
caption-second = hodiny tikají
caption-end = konec

## Konce

end-again = Hrát znovu
end-watch = Přehrát záznam
end-points = { $points ->
    [one] { $points } bod
    [few] { $points } body
    [many] { $points } bodu
   *[other] { $points } bodů
}
end-doubt = , jinak než při hře
end-best = Zatím nejlepší výsledek!
end-rank = Zatím { $place }. místo
kind-agar = agar
kind-cocci = koky
kind-rods = tyčinky
kind-rigid-cells = nálevníci
missed-undigested = { $count ->
    [one] Jedno sousto uvnitř nebylo stráveno: počítá se jen to, co je strávené.
    [few] { $count } sousta uvnitř nebyla strávena: počítá se jen to, co je strávené.
    [many] { $count } sousta uvnitř nebylo stráveno: počítá se jen to, co je strávené.
   *[other] { $count } soust uvnitř nebylo stráveno: počítá se jen to, co je strávené.
}
missed-all = Nic nebylo pohlceno: lez proti potravě, dokud není uvnitř.
missed-rigid = Žádný nálevník: pohlť některého pod zelenou šipkou.
missed-rigid-most = Žádný nálevník, a ti se počítají nejvíc. Rosti na drobné potravě, dokud nad některým není zelená šipka.
goal-better = Další cíl: víc než { $points }
goal-first = Další cíl: první body
goal-own-best = Další cíl: { $points } bodů

## Nejlepší výsledky

scores-heading = Nejlepší výsledky: { $game }, { $time } s
scores-none = Zatím žádné. Zahraj si!
scores-leave = Enter nebo kliknutí: zpět
scores-points = body
scores-small = drobné
scores-cells = velké
scores-seconds = sekundy
scores-next = Enter nebo kliknutí: dál. Escape: zpět

## Preparáty

slides-best = Nejlepší čas: { $time } s, všechny hvězdy. { $fact } ({ $source })
slides-next = Nejlepší čas: { $time } s. Další hvězda do { $next } s. { $task }
slide-end-next = Další preparát
slide-end-again = Znovu
slide-end-late = Čas vypršel
slide-end-taken = Pohltila tě větší améba
slide-end-done = Hotovo za { $time } s
slide-end-more = Další hvězda: do { $time } s
slide-end-left = { $task } Zatím: { $done }

## Potravní řetězec

chain-about = Jez, nebo zahyneš hladem. Obrům uteč mezerami. Jak rosteš, volíš si změny těla.
chain-best = { $about } Rekord: { $time } s.
chain-today = Dnešní voda
chain-other = Jiná voda
chain-same = Znovu: stejná voda
chain-today-best = Tuto vodu mají dnes všichni. Životů { $lives }, nejdelší { $time } s. { $days }
chain-today-new = Tuto vodu mají dnes všichni. { $goal }. { $days }
chain-days = Předchozí dny: { $days } s.
chain-water = Voda { $seed }: stejná pro všechny, kdo hrají toto číslo.
chain-done = Drobná potrava { $small }, nálevníci { $cells }, sousta z améb { $bites }, změny těla { $changes }
chain-goals = Cíle potravního řetězce: { $done } z { $all }
chain-goals-new = Nové cíle potravního řetězce: { $new }, celkem { $done } z { $all }
chain-next = Další cíl: { $what }, { $done } z { $least } v jednom životě
goals-title = Cíle
goals-heading = Splněné cíle: { $done } z { $all }
goals-chain = *: v jednom životě v potravním řetězci. { $leave }
goals-most = nejvíc { $most }
goal-points = body v jedné hře
goal-ciliates = nálevníci v jedné hře
goal-stars = hvězdy za preparáty
goal-together = body dvou společně
feat-changes = změny těla
feat-time = sekundy života
feat-small = drobná potrava
feat-cells = nálevníci
feat-divisions = dělení
feat-bites = sousta z améb
chain-wins = Nejdelší život: { $name }, { $best } s ku { $others } s
chain-draw = Remíza, všichni vydrželi { $points } s
chain-draw-best = Remíza nejlepších, každý { $points } s
chain-lived = Tvůj život: { $time } s
chain-starved = Došla ti potrava. Jdi, kde je drobné potravy hodně, a ber nálevníky pod zelenou šipkou.
chain-starved-fact = Améba, která nenajde potravu, se zakulatí a vytvoří cystu, nebo uhyne; tahle ji hledala až do konce.
chain-eaten = Snědla tě větší améba. Od výstražné značky hned odlez mezerou; velké buňky jedí soupeře.
chain-eaten-alone = Snědla tě větší améba. Od výstražné značky uteč a včas se rozděl ({ $key }): sestra je druhý život.
chain-eaten-fact = Entamoeba histolytica zabíjí živé buňky sousto po soustu: trogocytóza (Ralston a další, 2014, Nature 508).
change-heading = Vyrostl jsi: zvol si
change-speed = Rychlé tělo
change-speed-about = o 12 % rychleji
change-sticky-front = Lepkavé čelo
change-sticky-front-about = potrava jde dovnitř dřív, i ze strany
change-stomach = Druhý žaludek
change-stomach-about = tráví dřív, roste o 6 % víc
change-thrift = Úsporné tělo
change-thrift-about = o desetinu menší hlad
change-coat = Silný obal
change-coat-about = zdá se dvakrát větší, kousnutí uberou méně
change-wide-mouth = Široká ústa
change-wide-mouth-about = větší kořist, kouše i stejně velké améby

## Průvodce

guide-heading = Průvodce { $found }/{ $all }
guide-read = Enter nebo klepnutí: číst
guide-ask = Ještě nenalezeno. Zeptej se na to "Co je to?" v simulaci "{ $scene }".
guide-eat = Ještě nenalezeno. Stráv něco takového ve hře nebo na preparátu.
guide-take = Ještě nenalezeno. Pohlť čelem potravu a stráv ji.
guide-divide = Ještě nenalezeno. Rozděl svou buňku v potravním řetězci.
guide-look = Ještě nenalezeno. Podívej se takto: { $key } mění optiku.
guide-own = Ještě nenalezeno. Zeptej se "Co je to?" na těleso ve vlastním scénáři.
guide-unkept = Co jsi našel, nelze uložit: { $error }

## Dva hráči

two-about = { $what } Hráč 1: myš. Hráč 2: šipky nebo gamepad.
two-versus-about = Kdo sní víc za 90 sekund?
two-together-about = Kolik toho za 90 sekund sníte společně?
two-bot-about = Ty a buňka, kterou řídí program: kdo sní víc za 90 sekund?
two-versus = Proti sobě
two-together = Společně
two-bot = Proti programu
two-sum = Společně { $points }
two-you = Ty
two-program = Program
two-won = Vyhraná kola: { $first } ku { $second }
two-player = Hráč { $number }
two-wins = Vítěz: { $name }, { $best } ku { $others }
two-you-win = Vyhráváš, { $best } ku { $others }
two-bot-wins = Vyhrává program, { $best } ku { $others }
two-together-end = { $points ->
    [one] Společně { $points } bod
    [few] Společně { $points } body
    [many] Společně { $points } bodu
   *[other] Společně { $points } bodů
}
two-draw = { $points ->
    [one] Remíza, každý má { $points } bod
    [few] Remíza, každý má { $points } body
    [many] Remíza, každý má { $points } bodu
   *[other] Remíza, každý má { $points } bodů
}
two-draw-best = { $points ->
    [one] Remíza nejlepších, každý má { $points } bod
    [few] Remíza nejlepších, každý má { $points } body
    [many] Remíza nejlepších, každý má { $points } bodu
   *[other] Remíza nejlepších, každý má { $points } bodů
}

## Cesta do místnosti

join-how = Napiš kód místnosti: 4 až 12 písmen a číslic. Enter vstoupí, Escape se vrátí.
join-who = Dva až čtyři hráči se stejným kódem jsou ve stejné místnosti.
name-how = Napiš jméno do výsledků a místností: nejvýš 12 písmen a číslic. Enter uloží, Escape zpět.

## Hráči

colour-blue = modrá
colour-orange = oranžová
colour-green = zelená
colour-purple = fialová

## Místnost

room-heading = Místnost
room-ready = Připraveno
room-play = Hra
room-rate = Snímky
room-seed = Číslo náhody
room-any-seed = náhodně
room-leave = Odejít
room-seat = { $number } { $name }, { $colour }: { $note }
room-own-name = { $name } (ty)
room-coming = přichází
room-other-version = jiná verze
room-plays = hraje
room-is-ready = připraveno
room-not-ready = ještě ne
room-again = { $news } Kdo je připraven, hraje znovu.
room-match-on = Kód { $code }. Zápas už běží: kdo je připraven, dostane buňku bez hráče, nebo se dívá.
room-waits = Kód { $code }. Zápas začne, až tu budou dva až čtyři hráči a všichni budou připraveni.
room-entering = Kód { $code }. Spojuje se se serverem ...
room-cut = Spojení se serverem je přerušeno.
room-unreachable = Nelze se spojit s počítačem { $host }: { $error }
room-none = { $host } nemá místnosti
room-strange = Server odpovídá jinak než server místností.
room-code = Kód má 4 až 12 písmen a číslic.

## Zápas po síti

match-player = hráč { $number }, { $colour }
match-you-are = Jsi { $player }. Drž tlačítko myši nebo prst na obraze a lez.
match-watch = Díváš se.
match-waiting = Čeká se na ostatní ...
match-cut = Spojení je přerušeno. Obnovuje se ...
match-leave = Ještě jednou Escape: odejít ze zápasu
match-net = { $ping } ms, ztráty { $loss } %, návraty { $back }, snímků nejvýš { $frames } z { $window }
match-end = { $verdict }. Tvoje buňka: { $player }.
match-watched = { $verdict }. Tentokrát jsi jen divák.
match-slide-done = { $stars } za { $time } s
match-slide-late = Čas vypršel: { $done }
match-over = Zápas skončil.
match-silent = Někdo neodpovídá, takže je to remíza.
match-differs = Světy hráčů se před krokem { $step } rozešly, takže je to remíza.
match-kept = { $record } a { $world } jsou vedle nastavení.
match-given = { $record } a { $world } jsou mezi staženými soubory.
match-nobody = V zápase nikdo nepokračuje.

## Simulace

pick-file = soubor
scene-absorb-agar = První jídlo
scene-absorb-agar-about = Buňka mezi krevními destičkami najde agar a pohltí ho
scene-absorb-rigid = Velké sousto
scene-absorb-rigid-about = Buňka mezi krevními destičkami dostihne tuhou buňku a pohltí ji
scene-crawl = Buňka leze
scene-crawl-about = Čtyři typy améb lezou panožkami po volném poli
scene-crowd = Mnoho buněk
scene-crowd-about = Améboidní buňky bloudí a strkají se, v libovolném počtu
scene-dam-break = Protržená hráz
scene-dam-break-about = Sloupec kapaliny se sesype vlastní tíhou
scene-demo = Od všeho trochu
scene-demo-about = Lovící buňky mezi krevními destičkami: všechno najednou, na hraní (bakalářská práce, obr. 3.12)
scene-divide = Buňka se dělí
scene-divide-about = Buňka se mezi krevními destičkami rozdělí; poloviny se rozlezou, vrátí se a splynou
scene-empty = Prázdný prostor
scene-empty-about = Prázdný prostor, se kterým lze začít
scene-game = Hra
scene-game-about = 90 sekund na jídlo: nejdřív agar, pak trepky, větší a větší
scene-grow = Buňka roste
scene-grow-about = Buňka pojídá agar, tráví ho a roste
scene-hunt = Neutrofil loví
scene-hunt-about = Neutrofil loví koky mezi červenými krvinkami: film z padesátých let
scene-leak-stress = Teče buňka?
scene-leak-stress-about = Rostoucí buňka sebou hází mezi krevními destičkami a nic z ní nesmí uniknout
scene-platelets = Krevní destičky
scene-platelets-about = Sonda projíždí hustým polem krevních destiček, v libovolném počtu (bakalářská práce, tabulka 4.1)
scene-pond = Tůň
scene-pond-about = Trepky a améba ve skutečné velikosti
scene-ram-stress = Nárazy ze všech stran
scene-ram-stress-about = Tuhé buňky a sondy narážejí do buňky ze všech stran; dovnitř se dostanou jen pohlcením
scene-squeeze = Úzkou mezerou
scene-squeeze-about = Buňka se protáhne mezerou o polovině svého průměru
tool-steer = Řídit
tool-drag = Táhnout
tool-push = Odstrkovat
tool-spawn = Vložit
tool-remove = Odebrat
tool-follow = Sledovat
tool-ask = Co je to?
tool-look = Rozhlížet se
tool-join = Spojit
tool-wall = Stěna
tool-field = Pole
field-vortex = vír
field-stream = proud
panel-move = Pohyb
panel-bodies = Tělesa
panel-look = Pohled
panel-build = Stavba
panel-time = Čas
panel-scene = Scéna
panel-undo = Vzít zpět
panel-speed = Rychlost
panel-scenarios = Simulace
panel-menu = Nabídka
spawn-coccus = kok
spawn-bacillus = bacil
spawn-rigid-cell = nálevník
spawn-amoeboid = améba
spawn-platelet = destička
spawn-red-cell = krvinka
spawn-probe = sonda
spawn-fluid = kapalina
sandbox-panel = { $key } zase ukáže panel.
sandbox-paused = POZASTAVENO
sandbox-bodies = { $count ->
    [one] { $count } těleso
    [few] { $count } tělesa
    [many] { $count } tělesa
   *[other] { $count } těles
}
sandbox-particles = { $count ->
    [one] { $count } částice
    [few] { $count } částice
    [many] { $count } částice
   *[other] { $count } částic
}
sandbox-step = krok { $time } ms
sandbox-area = plocha { $area } µm²
sandbox-top = max. { $value }
sandbox-legend =
    kruh: částice
    tenká: vzdálenost, lano
    tlustá: kotva, membrána, kloub
    čtverec: čelo  proužek: zadní část
    tečka: vlevo  kroužek: vpravo
    odstín: chemická látka
    jantarová: dotyk
sandbox-stopped = Čas stojí: nejdřív ho pusť dál.
sandbox-no-undo = Není co vzít zpět.
sandbox-nobody = Nikoho nesleduješ: klikni na buňku, kterou chceš sledovat.
sandbox-immobile = Sledovaný organismus neumí lézt.
sandbox-nothing = Tady nic není.
sandbox-short = Táhni od jednoho konce k druhému.
sandbox-occupied = Tady něco překáží.
sandbox-whole = Vidíš celý prostor: nejdřív přibliž.
sandbox-free = Teď nikoho nesleduješ.
sandbox-overlap = Tady není místo: { $what }
sandbox-outside = Za stěnami: { $what }
sandbox-crowded = Víc se sem nevejde.
sandbox-refused = Sem nelze vložit: { $what }

## Fotografie, soubory a hlášení

photo-how = Tažení nebo šipky: posun. Kolečko, { $out } nebo { $in }: přiblížení. { $optics }: optika. { $picture }: uložit snímek. Escape: zpět.
waiting = Mikroskop se chystá ...
quality-lowered = Kvalita je teď { $quality }, aby byl obraz plynulý (Nastavení).
quality-drawn = jako u kresby
file-written = Uloženo: { $file }
file-unwritable = Nelze zapsat { $file }: { $error }
file-unreadable = Nelze přečíst { $file }: { $error }
file-not-text = není to text v UTF-8
file-senseless = Soubor { $file } nedává smysl
file-unfit = { $file } nelze spustit jako simulaci: { $problem }
error-missing = není tam
error-forbidden = přístup je odepřen
error-full = není už místo
error-no-file = není to soubor
error-too-long = je to příliš dlouhé
error-silent = nikdo tam neodpovídá
error-other = systém to odmítá
file-put-aside = { $told }; odložen jako { $aside }
file-added = { $file } je teď v seznamu simulací.
files-added = { $count ->
    [one] { $count } soubor je teď v seznamu simulací.
    [few] { $count } soubory jsou teď v seznamu simulací.
    [many] { $count } souboru je teď v seznamu simulací.
   *[other] { $count } souborů je teď v seznamu simulací.
}
last-game-none = Zatím není odehraná žádná hra.
last-game-broken = Poslední hru nelze znovu přehrát: její záznam je poškozený nebo z jiné verze.
last-game-unkept = Hru nelze uložit: { $error }
settings-unkept = Nastavení nelze uložit: { $error }

## Preparáty: názvy, úkoly a zajímavosti

slide-first-steps-title = První kroky
slide-first-steps-task = Dolez na tři označená místa.
slide-first-steps-fact = Lezoucí buňka tlačí své čelo vpřed růstem aktinových vláken pod membránou a vzadu je zase rozebírá.
slide-first-meal-title = První jídlo
slide-first-meal-task = Stráv šest kousků agaru: tlač se na ně čelem.
slide-first-meal-fact = V roce 1882 pozoroval Ilja Mečnikov, jak se buňky průhledné larvy hvězdice shromáždily kolem trnu. Pochopil, že některé buňky chrání tělo tím, že pojídají, co do něj vnikne.
slide-narrow-gap-title = Úzká mezera
slide-narrow-gap-task = Protáhni se oběma mezerami k označenému místu.
slide-narrow-gap-fact = Jádro je nejtužší částí lezoucí buňky. Kde je otvor menší než asi desetina jeho průřezu, buňka neprojde.
slide-maze-title = Bludiště
slide-maze-task = Najdi cestu bludištěm k označenému místu.
slide-maze-fact = Hlenka Physarum najde nejkratší cestu bludištěm: nejdřív ho celé vyplní, pak se stáhne ze slepých uliček a delších cest.
slide-scent-title = Pach
slide-scent-task = Najdi a stráv tři koky, které nejsou vidět: zabarvení ukazuje jejich pach.
slide-scent-fact = Neutrofil najde bakterie podle peptidů, které z nich unikají: pozná, že je jich na jedné straně těla o procento víc než na druhé.
slide-shy-prey-title = Plachá kořist
slide-shy-prey-task = Chyť a stráv čtyři bacily. Utíkají: zažeň je do kouta.
slide-shy-prey-fact = Escherichia coli plave asi sekundu rovně, desetinu sekundy se převaluje do nového směru a plave dál. Vede-li cesta k lepšímu místu, plave rovně déle.
slide-thrombus-title = Trombus
slide-thrombus-task = Protlač se krevními destičkami, které pruží zpět, k označenému místu.
slide-thrombus-fact = Krevní destičky nemají jádro. Každá je kouskem megakaryocytu, obří buňky kostní dřeně, která jich do krve uvolní tisíce.
slide-big-game-title = Velká kořist
slide-big-game-task = Vyrosti na agaru a pak stráv dvě tuhé buňky.
slide-big-game-fact = Amoeba proteus pojídá nálevníky celé: obklopí každého pohárkem cytoplazmy a stráví ho v potravní vakuole.
slide-red-cells-title = V davu
slide-red-cells-task = Protlač se červenými krvinkami ke koku a stráv ho.
slide-red-cells-fact = Lidská červená krvinka je průměrně 7,8 mikrometru široká, na okraji 2,6 a uprostřed 0,8 mikrometru silná.
slide-two-shapes-title = Tyčinky a kuličky
slide-two-shapes-task = Stráv čtyři tyčinky. Kulaté koky tě jen zasytí.
slide-two-shapes-fact = Světelný mikroskop běžně neukáže nic jemnějšího než asi polovinu vlnové délky, čtvrtinu mikrometru. Mnohé bakterie jsou jen několikrát větší.
slide-flood-title = Záplava
slide-flood-task = Probroď se vodou k oběma označeným místům.
slide-flood-fact = Bakterie, která přestane plavat, se setrvačností posune o méně než šířku atomu: pro tak malé tvory je tření vším a setrvačnost ničím.
slide-little-animals-title = Malá zvířátka
slide-little-animals-task = Stráv čtyři koky, dvě tyčinky a nálevníka a pak se vrať domů ke značce.
slide-little-animals-fact = Antoni van Leeuwenhoek viděl bakterie jako první, v roce 1676, jedinou čočkou menší než hrášek.
slide-predator-title = Dravec
slide-predator-task = Stráv čtyři koky a pak se ukryj na druhé straně. Obr, který jde po tvém pachu, tě pohltí; mezerami ale neprojde.
slide-predator-fact = Améba Dictyostelium caveatum žere améby příbuzných druhů. Z těch, které jsou větší než ona, okusuje kousky, dokud nejsou dost malé na pohlcení.
slide-both-poles-title = Oba póly
slide-both-poles-task = Buďte zároveň na obou koncích každé čáry, každý na jednom.
slide-both-poles-fact = Než se buňka rozdělí, čekají její chromozomy uprostřed, až i poslední z nich drží oba póly: jediný volný zastaví všechny.
slide-sieve-title = Síto
slide-sieve-task = Stravte spolu všech osm bacilů. Sítem proklouznou, vy ne.
slide-sieve-fact = Escherichia coli plave i kanálky jen o 30 procent širšími než ona. Těmi z poloviny užšími projde růstem a dělením.
slide-swarm-title = Hejno
slide-swarm-task = Stravte všech šest bacilů. Jsou stejně rychlí jako vy: jděte na ně z obou stran.
slide-swarm-fact = Neutrofily loví v hejnech: ty, které najdou poškozenou tkáň první, vydávají leukotrien B4, a ten přivolá další zdaleka.

## Způsoby pozorování

sight-bright-field = světlé pole
sight-classic = klasická
sight-dark-field = temné pole
sight-dic = DIC
sight-drawn = kresba
sight-fluorescence = fluorescence
sight-negative-phase-contrast = negativní fáz. kontrast
sight-phase-contrast = fázový kontrast
sight-stained = barvení

## Stránka kolem hry

page-title = microsim - buňka pod mikroskopem
page-heading = microsim: buňka pod mikroskopem
page-canvas = Hra. Nabídkami se prochází šipkami, klávesami Enter a Escape.
page-loading = Načítá se
page-stopped = Hra se zastavila
page-reload = Spustit znovu
page-menu = Nabídka
page-zoom-out = Oddálit
page-zoom-in = Přiblížit
page-lunge = Výpad
page-divide = Rozdělit
page-digest = Trávit
page-more = Soubory, odkazy a soukromí
page-open = Otevřít soubor
page-share = Kopírovat odkaz na poslední hru
page-share-water = Kopírovat odkaz na poslední vodu
page-share-scenario = Kopírovat odkaz na scénář
page-privacy = Nastavení, výsledky a hry zůstávají v tomto prohlížeči. Jen v místnosti se něco odesílá: tvé jméno a co dělá tvá buňka.
page-licences = Licence
page-copied = Odkaz je zkopírován.
page-in-address = Odkaz je v adresním řádku.
page-scene = Scéna
page-no-graphics = Prohlížeč odebral hře grafiku, jako po uspání počítače.
