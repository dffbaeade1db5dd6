//! Constraints whose lengths are scaled lane by lane: muscles, by an activation of their channel, and yielding links, by their
//! plastic strain.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A constraint of a list, and the channel that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Muscle {
    pub constraint: u32,
    pub channel: u32,
}

/// A constraint of a list whose lengths are scaled, by at least one row of the length state of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scaled {
    pub constraint: u32,
    /// Row of the factors of a channel.
    pub channel: Option<u32>,
    /// Row of the plastic strains of a yielding link.
    pub link: Option<u32>,
}

/// Divides a list of so many constraints, in its order, into those that are scaled and what lies between them; `scaled` are in
/// that order.
pub(crate) fn runs(constraints: usize, scaled: &[Scaled]) -> impl Iterator<Item = (Range<usize>, Option<&Scaled>)> {
    (0..=2 * scaled.len()).map(move |k| {
        let before = if k < 2 { 0 } else { scaled[k / 2 - 1].constraint as usize + 1 };
        match scaled.get(k / 2) {
            Some(scaled) if k % 2 == 1 => {
                let at = scaled.constraint as usize;
                (at..at + 1, Some(scaled))
            }
            Some(scaled) => (before..scaled.constraint as usize, None),
            None => (before..constraints, None),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_the_whole_list_in_its_order() {
        assert_eq!(runs(5, &[]).collect::<Vec<_>>(), [(0..5, None)]);
        let scaled =
            [(1, 7), (2, 8), (4, 9)].map(|(constraint, row)| Scaled { constraint, channel: Some(row), link: None });
        let [a, b, c] = scaled.each_ref().map(Some);
        let expected = [(0..1, None), (1..2, a), (2..2, None), (2..3, b), (3..4, None), (4..5, c), (5..5, None)];
        assert_eq!(runs(5, &scaled).collect::<Vec<_>>(), expected);
    }
}
