//! Controllers: what an organism wants when nobody commands it. They are part of the world's state.
//!
//! One file per model: its parameters, its state, `validate` and `decide`. A new one is a file, a variant of
//! [`Controller`] with its arms in `validate` and `decide`, and a row in the scenario reader's table.

pub(crate) mod avoidance;
pub(crate) mod brownian;
mod chain;
pub(crate) mod chemotaxis;
pub(crate) mod flee;
pub(crate) mod patrol;
pub(crate) mod persistent_walk;
pub(crate) mod pursue;
pub(crate) mod ram;
pub(crate) mod run_and_tumble;
pub(crate) mod senses;
#[cfg(test)]
mod testing;
pub(crate) mod thrash;
pub(crate) mod wander;

use crate::capability::Locomotion;
use crate::config::WorldConfig;
use crate::error::{Error, in_range, out_of_range};
use crate::id::ChemicalId;
use crate::rng::Rng;
use avoidance::{Avoidance, AvoidanceParams};
use brownian::{Brownian, BrownianParams};
use chemotaxis::{Chemotaxis, ChemotaxisParams};
use flee::{Flee, FleeParams};
use glam::Vec2;
use patrol::Patrol;
use persistent_walk::{PersistentWalk, PersistentWalkParams};
use pursue::{Pursue, PursueParams};
use ram::Ram;
use run_and_tumble::{RunAndTumble, RunAndTumbleParams};
use senses::{Senses, Steering};
use serde::{Deserialize, Serialize};
use thrash::Thrash;
use wander::Wander;

/// Most controllers of which each is what the one before it does otherwise.
const DEEPEST: usize = 8;

/// What steers an organism when no input does: a model of behaviour and its present state. It works for everything that
/// moves, whatever it is; [`Controller::chemotaxis`] needs an outline to sense with.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self")]
#[non_exhaustive]
pub enum Controller {
    /// Nothing: it rests, and moves as anything does that is pushed.
    #[default]
    Still,
    /// See [`Controller::wander`].
    Wander(Wander),
    /// See [`Controller::patrol`].
    Patrol(Patrol),
    /// See [`Controller::thrash`].
    Thrash(Thrash),
    /// See [`Controller::ram`].
    Ram(Ram),
    /// See [`Controller::persistent_walk`].
    PersistentWalk(PersistentWalk),
    /// See [`Controller::chemotaxis`].
    Chemotaxis(Chemotaxis),
    /// See [`Controller::run_and_tumble`].
    RunAndTumble(RunAndTumble),
    /// See [`Controller::brownian`].
    Brownian(Brownian),
    /// See [`Controller::avoidance`].
    Avoidance(Avoidance),
    /// See [`Controller::flee`].
    Flee(Flee),
    /// See [`Controller::pursue`].
    Pursue(Pursue),
}

impl Controller {
    /// The thesis' random movement (3.3.1): after a time drawn from `interval` (s, 0.05 to 600) a new goal anywhere in the
    /// room, or with probability `rest` (0 to 1) a rest.
    #[must_use]
    pub fn wander(interval: [f32; 2], rest: f32) -> Self {
        Self::Wander(Wander::new(interval, rest))
    }

    /// Movement through these points, 1 to 1000, once or for ever.
    #[must_use]
    pub fn patrol(through: Vec<Vec2>, repeats: bool) -> Self {
        Self::Patrol(Patrol::new(through, repeats))
    }

    /// Movement to and fro without rest that decides again every `interval` s (0.01 to 600), with probability `reversal` (0 to
    /// 1) for the opposite direction, else for a random one. Hard on membranes.
    #[must_use]
    pub fn thrash(interval: f32, reversal: f32) -> Self {
        Self::Thrash(Thrash::new(interval, reversal))
    }

    /// Charges of `charge` s (0.01 to 600) at the nearest engulfer, each from a random place `distance` units (0 to 10 000)
    /// away from its centre, for which there are `retreat` s (0.01 to 600).
    #[must_use]
    pub fn ram(charge: f32, retreat: f32, distance: f32) -> Self {
        Self::Ram(Ram::new(charge, retreat, distance))
    }

    /// A random walk that keeps its direction for a while and avoids walls.
    #[must_use]
    pub fn persistent_walk(params: PersistentWalkParams) -> Self {
        Self::PersistentWalk(PersistentWalk::new(params))
    }

    /// A persistent random walk that turns towards a chemical, compared all around the outline.
    #[must_use]
    pub fn chemotaxis(params: ChemotaxisParams) -> Self {
        Self::Chemotaxis(Chemotaxis::new(params))
    }

    /// Straight runs and tumbles, with longer runs while a chemical gets stronger.
    #[must_use]
    pub fn run_and_tumble(params: RunAndTumbleParams) -> Self {
        Self::RunAndTumble(RunAndTumble::new(params))
    }

    /// Brownian motion of what is kicked as a whole: a coccus, a bacillus or a probe. Refused where it would have to be faster
    /// than [`WorldConfig::max_speed`].
    #[must_use]
    pub fn brownian(params: BrownianParams) -> Self {
        Self::Brownian(Brownian::new(params))
    }

    /// A ciliate's swaying way, avoiding reaction and following of walls.
    #[must_use]
    pub fn avoidance(params: AvoidanceParams) -> Self {
        Self::Avoidance(Avoidance::new(params))
    }

    /// Flight from engulfers that are near, and another behaviour otherwise. At most 8 controllers may lie in one another.
    #[must_use]
    pub fn flee(params: FleeParams, otherwise: Self) -> Self {
        Self::Flee(Flee::new(params, otherwise))
    }

    /// Pursuit of prey in sight, and another behaviour otherwise, likewise.
    #[must_use]
    pub fn pursue(params: PursueParams, otherwise: Self) -> Self {
        Self::Pursue(Pursue::new(params, otherwise))
    }

    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        if self.chain().nth(DEEPEST).is_some() {
            return Err(Error::unsupported("otherwise", format!("at most {DEEPEST} controllers, one in another")));
        }
        match self {
            Self::Still => Ok(()),
            Self::Wander(model) => model.validate(),
            Self::Patrol(model) => model.validate(),
            Self::Thrash(model) => model.validate(),
            Self::Ram(model) => model.validate(),
            Self::PersistentWalk(model) => model.validate(),
            Self::Chemotaxis(model) => model.validate(),
            Self::RunAndTumble(model) => model.validate(),
            Self::Brownian(model) => model.validate(),
            Self::Avoidance(model) => model.validate(),
            Self::Flee(model) => model.validate(),
            Self::Pursue(model) => model.validate(),
        }
    }

    /// Checks that a body follows it as its law says: one that moves in this way, at this speed, in a world of these settings.
    pub(crate) fn check_body(&self, locomotion: &Locomotion, speed: f32, config: &WorldConfig) -> Result<(), Error> {
        self.chain().try_for_each(|controller| match controller {
            Self::PersistentWalk(model) => model.check_body(locomotion, config.dt).and(check_speed(speed, 0.0, config)),
            Self::RunAndTumble(model) => model.check_step(config.dt).and(check_speed(speed, 0.0, config)),
            Self::Brownian(model) => model.check_body(locomotion, config).and(check_speed(speed, 1e-3, config)),
            _ => Ok(()),
        })
    }

    /// Decides for one step.
    pub(crate) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        match self {
            Self::Still => None,
            Self::Wander(model) => model.decide(senses, rng),
            Self::Patrol(model) => model.decide(senses),
            Self::Thrash(model) => model.decide(senses, rng),
            Self::Ram(model) => model.decide(senses, rng),
            Self::PersistentWalk(model) => model.decide(senses, rng),
            Self::Chemotaxis(model) => model.decide(senses, rng),
            Self::RunAndTumble(model) => model.decide(senses, rng),
            Self::Brownian(model) => model.decide(senses, rng),
            Self::Avoidance(model) => model.decide(senses, rng),
            Self::Flee(model) => model.decide(senses, rng),
            Self::Pursue(model) => model.decide(senses, rng),
        }
    }

    /// Turns its own way, if it has one, to the direction in which it got away from where it was stuck.
    pub(crate) fn head(&mut self, direction: Vec2) {
        match self {
            Self::PersistentWalk(model) => model.heading = direction,
            Self::Chemotaxis(model) => model.walk.heading = direction,
            Self::Avoidance(model) => model.head(direction),
            _ => {
                if let Some(otherwise) = self.otherwise_mut() {
                    otherwise.head(direction);
                }
            }
        }
    }

    /// Whether it goes on against what is in its way: it knows where it has to go, or is there to push.
    pub(crate) fn insists(&self) -> bool {
        matches!(self, Self::Patrol(_) | Self::Thrash(_) | Self::Ram(_) | Self::Brownian(_))
    }

    /// What it does when the first thing that it would do is not called for.
    fn otherwise(&self) -> Option<&Self> {
        match self {
            Self::Flee(model) => Some(&model.otherwise),
            Self::Pursue(model) => Some(&model.otherwise),
            _ => None,
        }
    }

    fn otherwise_mut(&mut self) -> Option<&mut Self> {
        match self {
            Self::Flee(model) => Some(&mut model.otherwise),
            Self::Pursue(model) => Some(&mut model.otherwise),
            _ => None,
        }
    }

    /// It and everything that it does otherwise.
    fn chain(&self) -> impl Iterator<Item = &Self> {
        std::iter::successors(Some(self), |controller| controller.otherwise())
    }

    /// The chemicals that it goes by.
    pub(crate) fn chemicals(&self) -> impl Iterator<Item = ChemicalId> {
        self.chain().filter_map(|controller| match controller {
            Self::Chemotaxis(model) => Some(model.params.chemical),
            Self::RunAndTumble(model) => model.params.chemical,
            _ => None,
        })
    }

    /// Whether it compares concentrations around the organism's outline.
    pub(crate) fn needs_outline(&self) -> bool {
        self.chain().any(|controller| matches!(controller, Self::Chemotaxis(_)))
    }
}

/// Checks that what walks at random can have its speed.
fn check_speed(speed: f32, low: f32, config: &WorldConfig) -> Result<(), Error> {
    let accepted = || format!("{low} to {}, `max_speed` of the world, for a random walk", config.max_speed);
    let is_sound = (low..=config.max_speed).contains(&speed);
    is_sound.then_some(()).ok_or_else(|| out_of_range("speed", speed.into(), accepted()))
}

/// Checks that a time of a random walk is three steps long or longer: its law does not hold for shorter ones.
fn check_time(field: &str, time: f32, dt: f32) -> Result<(), Error> {
    let accepted = || format!("{} or more, three steps of {dt} s", 3.0 * dt);
    (time >= 2.99 * dt)
        .then_some(())
        .ok_or_else(|| out_of_range(&format!("controller.{field}"), time.into(), accepted()))
}

fn check_point(field: &str, point: Vec2) -> Result<(), Error> {
    in_range(&format!("{field}.x"), point.x, -1e6, 1e6)?;
    in_range(&format!("{field}.y"), point.y, -1e6, 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_knows_where_to_go_or_is_there_to_push_insists() {
        assert!(Controller::ram(1.0, 1.0, 1.0).insists());
        assert!(!Controller::avoidance(AvoidanceParams::default()).insists());
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let field = |controller: Controller| controller.validate().unwrap_err().field().to_owned();
        assert_eq!(field(Controller::wander([1.0, 0.5], 0.0)), "interval[1]");
        assert_eq!(field(Controller::wander([1.0, 2.0], f32::NAN)), "rest");
        assert_eq!(field(Controller::thrash(0.0, 1.0)), "interval");
        assert_eq!(field(Controller::thrash(1.0, 1.5)), "reversal");
        assert_eq!(field(Controller::ram(1.0, 0.0, 1.0)), "retreat");
        assert_eq!(field(Controller::patrol(vec![], true)), "through");
        assert_eq!(field(Controller::patrol(vec![Vec2::ZERO, Vec2::NAN], true)), "through[1].x");
        assert_eq!(field(Controller::persistent_walk(PersistentWalkParams { persistence: 0.0 })), "persistence");
        let chemotaxis = ChemotaxisParams { threshold: -1.0, ..ChemotaxisParams::towards(ChemicalId(0)) };
        assert_eq!(field(Controller::chemotaxis(chemotaxis)), "threshold");
        let run = RunAndTumbleParams { turn: [0.0, f32::INFINITY], ..RunAndTumbleParams::default() };
        assert_eq!(field(Controller::run_and_tumble(run)), "turn[1]");
        let avoidance = AvoidanceParams { back: [2.0, 1.0], ..AvoidanceParams::default() };
        assert_eq!(field(Controller::avoidance(avoidance)), "back[1]");
        let kicks = Controller::brownian(BrownianParams { interval: 0.0, ..BrownianParams::default() });
        assert_eq!(field(Controller::flee(FleeParams::default(), kicks)), "otherwise.interval");
        let pursuit = Controller::pursue(PursueParams { within: -1.0, ..PursueParams::default() }, Controller::Still);
        assert_eq!(field(pursuit), "within");
    }
}
