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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::{LANES, NO_OWNER, Particles};
    use crate::rng::Rng;

    /// The same without notes.
    fn first(kind: Vacancy, blocks: &[Block]) -> Option<usize> {
        Vacancies::default().find(kind, blocks)
    }

    /// Finds a block with room for an instance, the same as a search from the first one, or adds one.
    fn occupy(
        (template, slots): (u32, u32),
        owner: u32,
        vacancies: &mut Vacancies,
        blocks: &mut Vec<Block>,
        particles: &mut Particles,
    ) -> bool {
        let mut find = |kind| {
            let found = vacancies.find(kind, blocks);
            assert_eq!(found, first(kind, blocks));
            found
        };
        let found = find(Vacancy::Lane(template)).or_else(|| find(Vacancy::Block(slots)));
        let index = found.unwrap_or_else(|| {
            blocks.push(Block::new(template, slots as usize, particles));
            blocks.len() - 1
        });
        let is_of_another = blocks[index].template != template;
        blocks[index].template = template;
        vacancies.add(&blocks[index], index);
        let lane = blocks[index].free_lane().unwrap();
        blocks[index].owner[lane] = owner;
        is_of_another
    }

    #[test]
    fn notes_find_the_block_that_a_search_from_the_first_one_finds() {
        let (mut rng, mut particles) = (Rng::new(2, 2), Particles::default());
        let (mut blocks, mut vacancies) = (Vec::<Block>::new(), Vacancies::default());
        let mut served = 0;
        for turn in 0..6000 {
            if rng.range(0.0, 1.0) < if turn / 1000 % 2 == 0 { 0.7 } else { 0.3 } {
                // Templates 0 and 1 have blocks of equal size.
                let instance = [(0, 1), (1, 1), (2, 3)][rng.range(0.0, 2.999) as usize];
                served += u32::from(occupy(instance, turn, &mut vacancies, &mut blocks, &mut particles));
            } else if !blocks.is_empty() {
                let index = rng.range(0.0, blocks.len() as f32 - 0.01) as usize;
                let lanes = if turn % 4 == 0 { 0..LANES } else { 0..1 };
                blocks[index].owner[lanes].fill(NO_OWNER);
                vacancies.add(&blocks[index], index);
            }
        }
        assert!(served > 10, "{served}");
    }
}
