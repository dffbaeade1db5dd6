//! Bots: programs that play, to tune the game and to test its rules.

use super::hint::{Readiness, readiness};
use super::prey_class;
use microsim_core::glam::Vec2;
use microsim_core::{Intent, MealPhase, OrganismId, OrganismView, PreyClass, Rng, World};

/// How a bot plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Policy {
    /// Does nothing.
    Idle,
    /// Hunts everything and digests nothing.
    NeverConsume,
    /// Goes anywhere and digests now and then.
    Random,
    /// Goes for the nearest agar or coccus.
    AgarOnly,
    /// Goes for what is worth most for the way.
    Greedy,
}

impl Policy {
    /// All of them, from the worst to the best.
    pub const ALL: [Self; 5] = [Self::Idle, Self::NeverConsume, Self::Random, Self::AgarOnly, Self::Greedy];
}

/// Small things inside that make it worth while to stop and digest.
const FULL: usize = 4;
/// Time after which a target that has not been reached is given up, s, and time for which it is then left alone, s.
const PURSUIT_TIME: f64 = 5.0;
const AVOID_TIME: f64 = 6.0;
/// Worth of a rigid cell that can be taken in, in small things, and of one unit of way.
const RIGID_WORTH: f32 = 12.0;
/// Time between two decisions of the random bot, s.
const INTERVAL: [f32; 2] = [1.0, 3.0];

/// One bot.
#[derive(Clone, Debug)]
pub struct Bot {
    policy: Policy,
    rng: Rng,
    target: Option<OrganismId>,
    /// When it chose its target or last decided, s.
    since: f64,
    given_up: Vec<(OrganismId, f64)>,
    random: Intent,
    wait: f32,
}

impl Bot {
    /// A bot; its chance depends on the seed.
    #[must_use]
    pub fn new(policy: Policy, seed: u64) -> Self {
        let (rng, given_up) = (Rng::new(seed, 1 << 60), Vec::new());
        Self { policy, rng, target: None, since: 0.0, given_up, random: Intent::REST, wait: 0.0 }
    }

    /// What it does in the next step.
    pub fn intent(&mut self, world: &World, player: OrganismId) -> Intent {
        match self.policy {
            Policy::Idle => Intent::REST,
            Policy::Random => self.wander(world),
            Policy::NeverConsume => self.hunt(world, player).digesting(false),
            Policy::AgarOnly | Policy::Greedy => self.hunt(world, player),
        }
    }

    fn wander(&mut self, world: &World) -> Intent {
        if world.time() >= self.since + f64::from(self.wait) {
            let size = world.config().size;
            let goal = Vec2::new(self.rng.range(0.0, size.x), self.rng.range(0.0, size.y));
            self.random = Intent::toward(goal).unwrap_or(Intent::REST).digesting(self.rng.unit() < 0.3);
            (self.since, self.wait) = (world.time(), self.rng.range(INTERVAL[0], INTERVAL[1]));
        }
        self.random
    }

    fn hunt(&mut self, world: &World, player: OrganismId) -> Intent {
        let view = world.view();
        let (Some(me), Some(at)) = (view.organism(player), world.centroid(player)) else { return Intent::REST };
        self.choose(world, me, at);
        let goal = self.target.and_then(|target| world.centroid(target)).and_then(|goal| Intent::toward(goal).ok());
        goal.unwrap_or(Intent::REST).digesting(is_time_to_digest(world, me))
    }

    /// Keeps its target while that is free and worth it; else takes the best one.
    fn choose(&mut self, world: &World, me: OrganismView<'_>, at: Vec2) {
        let now = world.time();
        self.given_up.retain(|(_, until)| *until > now);
        if let Some(target) = self.target.filter(|_| now > self.since + PURSUIT_TIME) {
            self.given_up.push((target, now + AVOID_TIME));
            self.target = None;
        }
        let worth = |id| world.view().organism(id).and_then(|prey| self.worth(world, me, at, prey));
        if self.target.and_then(worth).is_some() {
            return;
        }
        let ids = world.organisms().filter(|id| self.given_up.iter().all(|(given_up, _)| given_up != id));
        let best = ids.filter_map(|id| Some((id, worth(id)?))).max_by(|a, b| a.1.total_cmp(&b.1));
        (self.target, self.since) = (best.map(|(id, _)| id), now);
    }

    /// What it is worth to go for something; `None` if it cannot be taken in.
    fn worth(&self, world: &World, me: OrganismView<'_>, at: Vec2, prey: OrganismView<'_>) -> Option<f32> {
        let worth = match prey.prey_class()? {
            _ if prey.held_by().is_some() => return None,
            PreyClass::Simple | PreyClass::Bacterium => 1.0,
            PreyClass::Soft if self.policy != Policy::AgarOnly => {
                (readiness(me, prey)? == Readiness::Ready).then_some(RIGID_WORTH)?
            }
            PreyClass::Soft => return None,
        };
        Some(worth / (5.0 + (world.centroid(prey.id())? - at).length()))
    }
}

/// Digests a rigid cell at once, because there is room for one only, and small things when there are some.
fn is_time_to_digest(world: &World, me: OrganismView<'_>) -> bool {
    let inside: Vec<_> = me.meals().filter(|(_, phase)| phase.is_inside()).collect();
    let has_begun = inside.iter().any(|(_, phase)| matches!(phase, MealPhase::Digesting(_)));
    let holds_rigid = inside.iter().any(|(prey, _)| world.view().organism(*prey).is_some_and(prey_class::is_soft));
    has_begun || holds_rigid || inside.len() >= FULL
}
