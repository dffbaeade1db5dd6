//! Distance constraint: two nodes keep their rest length: rigid at compliance 0, else a damped spring.
//!
//! `C = |x_b - x_a| - l`, gradient `±n`. One XPBD iteration per substep with the multiplier starting at 0
//! (Macklin, Mueller, Chentanez 2016, eqs. 18 and 26; Macklin et al. 2019, "Small Steps"):
//!
//! `lambda = (-C - g n.(dx_b - dx_a)) / ((1 + g)(w_a + w_b) + alpha / h^2)`, with `g = tau / h`,
//! where `dx` is the move since the substep began. `n` is the vector between the nodes over its length: with
//! numerator and denominator multiplied by that length as needed, one square root and one division do.

use super::{Constrain, Constraint, JacobianRow, MAX_LENGTH, PULL, check_nodes};
use crate::error::{Error, in_range};
use crate::instruction_set::each;
use crate::particle::Columns;
use crate::solver::lanes::{Pair, Span, ratio};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Two nodes at a fixed distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distance {
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

impl Constrain for Distance {
    fn order(&self) -> u8 {
        PULL
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
        check_nodes("a", &[self.a, self.b], nodes)?;
        in_range("rest_length", self.rest_length, 0.0, MAX_LENGTH)?;
        in_range("compliance", self.compliance, 0.0, MAX_LENGTH)?;
        in_range("damping", self.damping, 0.0, 10.0)
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        if self.damping > 0.0 {
            self.project_damped(spans, particles, h);
        } else {
            self.project_undamped(spans, particles, h);
        }
    }
}

/// Two kernels that share no value: what is computed before a branch and used on both sides is not compiled to vectors.
impl Distance {
    #[inline(always)]
    fn project_undamped<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let Self { a, b, rest_length, compliance, .. } = *self;
        let alpha = compliance / (h * h);
        for span in spans {
            let pair = Pair::<L>::load(particles, span.at(a), span.at(b));
            let length = each::<L>(|l| pair.length(l));
            let error = each::<L>(|l| rest_length * span.scale[l] - length[l]);
            let share = each(|l| ratio(error[l], length[l] * (pair.weight(l) + alpha)));
            pair.push(particles, share);
        }
    }

    #[inline(always)]
    fn project_damped<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let Self { a, b, rest_length, compliance, damping } = *self;
        let (alpha, gamma) = (compliance / (h * h), damping / h);
        for span in spans {
            let pair = Pair::<L>::load(particles, span.at(a), span.at(b));
            let resisted = pair.opening(particles);
            let length = each::<L>(|l| pair.length(l));
            let error = each::<L>(|l| rest_length * span.scale[l] - length[l]);
            let weight = each::<L>(|l| (1.0 + gamma) * pair.weight(l) + alpha);
            let share = each(|l| ratio(error[l] * length[l] - gamma * resisted[l], pair.squared[l] * weight[l]));
            pair.push(particles, share);
        }
    }
}

impl From<Distance> for Constraint {
    fn from(constraint: Distance) -> Self {
        Self::Distance(constraint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::testing::{assert_pair_laws, line};

    fn constraint(compliance: f32) -> Distance {
        Distance { a: 0, b: 1, rest_length: 1.0, compliance, damping: 0.0 }
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
    fn rigid_is_satisfied_at_once_and_shared_by_mass() {
        let mut p = line(2.0, [1.0, 0.5]);
        constraint(0.0).project(&[Span::LOOSE], &mut p.columns(), 0.01);
        assert!((p.x[1] - p.x[0] - 1.0).abs() < 1e-6);
        assert!((p.x[0] - 2.0 / 3.0).abs() < 1e-6, "the light one moves twice as far, got {}", p.x[0]);
    }

    #[test]
    fn compliance_leaves_the_error_that_the_formula_says() {
        let mut p = line(2.0, [1.0, 1.0]);
        constraint(1e-4).project(&[Span::LOOSE], &mut p.columns(), 0.01);
        // alpha / h^2 = 1, so a third of the error stays.
        assert!((p.x[1] - p.x[0] - (2.0 - 2.0 / 3.0)).abs() < 1e-6, "length {}", p.x[1] - p.x[0]);
        let mut p = line(2.0, [1.0, 1.0]);
        Distance { damping: 0.02, ..constraint(1e-4) }.project(&[Span::LOOSE], &mut p.columns(), 0.01);
        // Damping divides as the mass would that is three times as large: two sevenths go.
        assert!((p.x[1] - p.x[0] - (2.0 - 2.0 / 7.0)).abs() < 1e-6, "length {}", p.x[1] - p.x[0]);
    }

    #[test]
    fn damping_resists_motion_along_the_line() {
        let [mut free, mut damped] = [(); 2].map(|()| line(2.0, [1.0, 1.0]));
        (free.prev_x[1], damped.prev_x[1]) = (1.9, 1.9);
        let soft = Distance { rest_length: 2.0, ..constraint(1e-4) };
        soft.project(&[Span::LOOSE], &mut free.columns(), 0.01);
        Distance { damping: 0.02, ..soft }.project(&[Span::LOOSE], &mut damped.columns(), 0.01);
        assert_eq!(free.x[1], 2.0);
        assert!(damped.x[1] < 2.0 && damped.x[1] > 1.9);
    }
}
