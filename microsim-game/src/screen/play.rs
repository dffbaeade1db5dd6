//! The game, 90 seconds to eat, and slides.

use super::chain_scene;
use super::context::AppContext;
use super::done::DoneNote;
use super::follow::Follow;
use super::steer::{Hands, draw_prey, first_advice, held_to_crawl, optics_advice, targets_of};
use super::{Next, Overlay, Paused, Screen, new_seed};
use crate::draw::palette::ALERT;
use crate::game_choice::GameChoice;
use crate::guide;
use crate::hud::pulse::Pulses;
use crate::hud::{self, Status, marks, own, places, tint};
use crate::input::{Action, Input, Move};
use crate::platform;
use crate::rules::attempt::Attempt;
use crate::rules::bot::Bot;
use crate::rules::food_chain::NAME;
use crate::rules::ghost::Ghost;
use crate::rules::hint::{Hints, taken_in};
use crate::rules::lesson::FirstDeed;
use crate::rules::round::Round;
use crate::rules::two_players::{self, TwoPlayers};
use crate::slides;
use crate::sound::Cue;
use crate::store::settings::Settings;
use crate::ui::pen::Pen;
use crate::viewer::{Viewer, first_view};
use crate::words::{self, Key};
use microsim_core::replay::Replay;
use microsim_core::{OrganismId, View};

/// Time for which the player is told the task of a slide, and what to do, s.
const TASK_TIME: f64 = 9.0;
/// How strong the tint of a chemical is at most.
const SCENT: f32 = 0.4;
/// Entries of the guide that whoever crawls has seen.
const OWN_BODY: [&str; 3] = ["amoeboid-cell", "membrane", "pseudopod"];
const ADVICE_TIME: f64 = 7.0;
/// Time at the end in which it is said that only what is digested counts, s.
const LAST_TIME: f32 = 8.0;
/// A ghost is given up when a step takes longer than this with it, ms.
const GHOST_STEP: f32 = 10.0;

/// A round on the screen.
#[derive(Debug)]
pub(super) struct Play {
    round: Round,
    /// What is played, to start it again.
    played: Paused,
    /// The task of a slide, in the language of the player.
    task: Option<String>,
    viewer: Viewer,
    gains: marks::Gains,
    pulses: Pulses,
    done: DoneNote,
    /// Most of each chemical so far.
    fullest: Vec<f32>,
    /// What was heard in this frame.
    heard: Vec<Cue>,
    follow: Follow,
    /// The player whose cell is looked at.
    own: usize,
    hands: Hands,
    /// How two cells play, if it is a round of two, and who steers the second one in place of a player.
    two: Option<TwoPlayers>,
    bot: Option<Bot>,
    /// The player's best life in this water.
    ghost: Option<Ghost>,
    /// What is written on the keys that divide the cell and change the optics.
    divide_key: String,
    optics_key: String,
}

impl Play {
    /// A new round of the game, or of the one beside it.
    ///
    /// # Errors
    /// Says what is wrong with the scenario, for the player to read.
    pub(super) fn start(played: Paused, context: &AppContext) -> Result<Self, String> {
        Ok(Self::new(context.game_of(played).round(new_seed(context))?, played, context))
    }

    /// A slide.
    ///
    /// # Errors
    /// As for [`Play::start`].
    pub(super) fn slide(index: usize, context: &AppContext) -> Result<Self, String> {
        let name = slides::all().nth(index).map_or("", |slide| slide.name);
        let game = GameChoice { source: name.into(), overrides: Vec::new(), seed: None };
        Ok(Self::new(game.round(new_seed(context))?, Paused::Slide(index), context))
    }

    /// The food chain.
    ///
    /// # Errors
    /// As for [`Play::start`].
    pub(super) fn food_chain(seed: u64, context: &AppContext) -> Result<Self, String> {
        let game = GameChoice { source: NAME.into(), overrides: Vec::new(), seed: Some(seed) };
        Ok(Self::new(game.round(seed)?, Paused::FoodChain(seed), context))
    }

    /// Two cells on one slide.
    ///
    /// # Errors
    /// As for [`Play::start`].
    pub(super) fn two_players(way: TwoPlayers, context: &AppContext) -> Result<Self, String> {
        let game = GameChoice { source: two_players::NAME.into(), overrides: Vec::new(), seed: None };
        Ok(Self::new(game.round(new_seed(context))?, Paused::TwoPlayers(way), context))
    }

    /// The last round again.
    ///
    /// # Errors
    /// When there is none, or it cannot be read.
    pub(super) fn replay(context: &AppContext) -> Result<Self, String> {
        let record = context.last_game.as_ref().ok_or_else(|| words::text(Key::LastGameNone))?;
        let replay = Replay::read(record).ok().and_then(|replay| Round::again(&replay).ok());
        let round = replay.ok_or_else(|| words::text(Key::LastGameBroken))?;
        Ok(Self::new(round, Paused::Replay, context))
    }

    fn new(round: Round, played: Paused, context: &AppContext) -> Self {
        let world = round.world();
        // Of a match in the food chain one line is followed.
        let is_of_lines = played == Paused::Replay && round.chain().is_some();
        let two = (round.players().count() > 1 && !is_of_lines).then_some(match played {
            Paused::TwoPlayers(way) => way,
            _ => TwoPlayers::Versus,
        });
        let has_ghost = platform::KEEPS_GHOSTS && round.chain().is_some() && !round.is_replay();
        let best_life = if has_ghost { context.best_life.record() } else { None };
        let ghost = best_life.and_then(|record| Ghost::of(record, world));
        let own = if is_of_lines { context.last_seat } else { 0 };
        let screen = context.pen.screen();
        let seen = chain_scene::seen(&round, Some(own)).unwrap_or(round.player());
        let (follow, around) = Follow::new(&round, seen, screen);
        let camera = if two.is_some() { first_view(world, None, 1.0, screen) } else { around };
        let viewer = Viewer::new(world, camera);
        Self {
            bot: two.and_then(|way| way.bot(world.config().seed)),
            task: round.attempt().map(|attempt| slides::told(attempt.slide()).task),
            round,
            played,
            viewer,
            gains: marks::Gains::default(),
            pulses: Pulses::default(),
            done: DoneNote::default(),
            fullest: Vec::new(),
            heard: Vec::new(),
            follow,
            own,
            hands: Hands::default(),
            two,
            ghost,
            divide_key: context.settings.keys.label(Action::Divide),
            optics_key: context.settings.keys.label(Action::Optics),
        }
    }

    fn run(&mut self, input: &Input, context: &mut AppContext) {
        let was_crawling = self.hands.is_crawling;
        self.hands.note(input, context.settings.click_to_crawl);
        self.pulses.pass(context.pace.elapsed);
        if self.hands.is_crawling && !was_crawling && !self.round.is_replay() {
            self.pulses.call(self.viewer.camera.to_room(input.cursor));
        }
        let goals = self.hands.goals(input, &self.viewer.camera, &self.round, self.two);
        let digests = context.settings.digests(input);
        let Self { round, viewer, gains, pulses, heard, hands, bot, ghost, .. } = self;
        let (mut digested, mut has_eaten) = (Vec::new(), false);
        heard.clear();
        viewer.run(context.pace, context.settings.pace(), round, |round| {
            let mut intents = hands.intents(round, goals, digests);
            if let (Some(bot), Some(cell), Some(intent)) = (bot.as_mut(), round.players().nth(1), intents.get_mut(1)) {
                *intent = bot.intent(round.world(), cell);
            }
            round.step_all(&intents);
            ghost.iter_mut().for_each(Ghost::step);
            heard.extend(round.heard());
            gains.add(round.gains());
            let cells: Vec<OrganismId> = round.players().collect();
            taken_in(round.world(), &cells).for_each(|at| {
                pulses.take(at);
                has_eaten = true;
            });
            digested.extend(round.gains().map(|gain| gain.kind));
            round.world()
        });
        if self.viewer.step_ms() > GHOST_STEP {
            self.ghost = None;
        }
        self.gains.pass(context.pace.elapsed);
        if let Some(attempt) = self.round.attempt() {
            self.done.pass(attempt, context.pace.elapsed);
        }
        for (k, (_, chemical)) in self.round.world().view().chemicals().enumerate() {
            self.fullest.resize(self.fullest.len().max(k + 1), 0.0);
            self.fullest[k] = self.fullest[k].max(tint::fullest(chemical));
        }
        if !self.round.is_replay() {
            let before = context.lessons.first_deed();
            context.lessons.note(goals[0].is_some(), has_eaten, context.pace.elapsed);
            if before == Some(FirstDeed::Crawl) && context.lessons.first_deed() != before {
                OWN_BODY.into_iter().for_each(|name| context.find(name));
            }
        }
        let names = digested.into_iter().filter_map(|kind| Some(guide::of_kind(kind)?.name));
        names.for_each(|name| context.find(name));
        let events = [(Cue::Ingest, "phagocytosis"), (Cue::Digest, "phagosome"), (Cue::Divide, "division")];
        let heard = events.into_iter().filter(|(cue, _)| self.heard.contains(cue));
        heard.for_each(|(_, name)| context.find(name));
    }

    /// The cell that is looked at.
    fn seen(&self) -> OrganismId {
        chain_scene::seen(&self.round, Some(self.own)).unwrap_or(self.round.player())
    }

    /// The camera follows the cell; of two cells it shows the whole slide.
    fn look(&mut self, input: &Input, context: &AppContext) {
        if self.two.is_some() {
            return;
        }
        let (cell, steered) = (self.seen(), (input, self.hands.is_crawling));
        self.follow.look(&mut self.viewer, (&self.round, cell), steered, context);
    }

    fn draw_marks(&self, pen: &mut Pen, style: &marks::Style<'_>, view: View<'_>, hints: &Hints) {
        let mut taken = marks::MarkLayout::default();
        let (seen, is_alone) = (self.seen(), self.round.players().count() == 1);
        if let Some(cell) = self.ghost.as_ref().and_then(|ghost| ghost.cell(self.viewer.alpha())) {
            own::draw_ghost(pen, style, cell);
        }
        for (k, id) in self.round.players().enumerate() {
            if let Some(cell) = view.organism(id) {
                let width = if k == self.own { self.pulses.rim() } else { own::OTHERS };
                own::draw_own(pen, style, cell, (!is_alone).then_some(k + 1), width);
            }
        }
        self.pulses.draw(pen, style);
        places::draw_food(pen, style, view);
        places::draw_places(pen, style, &self.round, view);
        chain_scene::draw(pen, style, &self.round, view, (seen, !self.round.is_replay()));
        marks::draw_held(pen, style, &mut taken, &hints.held);
        if self.round.chain().is_none() {
            self.gains.draw(pen, style, &mut taken);
        }
        marks::draw_targets(pen, style, &mut taken, &targets_of(&self.round, view, seen, hints));
        for other in self.round.players().filter(|other| *other != seen) {
            draw_prey(pen, style, &mut taken, &self.round, view, other);
        }
    }

    fn draw_status(&self, pen: &mut Pen, is_calm: bool) {
        let note = match (self.round.is_replay(), self.round.mismatch()) {
            (false, _) => "",
            (true, None) => words::text(Key::HudReplay),
            (true, Some(_)) => words::text(Key::HudReplayDiffers),
        };
        let referee = self.round.referee();
        let of_game = || {
            let points = || match self.two {
                Some(way) => way.summary(&self.round.scores()),
                None => words::text_with(Key::HudScore, &[("points", referee.score().into())]),
            };
            let score = self.round.attempt().map_or_else(points, Attempt::summary);
            (score, [referee.time_left(), referee.game().time])
        };
        let life = chain_scene::status(&self.round, self.seen()).filter(|_| self.two.is_none());
        let (score, time) = life.unwrap_or_else(of_game);
        hud::draw_status(pen, &Status { score: &score, time, is_calm, note });
    }

    fn advice(
        &self,
        hints: &Hints,
        first: Option<FirstDeed>,
        (key, has_buttons): (Option<&str>, bool),
    ) -> Option<String> {
        let (time, left) = (self.round.world().time(), self.round.referee().time_left());
        if self.round.is_replay() {
            None
        } else if self.round.chain().is_some() {
            let of_ghost = || self.ghost.as_ref().and_then(|_| chain_scene::ghost_advice(time));
            chain_scene::advice(time, first, &self.divide_key, has_buttons).or_else(of_ghost)
        } else if let Some(task) = &self.task {
            let how = held_to_crawl(has_buttons);
            let alone = || words::text_with(Key::HintTask, &[("task", task.into()), ("what", how.into())]);
            let of_two = |_| format!("{task} {}", words::text(Key::HintTwoPlayers));
            (time < TASK_TIME).then(|| self.two.map_or_else(alone, of_two))
        } else if let Some(key) = key.filter(|_| hints.can_digest() && self.round.referee().score() == 0) {
            Some(words::text_with(Key::HintDigest, &[("key", key.into())]))
        } else if time < ADVICE_TIME && matches!(self.two, Some(TwoPlayers::Versus | TwoPlayers::Together)) {
            Some(words::text(Key::HintTwoPlayers).to_owned())
        } else if left < LAST_TIME && hints.can_digest() {
            Some(words::text(Key::HintLast).to_owned())
        } else {
            let of_optics = || (!has_buttons).then(|| optics_advice(time, &self.optics_key)).flatten();
            first.map(|deed| first_advice(deed, has_buttons)).or_else(of_optics)
        }
    }
}

/// What is written on the key or the button that digests, if the player has to hold one.
fn digestion_key(settings: &Settings, has_buttons: bool) -> Option<String> {
    let label = || {
        if has_buttons { words::text(Key::HintDigestButton).to_owned() } else { settings.keys.label(Action::Consume) }
    };
    settings.hold_to_digest.then(label)
}

impl Screen for Play {
    fn divides(&self) -> bool {
        self.round.chain().is_some() && !self.round.is_replay()
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.has_lost_focus || input.presses(Action::Pause) || input.step == Some(Move::Back) {
            return Next::Open(Overlay::Pause(self.played));
        }
        if input.presses(Action::Restart) {
            return self.played.restart();
        }
        if let Some(change) = context.chosen.take() {
            self.round.choose(0, change);
        }
        if input.presses(Action::Divide) {
            self.round.divide(0);
        }
        self.run(input, context);
        context.play(&self.heard);
        self.look(input, context);
        // What is done is seen before the end covers it.
        if self.round.is_over() && !self.done.is_shown() {
            let result = Box::new(self.round.result());
            return Next::Open(match (self.two, result.attempt.is_some(), result.life) {
                (_, true, _) => Overlay::SlideEnd(result, self.played),
                (Some(way), ..) => Overlay::TwoPlayersEnd(result, way, self.played),
                (None, false, Some(life)) => Overlay::FoodChainEnd(result, life, self.played),
                (None, false, None) => Overlay::End(result, self.played),
            });
        }
        self.round.offer(0).map_or(Next::Stay, |offer| Next::Open(Overlay::Choose(offer, self.played)))
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.viewer.camera.resize(context.pen.screen());
        let (view, camera) = (self.viewer.view(self.round.world()), &self.viewer.camera);
        let seen = context.paint(view, camera);
        if self.round.attempt().is_some() {
            for (k, (_, chemical)) in view.chemicals().enumerate() {
                let (now, most) = (tint::fullest(chemical), self.fullest.get(k).copied().unwrap_or_default());
                // What nobody secretes any more fades.
                let strength = if now < most { SCENT * (now / most).sqrt() } else { SCENT };
                tint::draw_chemical(context.pen.canvas(), &seen, chemical, ALERT, strength);
            }
        }
        if !context.is_top {
            return;
        }
        let hints = Hints::of(view, self.seen());
        let covered = platform::covered_height();
        let key = digestion_key(&context.settings, covered > 0.0);
        let time = context.motion();
        let style = marks::Style { camera, time, is_classic: context.settings.classic_arrows, key: key.as_deref() };
        let is_taken = view.organism(self.seen()).is_some_and(|cell| cell.held_by().is_some());
        let advice = if is_taken {
            Some(words::text(Key::HintTaken).to_owned())
        } else {
            self.advice(&hints, context.lessons.first_deed(), (key.as_deref(), covered > 0.0))
        };
        let lesson = context.lessons.pass(&hints, context.time, advice.is_none());
        let advice = advice.or_else(|| lesson.map(|lesson| words::text(lesson).to_owned()));
        let pen = &mut context.pen;
        self.draw_marks(pen, &style, view, &hints);
        self.draw_status(pen, context.settings.reduced_motion);
        if let Some((attempt, task)) = self.round.attempt().zip(self.task.as_ref()).filter(|_| self.done.is_shown()) {
            hud::draw_done(pen, &self.done.text(attempt, task), covered);
        } else if let Some(advice) = advice {
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
