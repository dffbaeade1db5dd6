//! Rope constraint: two nodes never get farther apart than a maximum length.
//!
//! `C = |x_b - x_a| - l_max <= 0`, projected rigidly when violated (Macklin et al. 2014, section 4: inequality
//! constraints are projected only while `C > 0`). The thesis' rope joint.

use super::{Constrain, Constraint, LIMIT, MAX_LENGTH, check_nodes};
use crate::error::{Error, in_range};
use crate::particle::Columns;
use crate::solver::lanes::{Span, pull_within};
use serde::{Deserialize, Serialize};

/// Two nodes at most so far apart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rope {
    /// First node.
    pub a: u32,
    /// Second node.
    pub b: u32,
    /// Largest length, units, at least 0.
    pub max_length: f32,
}

impl Constrain for Rope {
    fn order(&self) -> u8 {
        LIMIT + 1
    }

    fn links(&self) -> Vec<[u32; 2]> {
        vec![[self.a, self.b]]
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        check_nodes("a", &[self.a, self.b], nodes)?;
        in_range("max_length", self.max_length, 0.0, MAX_LENGTH)
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, _: f32) {
        self.shorten(spans, particles);
    }
}

impl Rope {
    /// Draws its nodes together where they are too far apart.
    #[inline(always)]
    pub(crate) fn shorten<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>) {
        pull_within([self.a, self.b], self.max_length, 0.0, spans, particles);
    }
}

impl From<Rope> for Constraint {
    fn from(constraint: Rope) -> Self {
        Self::Rope(constraint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::testing::{assert_pair_laws, line};

    const ROPE: Rope = Rope { a: 0, b: 1, max_length: 1.0 };

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        assert_pair_laws(&[1.7], 1.0, |p| ROPE.shorten(&[Span::LOOSE], &mut p.columns()));
    }

    #[test]
    fn slack_rope_does_nothing_and_taut_rope_stops() {
        let mut slack = line(0.4, [1.0, 1.0]);
        ROPE.shorten(&[Span::LOOSE], &mut slack.columns());
        assert_eq!((slack.x[0], slack.x[1]), (0.0, 0.4));
        let mut taut = line(3.0, [0.0, 1.0]);
        ROPE.shorten(&[Span::LOOSE], &mut taut.columns());
        assert_eq!((taut.x[0], taut.x[1]), (0.0, 1.0));
    }
}
