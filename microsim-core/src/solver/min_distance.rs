//! Minimum distance constraint: two nodes never get nearer than a minimum.
//!
//! `C = l_min - |x_b - x_a| <= 0`, projected rigidly when violated. Keeps a ring off its interlayer and a membrane from
//! folding (nodes `i` and `i + 2`).

use super::lanes::{Pair, Span, each, ratio};
use crate::particle::Columns;
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

#[inline(always)]
pub(crate) fn project<const L: usize>(list: &[MinDistance], span: Span<L>, particles: &mut Columns<'_>) {
    for c in list {
        let pair = Pair::<L>::load(particles, span.at(c.a), span.at(c.b));
        let shortest: [f32; L] = each(|l| c.min_length * span.scale[l]);
        if pair.is_shorter(shortest) {
            let share = each(|l| {
                let deficit = shortest[l] - pair.length(l);
                let active = if deficit > 0.0 { deficit } else { 0.0 };
                ratio(active, pair.length(l) * pair.weight(l))
            });
            pair.push(particles, share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_pair_laws, line};
    use super::*;

    const STANDOFF: MinDistance = MinDistance { a: 0, b: 1, min_length: 1.0 };

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        assert_pair_laws(&[0.5], 1.0, |p| project(&[STANDOFF], Span::LOOSE, &mut p.columns()));
    }

    #[test]
    fn acts_only_when_too_near() {
        let mut far = line(1.5, [1.0, 1.0]);
        project(&[STANDOFF], Span::LOOSE, &mut far.columns());
        assert_eq!(far.x[1], 1.5);
        let mut near = line(0.5, [1.0, 1.0]);
        project(&[STANDOFF], Span::LOOSE, &mut near.columns());
        assert_eq!((near.x[0], near.x[1]), (-0.25, 0.75));
    }
}
