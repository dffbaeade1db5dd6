//! Membrane: a closed ring of linked particles under tension, which may grow.
//!
//! Edge `i` links ring nodes `i` and `i + 1`. Three things together make it hug its content without wrinkles (no single
//! one does): a perimeter that contracts towards that of a circle around the content, a one-sided area limit, and
//! bending towards the circle's curvature. The content's pressure on it is that of the fluid's discs. Once per step [`Membrane::relax`] finds the targets; per substep [`project`]
//! applies them, see [`ring_lanes`], and [`Membrane::limit_strain`], last in the substep, keeps every link below
//! [`STRAIN_LIMIT`] (thesis, 4.2.2: "a distance joint that will respect a maximum length limit").

use super::constraint::Rope;
use super::ring_lanes::{self, RingTarget, STRIDES};
use crate::geometry::ring::unit_vector;
use crate::instruction_set::Dispatch;
use crate::particle::Particles;
use crate::solver::lanes::Span;
use serde::{Deserialize, Serialize};
use std::f32::consts::{PI, TAU};

/// No link gets longer than this many rest lengths: the promise ...
pub(crate) const STRAIN_LIMIT: f32 = 1.25;
/// ... what is enforced, because walls come after it in a substep ...
const TAUT: f32 = 1.2;
/// ... and how many sweeps that may take.
const STRAIN_SWEEPS: usize = 8;
/// Resting perimeter relative to the regular polygon around the content, and what is added while driven.
const PERIMETER_AT_REST: f32 = 0.995;
const PERIMETER_DRIVEN: f32 = 0.205;
/// Share of a driven membrane's excess perimeter that it accepts, up to this multiple of the circle.
const EXCESS_ACCEPTED: f32 = 0.7;
const EXCESS_LIMIT: f32 = 1.25;
/// That multiple for a ring that protrudes, over its driven perimeter.
const EXCESS_PROTRUDING: f32 = 1.14;
/// Time constants, s: how fast activity follows the drive, and the perimeter grows and shrinks.
const ACTIVITY_TIME: f32 = 0.5;
const STRETCH_TIME: f32 = 0.25;
const SHRINK_TIME: f32 = 0.6;
/// Activity above which a membrane was driven lately: it falls below 1.5 s after the drive.
const ACTIVE: f32 = 0.05;
/// Speed at which excess area is taken back at most, in link lengths per second: at rest and beyond the slack, and while driven, ...
const FASTEST_AT_REST: f32 = 4.0;
const FASTEST_DRIVEN: f32 = 0.7;
/// ... when the area may be larger by this share.
const AREA_SLACK: f32 = 0.015;

/// A closed ring's parameters and state. The ring itself, particle indices in counter-clockwise order, is its owner's.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Membrane {
    /// Length of every link when the membrane was made; a new node adds one more of it.
    pub rest_length: f32,
    /// Radius of a node.
    pub node_radius: f32,
    /// Radius of its circle at rest less that of its content, units.
    pub rim: f32,
    /// 0 at rest, 1 after being driven for a while.
    activity: f32,
    /// Present total rest length of the links.
    rest_perimeter: f32,
    target_area: f32,
    /// See [`MembraneContent::lobes`].
    lobes: f32,
    /// See [`Flexibility::stiffness`]. Found in every step.
    #[serde(skip)]
    stiffness: Vec<f32>,
}

/// How a membrane gives way while it is driven.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flexibility<'a> {
    /// Perimeter that it gains, relative to the circle around its content, or what it gains by default.
    pub slack: Option<f32>,
    /// Share of the bending stiffness at each node of the ring; empty: all of it.
    pub stiffness: &'a [f32],
}

impl Flexibility<'_> {
    /// That of a membrane that does not protrude.
    pub(crate) const LEAST: Self = Self { slack: None, stiffness: &[] };
}

/// What a membrane holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MembraneContent {
    /// Area at rest, square units.
    pub area: f32,
    /// Circles of equal size that it is to fill: 1, or up to 3 while a furrow closes.
    pub lobes: f32,
    /// Length that folds take beside that, units.
    pub folds: f32,
}

impl Membrane {
    pub(crate) fn new(rest_length: f32, node_radius: f32, rim: f32, nodes: usize) -> Self {
        let rest_perimeter = rest_length * nodes as f32;
        Self {
            rest_length,
            node_radius,
            rim,
            activity: 0.0,
            rest_perimeter,
            target_area: f32::INFINITY,
            lobes: 1.0,
            stiffness: Vec::new(),
        }
    }

    /// Present total rest length of its links.
    pub(crate) fn rest_perimeter(&self) -> f32 {
        self.rest_perimeter
    }

    /// Whether it has been driven lately.
    pub(crate) fn is_active(&self) -> bool {
        self.activity > ACTIVE
    }

    /// The same for a part of its ring, or for more: `nodes` instead of `before`, under the same tension.
    pub(crate) fn resized(&self, before: usize, nodes: usize) -> Self {
        let rest_perimeter = self.rest_perimeter * nodes as f32 / before as f32;
        Self { rest_perimeter, target_area: f32::INFINITY, lobes: 1.0, stiffness: Vec::new(), ..self.clone() }
    }

    /// Its numbers by the names of their fields: those that are always finite.
    pub(crate) fn state(&self) -> [f32; 5] {
        [self.rest_length, self.node_radius, self.rim, self.activity, self.rest_perimeter]
    }

    /// Finds this step's targets from what the membrane holds and whether it is being driven.
    pub(crate) fn relax(
        &mut self,
        ring: &[u32],
        particles: &Particles,
        content: MembraneContent,
        is_driven: bool,
        flexibility: Flexibility<'_>,
        dt: f32,
    ) {
        self.stiffness.clear();
        self.stiffness.extend_from_slice(flexibility.stiffness);
        let (gain, limit) = flexibility
            .slack
            .map_or((PERIMETER_DRIVEN, EXCESS_LIMIT), |slack| (slack, (1.0 + slack) * EXCESS_PROTRUDING));
        let drive = if is_driven { 1.0 } else { 0.0 };
        self.activity += (drive - self.activity) * share(dt, ACTIVITY_TIME);
        let radius = (content.area / (PI * content.lobes)).sqrt() + self.rim;
        self.target_area = content.lobes * PI * radius * radius;
        let circle = content.lobes * TAU * radius * polygon_over_circle(ring.len() as f32 / content.lobes);
        self.lobes = content.lobes;
        let mut target = (PERIMETER_AT_REST + gain * self.activity) * circle;
        let perimeter = perimeter(ring, particles);
        if perimeter > target {
            let accepted = if perimeter < limit * circle { perimeter } else { limit * circle };
            let excess = if accepted > target { accepted - target } else { 0.0 };
            target += EXCESS_ACCEPTED * self.activity * excess;
        }
        target += content.folds;
        let time = if target > self.rest_perimeter { STRETCH_TIME } else { SHRINK_TIME };
        self.rest_perimeter += (target - self.rest_perimeter) * share(dt, time);
    }

    /// What a substep of `h` aims at. `circle` is that of another membrane and becomes its own.
    fn target<'a>(&'a self, ring: &'a [u32], h: f32, circle: &mut Circle) -> RingTarget<'a> {
        let length = self.rest_perimeter / ring.len() as f32;
        let around = ring.len() as f32 / self.lobes;
        if circle.links != around {
            *circle = Circle::of(around);
        }
        let radius = 0.5 * length / circle.sine;
        let rises = circle.cosines.map(|cosine| radius * (1.0 - cosine));
        let speed = FASTEST_AT_REST + (FASTEST_DRIVEN - FASTEST_AT_REST) * self.activity;
        let at = |speed: f32| self.rest_perimeter * h * speed * self.rest_length;
        let (fastest, faster) = (at(speed), at(FASTEST_AT_REST - speed));
        let slack = AREA_SLACK * self.target_area;
        let stiffness = if self.stiffness.len() == ring.len() { self.stiffness.as_slice() } else { &[] };
        RingTarget { ring, length, rises, area: self.target_area, fastest, faster, slack, stiffness }
    }

    /// Shortens every link that is longer than [`STRAIN_LIMIT`] allows, in sweeps forwards and backwards.
    pub(crate) fn limit_strain(&self, ring: &[u32], particles: &mut Particles) {
        let particles = &mut particles.columns();
        let max_length = TAUT * self.rest_length;
        let mut shorten = |k: usize| {
            let (a, b) = (ring[k], ring[if k + 1 < ring.len() { k + 1 } else { 0 }]);
            let is_long = particles.between(a as usize, b as usize).length_squared() > max_length * max_length;
            if is_long {
                Rope { a, b, max_length }.shorten(&[Span::LOOSE], particles);
            }
            is_long
        };
        for sweep in 0..STRAIN_SWEEPS {
            let count = ring.len();
            let turn = |k| if sweep % 2 == 0 { k } else { count - 1 - k };
            if (0..count).filter(|&k| shorten(turn(k))).count() == 0 {
                break;
            }
        }
    }
}

/// One substep's tension, bending and area limit of membranes that share no node.
pub(crate) fn project<'a>(
    membranes: impl Iterator<Item = (&'a Membrane, &'a [u32])>,
    particles: &mut Particles,
    h: f32,
    dispatch: Dispatch,
) {
    let mut circle = Circle::of(1.0);
    let targets = membranes.map(|(membrane, ring)| membrane.target(ring, h, &mut circle)).collect();
    ring_lanes::project(targets, particles, h, dispatch);
}

/// A circle of links; most membranes have the same one.
struct Circle {
    /// How many links go once around.
    links: f32,
    /// Of half of the angle of a link.
    sine: f32,
    /// Of the angle of each of [`STRIDES`].
    cosines: [f32; 2],
}

impl Circle {
    fn of(links: f32) -> Self {
        let cosines = STRIDES.map(|stride| unit_vector(TAU * stride as f32 / links).x);
        Self { links, sine: unit_vector(PI / links).y, cosines }
    }
}

/// Neighbouring nodes, in the order of the ring.
pub(crate) fn links(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// Perimeter of a regular polygon of so many sides, at least three, over that of the circle of the same area.
fn polygon_over_circle(sides: f32) -> f32 {
    let sides = if sides > 3.0 { sides } else { 3.0 };
    let half_side = unit_vector(PI / sides);
    (sides * half_side.y / (PI * half_side.x)).sqrt()
}

fn perimeter(ring: &[u32], particles: &Particles) -> f32 {
    links(ring).map(|(a, b)| particles.between(a as usize, b as usize).length()).sum()
}

/// First-order approach to a target within `time`, for steps short against it.
fn share(dt: f32, time: f32) -> f32 {
    dt / (dt + time)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{momentum, ring};
    use super::*;
    use crate::geometry::polygon::signed_area;

    fn positions(p: &Particles) -> Vec<glam::Vec2> {
        p.live().map(|i| p.position(i)).collect()
    }

    fn longest_link(p: &Particles) -> f32 {
        let indices: Vec<u32> = (0..p.len() as u32).collect();
        links(&indices).map(|(a, b)| p.between(a as usize, b as usize).length()).fold(0.0, f32::max)
    }

    fn relax(p: &mut Particles, area: f32) {
        let indices: Vec<u32> = (0..p.len() as u32).collect();
        let mut membrane = Membrane::new(1.0, 0.5, 0.58, indices.len());
        let content = MembraneContent { area, lobes: 1.0, folds: 0.0 };
        for _ in 0..600 {
            membrane.relax(&indices, p, content, false, Flexibility::LEAST, 1.0 / 60.0);
            for _ in 0..8 {
                project([(&membrane, indices.as_slice())].into_iter(), p, 1.0 / 480.0, Dispatch::default());
                membrane.limit_strain(&indices, p);
            }
        }
    }

    #[test]
    fn a_dented_ring_becomes_round_again_and_keeps_its_momentum() {
        let mut p = ring(40, 6.4);
        for i in 0..10 {
            p.x[i] *= 0.7;
        }
        let before = momentum(&p);
        relax(&mut p, 90.0);
        let points = positions(&p);
        let centre = points.iter().sum::<glam::Vec2>() / 40.0;
        let radii: Vec<f32> = points.iter().map(|&at| (at - centre).length()).collect();
        let spread = radii.iter().fold(0.0f32, |far, r| far.max((r - radii[0]).abs()));
        assert!(spread < 0.25, "radii {radii:?}");
        assert!((momentum(&p) - before).length() < 1e-2);
    }

    #[test]
    fn perimeter_and_area_approach_the_circle_around_the_content() {
        for (count, content) in [(40, 80.0), (14, 7.0)] {
            let mut p = ring(count, 0.16 * count as f32);
            relax(&mut p, content);
            let radius = (content / PI).sqrt() + 0.58;
            let area = signed_area(&positions(&p));
            assert!((area / (PI * radius * radius) - 1.0).abs() < 0.02, "area {area} of {count} nodes");
        }
    }

    #[test]
    fn t15_stretched_links_return_to_their_rest_length() {
        let mut p = ring(40, 1.15 * 40.0 / TAU);
        let indices: Vec<u32> = (0..40).collect();
        let membrane = Membrane::new(1.0, 0.5, 0.58, 40);
        for _ in 0..400 {
            project([(&membrane, indices.as_slice())].into_iter(), &mut p, 1.0 / 480.0, Dispatch::default());
        }
        assert!(longest_link(&p) < 1.01, "longest {}", longest_link(&p));
    }

    #[test]
    fn no_link_stays_longer_than_the_strain_limit() {
        let mut p = ring(40, 6.4);
        p.x[0] += 2.0;
        let indices: Vec<u32> = (0..40).collect();
        let membrane = Membrane::new(1.0, 0.5, 0.58, 40);
        (0..40).for_each(|_| membrane.limit_strain(&indices, &mut p));
        assert!(longest_link(&p) < 1.26, "longest {}", longest_link(&p));
    }

    #[test]
    fn a_part_of_a_membrane_is_under_the_same_tension() {
        let mut whole = Membrane::new(1.0, 0.5, 0.58, 40);
        whole.rest_perimeter = 36.0;
        let [half, more] = [20, 50].map(|nodes| whole.resized(40, nodes).rest_perimeter());
        assert_eq!((half, more), (18.0, 45.0));
        let reached = [share(0.01, 0.25), share(0.25, 0.25), share(0.0, 0.25)];
        assert!((reached[0] - 0.04).abs() < 2e-3 && reached[1] == 0.5 && reached[2] == 0.0, "{reached:?}");
    }

    #[test]
    fn a_driven_membrane_accepts_a_share_of_an_excess_up_to_a_limit() {
        let circle = TAU * ((80.0 / PI).sqrt() + 0.58) * polygon_over_circle(40.0);
        let indices: Vec<u32> = (0..40).collect();
        for (slack, gain, limit) in [(None, PERIMETER_DRIVEN, EXCESS_LIMIT), (Some(0.3), 0.3, 1.3 * EXCESS_PROTRUDING)]
        {
            let (driven, most) = ((PERIMETER_AT_REST + gain) * circle, limit * circle);
            let half = 0.5 * (driven + most);
            for (perimeter, accepted) in [(0.9 * driven, driven), (half, half), (2.0 * most, most)] {
                let p = ring(40, perimeter / (80.0 * unit_vector(PI / 40.0).y));
                let mut membrane = Membrane::new(1.0, 0.5, 0.58, 40);
                let content = MembraneContent { area: 80.0, lobes: 1.0, folds: 0.0 };
                let flexibility = Flexibility { slack, stiffness: &[] };
                (0..3).for_each(|_| membrane.relax(&indices, &p, content, true, flexibility, 1e6));
                let expected = driven + EXCESS_ACCEPTED * (accepted - driven);
                let reached = membrane.rest_perimeter;
                assert!((reached / expected - 1.0).abs() < 1e-3, "{perimeter}: {reached}, not {expected}");
            }
        }
    }
}
