//! Rigid links once more after contacts. Contacts have the last word in a substep, so what they press on is stretched most at its
//! end. In long substeps a pass over the rigid links of these bodies, and over what pressed on them, costs less than another
//! substep and leaves smaller errors. In substeps of any length hard contacts ask for it: those with heavy discs.

use super::block::Block;
use super::contact::is_heavy;
use crate::collision::{Contact, Mobility};
use crate::particle::PositionCells;

/// Substeps up to this do without, s.
pub(super) const SHORT: f32 = 1.0 / 400.0;
/// Stands for no block.
const NO_BLOCK: usize = usize::MAX;

/// Contacts of a list whose discs overlapped in this substep, at least one disc of each linked to others.
#[derive(Debug, Default)]
pub(super) struct Pressed {
    pub is_long: bool,
    pub contacts: Vec<Contact>,
    /// Those of the hard contacts of this substep, in their order.
    hard: Vec<[u32; 2]>,
    /// Of each contact: the blocks that its linked sides are in, and whether it is hard.
    sides: Vec<([usize; 2], bool)>,
}

impl Pressed {
    /// Forgets those of the last substep, and begins with one of `h` seconds.
    pub(super) fn begin(&mut self, h: f32) {
        self.is_long = h > SHORT;
        self.hard.clear();
        self.contacts.clear();
    }

    /// Notes a contact that was projected.
    #[inline(always)]
    pub(super) fn note(&mut self, contact: &Contact, p: PositionCells<'_>) {
        if contact.mobility.contains(&Mobility::Linked) {
            if is_hard(contact, p) {
                self.hard.push([contact.i, contact.j]);
            }
            if self.is_long {
                self.add(contact);
            }
        }
    }

    /// Whether a hard contact was noted.
    pub(super) fn has_hard(&self) -> bool {
        !self.hard.is_empty()
    }

    /// Notes all contacts of the list that have touched in this step.
    pub(super) fn note_touched(&mut self, contacts: &[Contact]) {
        let linked = |contact: &&Contact| contact.touched && contact.mobility.contains(&Mobility::Linked);
        contacts.iter().filter(linked).for_each(|contact| self.add(contact));
    }

    fn add(&mut self, contact: &Contact) {
        // Its impact is known.
        self.contacts.push(Contact { restitution: 0.0, ..*contact });
    }

    /// Finds the blocks that linked sides of the contacts are in, and forgets contacts without any.
    pub(super) fn find_blocks(&mut self, blocks: &[Block]) {
        let Self { contacts, sides, hard, .. } = self;
        sides.clear();
        let mut hard = hard.iter().peekable();
        // Contacts of two bodies lie side by side, and bodies beside and above by turns: the last two blocks are often the next ones.
        let mut last = [[0; 2]; 2];
        contacts.retain(|contact| {
            let is_hard = hard.next_if_eq(&&[contact.i, contact.j]).is_some();
            let mut found = [NO_BLOCK; 2];
            for (k, side) in [contact.i, contact.j].into_iter().enumerate() {
                if contact.mobility[k] == Mobility::Linked
                    && let Some(block) = block_of(side, blocks, last[k])
                {
                    found[k] = block;
                    if block != last[k][0] {
                        last[k] = [block, last[k][0]];
                    }
                }
            }
            let any = found != [NO_BLOCK; 2];
            if any {
                sides.push((found, is_hard));
            }
            any
        });
    }

    /// The blocks that linked sides of the contacts are in, or of the hard ones only.
    pub(super) fn blocks(&self, hard_only: bool) -> impl Iterator<Item = usize> {
        let of = self.sides.iter().filter(move |(_, is_hard)| *is_hard || !hard_only);
        of.flat_map(|(sides, _)| *sides).filter(|side| *side != NO_BLOCK)
    }

    /// Forgets all contacts but those of some blocks.
    pub(super) fn keep_blocks(&mut self, kept: &[bool]) {
        let mut sides = self.sides.iter();
        let is_kept = |of: &[usize; 2]| of.iter().any(|&side| side != NO_BLOCK && kept[side]);
        self.contacts.retain(|_| sides.next().is_some_and(|(of, _)| is_kept(of)));
    }
}

/// Whether one side is heavy on the other, which is linked, and no drive moves it.
#[inline(always)]
fn is_hard(contact: &Contact, p: PositionCells<'_>) -> bool {
    let hard = |disc, on| disc != Mobility::Bounded && on == Mobility::Linked;
    let ([of_i, of_j], [i, j]) = (contact.mobility, [contact.i, contact.j].map(|i| p.inv_mass(i as usize)));
    (hard(of_i, of_j) && is_heavy(i, j)) || (hard(of_j, of_i) && is_heavy(j, i))
}

/// The block that a particle is in, if it is in any; those that are `likely` are looked at first.
fn block_of(particle: u32, blocks: &[Block], likely: [usize; 2]) -> Option<usize> {
    let holds = |k: usize| blocks.get(k).is_some_and(|block| block.holds(particle));
    let searched = || blocks.partition_point(|block| block.base <= particle).checked_sub(1).filter(|&k| holds(k));
    likely.into_iter().find(|&k| holds(k)).or_else(searched)
}

#[cfg(test)]
mod tests {
    use super::super::testing::disc;
    use super::*;
    use crate::particle::Particles;
    use glam::Vec2;

    #[test]
    fn a_particle_is_found_in_its_block_whichever_is_likely() {
        let mut p = Particles::default();
        p.insert(&disc(Vec2::ZERO, 1.0));
        let first = Block::new(0, 2, &mut p);
        let loose = p.insert(&disc(Vec2::ZERO, 1.0));
        let blocks = [first, Block::new(1, 1, &mut p)];
        for likely in [[0, 1], [1, 0], [2, 7]] {
            let found = |particle| block_of(particle, &blocks, likely);
            assert_eq!([found(0), found(loose), found(u32::MAX)], [None; 3]);
            for (k, block) in blocks.iter().enumerate() {
                assert_eq!([found(block.base), found(block.range().end() as u32 - 1)], [Some(k); 2]);
            }
        }
    }
}
