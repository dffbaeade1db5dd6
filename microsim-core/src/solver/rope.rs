//! Rope constraint: two nodes never get farther apart than a maximum length.
//!
//! `C = |x_b - x_a| - l_max <= 0`, projected rigidly when violated (Macklin et al. 2014, section 4: inequality
//! constraints are projected only while `C > 0`). The seed's rope joint.

use super::lanes::{Pair, Span, each};
use crate::particle::Columns;
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

#[inline(always)]
pub(crate) fn project<const L: usize>(list: &[Rope], span: Span<L>, particles: &mut Columns<'_>) {
    for c in list {
        let pair = Pair::<L>::load(particles, span.at(c.a), span.at(c.b));
        let longest: [f32; L] = each(|l| c.max_length * span.scale[l]);
        if pair.is_longer(longest) {
            pair.push(particles, pair.shortening(longest, 0.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_pair_laws, line};
    use super::*;

    const ROPE: Rope = Rope { a: 0, b: 1, max_length: 1.0 };

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        assert_pair_laws(&[1.7], 1.0, |p| project(&[ROPE], Span::LOOSE, &mut p.columns()));
    }

    #[test]
    fn slack_rope_does_nothing_and_taut_rope_stops() {
        let mut slack = line(0.4, [1.0, 1.0]);
        project(&[ROPE], Span::LOOSE, &mut slack.columns());
        assert_eq!((slack.x[0], slack.x[1]), (0.0, 0.4));
        let mut taut = line(3.0, [0.0, 1.0]);
        project(&[ROPE], Span::LOOSE, &mut taut.columns());
        assert_eq!((taut.x[0], taut.x[1]), (0.0, 1.0));
    }
}
