//! Where a block with room is: no block before the noted one has any, so that nobody has to search from the first one on.

use crate::solver::block::Block;
use std::collections::BTreeMap;

/// A kind of room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Vacancy {
    /// A free lane in a block of this template.
    Lane(u32),
    /// An empty block of so many slots.
    Block(u32),
}

/// The first block that may have room of each kind; that of a kind without an entry is the first of all.
#[derive(Debug, Default)]
pub(crate) struct Vacancies {
    first: BTreeMap<Vacancy, usize>,
}

impl Vacancies {
    /// Forgets everything, because these are other blocks.
    pub(super) fn clear(&mut self) {
        self.first.clear();
    }

    /// The first block with room of a kind.
    pub(super) fn find(&mut self, kind: Vacancy, blocks: &[Block]) -> Option<usize> {
        let has_room = |block: &Block| match kind {
            Vacancy::Lane(template) => block.template == template && block.free_lane().is_some(),
            Vacancy::Block(slots) => block.slots == slots && block.is_empty(),
        };
        let first = self.first.entry(kind).or_default();
        let found = blocks[*first..].iter().position(has_room).map(|at| *first + at);
        *first = found.unwrap_or(blocks.len());
        found
    }

    /// Notes that a block has room.
    pub(super) fn add(&mut self, block: &Block, index: usize) {
        for kind in [Vacancy::Lane(block.template), Vacancy::Block(block.slots)] {
            if let Some(first) = self.first.get_mut(&kind) {
                *first = index.min(*first);
            }
        }
    }
}
