//! Area constraint: a closed ring of nodes keeps (or does not exceed) the area that it encloses.
//!
//! `C = 1/2 sum_i (x_i y_{i+1} - x_{i+1} y_i) - A`, gradient of node `i` = `1/2 (y_{i+1} - y_{i-1}, x_{i-1} - x_{i+1})`
//! (Mueller et al. 2007, section 4.3, volume conservation, in two dimensions).

use super::{Constrain, Constraint, JacobianRow, MAX_LENGTH, PULL, check_ring};
use crate::error::{Error, in_range};
use crate::instruction_set::each;
use crate::particle::Columns;
use crate::solver::lanes::{Span, load, ratio, store};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// A ring of nodes around a given area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Area {
    /// The ring, counter-clockwise, at least three nodes.
    pub ring: Vec<u32>,
    /// Area at rest, square units, more than 0.
    pub rest_area: f32,
    /// Inverse stiffness (area per unit of multiplier), at least 0; 0 is rigid.
    pub compliance: f32,
    /// Acts only while the area is too large.
    pub is_upper_bound: bool,
}

impl Constrain for Area {
    fn order(&self) -> u8 {
        PULL + 1
    }

    fn half(&self) -> Option<Constraint> {
        Some(Self { compliance: 2.0 * self.compliance, ..self.clone() }.into())
    }

    fn rows(&self, places: &[Vec2]) -> Vec<JacobianRow> {
        let n = self.ring.len();
        let place = |k: usize| places[self.ring[k % n] as usize];
        let gradient = (0..n).map(|k| (self.ring[k], -0.5 * (place(k + 1) - place(k + n - 1)).perp())).collect();
        vec![JacobianRow { gradient, compliance: self.compliance }]
    }

    fn links(&self) -> Vec<[u32; 2]> {
        let next = self.ring.iter().cycle().skip(1);
        self.ring.iter().zip(next).map(|(&a, &b)| [a, b]).collect()
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        check_ring("ring", &self.ring, nodes)?;
        in_range("rest_area", self.rest_area, 1e-6, MAX_LENGTH)?;
        in_range("compliance", self.compliance, 0.0, MAX_LENGTH)
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let alpha = self.compliance / (h * h);
        for span in spans {
            let measured = MeasuredRing::measure(&self.ring, span, particles);
            let error = each::<L>(|l| measured.area[l] - self.rest_area * span.scale[l] * span.scale[l]);
            let mut acts = [true; L];
            if self.is_upper_bound {
                acts.iter_mut().zip(error).for_each(|(acts, error)| *acts = error > 0.0);
            }
            measured.enforce(error, acts, alpha, particles);
        }
    }
}

impl From<Area> for Constraint {
    fn from(constraint: Area) -> Self {
        Self::Area(constraint)
    }
}

/// Rings as they are now, one in each lane.
pub(crate) struct MeasuredRing<'a, const L: usize> {
    ring: &'a [u32],
    span: &'a Span<L>,
    /// Enclosed area, positive for a counter-clockwise ring.
    pub area: [f32; L],
    /// Sum of inverse mass times squared gradient over the nodes.
    pub weight: [f32; L],
}

impl<'a, const L: usize> MeasuredRing<'a, L> {
    #[inline(always)]
    pub(crate) fn measure(ring: &'a [u32], span: &'a Span<L>, particles: &Columns<'_>) -> Self {
        let at = |k: usize| span.at(ring[k]);
        let (mut twice_area, mut weight) = ([0.0; L], [0.0; L]);
        for k in 0..ring.len() {
            let next = if k + 1 < ring.len() { k + 1 } else { 0 };
            let before = if k > 0 { k - 1 } else { ring.len() - 1 };
            let [ax, ay] = particles.between_lanes::<L>(at(0), at(k));
            let [bx, by] = particles.between_lanes::<L>(at(0), at(next));
            twice_area = each(|l| twice_area[l] + (ax[l] * by[l] - ay[l] * bx[l]));
            let [gx, gy] = gradient(particles.between_lanes::<L>(at(before), at(next)));
            let inv_mass = load::<L>(particles.inv_mass, at(k));
            weight = each(|l| weight[l] + inv_mass[l] * (gx[l] * gx[l] + gy[l] * gy[l]));
        }
        Self { ring, span, area: each(|l| 0.5 * twice_area[l]), weight }
    }

    /// Corrects an area error in the lanes where it acts: moves every node along its gradient, as the ring was when it was
    /// measured.
    #[inline(always)]
    pub(crate) fn enforce(&self, error: [f32; L], acts: [bool; L], alpha: f32, particles: &mut Columns<'_>) {
        let at = |k: usize| self.span.at(self.ring[k]);
        let multiplier = each::<L>(|l| ratio(-error[l], self.weight[l] + alpha));
        // Nodes that are moved already are remembered where they were; all relative to the first node's old place.
        let mut before = particles.between_lanes::<L>(at(0), at(self.ring.len() - 1));
        let [mut here, mut moved_first] = [[[0.0; L]; 2]; 2];
        for k in 0..self.ring.len() {
            let is_last = k + 1 == self.ring.len();
            let after =
                if is_last { [[0.0; L]; 2] } else { sum(particles.between_lanes::<L>(at(0), at(k + 1)), moved_first) };
            let [gx, gy] = gradient::<L>(difference(after, before));
            let (x, y) = (load::<L>(particles.x, at(k)), load::<L>(particles.y, at(k)));
            let inv_mass = load::<L>(particles.inv_mass, at(k));
            let share = each::<L>(|l| multiplier[l] * inv_mass[l]);
            let by = [each::<L>(|l| gx[l] * share[l]), each::<L>(|l| gy[l] * share[l])];
            store(particles.x, at(k), each::<L>(|l| if acts[l] { x[l] + by[0][l] } else { x[l] }));
            store(particles.y, at(k), each::<L>(|l| if acts[l] { y[l] + by[1][l] } else { y[l] }));
            if k == 0 {
                moved_first = by;
            }
            (before, here) = (here, after);
        }
    }
}

/// Gradient of the area with respect to a node, from the way between its neighbours.
#[inline(always)]
fn gradient<const L: usize>([x, y]: [[f32; L]; 2]) -> [[f32; L]; 2] {
    [each(|l| 0.5 * y[l]), each(|l| -0.5 * x[l])]
}

#[inline(always)]
fn sum<const L: usize>(a: [[f32; L]; 2], b: [[f32; L]; 2]) -> [[f32; L]; 2] {
    [each(|l| a[0][l] + b[0][l]), each(|l| a[1][l] + b[1][l])]
}

#[inline(always)]
fn difference<const L: usize>(a: [[f32; L]; 2], b: [[f32; L]; 2]) -> [[f32; L]; 2] {
    [each(|l| a[0][l] - b[0][l]), each(|l| a[1][l] - b[1][l])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::polygon::signed_area;
    use crate::particle::Particles;
    use crate::solver::testing::{momentum, ring};

    fn area_of(p: &Particles) -> f32 {
        signed_area(&(0..p.len()).map(|i| p.position(i)).collect::<Vec<_>>())
    }

    fn constraint(count: u32, rest_area: f32, is_upper_bound: bool) -> Area {
        Area { ring: (0..count).collect(), rest_area, compliance: 0.0, is_upper_bound }
    }

    #[test]
    fn converges_to_the_rest_area_and_keeps_momentum() {
        for target in [2.0, 6.0] {
            let mut p = ring(12, 1.1);
            let before = momentum(&p);
            for _ in 0..8 {
                constraint(12, target, false).project(&[Span::LOOSE], &mut p.columns(), 0.01);
            }
            assert!((area_of(&p) - target).abs() < 1e-3, "area {} for {target}", area_of(&p));
            assert!((momentum(&p) - before).length() < 1e-4);
        }
    }

    #[test]
    fn rest_state_is_a_fixed_point_and_degenerate_rings_stay_finite() {
        let mut p = ring(12, 1.0);
        let (rest, before) = (area_of(&p), p.clone());
        constraint(12, rest, false).project(&[Span::LOOSE], &mut p.columns(), 0.01);
        assert!((0..12).all(|i| (p.position(i) - before.position(i)).length() < 1e-6));
        let mut point = ring(12, 0.0);
        constraint(12, 1.0, false).project(&[Span::LOOSE], &mut point.columns(), 0.01);
        assert!((0..12).all(|i| point.position(i).is_finite()));
    }

    #[test]
    fn upper_bound_lets_the_ring_shrink() {
        let mut p = ring(12, 0.5);
        let before = area_of(&p);
        constraint(12, 6.0, true).project(&[Span::LOOSE], &mut p.columns(), 0.01);
        assert_eq!(area_of(&p), before);
    }
}
