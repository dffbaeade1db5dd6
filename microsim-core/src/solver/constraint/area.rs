//! Area constraint: a closed ring of nodes keeps (or does not exceed) the area that it encloses.
//!
//! `C = 1/2 sum_i (x_i y_{i+1} - x_{i+1} y_i) - A`, gradient of node `i` = `1/2 (y_{i+1} - y_{i-1}, x_{i-1} - x_{i+1})`
//! (Mueller et al. 2007, section 4.3, volume conservation, in two dimensions).

use super::{Constrain, Constraint, MAX_LENGTH, PULL, check_ring};
use crate::error::{Error, in_range};
use crate::particle::Columns;
use crate::solver::lanes::{Span, ratio};
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
        let particles = &mut particles.even();
        for span in spans {
            for lane in 0..L {
                project_lane(self, |slot| span.at(slot) + lane, span.scale[lane], particles, h);
            }
        }
    }
}

impl From<Area> for Constraint {
    fn from(constraint: Area) -> Self {
        Self::Area(constraint)
    }
}

fn project_lane(c: &Area, at: impl Fn(u32) -> usize, scale: f32, particles: &mut Columns<'_>, h: f32) {
    let ring: Vec<u32> = c.ring.iter().map(|&slot| at(slot) as u32).collect();
    let measured = MeasuredRing::measure(&ring, particles);
    let error = measured.area - c.rest_area * scale * scale;
    if !c.is_upper_bound || error > 0.0 {
        enforce(&measured, &ring, error, c.compliance / (h * h), particles);
    }
}

/// A ring of particles as it is now.
pub(crate) struct MeasuredRing {
    /// Enclosed area, positive for a counter-clockwise ring.
    pub area: f32,
    /// Sum of inverse mass times squared gradient over the nodes.
    weight: f32,
}

impl MeasuredRing {
    pub(crate) fn measure(ring: &[u32], particles: &Columns<'_>) -> Self {
        let count = ring.len();
        let node = |k: usize| ring[k % count] as usize;
        let (mut twice_area, mut weight) = (0.0, 0.0);
        for k in 0..count {
            twice_area += particles.between(node(0), node(k)).perp_dot(particles.between(node(0), node(k + 1)));
            let gradient = gradient(particles.between(node(k + count - 1), node(k + 1)));
            weight += particles.inv_mass[node(k)] * gradient.length_squared();
        }
        Self { area: 0.5 * twice_area, weight }
    }
}

/// Corrects an area error: moves every node along its gradient, as the ring was when it was measured.
pub(crate) fn enforce(measured: &MeasuredRing, ring: &[u32], error: f32, alpha: f32, particles: &mut Columns<'_>) {
    let count = ring.len();
    let offset = |particles: &Columns<'_>, k: usize| particles.between(ring[0] as usize, ring[k % count] as usize);
    let multiplier = ratio(-error, measured.weight + alpha);
    // Nodes that are moved already are remembered where they were; all relative to the first node's old place.
    let mut before = offset(particles, count - 1);
    let mut here = Vec2::ZERO;
    let mut moved_first = Vec2::ZERO;
    for (k, &node) in ring.iter().enumerate() {
        let after = if k + 1 == count { Vec2::ZERO } else { offset(particles, k + 1) + moved_first };
        let i = node as usize;
        let by = gradient(after - before) * (multiplier * particles.inv_mass[i]);
        particles.x[i] += by.x;
        particles.y[i] += by.y;
        if k == 0 {
            moved_first = by;
        }
        (before, here) = (here, after);
    }
}

/// Gradient of the area with respect to a node, from the way between its neighbours.
fn gradient(across: Vec2) -> Vec2 {
    Vec2::new(0.5 * across.y, -0.5 * across.x)
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
