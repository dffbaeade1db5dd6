//! Counters of a world, which end far from overflow.

use serde::{Deserialize, Serialize};

/// What counters of a world end at, far from overflow.
pub(crate) const MOST_COUNTED: u64 = (1 << 53) - 1;

/// Adds to a counter of a world.
pub(crate) fn count(counter: &mut u64, more: u32) {
    *counter = (*counter + u64::from(more)).min(MOST_COUNTED);
}

/// Counts of discs that crossed a membrane since the world was made. Both should stay 0.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Guard {
    /// A disc was found on the wrong side of the link nearest to it.
    pub wrong_side: u64,
    /// A ray cast found a disc on the wrong side of a whole membrane, or links of one crossed.
    pub net_fired: u64,
}
