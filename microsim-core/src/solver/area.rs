//! Area constraint: a closed ring of nodes keeps (or does not exceed) the area that it encloses.
//!
//! `C = 1/2 sum_i (x_i y_{i+1} - x_{i+1} y_i) - A`, gradient of node `i` = `1/2 (y_{i+1} - y_{i-1}, x_{i-1} - x_{i+1})`
//! (Mueller et al. 2007, section 4.3, volume conservation, in two dimensions).

use super::lanes::{Span, ratio};
use crate::particle::Particles;

/// A ring of nodes around a given area.
#[derive(Clone, Debug, PartialEq)]
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

pub(crate) fn project<const L: usize>(list: &[Area], span: Span<L>, particles: &mut Particles, h: f32) {
    for c in list {
        for lane in 0..L {
            project_lane(c, |slot| span.at(slot) + lane, span.scale[lane], particles, h);
        }
    }
}

fn project_lane(c: &Area, at: impl Fn(u32) -> usize, scale: f32, particles: &mut Particles, h: f32) {
    let count = c.ring.len();
    let node = |k: usize| at(c.ring[k % count]);
    let (origin_x, origin_y) = (particles.x[node(0)], particles.y[node(0)]);
    let mut twice_area = 0.0;
    let mut weight = 0.0;
    for k in 0..count {
        let (i, next) = (node(k), node(k + 1));
        twice_area += (particles.x[i] - origin_x) * (particles.y[next] - origin_y)
            - (particles.x[next] - origin_x) * (particles.y[i] - origin_y);
        let (gx, gy) = gradient(particles, node(k + count - 1), next);
        weight += particles.inv_mass[i] * (gx * gx + gy * gy);
    }
    let error = 0.5 * twice_area - c.rest_area * scale * scale;
    if c.is_upper_bound && error <= 0.0 {
        return;
    }
    let multiplier = ratio(-error, weight + c.compliance / (h * h));
    // The gradients are those of the start, not of the nodes already moved.
    let first = (particles.x[node(0)], particles.y[node(0)]);
    let mut before = (particles.x[node(count - 1)], particles.y[node(count - 1)]);
    for k in 0..count {
        let i = node(k);
        let here = (particles.x[i], particles.y[i]);
        let after = if k + 1 == count {
            first
        } else {
            (particles.x[node(k + 1)], particles.y[node(k + 1)])
        };
        let step = multiplier * particles.inv_mass[i];
        particles.x[i] += step * 0.5 * (after.1 - before.1);
        particles.y[i] += step * 0.5 * (before.0 - after.0);
        before = here;
    }
}

fn gradient(particles: &Particles, previous: usize, next: usize) -> (f32, f32) {
    (
        0.5 * (particles.y[next] - particles.y[previous]),
        0.5 * (particles.x[previous] - particles.x[next]),
    )
}

#[cfg(test)]
mod tests {
    use super::super::testing::{momentum, ring};
    use super::*;
    use crate::geometry::polygon::signed_area;

    fn area_of(p: &Particles) -> f32 {
        signed_area(&(0..p.len()).map(|i| p.position(i)).collect::<Vec<_>>())
    }

    fn constraint(count: u32, rest_area: f32, is_upper_bound: bool) -> Area {
        Area {
            ring: (0..count).collect(),
            rest_area,
            compliance: 0.0,
            is_upper_bound,
        }
    }

    #[test]
    fn converges_to_the_rest_area_and_keeps_momentum() {
        for target in [2.0, 6.0] {
            let mut p = ring(12, 1.1);
            let before = momentum(&p);
            for _ in 0..8 {
                project(&[constraint(12, target, false)], Span::LOOSE, &mut p, 0.01);
            }
            assert!((area_of(&p) - target).abs() < 1e-3, "area {} for {target}", area_of(&p));
            assert!((momentum(&p) - before).length() < 1e-4);
        }
    }

    #[test]
    fn rest_state_is_a_fixed_point_and_degenerate_rings_stay_finite() {
        let mut p = ring(12, 1.0);
        let (rest, before) = (area_of(&p), p.clone());
        project(&[constraint(12, rest, false)], Span::LOOSE, &mut p, 0.01);
        assert!((0..12).all(|i| (p.position(i) - before.position(i)).length() < 1e-6));
        let mut point = ring(12, 0.0);
        project(&[constraint(12, 1.0, false)], Span::LOOSE, &mut point, 0.01);
        assert!((0..12).all(|i| point.position(i).is_finite()));
    }

    #[test]
    fn upper_bound_lets_the_ring_shrink() {
        let mut p = ring(12, 0.5);
        let before = area_of(&p);
        project(&[constraint(12, 6.0, true)], Span::LOOSE, &mut p, 0.01);
        assert_eq!(area_of(&p), before);
    }
}
