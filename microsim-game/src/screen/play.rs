//! The game: 90 seconds to eat.

use super::end::End;
use super::pause::{Over, Pause};
use super::{Change, Context, GameChoice, Screen};
use crate::args::Scene;
use crate::hud::{self, Status, marks};
use crate::input::{Action, Input, Move};
use crate::rules::hint::Hints;
use crate::rules::round::Round;
use crate::viewer::{Viewer, first_view};
use macroquad::miniquad;
use microsim_core::Intent;
use microsim_core::replay::Replay;
use microsim_core::scenario::Scenario;

/// Units that are seen from bottom to top at first; more as the cell grows.
const VIEW: f32 = 62.0;
/// Time for which the player is told what to do, s.
const ADVICE_TIME: f64 = 7.0;

/// A round on the screen.
#[derive(Debug)]
pub struct Play {
    round: Round,
    viewer: Viewer,
    gains: marks::Gains,
    /// Area of the cell at the beginning, and what the camera has made of its growth.
    first_area: f32,
    grown: f32,
}

impl GameChoice {
    /// The scenario of the next round.
    fn scenario(&self, seed: u64) -> Result<Scenario, String> {
        let text = self.scene.text()?;
        let mut scenario = Scenario::parse(&text, &self.overrides).map_err(|diagnostics| diagnostics.to_string())?;
        scenario.set_seed(self.seed.unwrap_or(seed));
        Ok(scenario)
    }

    /// What scores are kept under: the scenario and what was changed of it.
    #[must_use]
    pub fn label(&self) -> String {
        let seed = self.seed.map(|seed| ("seed".to_owned(), seed.to_string()));
        let changes = self.overrides.iter().chain(&seed).map(|(key, value)| format!(", {key} = {value}"));
        let scene = match &self.scene {
            Scene::File(path) => path.canonicalize().unwrap_or_else(|_| path.clone()).display().to_string(),
            builtin => builtin.to_string(),
        };
        scene + &changes.collect::<String>()
    }

    /// Time of the game, s, if it is one.
    #[must_use]
    pub fn time(&self) -> Option<f32> {
        Some(self.scenario(1).ok()?.game()?.time)
    }

    /// Whether it can be played.
    ///
    /// # Errors
    /// Says what is wrong with it, for the player to read.
    pub fn check(&self) -> Result<(), String> {
        Round::new(&self.scenario(1)?).map(drop)
    }
}

impl Play {
    /// A new round in place of all other screens.
    pub fn start(context: &mut Context) -> Change {
        // Every round is another one, but for pictures that must come out the same.
        let milliseconds = 1000.0 * miniquad::date::now();
        let seed = if context.pace.is_exact { 1 } else { milliseconds as u64 };
        let round = context.game.scenario(seed).and_then(|scenario| Round::new(&scenario));
        Self::open(round, context)
    }

    /// The last round again.
    pub fn replay(context: &mut Context) -> Change {
        let Some(record) = &context.last_game else {
            context.tell("No game has been played yet.");
            return Change::Stay;
        };
        let replay = Replay::read(record).map_err(|error| format!("the last game: {error}"));
        Self::open(replay.and_then(|replay| Round::again(&replay)), context)
    }

    fn open(round: Result<Round, String>, context: &mut Context) -> Change {
        let round = match round {
            Ok(round) => round,
            Err(problem) => {
                context.tell(problem);
                return Change::Stay;
            }
        };
        let world = round.world();
        let camera = first_view(world, Some(round.player()), VIEW, context.pen.screen());
        let first_area = world.view().organism(round.player()).map_or(1.0, |cell| cell.cytoplasm_area());
        let viewer = Viewer::new(world, camera);
        Change::reset(Self { round, viewer, gains: marks::Gains::default(), first_area, grown: 1.0 })
    }

    fn kind(&self) -> Over {
        if self.round.is_replay() { Over::Replay } else { Over::Round }
    }

    fn intent(&self, input: &Input) -> Intent {
        let goal = input.is_held.then(|| self.viewer.camera.to_room(input.cursor));
        let moving = goal.and_then(|goal| Intent::toward(goal).ok()).unwrap_or(Intent::REST);
        moving.digesting(input.holds(Action::Consume))
    }

    fn run(&mut self, input: &Input, context: &Context) {
        let intent = self.intent(input);
        let Self { round, viewer, gains, .. } = self;
        viewer.run(context.pace, 1.0, round, |round| {
            round.step(intent);
            gains.add(round.referee().gains());
            round.world()
        });
        self.gains.pass(context.pace.elapsed);
    }

    /// The camera follows the cell, and steps back as it grows.
    fn look(&mut self, input: &Input, context: &Context) {
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

    fn advice(&self, hints: &Hints, context: &Context) -> Option<String> {
        let key = context.settings.keys.label(Action::Consume);
        let time = self.round.world().time();
        if self.round.is_replay() {
            None
        } else if hints.can_digest() && self.round.referee().score() == 0 {
            Some(format!("Hold {key} to digest what you have taken in"))
        } else if time < ADVICE_TIME {
            Some("Hold the left mouse button to crawl. Push your front against food.".to_owned())
        } else {
            None
        }
    }
}

impl Screen for Play {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        let pauses = input.has_lost_focus || input.presses(Action::Pause) || input.step == Some(Move::Back);
        if pauses {
            return Change::push(Pause::new(self.kind()));
        }
        if input.presses(Action::Restart) {
            return self.kind().restart(context);
        }
        self.run(input, context);
        self.look(input, context);
        if self.round.is_over() {
            return Change::push(End::new(&self.round, context));
        }
        Change::Stay
    }

    fn draw(&mut self, context: &mut Context) {
        self.viewer.camera.resize(context.pen.screen());
        let (view, camera) = (self.viewer.view(self.round.world()), &self.viewer.camera);
        context.paint(view, camera);
        if !context.is_top {
            return;
        }
        let hints = Hints::of(view, self.round.player());
        let (key, time) = (context.settings.keys.label(Action::Consume), context.motion());
        let style = marks::Style { camera, time, is_classic: context.settings.classic_arrows, key: &key };
        let advice = self.advice(&hints, context);
        let pen = &mut context.pen;
        let mut taken = marks::Taken::default();
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
        hud::draw_status(pen, &Status { score: referee.score(), time, is_calm: context.settings.reduced_motion, note });
        advice.into_iter().for_each(|advice| hud::draw_advice(pen, &advice));
    }

    fn is_overlay(&self) -> bool {
        false
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
