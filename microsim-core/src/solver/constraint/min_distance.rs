//! Minimum distance constraint: two nodes never get nearer than a minimum.
//!
//! `C = l_min - |x_b - x_a| <= 0`, projected rigidly when violated. Keeps a ring off its interlayer and a membrane from
//! folding (nodes `i` and `i + 2`).

use super::{Constrain, Constraint, LIMIT, MAX_LENGTH, check_nodes};
use crate::error::{Error, in_range};
use crate::instruction_set::each;
use crate::particle::Columns;
use crate::solver::lanes::{Pair, Span, ratio};
use serde::{Deserialize, Serialize};

/// Two nodes at least so far apart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MinDistance {
    /// First node.
    pub a: u32,
    /// Second node.
    pub b: u32,
    /// Smallest length, units, at least 0.
    pub min_length: f32,
}

impl Constrain for MinDistance {
    fn order(&self) -> u8 {
        LIMIT
    }

    fn links(&self) -> Vec<[u32; 2]> {
        vec![[self.a, self.b]]
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        check_nodes("a", &[self.a, self.b], nodes)?;
        in_range("min_length", self.min_length, 0.0, MAX_LENGTH)
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, _: f32) {
        let Self { a, b, min_length } = *self;
        for span in spans {
            let pair = Pair::<L>::load(particles, span.at(a), span.at(b));
            let shortest = each::<L>(|l| min_length * span.scale[l]);
            if pair.is_shorter(shortest) {
                let length = each::<L>(|l| pair.length(l));
                let deficit = each::<L>(|l| shortest[l] - length[l]);
                let active = each::<L>(|l| if deficit[l] > 0.0 { deficit[l] } else { 0.0 });
                let share = each(|l| ratio(active[l], length[l] * pair.weight(l)));
                pair.push(particles, share);
            }
        }
    }
}

impl From<MinDistance> for Constraint {
    fn from(constraint: MinDistance) -> Self {
        Self::MinDistance(constraint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::testing::{assert_pair_laws, line};

    const STANDOFF: MinDistance = MinDistance { a: 0, b: 1, min_length: 1.0 };

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        assert_pair_laws(&[0.5], 1.0, |p| STANDOFF.project(&[Span::LOOSE], &mut p.columns(), 0.01));
    }

    #[test]
    fn acts_only_when_too_near() {
        let mut far = line(1.5, [1.0, 1.0]);
        STANDOFF.project(&[Span::LOOSE], &mut far.columns(), 0.01);
        assert_eq!(far.x[1], 1.5);
        let mut near = line(0.5, [1.0, 1.0]);
        STANDOFF.project(&[Span::LOOSE], &mut near.columns(), 0.01);
        assert_eq!((near.x[0], near.x[1]), (-0.25, 0.75));
    }
}
