//! Distance constraint whose oscillations keep their energy: two nodes keep their rest length, without the damping of implicit
//! Euler.
//!
//! Forces act where they were when the substep began, along `n_0 = d_0 / |d_0|` with `d_0` the vector between the nodes then: a rigid
//! one is SHAKE (Ryckaert, Ciccotti, Berendsen 1977, J. Comput. Phys. 23, 327), a soft one the scheme of Stoermer and Verlet
//! (Hairer, Lubich, Wanner 2003, Acta Numerica 12, 399), both of second order:
//!
//! `lambda = (-C - (g - s) (|d| - |d_0|)) / ((1 + g - s)(w_a + w_b) n.n_0 + alpha / h^2)`, with `C`, `g` and `alpha` as in
//! [`super::Distance`], and `s = a / (a + w_a + w_b)`, `a = alpha / h^2`, the share of an explicit force. It is 1 for
//! a slow oscillation, which is then damped by `omega^4 h^3 / 2` per second, and 0 for one that a substep cannot follow, which
//! stays stable as with implicit Euler.

use super::{Constrain, Constraint, Distance, JacobianRow, PULL};
use crate::error::Error;
use crate::instruction_set::each;
use crate::particle::Columns;
use crate::solver::lanes::{Pair, Span, ratio};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Two nodes at a fixed distance, like [`Distance`], whose oscillations lose energy by `damping` alone: for pendulums and
/// springs that swing for long. Among many neighbours, where what oscillates is an error of the solution, [`Distance`] comes to
/// rest sooner.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConservativeDistance {
    /// First node.
    pub a: u32,
    /// Second node.
    pub b: u32,
    /// Length at rest, units, at least 0.
    pub rest_length: f32,
    /// Inverse stiffness (length/force), at least 0; 0 is rigid.
    pub compliance: f32,
    /// Damping time (damping coefficient over stiffness), s, 0 to 10; 0 is undamped.
    pub damping: f32,
}

impl Constrain for ConservativeDistance {
    fn order(&self) -> u8 {
        PULL + 4
    }

    fn half(&self) -> Option<Constraint> {
        Some(Self { compliance: 2.0 * self.compliance, ..*self }.into())
    }

    fn rows(&self, places: &[Vec2]) -> Vec<JacobianRow> {
        JacobianRow::of_pair([self.a, self.b], self.compliance, places)
    }

    fn links(&self) -> Vec<[u32; 2]> {
        vec![[self.a, self.b]]
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        let Self { a, b, rest_length, compliance, damping } = *self;
        Distance { a, b, rest_length, compliance, damping }.validate(nodes)
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let (alpha, gamma) = (self.compliance / (h * h), self.damping / h);
        for span in spans {
            let pair = Pair::<L>::load(particles, span.at(self.a), span.at(self.b));
            let growth = pair.growth(particles);
            let earlier = pair.earlier(particles);
            let length = each::<L>(|l| pair.length(l));
            let before = each::<L>(|l| root(pair.squared[l] - growth[l]));
            let opening = each::<L>(|l| ratio(growth[l], length[l] + before[l]));
            let error = each::<L>(|l| self.rest_length * span.scale[l] - length[l]);
            let damped = each::<L>(|l| gamma - ratio(alpha, alpha + pair.weight(l)));
            let along = each::<L>(|l| earlier.length(l));
            let across = each::<L>(|l| ratio(pair.dot(&earlier, l), length[l]));
            let weight = each::<L>(|l| (1.0 + damped[l]) * pair.weight(l) * across[l] + alpha * along[l]);
            let share = each::<L>(|l| ratio(error[l] - damped[l] * opening[l], weight[l]));
            earlier.push(particles, share);
        }
    }
}

/// The root; 0 of what rounding made negative: nodes that were in one place.
#[inline(always)]
fn root(square: f32) -> f32 {
    if square > 0.0 { square.sqrt() } else { 0.0 }
}

impl From<ConservativeDistance> for Constraint {
    fn from(constraint: ConservativeDistance) -> Self {
        Self::ConservativeDistance(constraint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::Particles;
    use crate::solver::integrate::{move_origins, predict_positions, update_velocities};
    use crate::solver::testing::{assert_pair_laws, line};
    use glam::Vec2;
    use std::f32::consts::TAU;

    const H: f32 = 1.0 / 480.0;
    const FAST: f32 = 1e6;

    fn constraint(compliance: f32) -> ConservativeDistance {
        ConservativeDistance { a: 0, b: 1, rest_length: 1.0, compliance, damping: 0.0 }
    }

    #[test]
    fn two_halves_side_by_side_are_as_stiff_as_the_whole() {
        assert_eq!(constraint(1e-3).half(), Some(constraint(2e-3).into()));
    }

    #[test]
    fn what_rounding_makes_negative_has_the_root_zero() {
        assert_eq!([-1e-9, 0.0, 4.0].map(root), [0.0, 0.0, 2.0]);
    }

    /// The first node is fixed; steps, and shows the other after each.
    fn swing(p: &mut Particles, with: impl Constrain, g: f32, steps: u32, mut observe: impl FnMut(&Particles)) {
        for _ in 0..steps {
            predict_positions(&mut p.columns(), Vec2::new(0.0, -g), FAST, H);
            with.project(&[Span::LOOSE], &mut p.columns(), H);
            update_velocities(&mut p.columns(), 0.0, FAST, H);
            move_origins(&mut p.columns());
            observe(p);
        }
    }

    /// Amplitude in the second half of so many steps from a stretch of 0.1.
    fn kept(with: impl Constrain, steps: u32) -> f32 {
        let (mut p, mut most, mut step) = (line(1.1, [0.0, 1.0]), 0.0f32, 0);
        swing(&mut p, with, 0.0, steps, |p| {
            step += 1;
            most = if 2 * step > steps { most.max(p.position(1).x - 1.0) } else { 0.0 };
        });
        most / 0.1
    }

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        for compliance in [0.0, 1e-3] {
            assert_pair_laws(&[0.5, 1.7], 1.0, |p| {
                constraint(compliance).project(&[Span::LOOSE], &mut p.columns(), 0.01);
            });
        }
    }

    #[test]
    fn a_spring_keeps_its_amplitude_where_a_distance_loses_it() {
        // 1 Hz.
        let compliance = 1.0 / (TAU * TAU);
        let soft = Distance { a: 0, b: 1, rest_length: 1.0, compliance, damping: 0.0 };
        let undamped = kept(constraint(compliance), 9600);
        assert!((undamped - 1.0).abs() < 0.002, "{undamped}");
        assert!(kept(soft, 9600) < 0.7);
        // With a damping time of 2 z / omega: exp(-z omega t) in ten seconds, z 0.01.
        let damped = ConservativeDistance { damping: 0.02 / TAU, ..constraint(compliance) };
        assert!((kept(damped, 9600) - (-0.62832f32).exp()).abs() < 0.02, "{}", kept(damped, 9600));
    }

    #[test]
    fn a_pendulum_keeps_its_amplitude_and_its_length() {
        let mut p = line(1.0, [0.0, 1.0]);
        let (mut least, mut stretch) = (0.0f32, 0.0f32);
        swing(&mut p, constraint(0.0), 10.0, 9600, |p| {
            least = least.min(p.position(1).x);
            stretch = stretch.max((p.position(1).length() - 1.0).abs());
        });
        let energy = 10.0 * p.position(1).y + 0.5 * p.velocity(1).length_squared();
        assert!(energy.abs() < 0.05 && least < -0.999, "from the horizontal: energy {energy}, x {least}");
        assert!(stretch < 1e-5, "stretch {stretch}");
    }

    #[test]
    fn what_a_substep_cannot_follow_stays_stable() {
        for compliance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 0.0] {
            assert!(kept(constraint(compliance), 4800) < 1.001, "compliance {compliance}");
        }
    }

    #[test]
    fn what_turns_by_a_right_angle_in_a_substep_is_held_where_it_is() {
        let mut p = line(1.0, [0.0, 1.0]);
        (p.x[1], p.y[1]) = (0.0, 1.3);
        constraint(0.0).project(&[Span::LOOSE], &mut p.columns(), H);
        assert!(p.position(1).distance(Vec2::Y) < 1e-6, "{}", p.position(1));
    }
}
