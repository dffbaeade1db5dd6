//! The game, 90 seconds to eat, and slides.

use super::context::AppContext;
use super::{Next, Overlay, Paused, Screen};
use crate::draw::palette::ALERT;
use crate::hud::{self, Status, marks, places, tint};
use crate::input::{Action, Input, Move};
use crate::platform;
use crate::rules::attempt::Attempt;
use crate::rules::game::GameChoice;
use crate::rules::hint::Hints;
use crate::rules::round::Round;
use crate::slides::SLIDES;
use crate::sound::Cue;
use crate::viewer::{Viewer, first_view};
use macroquad::miniquad;
use microsim_core::Intent;
use microsim_core::replay::Replay;

/// Units that are seen from bottom to top at first; more as the cell grows.
const VIEW: f32 = 62.0;
/// Time for which the player is told the task of a slide, and what to do, s.
const TASK_TIME: f64 = 9.0;
/// How strong the tint of a chemical is at most.
const SCENT: f32 = 0.6;
const ADVICE_TIME: f64 = 7.0;

/// A round on the screen.
#[derive(Debug)]
pub(super) struct Play {
    round: Round,
    /// What is played, to start it again.
    played: Paused,
    viewer: Viewer,
    gains: marks::Gains,
    /// What was heard in this frame.
    heard: Vec<Cue>,
    /// Area of the cell at the beginning, and what the camera has made of its growth.
    first_area: f32,
    grown: f32,
}

impl Play {
    /// A new round.
    ///
    /// # Errors
    /// Says what is wrong with the scenario, for the player to read.
    pub(super) fn start(context: &AppContext) -> Result<Self, String> {
        Ok(Self::new(context.game.round(seed(context))?, Paused::Round, context))
    }

    /// A slide.
    ///
    /// # Errors
    /// As for [`Play::start`].
    pub(super) fn slide(index: usize, context: &AppContext) -> Result<Self, String> {
        let name = SLIDES.get(index).map_or("", |slide| slide.name);
        let game = GameChoice { source: name.into(), overrides: Vec::new(), seed: None };
        Ok(Self::new(game.round(seed(context))?, Paused::Slide(index), context))
    }

    /// The last round again.
    ///
    /// # Errors
    /// When there is none, or it cannot be read.
    pub(super) fn replay(context: &AppContext) -> Result<Self, String> {
        let record = context.last_game.as_ref().ok_or("No game has been played yet.")?;
        let replay = Replay::read(record).map_err(|error| format!("the last game: {error}"))?;
        Ok(Self::new(Round::again(&replay)?, Paused::Replay, context))
    }

    fn new(round: Round, played: Paused, context: &AppContext) -> Self {
        let world = round.world();
        let camera = first_view(world, Some(round.player()), VIEW, context.pen.screen());
        let first_area = world.view().organism(round.player()).map_or(1.0, |cell| cell.cytoplasm_area());
        let viewer = Viewer::new(world, camera);
        Self { round, played, viewer, gains: marks::Gains::default(), heard: Vec::new(), first_area, grown: 1.0 }
    }

    fn intent(&self, input: &Input, context: &AppContext) -> Intent {
        let goal = input.is_held.then(|| self.viewer.camera.to_room(input.cursor));
        let moving = goal.and_then(|goal| Intent::toward(goal).ok()).unwrap_or(Intent::REST);
        moving.digesting(context.settings.digests(input))
    }

    fn run(&mut self, input: &Input, context: &AppContext) {
        let intent = self.intent(input, context);
        let Self { round, viewer, gains, heard, .. } = self;
        heard.clear();
        viewer.run(context.pace, 1.0, round, |round| {
            round.step(intent);
            heard.extend(round.heard());
            gains.add(round.referee().gains());
            round.world()
        });
        self.gains.pass(context.pace.elapsed);
    }

    /// The camera follows the cell, and steps back as it grows.
    fn look(&mut self, input: &Input, context: &AppContext) {
        let cell = self.round.world().view().organism(self.round.player());
        let wanted = cell.map_or(1.0, |cell| (cell.cytoplasm_area() / self.first_area).max(0.1).powf(0.3));
        let step = self.grown + (wanted - self.grown) * (1.0 - (-1.5 * context.pace.elapsed).exp());
        self.viewer.camera.zoom(self.grown / step, 0.5 * context.pen.screen());
        self.grown = step;
        let at = self.viewer.place_of(self.round.world(), Some(self.round.player()));
        let looks_ahead = input.is_held && !self.round.is_replay() && context.motion().is_some();
        let cursor = looks_ahead.then_some(input.cursor);
        self.viewer.look(input.zoom(), input.wheel, at, cursor, context.pace.elapsed);
    }

    fn advice(&self, hints: &Hints, key: Option<&str>, has_buttons: bool) -> Option<String> {
        let time = self.round.world().time();
        if self.round.is_replay() {
            None
        } else if let Some(attempt) = self.round.attempt() {
            let what = held_to_crawl(has_buttons);
            (time < TASK_TIME).then(|| format!("{} Hold {what} to crawl.", attempt.slide().task))
        } else if let Some(key) = key.filter(|_| hints.can_digest() && self.round.referee().score() == 0) {
            Some(format!("Hold {key} to digest what you have taken in"))
        } else if time < ADVICE_TIME {
            let what = held_to_crawl(has_buttons);
            Some(format!("Hold {what} to crawl. Push your front against food."))
        } else {
            None
        }
    }
}

/// Every round has a seed of its own, except for pictures that must come out the same.
fn seed(context: &AppContext) -> u64 {
    let milliseconds = 1000.0 * miniquad::date::now();
    if context.pace.is_exact { 1 } else { milliseconds as u64 }
}

/// What the player holds to crawl.
fn held_to_crawl(has_buttons: bool) -> &'static str {
    if has_buttons { "a finger on the picture" } else { "the left mouse button" }
}

impl Screen for Play {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.has_lost_focus || input.presses(Action::Pause) || input.step == Some(Move::Back) {
            return Next::Open(Overlay::Pause(self.played));
        }
        if input.presses(Action::Restart) {
            return self.played.restart();
        }
        self.run(input, context);
        context.play(&self.heard);
        self.look(input, context);
        if self.round.is_over() {
            let result = Box::new(self.round.result());
            let is_slide = result.attempt.is_some();
            return Next::Open(if is_slide { Overlay::SlideEnd(result, self.played) } else { Overlay::End(result) });
        }
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.viewer.camera.resize(context.pen.screen());
        let (view, camera) = (self.viewer.view(self.round.world()), &self.viewer.camera);
        context.paint(view, camera);
        if self.round.attempt().is_some() {
            view.chemicals()
                .for_each(|(_, chemical)| tint::draw_chemical(context.pen.canvas(), camera, chemical, ALERT, SCENT));
        }
        if !context.is_top {
            return;
        }
        let hints = Hints::of(view, self.round.player());
        let covered = platform::covered_height();
        let label = || if covered > 0.0 { "Digest".to_owned() } else { context.settings.keys.label(Action::Consume) };
        let key = context.settings.hold_to_digest.then(label);
        let time = context.motion();
        let style = marks::Style { camera, time, is_classic: context.settings.classic_arrows, key: key.as_deref() };
        let advice = self.advice(&hints, key.as_deref(), covered > 0.0);
        let pen = &mut context.pen;
        let mut taken = marks::MarkLayout::default();
        if let Some(attempt) = self.round.attempt() {
            places::draw_food(pen, &style, view);
            places::draw_places(pen, &style, attempt.goals());
        }
        marks::draw_held(pen, &style, &mut taken, &hints.held);
        self.gains.draw(pen, &style, &mut taken);
        marks::draw_targets(pen, &style, &mut taken, &hints.targets);
        let referee = self.round.referee();
        let note = match (self.round.is_replay(), self.round.mismatch()) {
            (false, _) => "",
            (true, None) => "Replay",
            (true, Some(_)) => "Replay, not as it was played",
        };
        let time = [referee.time_left(), referee.game().time];
        let points = || format!("Score {}", referee.score());
        let score = &self.round.attempt().map_or_else(points, Attempt::summary);
        hud::draw_status(pen, &Status { score, time, is_calm: context.settings.reduced_motion, note });
        if let Some(advice) = advice {
            hud::draw_advice(pen, &advice, covered);
        }
    }

    fn is_scene(&self) -> bool {
        true
    }

    fn name(&self) -> String {
        let what = if self.round.is_replay() { "replay-of-" } else { "" };
        let (step, score) = (self.round.world().step_index(), self.round.referee().score());
        format!("{what}{}-{step}-{score}", self.round.name())
    }

    fn is_at_stake(&self) -> bool {
        !self.round.is_replay() && !self.round.is_over()
    }
}
