//! Bots that play the food chain, to tune it and to test its rules.

use crate::rules::food_chain::bites::cytoplasm;
use crate::rules::food_chain::change::{Change, line_of};
use crate::rules::food_chain::others;
use crate::rules::hint::{Readiness, readiness};
use crate::rules::path::PathMap;
use crate::rules::round::Round;
use crate::rules::threat::Other;
use microsim_core::glam::Vec2;
use microsim_core::{Intent, OrganismView, PreyClass, Rng};

/// How a bot plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skill {
    /// Does nothing.
    Idle,
    /// Goes anywhere, and changes by chance.
    Random,
    /// Goes for the nearest food as somebody does who is new: late, not quite there, into walls, and flees from nobody. Changes by
    /// chance.
    Novice,
    /// Goes for the nearest food, and changes by chance.
    Forager,
    /// Goes for the best food that no threat is near, flees, divides in time, and takes the change that did best when it played on
    /// with each.
    Survivor,
}

impl Skill {
    /// All of them, from the worst to the best.
    pub const ALL: [Self; 5] = [Self::Idle, Self::Random, Self::Novice, Self::Forager, Self::Survivor];
}

/// Steps between two decisions.
const INTERVAL: u64 = 10;
/// Distance from the rim of a threat within which a survivor flees, and takes no food, units.
const DANGER: f32 = 13.0;
/// Size at which a survivor divides that has no sister, 1 at the beginning.
const DIVISION: f32 = 1.6;
/// Time between two goals of the random bot, steps.
const RANDOM_INTERVAL: u64 = 120;
/// Time between two decisions of a novice, steps; how far off its heading is at most, rad; and how often it does nothing.
const NOVICE_INTERVAL: u64 = 45;
const NOVICE_ERROR: f32 = 0.6;
const NOVICE_IDLE: f32 = 0.2;
/// Time without progress after which who finds ways goes elsewhere, s, and for how many steps: a grown cell may not fit a gap.
const STALLED: f32 = 1.5;
const DETOUR: u64 = 120;
/// How long a trial of a change plays on, s, and how many trials there are of each.
const TRIAL: f64 = 20.0;
const TRIALS: u64 = 2;

/// One bot.
#[derive(Clone, Debug)]
pub struct ChainBot {
    skill: Skill,
    rng: Rng,
    map: PathMap,
    intent: Intent,
    /// Steps by which it decides sooner.
    phase: u64,
    /// Where it goes in place of a way that is blocked, and until which step.
    detour: Option<(Vec2, u64)>,
}

impl ChainBot {
    /// A bot for a round; its chance depends on the round's seed.
    #[must_use]
    pub fn new(skill: Skill, round: &Round) -> Self {
        let world = round.world();
        let (rng, map) = (Rng::new(world.config().seed, 7 << 60), PathMap::new(world));
        Self { skill, rng, map, intent: Intent::REST, phase: 0, detour: None }
    }

    /// Plays a step. Returns the change that it has chosen before, if there was one to choose.
    pub fn step(&mut self, round: &mut Round) -> Option<Change> {
        let chosen = round.offer(0).map(|offer| self.choice(round, offer));
        if let Some(change) = chosen {
            round.choose(0, change);
        }
        self.act(round);
        chosen
    }

    fn act(&mut self, round: &mut Round) {
        self.decide(round);
        if self.skill == Skill::Survivor && is_to_divide(round) {
            round.divide(0);
        }
        round.step(self.intent);
    }

    fn choice(&mut self, round: &Round, offer: [Change; 3]) -> Change {
        if self.skill == Skill::Survivor {
            let worths = offer.map(|change| self.worth(round, change));
            let best = (1..offer.len()).fold(0, |best, k| if worths[k] > worths[best] { k } else { best });
            return offer[best];
        }
        self.any(offer)
    }

    fn any(&mut self, offer: [Change; 3]) -> Change {
        offer[self.rng.next_u32() as usize % offer.len()]
    }

    /// What a change is worth: how long the cell then lives, s, and what it has in the end; sums of the trials.
    fn worth(&self, round: &Round, change: Change) -> (f64, u32) {
        let trial = |k| {
            let mut bot = Self { phase: k * INTERVAL / TRIALS, ..self.clone() };
            bot.play_on(round, change)
        };
        (0..TRIALS).map(trial).fold((0.0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    }

    /// Plays a copy of a round on for some time; later changes are by chance.
    fn play_on(&mut self, round: &Round, change: Change) -> (f64, u32) {
        let (mut round, begin) = (round.clone(), round.world().time());
        round.change(0, change);
        while !round.is_over() && round.world().time() < begin + TRIAL {
            if let Some(offer) = round.offer(0) {
                round.choose(0, self.any(offer));
            }
            self.act(&mut round);
        }
        let cell = round.world().view().organism(round.player());
        (round.world().time() - begin, cell.map_or(0, cytoplasm))
    }

    fn decide(&mut self, round: &Round) {
        let interval = match self.skill {
            Skill::Random => RANDOM_INTERVAL,
            Skill::Novice => NOVICE_INTERVAL,
            _ => INTERVAL,
        };
        if !(round.world().step_index() + self.phase).is_multiple_of(interval) {
            return;
        }
        let Some(cell) = round.world().view().organism(round.player()) else { return };
        let goal = match self.skill {
            Skill::Idle => None,
            Skill::Random => Some(self.anywhere(round)),
            Skill::Novice => self.blunder(round, cell),
            Skill::Forager => self.food(round, cell, &[]),
            Skill::Survivor => self.survive(round, cell),
        };
        let finds_ways = matches!(self.skill, Skill::Forager | Skill::Survivor);
        let now = round.world().step_index();
        self.detour = self.detour.filter(|(_, until)| now < *until);
        if finds_ways && self.detour.is_none() && cell.stalled_for() > STALLED {
            self.detour = Some((self.anywhere(round), now + DETOUR));
        }
        let goal = self.detour.map(|(place, _)| place).or(goal);
        let next = goal.map(|goal| if finds_ways { self.map.next(cell.centroid(), goal) } else { goal });
        self.intent = next.and_then(|next| Intent::toward(next).ok()).unwrap_or(Intent::REST).digesting(true);
    }

    fn anywhere(&mut self, round: &Round) -> Vec2 {
        let size = round.world().config().size;
        Vec2::new(self.rng.range(0.0, size.x), self.rng.range(0.0, size.y))
    }

    /// Beside the nearest food, or nowhere.
    fn blunder(&mut self, round: &Round, cell: OrganismView<'_>) -> Option<Vec2> {
        let error = self.rng.range(-NOVICE_ERROR, NOVICE_ERROR);
        if self.rng.range(0.0, 1.0) < NOVICE_IDLE {
            return None;
        }
        let (at, food) = (cell.centroid(), self.food(round, cell, &[])?);
        Some(at + Vec2::from_angle(error).rotate(food - at))
    }

    fn survive(&self, round: &Round, cell: OrganismView<'_>) -> Option<Vec2> {
        let [threats, ..] = others(round.world().view(), round.player());
        let at = cell.centroid();
        if threats.first().is_some_and(|threat| is_near(threat, at)) {
            self.refuge(round, at, &threats)
        } else {
            self.food(round, cell, &threats)
        }
    }

    /// The place of a coarse grid that is farthest from threats, on a way that leads to none.
    fn refuge(&self, round: &Round, at: Vec2, threats: &[Other]) -> Option<Vec2> {
        let size = round.world().config().size;
        let places = (0..8).flat_map(|x| (0..4).map(move |y| Vec2::new(x as f32 + 0.5, y as f32 + 0.5)));
        let places = places.map(|place| place / Vec2::new(8.0, 4.0) * size);
        let safety = |place: Vec2| {
            let way = (self.map.next(at, place) - at).normalize_or_zero();
            let ahead =
                |threat: &Other| way.dot((threat.at - at).normalize_or_zero()) * 40.0 / (1.0 + 0.1 * threat.distance);
            let risk = threats.iter().filter(|threat| threat.distance < 60.0).map(ahead).fold(-40.0, f32::max);
            threats.iter().map(|threat| threat.at.distance(place)).fold(60.0, f32::min)
                - risk
                - 0.1 * at.distance(place)
        };
        places.max_by(|a, b| safety(*a).total_cmp(&safety(*b)))
    }

    /// Where there is most to be had for the way.
    fn food(&self, round: &Round, cell: OrganismView<'_>, threats: &[Other]) -> Option<Vec2> {
        let (view, at) = (round.world().view(), cell.centroid());
        let is_greedy = self.skill == Skill::Survivor;
        let free = view.organisms().filter(|prey| prey.held_by().is_none());
        let mut found: Vec<(Vec2, f32)> = free
            .filter_map(|prey| {
                let worth = match prey.prey_class()? {
                    PreyClass::Bacterium if is_greedy => 1.2,
                    PreyClass::Simple | PreyClass::Bacterium => 3.0,
                    PreyClass::Soft if is_greedy && readiness(cell, prey) == Some(Readiness::Ready) => 9.0,
                    PreyClass::Soft => return None,
                };
                Some((prey.centroid(), worth))
            })
            .collect();
        if is_greedy {
            let [_, victims, _] = others(view, round.player());
            found.extend(victims.iter().map(|victim| (victim.at, 15.0)));
        }
        let is_safe = |place: Vec2| !threats.iter().any(|threat| is_near(threat, place));
        let best = found.into_iter().filter(|(place, _)| is_safe(*place));
        let for_the_way = |&(place, worth): &(Vec2, f32)| worth / (4.0 + place.distance(at));
        best.max_by(|a, b| for_the_way(a).total_cmp(&for_the_way(b))).map(|(place, _)| place)
    }
}

/// Whether a player has no sister and is large enough, and no threat is near.
fn is_to_divide(round: &Round) -> bool {
    let view = round.world().view();
    let (Some(chain), Some(cell)) = (round.chain(), view.organism(round.player())) else { return false };
    let [threats, ..] = others(view, cell.id());
    let is_alone = view.organisms().filter(|other| line_of(*other) == line_of(cell)).count() == 1;
    is_alone && chain.size(cell) >= DIVISION && !threats.iter().any(|threat| is_near(threat, cell.centroid()))
}

fn is_near(threat: &Other, place: Vec2) -> bool {
    threat.at.distance(place) - threat.half_extent < DANGER
}

#[cfg(test)]
mod tests;
