//! Everything about a world that is fixed when it is made.

use crate::error::{Error, count_in_range, in_range, out_of_range};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// Without protection of its membranes a world lets things move so many times faster than its speed limit.
const UNPROTECTED: f32 = 15.0;

/// Shortest substep, s: in shorter ones the corrections of a membrane that changes exceed the speed limit, and discs get through
/// it.
const SHORTEST_SUBSTEP: f32 = 0.0002;
/// Longest substep, s.
const LONGEST_SUBSTEP: f32 = 0.017;
/// The same with a membrane, s: in longer ones loads stretch links beyond their limit, and crawling cells tear voids open.
const LONGEST_SUBSTEP_OF_MEMBRANES: f32 = 0.006;
/// The same with grains, s: in longer ones they make energy, and heaps slide apart.
const LONGEST_SUBSTEP_OF_GRAINS: f32 = 0.0025;
/// Largest angular frequency times substep of a spring: beyond, its damping ratio is wrong by more than 0.01.
const FASTEST_SWING: f32 = 0.25;
/// Largest damping times substep: what moves steadily gets one and this times as far as its speed says.
const MOST_DAMPED: f32 = 0.05;
/// Largest viscosity times substep: differences between nearest neighbours decay faster than they should, here by an eighth. With
/// room for the rounding of the substep.
const MOST_VISCOUS: f32 = 0.5 + f32::EPSILON;

/// Sleep speed, units/s: on a screen with ten pixels to a unit a pixel in five seconds.
const SLEEP_SPEED: f32 = 0.02;
/// Time below the sleep speed after which a body falls asleep, s.
const TIME_TO_SLEEP: f32 = 0.5;

/// What gives crawling cells their grip: rigid and amoeboid cells. Bacteria, probes and templates with a
/// [`Propulsion`](crate::Propulsion) swim: they need none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Substrate {
    /// The slide, everywhere: the room is seen from above. What drives a cell gives its nodes their velocities, as in the thesis.
    #[default]
    Slide,
    /// Only what a cell touches: obstacles, walls and other organisms. It pulls itself along them with a finite force, organisms
    /// are pulled the other way, and a cell that touches nothing flies or falls.
    Surfaces,
}

/// Size of the largest body, units: beyond an open side it is removed only when all of it is.
const LARGEST_BODY: f32 = 10_000.0;

/// Shortest length between periodic sides, in ways at the speed limit in a step: a particle meets one image of another.
const SHORTEST_PERIOD: f32 = 4.0;
/// What that length is a multiple of, units: the distance of origins of positions, so that images are displaced exactly.
const PERIOD_GRID: f32 = 1.0 / 256.0;

/// What one side of the room is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Side {
    /// A wall.
    #[default]
    Wall,
    /// Nothing: what has the centres of all its discs beyond it is removed at the end of the step, fluid particle by particle, with
    /// [`Event::Drained`](crate::Event::Drained).
    Open,
    /// The opposite side: the room repeats beyond it. What goes out here comes in there, and near it things touch images of what is
    /// near the opposite one, which has to be periodic as well. The room's length between the two is a multiple of 1/256, and at least
    /// four times the way at the speed limit in a step. What such a room cannot hold is refused by name: membranes, chemicals and
    /// controllers among others.
    Periodic,
}

/// What the sides of the room are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Sides {
    /// At y = 0.
    pub bottom: Side,
    /// At the room's height.
    pub top: Side,
    /// At x = 0.
    pub left: Side,
    /// At the room's width.
    pub right: Side,
}

impl Sides {
    /// All of them, in the order of [`Wall::ALL`](crate::Wall::ALL).
    pub(crate) fn in_order(self) -> [Side; 4] {
        [self.bottom, self.top, self.left, self.right]
    }
}

/// Settings of a [`crate::World`]. The length unit is the micrometre of the picture, the time unit the second.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldConfig {
    /// Width and height of the walled room; its lower left corner is the origin. 1 to 20 000 each. [`crate::World::set_size`]
    /// changes it.
    pub size: Vec2,
    /// Time of one step, s. 0.001 to 0.1.
    pub dt: f32,
    /// Substeps per step, 1 to 64, each 0.0002 to 0.017 s long, with amoeboid cells at most 0.006 s, with grains 0.0025 s.
    /// More are stiffer and cost proportionally; below 6 jams stretch visibly.
    pub substeps: u32,
    /// Acceleration on everything, units/s2. Components within ±1000.
    pub gravity: Vec2,
    /// Linear damping, 1/s, the drag of the medium: a free particle keeps exp(-damping t) of its speed. 0 to 100, and at most 0.05
    /// over the substep: 24 by default.
    pub damping: f32,
    /// Speed limit of every particle, units/s, 0.1 to 1000. Bounds how far anything moves in a step, hence the margin with
    /// which pairs are searched, and is what makes walls and membranes tight (thesis 3.1.2, 4.2.2).
    /// Where it lets a particle pass a node of a membrane within a substep, an absurd load can make a cell leak or press it flat;
    /// one that is flat is frozen, see [`crate::Event::Quarantined`].
    pub max_speed: f32,
    /// Seed of every random number in the world.
    pub seed: u64,
    /// Whether membranes are protected from leaking: contacts with links that know their side, strain limit, displacement
    /// clamp, ray-cast net. Without it they are the thesis' chain of discs, which leaks; for comparison only.
    pub protects_membranes: bool,
    /// Whether bodies that lie still are left out of the step until something that moves comes near. Membranes and fluid never
    /// are. Without it, everything costs its full share in every step.
    pub sleeps: bool,
    /// Most particles that the world accepts, 1 to 4 000 000.
    pub max_particles: u32,
    /// What gives crawling cells their grip.
    pub substrate: Substrate,
    /// Which sides of the room are walls. Chemicals stay in it whatever they are.
    pub sides: Sides,
}

impl Default for WorldConfig {
    fn default() -> Self {
        Self {
            size: Vec2::new(160.0, 90.0),
            dt: 1.0 / 60.0,
            substeps: 8,
            gravity: Vec2::ZERO,
            damping: 0.5,
            max_speed: 20.0,
            seed: 0,
            protects_membranes: true,
            sleeps: true,
            max_particles: 500_000,
            substrate: Substrate::Slide,
            sides: Sides::default(),
        }
    }
}

impl WorldConfig {
    /// Largest width and height of a room, units: beyond it `f32` is too coarse for contacts.
    pub const MAX_SIZE: f32 = 20_000.0;

    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        in_range("size.x", self.size.x, 1.0, Self::MAX_SIZE)?;
        in_range("size.y", self.size.y, 1.0, Self::MAX_SIZE)?;
        in_range("dt", self.dt, 0.001, 0.1)?;
        count_in_range("substeps", self.substeps, 1, 64)?;
        self.check_substeps(LONGEST_SUBSTEP, "")?;
        in_range("gravity.x", self.gravity.x, -1000.0, 1000.0)?;
        in_range("gravity.y", self.gravity.y, -1000.0, 1000.0)?;
        self.check_damping("damping", self.damping)?;
        in_range("max_speed", self.max_speed, 0.1, 1000.0)?;
        self.check_periodic_sides()?;
        count_in_range("max_particles", self.max_particles, 1, 4_000_000)
    }

    #[inline(never)]
    fn check_periodic_sides(&self) -> Result<(), Error> {
        let Sides { bottom, top, left, right } = self.sides;
        for (pair, field) in [([left, right], "sides.right"), ([bottom, top], "sides.top")] {
            if pair[0] != pair[1] && pair.contains(&Side::Periodic) {
                return Err(Error::unsupported(field, "a side that is periodic if and only if the opposite one is"));
            }
        }
        if self.period_lengths() != Vec2::ZERO && self.substrate == Substrate::Surfaces {
            return Err(Error::unsupported("substrate", "the slide in a room with periodic sides"));
        }
        for (length, field) in self.period_lengths().to_array().into_iter().zip(["size.x", "size.y"]) {
            let least = SHORTEST_PERIOD * self.max_displacement();
            if length > 0.0 && (length < least || (length / PERIOD_GRID).fract() != 0.0) {
                let accepted = format!("a multiple of 1/256 of at least {least:.3} between periodic sides");
                return Err(out_of_range(field, length.into(), accepted));
            }
        }
        Ok(())
    }

    /// The room's lengths between periodic sides, 0 between others.
    pub(crate) fn period_lengths(&self) -> Vec2 {
        let Sides { bottom, left, .. } = self.sides;
        let or_zero = |side: Side, length: f32| if side == Side::Periodic { length } else { 0.0 };
        Vec2::new(or_zero(left, self.size.x), or_zero(bottom, self.size.y))
    }

    /// Lower left and upper right corner of what the walls enclose, infinitely far where a side is none.
    pub(crate) fn walls(&self) -> [Vec2; 2] {
        let Sides { bottom, top, left, right } = self.sides;
        let or = |side: Side, wall: f32, far: f32| if side == Side::Wall { wall } else { far };
        let far = f32::INFINITY;
        let low = Vec2::new(or(left, 0.0, -far), or(bottom, 0.0, -far));
        [low, Vec2::new(or(right, self.size.x, far), or(top, self.size.y, far))]
    }

    /// Lower left and upper right corner of where particles may be: within a room's size of the room, and beyond an open side as
    /// far as the largest body that is still partly in the room.
    pub(crate) fn particle_bounds(&self) -> [Vec2; 2] {
        let Sides { bottom, top, left, right } = self.sides;
        let beyond =
            |side: Side, size: f32| if side == Side::Open && size < LARGEST_BODY { LARGEST_BODY } else { size };
        let low = Vec2::new(beyond(left, self.size.x), beyond(bottom, self.size.y));
        let high = Vec2::new(beyond(right, self.size.x), beyond(top, self.size.y));
        [-low, self.size + high]
    }

    /// Checks that substeps are short enough for a damping of everything, or of one organism.
    pub(crate) fn check_damping(&self, field: &str, damping: f32) -> Result<(), Error> {
        in_range(field, damping, 0.0, 100.0)?;
        self.check_rate(field, damping, [0.0, MOST_DAMPED / self.substep()])
    }

    /// Checks that substeps are short enough for cells with membranes.
    pub(crate) fn check_membranes(&self) -> Result<(), Error> {
        self.check_substeps(LONGEST_SUBSTEP_OF_MEMBRANES, ", with amoeboid cells")
    }

    /// Checks that substeps are short enough for grains.
    pub(crate) fn check_grains(&self) -> Result<(), Error> {
        self.check_substeps(LONGEST_SUBSTEP_OF_GRAINS, ", with grains")
    }

    /// Checks that substeps are short enough for a fluid of this viscosity, 1/s.
    pub(crate) fn check_viscosity(&self, viscosity: f32) -> Result<(), Error> {
        self.check_rate("viscosity", viscosity, [0.0, MOST_VISCOUS / self.substep()])
    }

    /// Checks that substeps are short enough for a spring of this frequency, Hz.
    pub(crate) fn check_frequency(&self, frequency: f32) -> Result<(), Error> {
        self.check_rate("frequency", frequency, [0.01, FASTEST_SWING / (TAU * self.substep())])
    }

    fn check_substeps(&self, longest: f32, whose: &str) -> Result<(), Error> {
        let [least, most] = [(self.dt / longest).ceil() as u32, ((self.dt / SHORTEST_SUBSTEP) as u32).min(64)];
        let accepted = || {
            let range = format!("substeps of {SHORTEST_SUBSTEP} to {longest} s");
            out_of_range(
                "substeps",
                f64::from(self.substeps),
                format!("{least} to {most} of a step of {} s{whose}: {range}", self.dt),
            )
        };
        (least..=most).contains(&self.substeps).then_some(()).ok_or_else(accepted)
    }

    /// Checks a number whose range depends on the substep.
    fn check_rate(&self, field: &str, rate: f32, [least, most]: [f32; 2]) -> Result<(), Error> {
        let accepted = || {
            let range = format!("{least} to {most:.1} with {} substeps of a step of {} s", self.substeps, self.dt);
            out_of_range(field, f64::from(rate), range)
        };
        (least..=most).contains(&rate).then_some(()).ok_or_else(accepted)
    }

    /// Least distance between two walls that face each other, units; infinite if there are none.
    pub(crate) fn width_between_walls(&self) -> f32 {
        let [low, high] = self.walls();
        (high - low).min_element()
    }

    /// Time of one substep, s.
    pub(crate) fn substep(&self) -> f32 {
        self.dt / self.substeps as f32
    }

    /// Largest speed that a particle keeps in a substep.
    pub(crate) fn speed_limit(&self) -> f32 {
        if self.protects_membranes { self.max_speed } else { UNPROTECTED * self.max_speed }
    }

    /// Steps below the sleep speed after which a body falls asleep.
    pub(crate) fn steps_to_sleep(&self) -> u16 {
        (TIME_TO_SLEEP / self.dt) as u16
    }

    /// Speed of its fastest particle below which a body counts as at rest, units/s. At most a quarter of the speed of free fall
    /// through the medium after the time to sleep, so that nothing falls asleep on its way down, or where it turns round.
    pub(crate) fn sleep_speed(&self) -> f32 {
        let fall = self.fall_speed(1.0, 0.0);
        if fall > 0.0 && 0.25 * fall < SLEEP_SPEED { 0.25 * fall } else { SLEEP_SPEED }
    }

    /// Speed that what was at rest falls with after the time to sleep, with a share of gravity and a damping of its own, units/s.
    pub(crate) fn fall_speed(&self, gravity_scale: f32, own_damping: f32) -> f32 {
        let damping = self.damping + own_damping;
        gravity_scale.abs() * self.gravity.length() * TIME_TO_SLEEP / (1.0 + damping * TIME_TO_SLEEP)
    }

    /// Largest displacement of a particle in a step, units.
    pub(crate) fn max_displacement(&self) -> f32 {
        self.max_speed * self.dt
    }

    /// Largest displacement of a particle in a substep, units.
    pub(crate) fn max_substep_displacement(&self) -> f32 {
        self.speed_limit() * self.substep()
    }
}
