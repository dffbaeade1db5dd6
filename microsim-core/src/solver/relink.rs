//! Rigid links once more after contacts. Contacts have the last word in a substep, so what they press on is stretched most at its
//! end. In long substeps a pass over the rigid links of these bodies, and over what pressed on them, costs less than another
//! substep and leaves smaller errors. In substeps of any length hard contacts ask for it: those with heavy discs.

use super::block::{self, Block};
use super::constraint::Constraint;
use super::contact::{self, is_heavy};
use super::contact_record::ContactRecorder;
use crate::collision::{Contact, Mobility};
use crate::instruction_set::Dispatch;
use crate::particle::Particles;

/// Passes in a long substep.
const PASSES: usize = 2;
/// Substeps up to this do without, s.
const SHORT: f32 = 1.0 / 400.0;
/// Passes over the blocks with hard contacts.
const HARD_PASSES: usize = 8;
/// Stands for no block.
const NO_BLOCK: usize = usize::MAX;

/// Discs that overlapped in this substep, at least one of them linked to others.
#[derive(Debug, Default)]
pub(crate) struct Pressed {
    is_long: bool,
    /// Those of the hard contacts of this substep, in their order.
    hard: Vec<[u32; 2]>,
    contacts: Vec<Contact>,
    /// Of each contact: the blocks that its linked sides are in, and whether it is hard.
    sides: Vec<([usize; 2], bool)>,
    /// By block: whether it is projected.
    blocks: Vec<bool>,
}

impl Pressed {
    /// Forgets those of the last substep, and begins with one of `h` seconds.
    pub(crate) fn begin(&mut self, h: f32) {
        self.is_long = h > SHORT;
        self.hard.clear();
        self.contacts.clear();
    }

    /// Notes a contact that was projected.
    #[inline(always)]
    pub(crate) fn note(&mut self, contact: &Contact, particles: &Particles) {
        if contact.mobility.contains(&Mobility::Linked) {
            if is_hard(contact, particles) {
                self.hard.push([contact.i, contact.j]);
            }
            if self.is_long {
                self.add(contact);
            }
        }
    }

    /// Notes what has touched in this step, if the substep is short and has hard contacts. Lists come in the order in which they were
    /// projected.
    pub(crate) fn note_neighbours(&mut self, contacts: &[Contact]) {
        if !self.hard.is_empty() && !self.is_long {
            let linked = |contact: &&Contact| contact.touched && contact.mobility.contains(&Mobility::Linked);
            contacts.iter().filter(linked).for_each(|contact| self.add(contact));
        }
    }

    fn add(&mut self, contact: &Contact) {
        // Its impact is known.
        self.contacts.push(Contact { restitution: 0.0, ..*contact });
    }

    /// Projects the links of the bodies that were pressed on, and then what pressed on them. `links` are the rigid ones of a
    /// template, by its index.
    pub(crate) fn relink<'a>(
        &mut self,
        blocks: &[Block],
        links: impl Fn(usize) -> &'a [Constraint],
        particles: &mut Particles,
        recorder: &mut ContactRecorder,
        dispatch: Dispatch,
    ) {
        if self.contacts.is_empty() {
            return;
        }
        self.find_blocks(blocks);
        if self.is_long {
            self.project(PASSES, blocks, &links, particles, recorder, dispatch);
        }
        if !self.hard.is_empty() {
            self.keep_hard_blocks();
            self.project(HARD_PASSES, blocks, &links, particles, recorder, dispatch);
        }
    }

    fn project<'a>(
        &mut self,
        passes: usize,
        blocks: &[Block],
        links: impl Fn(usize) -> &'a [Constraint],
        particles: &mut Particles,
        recorder: &mut ContactRecorder,
        dispatch: Dispatch,
    ) {
        for _ in 0..passes {
            let pressed = blocks.iter().zip(&self.blocks).filter(|(_, is_pressed)| **is_pressed);
            let mut pressed: Vec<_> = pressed.map(|(block, _)| (block, ())).collect();
            for mut batch in block::batches(&mut pressed, particles) {
                let links = links(batch.template());
                batch.project_links(links, dispatch);
            }
            contact::project(&mut self.contacts, particles, &mut Vec::new(), recorder, |_, _| {});
        }
    }

    /// Finds the blocks that linked sides of the contacts are in, and forgets contacts without any.
    fn find_blocks(&mut self, blocks: &[Block]) {
        let Self { contacts, sides, blocks: pressed, hard, .. } = self;
        pressed.clear();
        pressed.resize(blocks.len(), false);
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
                    (found[k], pressed[block]) = (block, true);
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

    /// Forgets all contacts but those of the blocks that have hard ones.
    fn keep_hard_blocks(&mut self) {
        let Self { contacts, sides, blocks: pressed, .. } = self;
        pressed.fill(false);
        for &(of, _) in sides.iter().filter(|(_, is_hard)| *is_hard) {
            of.iter().filter(|side| **side != NO_BLOCK).for_each(|&side| pressed[side] = true);
        }
        let mut sides = sides.iter();
        let is_pressed = |of: &[usize; 2]| of.iter().any(|&side| side != NO_BLOCK && pressed[side]);
        contacts.retain(|_| sides.next().is_some_and(|(of, _)| is_pressed(of)));
    }
}

/// Whether one side is heavy on the other, which is linked, and no drive moves it.
#[inline(always)]
fn is_hard(contact: &Contact, particles: &Particles) -> bool {
    let hard = |disc, on| disc != Mobility::Bounded && on == Mobility::Linked;
    let (i, j, [of_i, of_j]) = (contact.i, contact.j, contact.mobility);
    (hard(of_i, of_j) && is_heavy(particles, i, j)) || (hard(of_j, of_i) && is_heavy(particles, j, i))
}

/// The block that a particle is in, if it is in any; those that are `likely` are looked at first.
fn block_of(particle: u32, blocks: &[Block], likely: [usize; 2]) -> Option<usize> {
    let holds = |k: usize| blocks.get(k).is_some_and(|block| block.holds(particle));
    let searched = || blocks.partition_point(|block| block.base <= particle).checked_sub(1).filter(|&k| holds(k));
    likely.into_iter().find(|&k| holds(k)).or_else(searched)
}

#[cfg(test)]
mod tests {
    use super::super::constraint::Distance;
    use super::super::lanes::LANES;
    use super::super::testing::disc;
    use super::*;
    use glam::Vec2;

    const LONG: f32 = 0.005;
    const LINK: Distance = Distance { a: 0, b: 1, rest_length: 2.0, compliance: 0.0, damping: 0.0 };

    /// Two blocks with a stretched dumbbell each, of which a disc of an inverse mass presses on the first: the stretch that relinking leaves in
    /// each, relative to that before.
    fn stretch_left(h: f32, mobility: Mobility, inv_mass: f32, overlap: f32) -> [f32; 2] {
        let mut p = Particles::default();
        let blocks = [0, 1].map(|_| Block { owner: [0; LANES], ..Block::new(0, 2, &mut p) });
        for (block, x) in blocks.iter().zip([0.0, 50.0]) {
            for slot in 0..2 {
                p.set(block.particle(slot, 0) as usize, &disc(Vec2::new(x, 2.2 * slot as f32), 1.0));
            }
        }
        let heavy = p.insert(&disc(Vec2::new(1.0 - overlap, 2.2), inv_mass));
        let side = blocks[0].particle(1, 0) as usize;
        let mut contacts = [Contact::new(&p, heavy as usize, side, [Mobility::Single, mobility], 0.0)];
        let mut pressed = Pressed::default();
        let mut recorder = ContactRecorder::default();
        pressed.begin(h);
        contact::project(&mut contacts, &mut p, &mut Vec::new(), &mut recorder, |contact, p| pressed.note(contact, p));
        pressed.note_neighbours(&contacts);
        let stretch = |p: &Particles| {
            let ends = blocks.each_ref().map(|block| [0, 1].map(|slot| block.particle(slot, 0) as usize));
            ends.map(|[a, b]| (p.between(a, b).length() - 2.0).abs())
        };
        let before = stretch(&p);
        let links = [Constraint::from(LINK)];
        pressed.relink(&blocks, |_| &links, &mut p, &mut recorder, Dispatch::default());
        let after = stretch(&p);
        assert!(p.between(heavy as usize, side).length() > contacts[0].radius_sum - 0.05);
        [0, 1].map(|k| after[k] / before[k])
    }

    #[test]
    fn under_hard_contacts_links_are_got_back_in_substeps_of_any_length() {
        for (h, inv_mass, overlap) in [(LONG, 1e-3, 0.1), (SHORT, 1e-3, 0.01)] {
            let [pressed, other] = stretch_left(h, Mobility::Linked, inv_mass, overlap);
            assert!(pressed < 0.3 && other == 1.0, "{h} s, {inv_mass}, {overlap}: {pressed} {other}");
        }
    }

    #[test]
    fn without_hard_contacts_long_substeps_alone_do_so() {
        let [long, short] = [LONG, SHORT].map(|h| stretch_left(h, Mobility::Linked, 0.1, 0.01));
        assert!(long[0] < 0.6 && long[1] == 1.0, "{long:?}");
        assert_eq!(short, [1.0; 2]);
    }

    #[test]
    fn what_is_not_linked_is_left_alone() {
        assert_eq!(stretch_left(LONG, Mobility::Single, 1e-3, 0.1), [1.0; 2]);
    }

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
