//! The game, 90 seconds to eat, and slides.

mod start;
mod told;

use super::chain_scene;
use super::context::AppContext;
use super::done::DoneNote;
use super::follow::Follow;
use super::steer::{Hands, draw_prey, targets_of};
use super::{Next, Overlay, Paused, Screen};
use crate::clock::Tempo;
use crate::draw::palette::ALERT;
use crate::guide;
use crate::hud::pulse::{Pulses, is_large};
use crate::hud::{self, marks, own, places, tint};
use crate::input::{Action, Input, Move};
use crate::platform;
use crate::rules::bot::Bot;
use crate::rules::food_chain::feats::Feats;
use crate::rules::ghost::Ghost;
use crate::rules::hint::Hints;
use crate::rules::lesson::FirstDeed;
use crate::rules::news::News;
use crate::rules::referee::Gain;
use crate::rules::round::Round;
use crate::rules::threat::Alarm;
use crate::rules::two_players::TwoPlayers;
use crate::sound::Cue;
use crate::store::settings::Settings;
use crate::ui::pen::Pen;
use crate::viewer::Viewer;
use crate::words::{self, Key};
use microsim_core::glam::Vec2;
use microsim_core::{OrganismId, View};

/// How strong the tint of a chemical is at most.
const SCENT: f32 = 0.4;
/// Entries of the guide that whoever crawls has seen.
const OWN_BODY: [&str; 3] = ["amoeboid-cell", "membrane", "pseudopod"];
/// Time for which the scene is still seen when a round is over, and when the own cell is gone, s.
const LAST_LOOK: f32 = 0.8;
const LAST_LOOK_AT_EATER: f32 = 1.6;
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
    alarm: Alarm,
    follow: Follow,
    /// The player whose cell is looked at.
    own: usize,
    hands: Hands,
    /// How two cells play, if it is a round of two, and who steers the second one in place of a player.
    two: Option<TwoPlayers>,
    bot: Option<Bot>,
    /// Whether time passes: from the first act of a player on.
    has_begun: bool,
    /// How fast a replay goes.
    tempo: Tempo,
    /// Where the own cell was last, what its status said, and time since the round is over, s.
    last_place: Vec2,
    last_life: Option<(String, [f32; 2])>,
    over_for: f32,
    /// The player's best life in this water.
    ghost: Option<Ghost>,
    /// What is written on the keys that divide the cell, let it lunge, and change the optics.
    divide_key: String,
    lunge_key: String,
    optics_key: String,
    /// The keys that make a replay slower and faster, and stop it.
    tempo_keys: [String; 3],
}

impl Play {
    fn run(&mut self, input: &Input, context: &mut AppContext) {
        let was_crawling = self.hands.is_crawling;
        self.hands.note(input, context.settings.click_to_crawl);
        self.pulses.pass(context.pace.elapsed);
        if self.hands.is_crawling && !was_crawling && !self.round.is_replay() {
            self.pulses.call(self.viewer.camera.to_room(input.cursor));
        }
        let goals = self.hands.goals(input, &self.viewer.camera, &self.round, self.two);
        self.has_begun |=
            goals.iter().any(Option::is_some) || input.presses(Action::Divide) || input.presses(Action::Lunge);
        let digests = context.settings.digests(input);
        let speed = if self.has_begun { context.settings.pace() * self.tempo.factor() } else { 0.0 };
        let Self { round, viewer, hands, bot, ghost, .. } = self;
        let mut news = News::default();
        viewer.run(context.pace, speed, round, |round| {
            let mut intents = hands.intents(round, goals, digests);
            if let (Some(bot), Some(cell), Some(intent)) = (bot.as_mut(), round.players().nth(1), intents.get_mut(1)) {
                *intent = bot.intent(round.world(), cell);
            }
            news.step(round, &intents);
            ghost.iter_mut().for_each(Ghost::step);
            round.world()
        });
        let News { heard, gains, meals, is_division_refused } = news;
        Self::find(&heard, &gains, context);
        self.heard = heard;
        meals.iter().for_each(|&(at, half_extent)| self.pulses.take(at, half_extent));
        if is_division_refused {
            context.tell(words::text(Key::HudUndivided));
        }
        let is_feast = meals.iter().any(|(_, half_extent)| is_large(*half_extent));
        if is_feast && self.two.is_none() && context.motion().is_some() {
            self.follow.nudge(&mut self.viewer, context.pen.screen());
        }
        if self.viewer.step_ms() > GHOST_STEP {
            self.ghost = None;
        }
        self.gains.add(gains.into_iter());
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
            context.lessons.note(goals[0].is_some(), !meals.is_empty(), context.pace.elapsed);
            if before == Some(FirstDeed::Crawl) && context.lessons.first_deed() != before {
                OWN_BODY.into_iter().for_each(|name| context.find(name));
            }
        }
    }

    /// Finds in the field guide what was digested and heard.
    fn find(heard: &[Cue], gains: &[Gain], context: &mut AppContext) {
        let digested = gains.iter().filter_map(|gain| Some(guide::of_kind(gain.kind)?.name));
        digested.for_each(|name| context.find(name));
        let events = [(Cue::Ingest, "phagocytosis"), (Cue::Digest, "phagosome"), (Cue::Divide, "division")];
        let heard = events.into_iter().filter(|(cue, _)| heard.contains(cue));
        heard.for_each(|(_, name)| context.find(name));
    }

    /// Lets the own cell lunge. Its price, and why it cannot, is said once; later a dim ring says that it cannot.
    fn lunge(&mut self, context: &mut AppContext) {
        let lunged = self.round.lunge(0);
        let said = lunged.err().unwrap_or(Key::HudLungePrice);
        if context.lessons.is_first(said) {
            context.tell(words::text(said));
        } else if lunged.is_err() {
            self.pulses.refuse(self.last_place);
        }
    }

    /// The cell that is looked at.
    fn seen(&self) -> OrganismId {
        chain_scene::seen(&self.round, Some(self.own)).unwrap_or(self.round.player())
    }

    /// Keeps what was reached so far of the goals of the food chain: the life may be left.
    fn keep_feats(&self, context: &mut AppContext) {
        let life = self.round.result().life.filter(|_| !self.round.is_replay() && !context.pace.is_exact);
        if let Some(life) = life {
            context.keep_feats(Feats { time: 0, ..life.feats });
        }
    }

    /// Whether the round is over, and what happened last was seen before the end covers it.
    fn has_ended(&mut self, context: &AppContext) -> bool {
        if !self.round.is_over() {
            self.last_place = self.round.world().centroid(self.seen()).unwrap_or(self.last_place);
            self.last_life = chain_scene::status(&self.round, self.seen());
            return false;
        }
        let is_gone = self.round.world().centroid(self.seen()).is_none();
        if is_gone && self.over_for == 0.0 {
            self.pulses.lose(self.last_place);
        }
        self.over_for += context.pace.elapsed;
        let look = if is_gone { LAST_LOOK_AT_EATER } else { LAST_LOOK };
        !self.done.is_shown() && (context.pace.is_exact || self.over_for > look)
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
                own::draw_lunge(pen, style, cell, self.round.lunge_of(k));
                if self.round.chain().is_some_and(|chain| chain.is_bitten(id)) {
                    own::draw_rim(pen, style, cell, ALERT, own::BITTEN);
                }
            }
        }
        self.pulses.draw(pen, style);
        if !self.round.is_replay() {
            chain_scene::draw_end(pen, style, &self.round, view, self.last_place);
        }
        places::draw_food(pen, style, &self.round, view);
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
}

/// What is written on the key or the button that digests, if the player has to hold one.
fn digestion_key(settings: &Settings, has_buttons: bool) -> Option<String> {
    let label = || {
        if has_buttons { words::text(Key::HintDigestButton).to_owned() } else { settings.keys.label(Action::Consume) }
    };
    settings.hold_to_digest.then(label)
}

impl Screen for Play {
    fn deeds(&self) -> [bool; 2] {
        [self.round.chain().is_some() && !self.round.is_replay(), self.round.has_lunges()]
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let stands = self.round.is_replay() && input.presses(Action::Pause);
        self.has_begun ^= stands;
        if input.has_lost_focus || (input.presses(Action::Pause) && !stands) || input.step == Some(Move::Back) {
            self.keep_feats(context);
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
        if input.presses(Action::Lunge) && self.round.has_lunges() {
            self.lunge(context);
        }
        if self.round.is_replay() {
            self.tempo = self.tempo.changed(input.presses(Action::Faster), input.presses(Action::Slower));
        }
        self.run(input, context);
        let is_hunted = chain_scene::is_hunted(&self.round, self.round.world().view(), self.seen());
        if self.alarm.rings(is_hunted, context.pace.elapsed) {
            self.heard.push(Cue::Danger);
        }
        context.play(&self.heard);
        self.look(input, context);
        if self.has_ended(context) {
            let result = Box::new(self.round.result());
            return Next::Open(match (self.two, result.attempt.is_some(), result.life) {
                (_, true, _) => Overlay::SlideEnd(result, self.played),
                (Some(way), ..) => Overlay::TwoPlayersEnd(result, way, self.played),
                (None, false, Some(life)) => Overlay::FoodChainEnd(result, life, self.played),
                (None, false, None) => Overlay::End(result, self.played),
            });
        }
        let offer = self.round.offer(0).filter(|_| !self.round.is_over());
        offer.map_or(Next::Stay, |offer| Next::Open(Overlay::Choose(offer, self.played)))
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
        let is_hunted = self.round.has_lunges().then(|| chain_scene::is_hunted(&self.round, view, self.seen()));
        let lesson = context.lessons.pass(&hints, is_hunted, context.time, advice.is_none());
        let advice = advice.or_else(|| lesson.map(|lesson| self.lesson(lesson, covered > 0.0)));
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
