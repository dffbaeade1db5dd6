//! Blocks: ranges of the store that hold eight instances of a template, slot-major.

use std::ops::Range;

/// Instances of a template in one block.
pub(crate) const LANES: usize = 8;

/// Where a block lies in the store.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockRange {
    /// Entry of slot 0 in lane 0.
    pub base: usize,
    pub slots: usize,
}

impl BlockRange {
    /// Entry of a slot in a lane.
    pub(crate) fn entry(&self, slot: usize, lane: usize) -> usize {
        self.base + slot * LANES + lane
    }

    /// Number of its entries.
    pub(crate) fn len(&self) -> usize {
        self.slots * LANES
    }

    /// One past its last entry.
    pub(crate) fn end(&self) -> usize {
        self.base + self.len()
    }
}

/// Ranges of a store of `len` entries that are in no block. The blocks come in the order in which they lie in the store.
pub(crate) fn outside_of(
    blocks: impl Iterator<Item = BlockRange> + Clone,
    len: usize,
) -> impl Iterator<Item = Range<usize>> {
    let starts = std::iter::once(0).chain(blocks.clone().map(|block| block.end()));
    starts.zip(blocks.map(|block| block.base).chain([len])).map(|(start, end)| start..end)
}
