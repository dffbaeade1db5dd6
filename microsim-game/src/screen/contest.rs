//! A match over a network, on the screen.

use super::context::AppContext;
use super::lobby::clock;
use super::steer::{Hands, draw_prey};
use super::{MainScreen, Next, Screen};
use crate::hud::{self, Status, marks, own, places};
use crate::input::{Action, Input, Move};
use crate::network::room::Match;
use crate::platform;
use crate::viewer::{Viewer, first_view};

/// Time for which the player is told what to do, s.
const ADVICE_TIME: f64 = 7.0;
/// Time within which Escape leaves when it is pressed again, s.
const LEAVING_TIME: f32 = 3.0;
/// Frames without a new one after which the player is told that others are waited for.
const PATIENCE: u32 = 15;
/// Frames after the end for which a last word of the others is waited for.
const LAST_WORD: u32 = 60;
/// The same after which a match with somebody who does not answer is a draw.
const LONGEST_WAIT: u32 = 900;
/// Files of a match that came apart.
const RECORD: &str = "desync.replay";
const WORLD: &str = "desync.snapshot";

#[derive(Debug)]
pub(super) struct Contest {
    game: Match,
    viewer: Viewer,
    hands: Hands,
    gains: marks::Gains,
    /// Frames that were waited for others.
    waiting: u32,
    /// Until when Escape leaves, s.
    leaves_until: f32,
    shows_net: bool,
}

impl Contest {
    pub(super) fn new(game: Match, context: &AppContext) -> Self {
        let (world, steps) = (game.session().round().world(), game.session().steps());
        let viewer = Viewer::with_long_steps(world, first_view(world, None, 1.0, context.pen.screen()), steps);
        let (hands, gains) = (Hands::default(), marks::Gains::default());
        Self { game, viewer, hands, gains, waiting: 0, leaves_until: 0.0, shows_net: false }
    }

    fn run(&mut self, input: &Input, context: &mut AppContext) {
        self.hands.note(input, context.settings.click_to_crawl);
        let (pace, digests) = (context.pace, context.settings.digests(input));
        let Self { game, viewer, hands, gains, waiting, .. } = self;
        let goal = hands.goal(input, &viewer.camera, game.session().round(), game.own());
        let Some(room) = &mut context.room else { return };
        let mut heard = Vec::new();
        viewer.run(pace, 1.0, game, |game| {
            let round = game.session().round();
            let cell = round.players().nth(game.own()).unwrap_or(round.player());
            let intent = hands.intent(0, round, cell, goal).digesting(digests);
            let is_taken = game.advance(room, intent, clock());
            *waiting = if is_taken { 0 } else { *waiting + 1 };
            heard.extend_from_slice(game.session().heard());
            gains.add(game.session().gains().iter().copied());
            game.session().round().world()
        });
        context.play(&heard);
        self.gains.pass(pace.elapsed);
    }

    /// What the match came to, if it has ended.
    fn outcome(&self, context: &mut AppContext) -> Option<String> {
        let session = self.game.session();
        let round = session.round();
        if let Some(step) = session.desync() {
            let parts = [round.record(), round.world().to_snapshot().ok()];
            let kept = [RECORD, WORLD].into_iter().zip(parts);
            let kept = kept.filter_map(|(name, bytes)| Some(context.store.write(name, &bytes?)));
            let are_kept = kept.filter(Result::is_ok).count() == 2;
            let files =
                if are_kept { format!(" {RECORD} and {WORLD} are beside the settings.") } else { String::new() };
            return Some(format!("The worlds of the players differ before step {step}, so it is a draw.{files}"));
        }
        if self.waiting >= LONGEST_WAIT && !round.is_over() {
            return Some("Somebody does not answer, so it is a draw.".to_owned());
        }
        let last_word = session.frames_over() + self.waiting;
        if !session.is_over() && (!round.is_over() || last_word < LAST_WORD) {
            return None;
        }
        if let Some(record) = round.record() {
            context.keep_game(record, Ok(()));
        }
        Some(format!("{}. You were player {}.", self.game.way().verdict(&round.scores()), self.game.own() + 1))
    }

    fn advice(&self, context: &AppContext) -> Option<String> {
        let time = self.game.session().round().world().time();
        if context.time < self.leaves_until {
            Some("Escape again: leave the match".to_owned())
        } else if self.waiting > PATIENCE {
            Some("Waiting for the others ...".to_owned())
        } else {
            let text =
                || format!("You are player {}. Hold the mouse button or a finger to crawl.", self.game.own() + 1);
            (time < ADVICE_TIME).then(text)
        }
    }

    /// How the network is, for the status line.
    fn net(&self) -> String {
        let session = self.game.session();
        let (ping, loss) = session.way();
        let ping = ping.map_or_else(|| "-".to_owned(), |ping| ping.to_string());
        let tally = session.tally();
        format!(
            "{ping} ms, {:.0} % lost, back {} times, {} frames at most",
            100.0 * loss,
            tally.rollbacks,
            tally.deepest
        )
    }
}

impl Screen for Contest {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let Some(room) = &mut context.room else { return Next::Show(MainScreen::Title) };
        // No other match begins while this one is on.
        let _ = room.update(clock(), 0, Some(&mut self.game));
        if let Some(reason) = room.closed().map(str::to_owned) {
            context.room = None;
            context.tell(reason);
            return Next::Show(MainScreen::Title);
        }
        if input.step == Some(Move::Back) {
            if context.time < self.leaves_until {
                context.room = None;
                return Next::Show(MainScreen::Title);
            }
            self.leaves_until = context.time + LEAVING_TIME;
        }
        self.shows_net ^= input.presses(Action::Plots);
        self.run(input, context);
        let Some(news) = self.outcome(context) else { return Next::Stay };
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
        let is_calm = context.settings.reduced_motion;
        let pen = &mut context.pen;
        for (k, id) in round.players().enumerate() {
            if let Some(cell) = view.organism(id) {
                own::draw_own(pen, &style, cell, Some(k + 1), k == self.game.own());
            }
        }
        places::draw_food(pen, &style, view);
        let mut taken = marks::MarkLayout::default();
        self.gains.draw(pen, &style, &mut taken);
        if let Some(cell) = round.players().nth(self.game.own()) {
            draw_prey(pen, &style, &mut taken, round, view, cell);
        }
        let referee = round.referee();
        let score = self.game.way().summary(&round.scores());
        let note = if self.shows_net { self.net() } else { String::new() };
        let time = [referee.time_left(), referee.game().time];
        hud::draw_status(pen, &Status { score: &score, time, is_calm, note: &note });
        if let Some(advice) = advice {
            hud::draw_advice(pen, &advice, platform::covered_height());
        }
    }

    fn is_scene(&self) -> bool {
        true
    }

    fn name(&self) -> String {
        let session = self.game.session();
        format!("match-{}-{}", session.frame(), session.round().scores().iter().sum::<u32>())
    }

    fn is_at_stake(&self) -> bool {
        true
    }
}
