//! Bend constraint: the path over three nodes turns by a given angle at the middle one; soft ones in a row are an elastic rod.
//!
//! `C = 2 tan((theta - phi) / 2)`: the discrete curvature of Bergou et al. 2008, "Discrete Elastic Rods", section 4.2, for the
//! turn `theta` from `e = x_b - x_a` to `f = x_c - x_b`, less the turn at rest `phi`. It is `2 s / (|e| |f| + c)` with the sine
//! and the cosine of `theta - phi` times `|e| |f|`, so that no angle is computed. Gradients are `(1 + C^2 / 4)` times those of
//! `theta`: `perp(e) / |e|^2` at `a`, `perp(f) / |f|^2` at `c`, and minus their sum at `b`.

use super::{Constrain, Constraint, JacobianRow, MAX_LENGTH, PULL, check_nodes};
use crate::error::{Error, in_range};
use crate::geometry::ring::unit_vector;
use crate::instruction_set::each;
use crate::particle::Columns;
use crate::solver::lanes::{Span, add, load, ratio};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Three nodes whose path turns by a fixed angle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bend {
    /// First node.
    pub a: u32,
    /// The node at which the path turns.
    pub b: u32,
    /// Last node.
    pub c: u32,
    /// Direction of the second part, seen from the first, at rest: a unit vector, (1, 0) where the path is straight.
    pub rest_turn: Vec2,
    /// Inverse stiffness (radians per torque), at least 0; 0 is rigid. A rod of flexural rigidity `EI` whose links are `l` long
    /// has `l / EI`.
    pub compliance: f32,
}

impl Bend {
    /// A path over three nodes that turns by `angle` radians at rest, counter-clockwise; 0 is straight.
    #[must_use]
    pub fn new([a, b, c]: [u32; 3], angle: f32, compliance: f32) -> Self {
        Self { a, b, c, rest_turn: unit_vector(angle), compliance }
    }
}

impl Constrain for Bend {
    fn order(&self) -> u8 {
        PULL + 3
    }

    fn half(&self) -> Option<Constraint> {
        Some(Self { compliance: 2.0 * self.compliance, ..*self }.into())
    }

    /// At rest `C` changes as the turn does.
    fn rows(&self, places: &[Vec2]) -> Vec<JacobianRow> {
        let [a, b, c] = [self.a, self.b, self.c].map(|slot| places[slot as usize]);
        let [at_a, at_c] = [b - a, c - b].map(|part| part.perp() / part.length_squared());
        let gradient = vec![(self.a, at_a), (self.b, -at_a - at_c), (self.c, at_c)];
        if (at_a + at_c).is_finite() { vec![JacobianRow { gradient, compliance: self.compliance }] } else { Vec::new() }
    }

    fn links(&self) -> Vec<[u32; 2]> {
        vec![[self.a, self.b], [self.b, self.c]]
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        check_nodes("a", &[self.a, self.b, self.c], nodes)?;
        in_range("rest_turn", self.rest_turn.length(), 0.999, 1.001)?;
        in_range("compliance", self.compliance, 0.0, MAX_LENGTH)
    }

    fn has_lengths(&self) -> bool {
        false
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let alpha = self.compliance / (h * h);
        let Vec2 { x: cos, y: sin } = self.rest_turn;
        for span in spans {
            let [a, b, c] = [self.a, self.b, self.c].map(|slot| span.at(slot));
            let [e, f] = [particles.between_lanes::<L>(a, b), particles.between_lanes::<L>(b, c)];
            let (e_squared, f_squared) = (squared(e), squared(f));
            let cross = each::<L>(|l| e[0][l] * f[1][l] - e[1][l] * f[0][l]);
            let dot = each::<L>(|l| e[0][l] * f[0][l] + e[1][l] * f[1][l]);
            let sine = each::<L>(|l| cross[l] * cos - dot[l] * sin);
            let cosine = each::<L>(|l| dot[l] * cos + cross[l] * sin);
            let lengths = each::<L>(|l| e_squared[l].sqrt() * f_squared[l].sqrt());
            let error = each::<L>(|l| ratio(2.0 * sine[l], lengths[l] + cosine[l]));
            let slope = each::<L>(|l| 1.0 + 0.25 * error[l] * error[l]);
            let (at_a, at_c) = (over(e, e_squared), over(f, f_squared));
            let at_b = [each::<L>(|l| -at_a[0][l] - at_c[0][l]), each::<L>(|l| -at_a[1][l] - at_c[1][l])];
            let inv_mass = [a, b, c].map(|at| load::<L>(particles.inv_mass, at));
            let (a_squared, b_squared, c_squared) = (squared(at_a), squared(at_b), squared(at_c));
            let outer = each::<L>(|l| inv_mass[0][l] * a_squared[l] + inv_mass[2][l] * c_squared[l]);
            let weight = each::<L>(|l| outer[l] + inv_mass[1][l] * b_squared[l]);
            let stiff = each::<L>(|l| slope[l] * slope[l] * weight[l] + alpha);
            let share = each::<L>(|l| ratio(-error[l] * slope[l], stiff[l]));
            for (k, (at, gradient)) in [(a, at_a), (b, at_b), (c, at_c)].into_iter().enumerate() {
                add(particles.x, at, each::<L>(|l| share[l] * inv_mass[k][l] * gradient[0][l]));
                add(particles.y, at, each::<L>(|l| share[l] * inv_mass[k][l] * gradient[1][l]));
            }
        }
    }
}

#[inline(always)]
fn squared<const L: usize>([x, y]: [[f32; L]; 2]) -> [f32; L] {
    each(|l| x[l] * x[l] + y[l] * y[l])
}

/// Vectors turned by a right angle, over their squared lengths: gradients of their angles.
#[inline(always)]
fn over<const L: usize>([x, y]: [[f32; L]; 2], squared: [f32; L]) -> [[f32; L]; 2] {
    [each(|l| ratio(-y[l], squared[l])), each(|l| ratio(x[l], squared[l]))]
}

impl From<Bend> for Constraint {
    fn from(constraint: Bend) -> Self {
        Self::Bend(constraint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::Particles;
    use crate::solver::testing::{disc, momentum};
    use std::f32::consts::PI;

    /// A path over three discs with links of length 1 and 2 that turns by an angle.
    fn path(turn: f32, inv_mass: [f32; 3]) -> Particles {
        let mut particles = Particles::default();
        let places = [Vec2::NEG_X, Vec2::ZERO, 2.0 * unit_vector(turn)];
        places.into_iter().zip(inv_mass).for_each(|(at, inv_mass)| _ = particles.insert(&disc(at, inv_mass)));
        particles
    }

    fn turn(p: &Particles) -> f32 {
        (p.position(1) - p.position(0)).angle_to(p.position(2) - p.position(1))
    }

    fn project(bend: Bend, p: &mut Particles) {
        bend.project(&[Span::LOOSE], &mut p.columns(), 0.01);
    }

    #[test]
    fn finds_its_turn_and_keeps_momentum() {
        for (from, rest) in [(0.5, 0.0), (-1.2, 0.3), (2.8, -0.2), (0.0, 2.5), (-3.0, 3.0)] {
            let mut p = path(from, [1.0, 0.5, 2.0]);
            let (momentum_before, spin) = (momentum(&p), |p: &Particles| -> f32 {
                (0..3)
                    .map(|i| p.position(i).perp_dot(p.position(i) - path(from, [1.0; 3]).position(i)) / p.inv_mass[i])
                    .sum()
            });
            project(Bend::new([0, 1, 2], rest, 0.0), &mut p);
            assert!(spin(&p).abs() < 0.3, "turned by {}", spin(&p));
            for _ in 0..60 {
                project(Bend::new([0, 1, 2], rest, 0.0), &mut p);
            }
            let error = (turn(&p) - rest + PI).rem_euclid(std::f32::consts::TAU) - PI;
            assert!(error.abs() < 1e-4, "{from} to {rest}: {}", turn(&p));
            assert!((momentum(&p) - momentum_before).length() < 1e-4);
        }
    }

    #[test]
    fn the_rest_state_and_what_cannot_move_or_has_no_direction_stays() {
        let mut rest = path(0.7, [1.0; 3]);
        project(Bend::new([0, 1, 2], 0.7, 0.0), &mut rest);
        assert!((0..3).all(|i| (rest.position(i) - path(0.7, [1.0; 3]).position(i)).length() < 1e-6));
        let mut pinned = path(0.7, [0.0; 3]);
        project(Bend::new([0, 1, 2], 0.0, 0.0), &mut pinned);
        assert!((0..3).all(|i| pinned.position(i) == path(0.7, [0.0; 3]).position(i)));
        for rest in [0.0, 1.0, PI] {
            let mut point = path(0.0, [1.0; 3]);
            (point.x, point.y) = (vec![0.0; 3], vec![0.0; 3]);
            project(Bend::new([0, 1, 2], rest, 0.0), &mut point);
            assert!((0..3).all(|i| point.position(i) == Vec2::ZERO));
        }
    }

    #[test]
    fn compliance_leaves_the_error_that_the_formula_says() {
        // Gradients are 1, 3/2 and 1/2 long, so that the weights add up to 3.5.
        let mut p = path(0.02, [1.0; 3]);
        project(Bend::new([0, 1, 2], 0.0, 3.5e-4), &mut p);
        assert!((turn(&p) / 0.01 - 1.0).abs() < 1e-3, "{}", turn(&p));
    }
}
