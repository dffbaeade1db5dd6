//! One round: a world, its player and the referee. The intents of mouse and bots are recorded; a replay has its own.

use super::attempt::Attempt;
use super::course::Course;
use super::food_chain::change::Change;
use super::food_chain::{self, Deed, FoodChain, Life};
use super::lunge::Lunge;
use super::prey_class;
use super::referee::{Gain, KindScore, Referee};
use super::threat;
use crate::sound::Cue;
use crate::words::Key;
use microsim_core::replay::{Mismatch, Player, Recorder, Replay};
use microsim_core::scenario::Scenario;
use microsim_core::{Event, Inputs, Intent, Kind, MealPhase, OrganismId, OrganismView, World};
use std::num::NonZeroU32;

/// Steps between two digests of a recorded round.
const DIGEST_INTERVAL: NonZeroU32 = NonZeroU32::new(60).expect("not zero");

/// Cells that can be played in one round: the player of a scenario, and those named `player-2` to `player-4`.
pub const MOST_PLAYERS: usize = 4;

/// A round that is being played, or played again. `clone_from` of a round of the same game takes over the world without new memory, so
/// that going back is cheap.
#[derive(Debug)]
pub struct Round {
    name: String,
    course: Course,
    /// Those who play, at least one.
    seats: Vec<Seat>,
    /// If it is of a slide.
    attempt: Option<Attempt>,
    /// If it is one of the food chain.
    chain: Option<FoodChain>,
}

/// One of those who play: its cell, how that stands with its lunges, and its score.
#[derive(Clone, Debug)]
struct Seat {
    cell: OrganismId,
    lunge: Lunge,
    referee: Referee,
}

/// How a round ended.
#[derive(Clone, Debug)]
pub struct RoundResult {
    /// Points.
    pub score: u32,
    /// [`Round::scores`].
    pub scores: Vec<u32>,
    /// How many small things, and how many rigid cells, each player has digested.
    pub counts: Vec<[u32; 2]>,
    /// Time of the round, s.
    pub time: f32,
    /// How many things were inside, and not digested.
    pub undigested: u32,
    /// What was digested, by kind.
    pub kinds: Vec<(Kind, KindScore)>,
    /// How the attempt at a slide ended, if it was one.
    pub attempt: Option<Attempt>,
    /// How a food chain ended, if it was one.
    pub life: Option<Life>,
    /// The round as a [`Replay`]; `None` if it was a replay itself.
    pub record: Option<Vec<u8>>,
    /// Whether a replay differed from what was recorded.
    pub is_mismatch: bool,
}

impl Round {
    /// Sets up a round.
    ///
    /// # Errors
    /// Says what is wrong with the scenario, or that it is neither a game nor a slide.
    pub fn new(scenario: &Scenario) -> Result<Self, String> {
        let run = Box::new(scenario.build().map_err(|diagnostics| diagnostics.to_string())?);
        let (recorder, record) = Recorder::new(scenario.origin(), DIGEST_INTERVAL);
        Self::of(scenario.name(), Course::Live { run, recorder, record })
    }

    /// Sets up a round that was recorded.
    ///
    /// # Errors
    /// As for [`Round::new`].
    pub fn again(replay: &Replay) -> Result<Self, String> {
        let scenario = replay.origin().scenario().map_err(|diagnostics| diagnostics.to_string())?;
        let run = Box::new(Player::new(replay).map_err(|diagnostics| diagnostics.to_string())?);
        Self::of(scenario.name(), Course::Replay { run, is_over: false, mismatch: None })
    }

    fn of(name: &str, course: Course) -> Result<Self, String> {
        let run = course.run();
        let attempt = run.slide.clone().map(Attempt::new);
        let game = attempt.as_ref().map(|attempt| Attempt::game(attempt.slide())).or_else(|| run.game.clone());
        let (Some(game), Some(player)) = (game, run.player) else {
            return Err(format!("`{name}` is no game: it has no table [game] or [slide]"));
        };
        let others = (2..=MOST_PLAYERS).filter_map(|k| {
            let name = format!("player-{k}");
            run.named.iter().find(|(known, _)| *known == name).map(|(_, cell)| *cell)
        });
        let cells = std::iter::once(player).chain(others);
        let cells: Vec<OrganismId> = cells.collect();
        let chain = (name == food_chain::NAME).then(|| FoodChain::new(&run.world, &cells));
        let seat = |cell| Seat { cell, lunge: Lunge::default(), referee: Referee::new(game.clone(), cell, &run.world) };
        let seats = cells.into_iter().map(seat).collect();
        Ok(Self { name: name.to_owned(), course, seats, attempt, chain })
    }

    /// One step; in a replay the intent does not count. Nothing happens any more when the round is over.
    pub fn step(&mut self, intent: Intent) {
        self.step_all(&[intent]);
    }

    /// One step with the intents of all who play, in the order of [`Round::players`].
    pub fn step_all(&mut self, intents: &[Intent]) {
        if self.is_over() {
            return;
        }
        let cells: Vec<OrganismId> = self.players().collect();
        let speed = |cell: &OrganismId| self.world().view().organism(*cell).map(OrganismView::speed);
        let speeds: Vec<Option<f32>> = cells.iter().map(speed).collect();
        match &mut self.course {
            Course::Live { run, recorder, record } => {
                if let Some(chain) = &mut self.chain {
                    chain.before_step(&mut run.world, &cells);
                }
                self.seats.iter_mut().for_each(|seat| seat.lunge.before_step(&mut run.world));
                let mut inputs = Inputs::new();
                // What is told to a cell that is gone does nothing.
                cells.iter().zip(intents).for_each(|(cell, intent)| inputs.set(*cell, *intent));
                threat::digest_players(&run.world, &cells, &mut inputs);
                run.step(&inputs);
                record.extend(recorder.step(&inputs, &run.world));
            }
            Course::Replay { run, is_over, mismatch } => match run.next() {
                Some(step) => *mismatch = mismatch.or(step.err()),
                None => {
                    *is_over = true;
                    return;
                }
            },
        }
        let (world, is_replay) = (&self.course.run().world, self.is_replay());
        for (player, Seat { cell, lunge, referee }) in self.seats.iter_mut().enumerate() {
            if let Some(before) = speeds[player].filter(|_| is_replay) {
                lunge.after_replayed_step(world, *cell, before);
            }
            referee.after_step(world);
            if let Some(chain) = &mut self.chain {
                *cell = chain.after_step(world, player, *cell);
                referee.follow(*cell);
            }
        }
        if let Some(attempt) = &mut self.attempt {
            let players: Vec<_> = cells.iter().filter_map(|cell| threat::free_place(world, *cell)).collect();
            let digested = |kind| self.seats.iter().map(|seat| seat.referee.digested(kind)).sum();
            attempt.after_step(world.time() as f32, &players, digested);
            if threat::are_digested(world, &cells) {
                attempt.lose();
            }
        }
    }

    /// What a player does in a food chain, if it can: the change has to be offered, and a cell that is gone does not divide.
    pub fn act(&mut self, player: usize, deed: Deed) {
        match deed {
            Deed::Choose(place) => {
                if let Some(change) = self.offer(player).and_then(|offer| offer.get(place).copied()) {
                    self.choose(player, change);
                }
            }
            Deed::Divide => self.divide(player),
            Deed::Lunge => {
                // Whoever is refused sees why: the ring is not closed.
                let _ = self.lunge(player);
            }
        }
    }

    /// Whether those who play can lunge: in the food chain, and alone in the game.
    #[must_use]
    pub fn has_lunges(&self) -> bool {
        !self.is_replay() && self.attempt.is_none() && (self.chain.is_some() || self.seats.len() == 1)
    }

    /// A player's cell crawls faster for a moment, if it can.
    ///
    /// # Errors
    /// When it cannot: what the player is told.
    pub fn lunge(&mut self, player: usize) -> Result<(), Key> {
        let is_possible = self.has_lunges() && !self.is_over();
        match (&mut self.course, self.seats.get_mut(player).filter(|_| is_possible)) {
            (Course::Live { run, .. }, Some(seat)) => seat.lunge.begin(&mut run.world, seat.cell),
            _ => Err(Key::HudLungeEarly),
        }
    }

    /// How a player's cell stands with its lunges.
    #[must_use]
    pub fn lunge_of(&self, player: usize) -> Lunge {
        self.seats.get(player).map_or_else(Lunge::default, |seat| seat.lunge)
    }

    /// Changes a player's cell, if this change of a food chain is offered.
    pub fn choose(&mut self, player: usize, change: Change) {
        if self.offer(player).is_some_and(|offer| offer.contains(&change)) {
            self.change(player, change);
        }
    }

    /// Changes a player's cell, whatever a food chain offers: a trial of what a change is worth.
    pub(super) fn change(&mut self, player: usize, change: Change) {
        if let (Course::Live { run, .. }, Some(chain)) = (&mut self.course, &mut self.chain) {
            chain.change(change, &mut run.world, player, self.seats[player].cell);
        }
    }

    /// Divides a player's cell, in a food chain: the sister that rests is a second life.
    pub fn divide(&mut self, player: usize) {
        if let (Course::Live { run, .. }, Some(_), Some(seat)) = (&mut self.course, &self.chain, self.seats.get(player))
        {
            // Refused if it is gone.
            let _ = run.world.divide(seat.cell);
        }
    }

    /// Whether a player's cell was told to divide in the last step and cannot.
    #[must_use]
    pub fn is_division_refused(&self) -> bool {
        let is_own = |cell: &OrganismId| self.players().any(|own| own == *cell);
        let events = self.world().events().iter();
        events.filter(|event| matches!(event, Event::DivisionRefused { organism, .. } if is_own(organism))).count() > 0
    }

    /// What those who play hear of the last step: what their cells do, the last seconds, and the end.
    pub fn heard(&self) -> impl Iterator<Item = Cue> + '_ {
        let of = |event| self.players().find_map(|cell| Cue::of(event, Some(cell)));
        let events = self.world().events().iter().filter_map(of);
        let dt = self.world().config().dt;
        let lunges = self.seats.iter().filter(move |seat| seat.lunge.is_new(dt)).map(|_| Cue::Lunge);
        let second = self.referee().begins_second().map(|left| if left == 0 { Cue::End } else { Cue::Second });
        events.chain(lunges).chain(if self.is_won() || self.is_dead() { Some(Cue::End) } else { second })
    }

    /// Who ate the first player's cell, or digested the last one of all, when the round has ended by that.
    #[must_use]
    pub fn eater(&self) -> Option<OrganismId> {
        let digester = |event: &Event| match *event {
            Event::Consumed { engulfer, prey, .. } if self.players().any(|cell| cell == prey) => Some(engulfer),
            _ => None,
        };
        let of_chain = || self.chain.as_ref().and_then(|chain| chain.eater(0));
        if self.is_dead() { of_chain().or_else(|| self.world().events().iter().find_map(digester)) } else { None }
    }

    fn is_won(&self) -> bool {
        self.attempt.as_ref().is_some_and(|attempt| attempt.time().is_some())
    }

    fn is_dead(&self) -> bool {
        self.chain.as_ref().is_some_and(FoodChain::is_over) || self.attempt.as_ref().is_some_and(Attempt::is_lost)
    }

    /// Whether time is up, all goals of a slide are reached, nobody of the players or their lines lives, or the replay ends.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.is_won()
            || self.is_dead()
            || self.referee().is_over()
            || matches!(self.course, Course::Replay { is_over: true, .. })
    }

    /// Whether it is played again.
    #[must_use]
    pub fn is_replay(&self) -> bool {
        matches!(self.course, Course::Replay { .. })
    }

    /// Where a replay first differed from what was recorded, perhaps by another version of the library.
    #[must_use]
    pub fn mismatch(&self) -> Option<Mismatch> {
        if let Course::Replay { mismatch, .. } = &self.course { *mismatch } else { None }
    }

    /// The round so far, as a [`Replay`]; `None` if it is a replay itself.
    #[must_use]
    pub fn record(&self) -> Option<Vec<u8>> {
        let Course::Live { run, recorder, record } = &self.course else { return None };
        Some([&record[..], &recorder.clone().finish(&run.world)].concat())
    }

    /// How it stands, to be kept when it is over.
    #[must_use]
    pub fn result(&self) -> RoundResult {
        RoundResult {
            score: self.referee().score(),
            scores: self.scores(),
            counts: self.seats.iter().map(|seat| prey_class::counts(seat.referee.kinds())).collect(),
            time: self.referee().game().time,
            undigested: self.undigested(),
            kinds: self.referee().kinds().to_vec(),
            attempt: self.attempt.clone(),
            life: self.chain.as_ref().and_then(|chain| chain.life(self.world(), self.referee().kinds())),
            record: self.record(),
            is_mismatch: self.mismatch().is_some(),
        }
    }

    fn undigested(&self) -> u32 {
        let player = self.world().view().organism(self.player());
        let is_inside = |phase: &MealPhase| matches!(phase, MealPhase::Ingested | MealPhase::Digesting(_));
        player.map_or(0, |player| player.meals().filter(|(_, phase)| is_inside(phase)).count() as u32)
    }

    /// Name of its scenario.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its world.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.course.run().world
    }

    /// The cell that is played; of several the first.
    #[must_use]
    pub fn player(&self) -> OrganismId {
        self.seats[0].cell
    }

    /// The cells of all who play.
    pub fn players(&self) -> impl Iterator<Item = OrganismId> + '_ {
        self.seats.iter().map(|seat| seat.cell)
    }

    /// Points of all who play; in a food chain how long their lines have lived, s.
    #[must_use]
    pub fn scores(&self) -> Vec<u32> {
        match &self.chain {
            Some(chain) => chain.lives(self.world().time() as f32).map(|time| time as u32).collect(),
            None => self.seats.iter().map(|seat| seat.referee.score()).collect(),
        }
    }

    /// What the last step earned, whoever it was.
    pub fn gains(&self) -> impl Iterator<Item = Gain> + '_ {
        self.seats.iter().flat_map(|seat| seat.referee.gains()).copied()
    }

    /// How the attempt at a slide stands, if it is one.
    #[must_use]
    pub fn attempt(&self) -> Option<&Attempt> {
        self.attempt.as_ref()
    }

    /// How the food chain stands, if it is one.
    #[must_use]
    pub fn chain(&self) -> Option<&FoodChain> {
        self.chain.as_ref()
    }

    /// The changes of which a player may choose one now.
    #[must_use]
    pub fn offer(&self, player: usize) -> Option<[Change; 3]> {
        if self.is_replay() { None } else { self.chain.as_ref()?.offer(player) }
    }

    /// Score and time; of several players those of the first.
    #[must_use]
    pub fn referee(&self) -> &Referee {
        &self.seats[0].referee
    }
}

impl Clone for Round {
    fn clone(&self) -> Self {
        let Self { name, course, seats, attempt, chain } = self;
        let (name, course, seats) = (name.clone(), course.clone(), seats.clone());
        Self { name, course, seats, attempt: attempt.clone(), chain: chain.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        let Self { name, course, seats, attempt, chain } = source;
        self.name.clone_from(name);
        self.course.clone_from(course);
        self.seats.clone_from(seats);
        self.attempt.clone_from(attempt);
        self.chain.clone_from(chain);
    }
}
