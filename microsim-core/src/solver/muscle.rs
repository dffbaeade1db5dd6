//! Muscles: constraints of which an activation scales the lengths, by channel.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A constraint of a list, and the channel that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Muscle {
    pub constraint: u32,
    pub channel: u32,
}

/// Divides a list of so many constraints, in its order, into muscles and what lies between them; `muscles` are in that order.
pub(crate) fn runs(constraints: usize, muscles: &[Muscle]) -> impl Iterator<Item = (Range<usize>, Option<u32>)> {
    (0..=2 * muscles.len()).map(move |k| {
        let before = if k < 2 { 0 } else { muscles[k / 2 - 1].constraint as usize + 1 };
        match muscles.get(k / 2) {
            Some(muscle) if k % 2 == 1 => {
                let at = muscle.constraint as usize;
                (at..at + 1, Some(muscle.channel))
            }
            Some(muscle) => (before..muscle.constraint as usize, None),
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
        let muscles = [(1, 7), (2, 8), (4, 9)].map(|(constraint, channel)| Muscle { constraint, channel });
        let expected =
            [(0..1, None), (1..2, Some(7)), (2..2, None), (2..3, Some(8)), (3..4, None), (4..5, Some(9)), (5..5, None)];
        assert_eq!(runs(5, &muscles).collect::<Vec<_>>(), expected);
    }
}
