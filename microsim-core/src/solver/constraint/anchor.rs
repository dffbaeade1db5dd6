//! Anchor constraint: a rope from a node to a static point that tends to contract (thesis, 3.1.4).
//!
//! Two inequality constraints on `d = |x - anchor|`: `d <= l_rest` with compliance `alpha` (the pull home), then
//! `d <= l_max` rigidly (the bound). The anchor is a node of infinite mass that collides with nothing.

use super::{Constrain, Constraint, JacobianRow, MAX_LENGTH, PULL, check_nodes};
use crate::error::{Error, in_range};
use crate::particle::Columns;
use crate::solver::lanes::{Span, pull_within};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// A node held to a static anchor by a contracting rope.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Anchor {
    /// The held node.
    pub node: u32,
    /// The static node that it is held to (mass infinite).
    pub anchor: u32,
    /// Length to which the rope contracts, units, at least 0.
    pub rest_length: f32,
    /// Length beyond which it does not stretch, units, at least `rest_length`.
    pub max_length: f32,
    /// Inverse stiffness of the contraction (length/force), at least 0.
    pub compliance: f32,
}

impl Constrain for Anchor {
    fn order(&self) -> u8 {
        PULL + 2
    }

    fn half(&self) -> Option<Constraint> {
        Some(Self { compliance: 2.0 * self.compliance, ..*self }.into())
    }

    fn rows(&self, places: &[Vec2]) -> Vec<JacobianRow> {
        JacobianRow::of_pair([self.node, self.anchor], self.compliance, places)
    }

    fn links(&self) -> Vec<[u32; 2]> {
        vec![[self.node, self.anchor]]
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        check_nodes("node", &[self.node, self.anchor], nodes)?;
        in_range("rest_length", self.rest_length, 0.0, MAX_LENGTH)?;
        in_range("max_length", self.max_length, self.rest_length, MAX_LENGTH)?;
        in_range("compliance", self.compliance, 0.0, MAX_LENGTH)
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let ends = [self.anchor, self.node];
        pull_within(ends, self.rest_length, self.compliance / (h * h), spans, particles);
        pull_within(ends, self.max_length, 0.0, spans, particles);
    }
}

impl From<Anchor> for Constraint {
    fn from(constraint: Anchor) -> Self {
        Self::Anchor(constraint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::testing::line;

    const ANCHOR: Anchor = Anchor { node: 1, anchor: 0, rest_length: 0.0, max_length: 2.0, compliance: 1e-4 };

    #[test]
    fn pulls_home_softly_and_stops_hard() {
        let mut p = line(1.0, [0.0, 1.0]);
        ANCHOR.project(&[Span::LOOSE], &mut p.columns(), 0.01);
        assert_eq!((p.x[0], p.x[1]), (0.0, 0.5));
        let mut p = line(100.0, [0.0, 1.0]);
        ANCHOR.project(&[Span::LOOSE], &mut p.columns(), 0.001);
        assert_eq!(p.x[1], 2.0);
    }

    #[test]
    fn node_at_its_anchor_stays() {
        let mut p = line(0.0, [0.0, 1.0]);
        ANCHOR.project(&[Span::LOOSE], &mut p.columns(), 0.01);
        assert_eq!((p.x[1], p.y[1]), (0.0, 0.0));
    }
}
