//! A match over a network, on the screen.

use super::context::AppContext;
use super::follow::Follow;
use super::lobby::clock;
use super::offer::{self, Taking};
use super::parted::keep_parted;
use super::steer::{Hands, draw_prey};
use super::{MainScreen, Next, Screen, chain_scene, new_seed};
use crate::draw::palette::PLAYERS;
use crate::hud::{self, Status, marks, own, places};
use crate::input::{Action, Input, Move};
use crate::network::contest::Match;
use crate::platform;
use crate::rules::food_chain::Deed;
use crate::rules::food_chain::change::Change;
use crate::rules::threat::Alarm;
use crate::slides;
use crate::sound::Cue;
use crate::viewer::{Viewer, first_view};
use crate::words::{self, Key};
use microsim_core::scenario::Slide;
use microsim_core::{Intent, OrganismId};
use std::ops::RangeInclusive;
use std::time::Duration;

/// Time for which the player is told what to do, s.
const ADVICE_TIME: f64 = 9.0;
/// Time within which Escape leaves when it is pressed again, s.
const LEAVING_TIME: f32 = 3.0;
/// Time without a frame after which the player is told that others are waited for, s.
const WAITING_TIME: f32 = 0.5;
/// Time after the end, or after worlds were found to differ, for which the others are told and heard, s.
const LAST_WORD: f32 = 2.0;
/// Time after which a match with somebody who does not answer is a draw, s.
const LONGEST_WAIT: f32 = 30.0;
/// Time for which a cut connection is tried again, s, and time between two trials, s.
const RETURN_TIME: f32 = 30.0;
const RETRY_INTERVAL: f32 = 2.0;
/// Share of a picture's time in which one who comes late takes frames of the past, and bounds of that time.
const CATCH_UP_SHARE: f32 = 0.5;
const CATCH_UP_TIME: RangeInclusive<Duration> = Duration::from_millis(20)..=Duration::from_millis(500);

#[derive(Debug)]
pub(super) struct Contest {
    game: Match,
    viewer: Viewer,
    /// In the food chain the camera follows a cell; else the whole slide is seen.
    follow: Option<Follow>,
    /// The slide that is played, in the language of the player.
    slide: Option<Slide>,
    hands: Hands,
    taking: Taking,
    /// What is written on the key that divides the cell.
    divide_key: String,
    gains: marks::Gains,
    alarm: Alarm,
    /// Frames that were waited for others.
    waiting: u32,
    /// Until when Escape leaves, s.
    leaves_until: f32,
    shows_net: bool,
    /// Since when the connection is cut, and when it is tried again, s.
    cut_since: Option<f32>,
    retries_at: f32,
}

impl Contest {
    pub(super) fn new(game: Match, context: &AppContext) -> Self {
        let (round, screen) = (game.session().round(), context.pen.screen());
        let followed = seen(&game).filter(|_| round.chain().is_some());
        let (follow, around) = followed.map(|cell| Follow::new(round, cell, screen)).unzip();
        let camera = around.unwrap_or_else(|| first_view(round.world(), None, 1.0, screen));
        let slide = round.attempt().map(|attempt| slides::told(attempt.slide()));
        Self {
            viewer: Viewer::with_long_steps(round.world(), camera, game.session().steps()),
            follow,
            slide,
            hands: Hands::default(),
            taking: Taking::default(),
            divide_key: context.settings.keys.label(Action::Divide),
            gains: marks::Gains::default(),
            alarm: Alarm::default(),
            waiting: 0,
            leaves_until: 0.0,
            shows_net: false,
            cut_since: None,
            retries_at: 0.0,
            game,
        }
    }

    /// The changes of which the own cell may take one now.
    fn offer(&self) -> Option<[Change; 3]> {
        living(&self.game).and_then(|own| self.game.session().round().offer(own))
    }

    /// What the player does in a food chain besides crawling; what it clicks at for that is taken out of the input.
    fn act(&mut self, input: &mut Input, context: &AppContext) {
        let offer = self.offer();
        let chosen = self.taking.take(input, &context.pen, offer).map(Deed::Choose);
        let possible = [(Action::Divide, Deed::Divide), (Action::Lunge, Deed::Lunge)].into_iter().zip(self.deeds());
        let mut pressed = possible.filter(|((action, _), is_possible)| *is_possible && input.presses(*action));
        if let Some(deed) = chosen.or_else(|| Some(pressed.next()?.0.1)) {
            self.game.act(deed);
        }
    }

    fn look(&mut self, input: &Input, context: &AppContext) {
        if let (Some(follow), Some(cell)) = (&mut self.follow, seen(&self.game)) {
            let is_steering = self.hands.is_crawling && living(&self.game).is_some();
            follow.look(&mut self.viewer, (self.game.session().round(), cell), (input, is_steering), context);
        }
    }

    fn run(&mut self, input: &Input, context: &mut AppContext) {
        self.hands.note(input, context.settings.click_to_crawl);
        let (pace, digests) = (context.pace, context.settings.digests(input));
        let Self { game, viewer, hands, gains, waiting, .. } = self;
        let goal = game.own().and_then(|own| hands.goal(input, &viewer.camera, game.session().round(), own));
        let Some(room) = &mut context.room else { return };
        let began = platform::now();
        let (least, most) = CATCH_UP_TIME.into_inner();
        let most = Duration::from_secs_f32(CATCH_UP_SHARE * pace.elapsed).clamp(least, most);
        while platform::now() - began < most && game.catch_up() {}
        let mut heard = Vec::new();
        viewer.run(pace, 1.0, game, |game| {
            let round = game.session().round();
            let intent = game.own().map_or(Intent::REST, |own| hands.intent(0, round, own, goal)).digesting(digests);
            let was_equal = game.session().desync().is_none();
            let began = platform::now();
            let is_taken = room.advance(game, intent, clock());
            game.note_time(platform::now() - began);
            let parts = was_equal && game.session().desync().is_some();
            *waiting = if is_taken || parts { 0 } else { *waiting + 1 };
            heard.extend_from_slice(game.session().heard());
            gains.add(game.session().gains().iter().copied());
            game.session().round().world()
        });
        if self.is_alarmed(pace.elapsed) {
            heard.push(Cue::Danger);
        }
        context.play(&heard);
        self.gains.pass(pace.elapsed);
    }

    /// Whether somebody who bites has come near the own cell.
    fn is_alarmed(&mut self, elapsed: f32) -> bool {
        let round = self.game.session().round();
        let cell = living(&self.game).and_then(|own| round.players().nth(own));
        let is_hunted = cell.is_some_and(|cell| chain_scene::is_hunted(round, round.world().view(), cell));
        self.alarm.rings(is_hunted, elapsed)
    }

    /// What the match came to, if it has ended.
    fn outcome(&self, context: &mut AppContext) -> Option<String> {
        let session = self.game.session();
        let round = session.round();
        if let (Some(step), Some(parted)) = (session.desync(), session.parted()) {
            return (session.seconds(self.waiting) >= LAST_WORD)
                .then(|| keep_parted(parted, step, &context.store, platform::hand_over));
        }
        if session.seconds(self.waiting) >= LONGEST_WAIT && !round.is_over() {
            return Some(words::text(Key::MatchSilent).to_owned());
        }
        let last_word = session.seconds(session.frames_over() + self.waiting);
        if !session.is_over() && (!round.is_over() || last_word < LAST_WORD) {
            return None;
        }
        if let Some(record) = round.record() {
            context.keep_game(record, Ok(()));
            context.last_seat = self.game.own().unwrap_or(0);
        }
        let verdict = self.game.plan().way.verdict(round, self.game.names());
        let verdict = ("verdict", (&verdict).into());
        let told = match self.game.own() {
            Some(own) => words::text_with(Key::MatchEnd, &[verdict, ("player", (&player(own)).into())]),
            None => words::text_with(Key::MatchWatched, &[verdict]),
        };
        let is_done = round.attempt().is_some_and(|attempt| attempt.time().is_some());
        let lesson = self.slide.as_ref().filter(|_| is_done);
        Some(lesson.map_or(told.clone(), |slide| format!("{told} {} ({})", slide.fact, slide.source)))
    }

    /// The connection is cut: goes into the room again, for a while.
    fn come_back(&mut self, since: f32, context: &mut AppContext) -> Next {
        let Some(room) = &mut context.room else { return Next::Show(MainScreen::Title) };
        if context.time - since > RETURN_TIME {
            let reason = room.closed().unwrap_or(words::text(Key::MatchNobody)).to_owned();
            context.room = None;
            context.tell(reason);
            return Next::Show(MainScreen::Title);
        }
        if room.closed().is_some() && context.time >= self.retries_at {
            self.retries_at = context.time + RETRY_INTERVAL;
            if let Ok(way) = platform::open_room(&context.party.server, room.code(), &context.party.key) {
                room.reopen(way);
            }
        }
        if room.is_idle() {
            room.finish();
            return Next::Show(MainScreen::Lobby(Some(words::text(Key::MatchOver).to_owned())));
        }
        Next::Stay
    }

    fn advice(&self, context: &AppContext) -> Option<String> {
        let key = if context.time < self.leaves_until {
            Key::MatchLeave
        } else if self.cut_since.is_some() {
            Key::MatchCut
        } else if self.game.session().seconds(self.waiting) > WAITING_TIME {
            Key::MatchWaiting
        } else {
            Key::MatchWatch
        };
        let round = self.game.session().round();
        let time = round.world().time();
        match living(&self.game) {
            Some(own) if key == Key::MatchWatch && time < ADVICE_TIME => Some(player_advice(own, self.slide.as_ref())),
            Some(_) if key == Key::MatchWatch => round
                .chain()
                .and_then(|_| chain_scene::advice(time, None, &self.divide_key, platform::covered_height() > 0.0)),
            _ => Some(words::text(key).to_owned()),
        }
    }

    /// How the network is, for the status line.
    fn net(&self) -> String {
        let session = self.game.session();
        let (ping, loss) = session.way();
        let (ping, loss) =
            (ping.map_or_else(|| "-".to_owned(), |ping| ping.to_string()), words::number(100.0 * loss, 0));
        let tally = session.tally();
        let frames = [("frames", tally.deepest.into()), ("window", session.window().into())];
        let way = [("ping", (&ping).into()), ("loss", (&loss).into())];
        words::text_with(Key::MatchNet, &[&way[..], &[("back", tally.rollbacks.into())], &frames].concat())
    }
}

impl Screen for Contest {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let seed = new_seed(context);
        let Some(room) = &mut context.room else { return Next::Show(MainScreen::Title) };
        let current = if self.cut_since.is_none() { Some(&mut self.game) } else { None };
        // No other match begins while this one is on; after a cut this one begins again.
        if let Some(game) = room.update(clock(), seed, current) {
            *self = Self::new(game, context);
            return Next::Stay;
        }
        let is_cut = room.closed().is_some();
        let is_alone = self.game.own().is_none() && room.is_idle();
        if input.step == Some(Move::Back) {
            if context.time < self.leaves_until {
                context.room = None;
                return Next::Show(MainScreen::Title);
            }
            self.leaves_until = context.time + LEAVING_TIME;
        }
        self.shows_net ^= input.presses(Action::Plots);
        if is_cut {
            self.cut_since.get_or_insert(context.time);
        }
        if let Some(since) = self.cut_since {
            return self.come_back(since, context);
        }
        let mut input = input.clone();
        self.act(&mut input, context);
        self.run(&input, context);
        self.look(&input, context);
        let over = is_alone.then(|| words::text(Key::MatchOver).to_owned());
        let Some(news) = self.outcome(context).or(over) else { return Next::Stay };
        if let Some(room) = &mut context.room {
            room.finish();
        }
        Next::Show(MainScreen::Lobby(Some(news)))
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.viewer.camera.resize(context.pen.screen());
        let round = self.game.session().round();
        let (view, camera) = (self.viewer.view(round.world()), &self.viewer.camera);
        context.paint(view, camera);
        let (time, advice) = (context.motion(), self.advice(context));
        let style = marks::Style { camera, time, is_classic: context.settings.classic_arrows, key: None };
        let pen = &mut context.pen;
        for (k, id) in round.players().enumerate() {
            if let Some(cell) = view.organism(id) {
                let width = if Some(k) == self.game.own() { 1.0 } else { own::OTHERS };
                own::draw_own(pen, &style, cell, Some(k + 1), width);
                own::draw_lunge(pen, &style, cell, round.lunge_of(k));
            }
        }
        places::draw_food(pen, &style, round, view);
        places::draw_places(pen, &style, round, view);
        let mut taken = marks::MarkLayout::default();
        if round.chain().is_none() {
            self.gains.draw(pen, &style, &mut taken);
        }
        let looked_at = seen(&self.game);
        if let Some(cell) = looked_at {
            chain_scene::draw(pen, &style, round, view, (cell, living(&self.game).is_some()));
        }
        if let Some(cell) = self.game.own().and_then(|own| round.players().nth(own)) {
            draw_prey(pen, &style, &mut taken, round, view, cell);
        }
        let note = if self.shows_net { self.net() } else { String::new() };
        let of_points = || {
            let referee = round.referee();
            (self.game.plan().way.summary(round), [referee.time_left(), referee.game().time])
        };
        let life = looked_at.and_then(|cell| chain_scene::status(round, cell));
        let starves = life.is_some();
        let (score, time) = life.map_or_else(of_points, |(told, time)| (vec![(None, told)], time));
        hud::draw_status(pen, &Status { score: &score, time, starves, is_calm: style.time.is_none(), note: &note });
        match (self.offer(), advice) {
            (Some(offered), _) => offer::draw(pen, offered),
            (None, Some(advice)) => hud::draw_advice(pen, &advice, platform::covered_height()),
            (None, None) => {}
        }
    }

    fn is_scene(&self) -> bool {
        true
    }

    fn deeds(&self) -> [bool; 2] {
        [living(&self.game).is_some() && self.game.session().round().chain().is_some(); 2]
    }

    fn name(&self) -> String {
        let session = self.game.session();
        format!("match-{}-{}", session.frame(), session.round().scores().iter().sum::<u32>())
    }

    fn is_at_stake(&self) -> bool {
        true
    }
}

/// The number of this player, while a cell of its line lives.
fn living(game: &Match) -> Option<usize> {
    let chain = game.session().round().chain();
    game.own().filter(|own| chain.is_none_or(|chain| !chain.is_gone(*own)))
}

/// The cell of this player, or of the first one who lives.
fn seen(game: &Match) -> Option<OrganismId> {
    chain_scene::seen(game.session().round(), living(game))
}

/// A player, for people.
fn player(own: usize) -> String {
    let colour = words::text(PLAYERS[own % PLAYERS.len()].0);
    words::text_with(Key::MatchPlayer, &[("number", (own as u32 + 1).into()), ("colour", colour.into())])
}

/// What a player is told at the beginning.
fn player_advice(own: usize, slide: Option<&Slide>) -> String {
    let you = words::text_with(Key::MatchYouAre, &[("player", (&player(own)).into())]);
    slide.map_or(you.clone(), |slide| format!("{} {you}", slide.task))
}
