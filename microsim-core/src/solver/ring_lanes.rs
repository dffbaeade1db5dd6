//! Tension, bending and area limit of closed rings, in lanes: up to eight rings with equally many nodes are gathered into a
//! block, where node `k` of each is slot `k`, and projected side by side. Each node waits for the one before it, whatever the
//! number of lanes.
//!
//! - Tension: `C = |x_b - x_a| - l` with a compliance when stretched; when slack, a small share of it only, so that the ring
//!   does not buckle under its own compression;
//! - bending: `C = x_i - (x_{i-s} + x_{i+s}) / 2 - n h_s`, `h_s = R (1 - cos(2 pi s / M))` the sagitta of the circle, for
//!   strides `s = 2` and `1` (Mueller et al. 2007, section 4, a stretch of the midpoint);
//! - area: `C = A - A_t <= 0`, see [`super::constraint::Area`], limited in speed, less so beyond a slack.

use super::constraint::MeasuredRing;
use super::lanes::{LANES, Pair, Span, add, load, ratio};
use crate::instruction_set::{Dispatch, each};
use crate::parallel;
use crate::particle::{Columns, DisjointPositions, Particles, PositionCells};
use glam::Vec2;

/// Strides of bending.
pub(super) const STRIDES: [usize; 2] = [2, 1];
/// Inverse stiffness of each over inverse mass, s2.
const BENDING: [f32; 2] = [1.24e-4, 5.9e-5];
/// Inverse stiffness of a stretched link (length/force).
const TENSION_COMPLIANCE: f32 = 1e-5;
/// Share of the tension correction that a slack link gets in a substep of [`SUBSTEP`], in shorter ones less ...
const SLACK_SHARE: f32 = 0.05;
/// ... and the share of its present length below which it is rigid.
const SHORTEST: f32 = 0.5;
/// Substep up to which a slack link is soft by a compliance, s.
const SUBSTEP: f32 = 1.0 / 480.0;
/// Inverse stiffness of the area limit.
const AREA_COMPLIANCE: f32 = 1e-4;

/// Rings from which on gathering them takes less time than it saves.
const FEWEST: usize = 3;
/// Rings that a thread projects at a time, a fixed number whatever the number of threads.
const PORTION: usize = 4 * LANES;

/// A ring, and what its projection aims at.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingTarget<'a> {
    pub ring: &'a [u32],
    /// Of each link.
    pub length: f32,
    /// Sagitta of its circle for each of [`STRIDES`].
    pub rises: [f32; 2],
    /// Most that it encloses.
    pub area: f32,
    /// Most of the excess area that a substep takes back, ...
    pub fastest: f32,
    /// ... and how much more of what is beyond `slack`.
    pub faster: f32,
    /// Excess area that a driven membrane may have for a while.
    pub slack: f32,
    /// Share of the bending stiffness at each node; empty: all of it.
    pub stiffness: &'a [f32],
}

/// The targets of rings side by side.
struct Targets<const L: usize> {
    length: [f32; L],
    rises: [[f32; L]; 2],
    area: [f32; L],
    fastest: [f32; L],
    faster: [f32; L],
    slack: [f32; L],
}

/// Rings side by side in a block of its own.
#[derive(Default)]
struct Gathered {
    origin_x: Vec<f32>,
    origin_y: Vec<f32>,
    x: Vec<f32>,
    y: Vec<f32>,
    inv_mass: Vec<f32>,
    /// Of each node; empty if all rings are stiff throughout.
    stiffness: Vec<f32>,
}

/// One substep's projection of rings that share no node.
pub(super) fn project(mut rings: Vec<RingTarget<'_>>, particles: &mut Particles, h: f32, dispatch: Dispatch) {
    rings.sort_by_key(|target| target.ring.len());
    let of_sizes = rings.chunk_by(|a, b| a.ring.len() == b.ring.len());
    if !parallel::is_large(particles.len()) {
        let mut gathered = Gathered::default();
        for members in of_sizes.flat_map(|of_size| of_size.chunks(LANES)) {
            if members.len() < FEWEST {
                members.iter().for_each(|target| project_alone(target, particles, h, dispatch));
            } else {
                gathered.project(members, particles.position_cells(), h, dispatch);
            }
        }
        return;
    }
    #[expect(unsafe_code, reason = "rings are disjoint, but their nodes do not lie side by side")]
    // SAFETY: a ring is in one portion, and no node is in two rings.
    let positions = unsafe { DisjointPositions::new(particles.position_cells()) };
    let portions = of_sizes.flat_map(|of_size| of_size.chunks(PORTION)).collect();
    parallel::for_each(portions, |rings: &[RingTarget<'_>]| {
        let mut gathered = Gathered::default();
        for members in rings.chunks(LANES) {
            gathered.project(members, positions.cells(), h, dispatch);
        }
    });
}

/// The same for one ring where it lies.
fn project_alone(target: &RingTarget<'_>, particles: &mut Particles, h: f32, dispatch: Dispatch) {
    let targets = Targets::<1>::of(std::slice::from_ref(target));
    dispatch.run(
        #[inline(always)]
        || targets.project(target.ring, &Span::LOOSE, &mut (particles.columns(), target.stiffness), h),
    );
}

impl<const L: usize> Targets<L> {
    /// Lanes beyond the last ring do nothing, as nothing has mass there.
    fn of(rings: &[RingTarget<'_>]) -> Self {
        let each_of = |value: &dyn Fn(&RingTarget<'_>) -> f32| each(|l| rings.get(l).map_or(0.0, value));
        Self {
            length: each_of(&|ring| ring.length),
            rises: [each_of(&|ring| ring.rises[0]), each_of(&|ring| ring.rises[1])],
            area: each_of(&|ring| ring.area),
            fastest: each_of(&|ring| ring.fastest),
            faster: each_of(&|ring| ring.faster),
            slack: each_of(&|ring| ring.slack),
        }
    }

    /// Projects the rings whose nodes are in these slots; `stiffness` as in [`Gathered`].
    #[inline(always)]
    fn project(&self, ring: &[u32], span: &Span<L>, (p, stiffness): &mut (Columns<'_>, &[f32]), h: f32) {
        self.tighten(ring, span, p, h);
        for ((stride, rise), compliance) in STRIDES.into_iter().zip(self.rises).zip(BENDING) {
            let alpha = compliance / (h * h);
            if stiffness.is_empty() {
                let firmness = [1.5 + alpha; L];
                bend(ring, stride, rise, span, p, |_| firmness);
            } else {
                let firmness = |k: usize| {
                    let stiffness = load::<L>(stiffness, k * L);
                    each(|l| 1.5 + alpha / stiffness[l])
                };
                bend(ring, stride, rise, span, p, firmness);
            }
        }
        let measured = MeasuredRing::measure(ring, span, p);
        let alpha = AREA_COMPLIANCE / (h * h);
        let excess = each::<L>(|l| measured.area[l] - self.area[l]);
        let beyond = each::<L>(|l| clamp(excess[l] - self.slack[l], self.faster[l]));
        // The compliance takes back a share only of the error that it is given.
        let most = each::<L>(|l| (self.fastest[l] + beyond[l]) * (1.0 + ratio(alpha, measured.weight[l])));
        let error = each::<L>(|l| if excess[l] < most[l] { excess[l] } else { most[l] });
        let mut acts = [false; L];
        acts.iter_mut().zip(excess).for_each(|(acts, excess)| *acts = excess > 0.0);
        if acts != [false; L] {
            measured.enforce(error, acts, alpha, p);
        }
    }

    #[inline(always)]
    fn tighten(&self, ring: &[u32], span: &Span<L>, p: &mut Columns<'_>, h: f32) {
        let alpha = TENSION_COMPLIANCE / (h * h);
        let shorter = if h < SUBSTEP { (h * h) / (SUBSTEP * SUBSTEP) } else { 1.0 };
        let slack_share = shorter / (shorter + (1.0 - SLACK_SHARE) / SLACK_SHARE);
        let shortest = each::<L>(|l| SHORTEST * self.length[l]);
        for k in 0..ring.len() {
            let next = if k + 1 < ring.len() { k + 1 } else { 0 };
            let pair = Pair::<L>::load(p, span.at(ring[k]), span.at(ring[next]));
            let present = each::<L>(|l| pair.length(l));
            let lack = each::<L>(|l| self.length[l] - present[l]);
            let share = each::<L>(|l| {
                let is_short = present[l] < shortest[l] && lack[l] >= 0.0;
                let numerator = if is_short { shortest[l] - present[l] } else { lack[l] };
                let softness = if is_short { 0.0 } else { alpha };
                let share = ratio(numerator, present[l] * (pair.weight(l) + softness));
                if is_short || lack[l] < 0.0 { share } else { slack_share * share }
            });
            pair.push(p, share);
        }
    }
}

/// A value limited to the range from 0 to `most`.
#[inline(always)]
fn clamp(value: f32, most: f32) -> f32 {
    let value = if value < most { value } else { most };
    if value > 0.0 { value } else { 0.0 }
}

/// Moves each node towards the sagitta `rise` over the nodes `stride` before and after it. Gradient 1 for the node and -1/2 for
/// each neighbour: the squares add up to 1.5, which is the `firmness` of a node without its compliance. All nodes weigh the
/// same, so that compliance is relative to their inverse mass.
#[inline(always)]
fn bend<const L: usize>(
    ring: &[u32],
    stride: usize,
    rise: [f32; L],
    span: &Span<L>,
    p: &mut Columns<'_>,
    firmness: impl Fn(usize) -> [f32; L],
) {
    let count = ring.len();
    for k in 0..count {
        let before = span.at(ring[if k < stride { k + count - stride } else { k - stride }]);
        let after = span.at(ring[if k + stride < count { k + stride } else { k + stride - count }]);
        let node = span.at(ring[k]);
        let [chord_x, chord_y] = p.between_lanes::<L>(before, after);
        let [way_x, way_y] = p.between_lanes::<L>(before, node);
        let inverse = each::<L>(|l| 1.0 / (chord_y[l] * chord_y[l] + chord_x[l] * chord_x[l]).sqrt());
        // Counter-clockwise, so outwards is to the right of the chord. Without a chord there is no such direction.
        let towards = |chord: f32, inverse: f32| {
            if inverse > 0.0 && inverse < f32::INFINITY { chord * inverse } else { -0.0 }
        };
        let outwards_x = each::<L>(|l| towards(chord_y[l], inverse[l]));
        let outwards_y = each::<L>(|l| towards(-chord_x[l], inverse[l]));
        let firmness = firmness(k);
        let by_x = each::<L>(|l| (way_x[l] - chord_x[l] * 0.5 - outwards_x[l] * rise[l]) / firmness[l]);
        let by_y = each::<L>(|l| (way_y[l] - chord_y[l] * 0.5 - outwards_y[l] * rise[l]) / firmness[l]);
        add(p.x, node, each::<L>(|l| -by_x[l]));
        add(p.y, node, each::<L>(|l| -by_y[l]));
        let (half_x, half_y) = (each::<L>(|l| by_x[l] * 0.5), each::<L>(|l| by_y[l] * 0.5));
        for neighbour in [before, after] {
            add(p.x, neighbour, half_x);
            add(p.y, neighbour, half_y);
        }
    }
}

impl Gathered {
    /// One substep's projection of up to eight rings of as many nodes.
    fn project(&mut self, rings: &[RingTarget<'_>], p: PositionCells<'_>, h: f32, dispatch: Dispatch) {
        self.gather(rings, p);
        let slots: Vec<u32> = (0..rings[0].ring.len() as u32).collect();
        let targets = Targets::<LANES>::of(rings);
        dispatch.run(
            #[inline(always)]
            || targets.project(&slots, &Span { base: 0, scale: [1.0; LANES] }, &mut self.parts(), h),
        );
        self.scatter(rings, p);
    }

    fn gather(&mut self, rings: &[RingTarget<'_>], p: PositionCells<'_>) {
        let count = rings[0].ring.len() * LANES;
        let Self { origin_x, origin_y, x, y, inv_mass, stiffness } = self;
        for gathered in [&mut *origin_x, origin_y, x, y, inv_mass] {
            gathered.clear();
            gathered.resize(count, 0.0);
        }
        for (target, lane) in rings.iter().zip(0..) {
            for (slot, &node) in target.ring.iter().enumerate() {
                let (at, node) = (slot * LANES + lane, node as usize);
                (origin_x[at], origin_y[at]) = p.origin(node).into();
                (x[at], y[at]) = p.offset(node).into();
                inv_mass[at] = p.inv_mass(node);
            }
        }
        stiffness.clear();
        if rings.iter().any(|target| !target.stiffness.is_empty()) {
            stiffness.resize(count, 1.0);
            for (target, lane) in rings.iter().zip(0..) {
                for (slot, &share) in stiffness.chunks_exact_mut(LANES).zip(target.stiffness) {
                    slot[lane] = share;
                }
            }
        }
    }

    /// The nodes as a block that begins at 0, and their stiffness.
    fn parts(&mut self) -> (Columns<'_>, &[f32]) {
        let Self { origin_x, origin_y, x, y, inv_mass, stiffness } = self;
        let columns =
            Columns { origin_x, origin_y, x, y, prev_x: &mut [], prev_y: &mut [], vx: &mut [], vy: &mut [], inv_mass };
        (columns, stiffness)
    }

    /// Puts the nodes back where they came from.
    fn scatter(&self, rings: &[RingTarget<'_>], p: PositionCells<'_>) {
        for (target, lane) in rings.iter().zip(0..) {
            for (slot, &node) in target.ring.iter().enumerate() {
                let at = slot * LANES + lane;
                p.set_offset(node as usize, Vec2::new(self.x[at], self.y[at]));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::disc;
    use super::*;
    use crate::rng::Rng;

    /// Rings of `count` nodes that are far from round, some of them without all of their stiffness.
    fn crooked(count: usize, rings: usize, rng: &mut Rng) -> (Particles, Vec<Vec<u32>>, Vec<Vec<f32>>) {
        let mut particles = Particles::default();
        let mut ring = || {
            let origin = Vec2::new(rng.range(0.0, 90.0).floor(), rng.range(0.0, 90.0).floor());
            let mut node = |k: usize| {
                let angle = std::f32::consts::TAU * k as f32 / count as f32;
                let at = crate::geometry::ring::unit_vector(angle) * rng.range(0.3, 0.5) * count as f32 / 3.0;
                particles.insert(&crate::particle::Particle { origin, offset: at, ..disc(at, rng.range(0.5, 2.0)) })
            };
            (0..count).map(&mut node).collect()
        };
        let nodes = (0..rings).map(|_| ring()).collect();
        let stiffness = (0..rings).map(|r| (0..count * (r % 2)).map(|_| rng.range(0.1, 1.0)).collect()).collect();
        (particles, nodes, stiffness)
    }

    #[test]
    fn excess_area_is_taken_back_at_its_speed_in_substeps_of_any_length() {
        use super::super::testing::ring;
        use crate::geometry::{polygon::signed_area, ring::unit_vector};
        use std::f32::consts::TAU;
        let nodes: Vec<u32> = (0..40).collect();
        let area = |p: &Particles| signed_area(&p.live().map(|i| p.position(i)).collect::<Vec<_>>());
        for h in [1.0 / 120.0, 1.0 / 480.0, 1.0 / 5000.0] {
            let mut p = ring(40, 6.4);
            let before = area(&p);
            let (length, fastest) = (12.8 * unit_vector(0.5 * TAU / 40.0).y, 10.0 * h);
            let rises = STRIDES.map(|stride| 6.4 * (1.0 - unit_vector(TAU * stride as f32 / 40.0).x));
            let target = RingTarget {
                ring: &nodes,
                length,
                rises,
                area: 0.9 * before,
                fastest,
                faster: 0.0,
                slack: 0.0,
                stiffness: &[],
            };
            project(vec![target], &mut p, h, Dispatch::default());
            let speed = (before - area(&p)) / h;
            assert!((speed / 10.0 - 1.0).abs() < 0.1, "{speed} units2/s in a substep of {h} s");
        }
    }

    #[test]
    fn eight_lanes_give_the_bits_of_one() {
        let mut rng = Rng::new(5, 3);
        // The last ones in a world that is projected in portions.
        for (count, rings, others) in [(5, 3, 0), (24, 8, 0), (40, 11, 0), (24, 70, 9000)] {
            let (mut side_by_side, nodes, stiffness) = crooked(count, rings, &mut rng);
            side_by_side.extend(others);
            let mut alone = side_by_side.clone();
            let targets: Vec<RingTarget<'_>> = nodes
                .iter()
                .zip(&stiffness)
                .map(|(ring, stiffness)| {
                    let (length, fastest) = (rng.range(0.5, 1.5), rng.range(0.0, 0.1));
                    RingTarget {
                        ring,
                        length,
                        rises: [0.3, 0.1],
                        area: rng.range(0.0, 20.0),
                        fastest,
                        faster: 0.5 * fastest,
                        slack: 1.0,
                        stiffness,
                    }
                })
                .collect();
            for h in [1.0 / 480.0, 1.0 / 2000.0] {
                project(targets.clone(), &mut side_by_side, h, Dispatch::default());
                for target in &targets {
                    project_alone(target, &mut alone, h, Dispatch::default());
                }
            }
            assert_eq!((&side_by_side.x, &side_by_side.y), (&alone.x, &alone.y), "{rings} rings of {count}");
        }
    }

    #[test]
    fn slack_links_grow_more_slowly_in_shorter_substeps_and_grow() {
        let nodes: Vec<u32> = (0..40).collect();
        let grown = |h: f32| {
            let mut p = super::super::testing::ring(40, 6.4);
            let around = |p: &Particles| (0..40).map(|k| p.between(k, (k + 1) % 40).length()).sum::<f32>();
            let before = around(&p);
            let target = RingTarget {
                ring: &nodes,
                length: before / 40.0 / 0.97,
                rises: [0.0; 2],
                area: 0.0,
                fastest: 0.0,
                faster: 0.0,
                slack: 0.0,
                stiffness: &[],
            };
            Targets::<1>::of(std::slice::from_ref(&target)).tighten(&nodes, &Span::LOOSE, &mut p.columns(), h);
            around(&p) - before
        };
        let [whole, half] = [1.0, 0.5].map(|share| grown(share * SUBSTEP));
        assert!(half > 0.05 * whole && half < 0.9 * whole, "{half} of {whole}");
    }
}
