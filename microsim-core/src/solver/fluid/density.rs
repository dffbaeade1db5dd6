//! The density constraint of position-based fluids (Macklin, Mueller 2013), and viscosity in the same passes.
//!
//! Lengths are in units of the support `H`: `q = |x_i - x_j|`, `W = (1 - q)^3`, `|grad W| = 3 (1 - q)^2`.

use super::neighbours::{Group, Lanes, Neighbour, Walls, distance, positive};
use crate::instruction_set::each;
use crate::solver::lanes::LANES;

/// Kernel radius in units of the rest spacing.
pub(super) const SUPPORT: f32 = 2.0;
/// Softens the multiplier where a particle has few neighbours, at a substep of [`SUBSTEP`] or longer.
const RELAXATION: f32 = 0.5;
/// In shorter substeps, s, the softness is that of a compliance: it grows with `1 / h^2`.
const SUBSTEP: f32 = 1.0 / 480.0;
/// Share of the correction that is applied: neighbours correct the same error at once.
const UNDER_RELAXATION: f32 = 0.7;
/// Enclosed particles are kept from getting nearer than this share of the rest spacing.
const MIN_SPACING: f32 = 0.85;
/// Share of what two of them lack to it that a substep of [`SUBSTEP`] or longer corrects, on each side.
const SPACING_SHARE: f32 = 0.25;

/// A wall stands for the mirror image of the fluid before it, or else fluid would crowd there: this many particles ...
const WALL_WEIGHT: f32 = 11.6;
/// ... this far behind its surface. In a mirrored hexagonal lattice a particle at half a spacing gets that density, and that push,
/// from its own multiplier and that of its image. Here its own alone gives it, so that the push is a gradient and makes no energy.
const WALL_DEPTH: f32 = 1.0 / SUPPORT;

/// Kernel sums of a group's members, themselves included, and what follows from them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    density: Lanes,
    gradient_x: Lanes,
    gradient_y: Lanes,
    /// The walls' part of the gradient.
    wall_x: Lanes,
    wall_y: Lanes,
    /// Sum of the squared lengths of the neighbours' gradients.
    squared: Lanes,
    /// Sum of the neighbours' ways in this substep, each with its kernel's weight.
    drift_x: Lanes,
    drift_y: Lanes,
    /// `-lambda` (eq. 11), times what is common to all corrections of eq. 12.
    pub multiplier: Lanes,
}

/// First pass: sums over the neighbours. Keeps the members' distances from each candidate for the second pass, so that roots are
/// taken once.
#[inline(always)]
pub(super) fn sum(group: &Group, neighbours: &[Neighbour], mut distances: &mut [Lanes]) -> Sums {
    let (x, y) = (group.load(neighbours, |s| s.x), group.load(neighbours, |s| s.y));
    // A particle's own kernel adds 1 to its squares but is no neighbour's gradient.
    let mut sums = Sums { squared: [-1.0; LANES], ..Sums::default() };
    for window in group.windows(neighbours) {
        let (kept, others) = distances.split_at_mut(window.len());
        distances = others;
        for (other, kept) in window.iter().zip(kept) {
            let (dx, dy): (Lanes, Lanes) = (each(|l| x[l] - other.x), each(|l| y[l] - other.y));
            let r: Lanes = each(|l| distance(dx[l], dy[l]));
            *kept = r;
            let near: Lanes = each(|l| positive(1.0 - r[l]));
            let slope: Lanes = each(|l| near[l] * near[l]);
            let (along, weight): (Lanes, Lanes) = (each(|l| slope[l] / r[l]), each(|l| slope[l] * near[l]));
            add(&mut sums.density, |l| weight[l]);
            add(&mut sums.gradient_x, |l| dx[l] * along[l]);
            add(&mut sums.gradient_y, |l| dy[l] * along[l]);
            add(&mut sums.squared, |l| slope[l] * slope[l]);
            add(&mut sums.drift_x, |l| weight[l] * other.moved_x);
            add(&mut sums.drift_y, |l| weight[l] * other.moved_y);
        }
    }
    sums
}

impl Sums {
    /// Adds the walls' density and gradient.
    #[inline(always)]
    pub(super) fn add_walls(&mut self, group: &Group, neighbours: &[Neighbour], walls: &Walls) {
        let (x, y) = (group.load(neighbours, |s| s.x), group.load(neighbours, |s| s.y));
        for l in 0..LANES {
            for (sign, near) in [(1.0, wall_nearness(x[l] - walls.low.x)), (-1.0, wall_nearness(walls.high.x - x[l]))] {
                self.density[l] += WALL_WEIGHT * near * near * near;
                self.wall_x[l] += sign * WALL_WEIGHT * near * near;
            }
            for (sign, near) in [(1.0, wall_nearness(y[l] - walls.low.y)), (-1.0, wall_nearness(walls.high.y - y[l]))] {
                self.density[l] += WALL_WEIGHT * near * near * near;
                self.wall_y[l] += sign * WALL_WEIGHT * near * near;
            }
            self.gradient_x[l] += self.wall_x[l];
            self.gradient_y[l] += self.wall_y[l];
        }
    }

    /// Density over the rest density, less 1, where that is positive.
    #[inline(always)]
    pub(super) fn compression(&self, rest_density: f32) -> Lanes {
        each(|l| positive(self.density[l] / rest_density - 1.0))
    }

    /// Finds the multipliers from the sums.
    #[inline(always)]
    pub(super) fn find_multipliers(&mut self, rest_density: f32, relaxation: f32) {
        let compression = self.compression(rest_density);
        let slope = 3.0 / rest_density;
        self.multiplier = each(|l| {
            let own = self.gradient_x[l] * self.gradient_x[l] + self.gradient_y[l] * self.gradient_y[l];
            let weight = (self.squared[l] + own) * (slope * slope) + relaxation;
            compression[l] / weight * (UNDER_RELAXATION * slope)
        });
    }
}

/// Adds a value to each lane of a sum.
#[inline(always)]
fn add(sum: &mut Lanes, value: impl Fn(usize) -> f32) {
    *sum = each(|l| sum[l] + value(l));
}

/// What is added to the weight of a density constraint in a substep of `h`.
pub(super) fn relaxation(h: f32) -> f32 {
    if h < SUBSTEP { RELAXATION * (SUBSTEP * SUBSTEP) / (h * h) } else { RELAXATION }
}

/// Second pass, with the `distances` of the first: how far the members are moved, by the constraints (eq. 12), with what is
/// `added` to their push at a distance, and by viscosity, which takes a share of the differences between the displacement of a
/// particle in this substep and those of its neighbours (XSPH, eq. 17). Weights are relative to the rest density, so that what one
/// gains another loses.
#[inline(always)]
pub(super) fn shifts(
    group: &Group,
    neighbours: &[Neighbour],
    mut distances: &[Lanes],
    sums: &Sums,
    [viscosity, rest_density]: [f32; 2],
    added: impl Fn(f32, f32) -> f32,
) -> [Lanes; 2] {
    let (x, y) = (group.load(neighbours, |s| s.x), group.load(neighbours, |s| s.y));
    let own = sums.multiplier;
    let [mut shift_x, mut shift_y] = [[0.0; LANES]; 2];
    for window in group.windows(neighbours) {
        let (kept, others) = distances.split_at(window.len());
        distances = others;
        for (other, r) in window.iter().zip(kept) {
            let (dx, dy): (Lanes, Lanes) = (each(|l| x[l] - other.x), each(|l| y[l] - other.y));
            let near: Lanes = each(|l| positive(1.0 - r[l]));
            let push: Lanes = each(|l| (own[l] + other.multiplier) * (near[l] * near[l]));
            let along: Lanes = each(|l| added(push[l], r[l]) / r[l]);
            add(&mut shift_x, |l| dx[l] * along[l]);
            add(&mut shift_y, |l| dy[l] * along[l]);
        }
    }
    let (moved_x, moved_y) = (group.load(neighbours, |s| s.moved_x), group.load(neighbours, |s| s.moved_y));
    let share = viscosity / rest_density;
    let toward = |drift: &Lanes, moved: Lanes, l: usize| share * (drift[l] - sums.density[l] * moved[l]);
    [
        each(|l| shift_x[l] + own[l] * sums.wall_x[l] + toward(&sums.drift_x, moved_x, l)),
        each(|l| shift_y[l] + own[l] * sums.wall_y[l] + toward(&sums.drift_y, moved_y, l)),
    ]
}

/// Share of a lack of spacing that a substep of `h` corrects.
pub(super) fn spacing_share(h: f32) -> f32 {
    let softness = (1.0 / SPACING_SHARE - 1.0) * (SUBSTEP * SUBSTEP) / (h * h);
    if h < SUBSTEP { 1.0 / (1.0 + softness) } else { SPACING_SHARE }
}

/// A push at a distance, and this share of what the distance lacks to the least spacing.
#[inline(always)]
pub(super) fn keep_spacing(share: f32) -> impl Fn(f32, f32) -> f32 + Copy + Send + Sync {
    #[inline(always)]
    move |push, r| push + share * positive(MIN_SPACING / SUPPORT - r)
}

/// A push alone.
#[inline(always)]
pub(super) fn keep_no_spacing(push: f32, _: f32) -> f32 {
    push
}

/// `1 - q` of a wall at this distance.
#[inline(always)]
fn wall_nearness(distance: f32) -> f32 {
    positive(1.0 - (distance + WALL_DEPTH))
}

/// Kernel sum at a point of a hexagonal lattice at the rest spacing.
pub(super) fn lattice_density() -> f32 {
    let mut density = 0.0;
    for row in -3i32..=3 {
        for column in -4i32..=4 {
            let x = column as f32 + 0.5 * (row & 1) as f32;
            let y = row as f32 * 0.75f32.sqrt();
            let near = positive(1.0 - (x * x + y * y).sqrt() / SUPPORT);
            density += near * near * near;
        }
    }
    density
}
