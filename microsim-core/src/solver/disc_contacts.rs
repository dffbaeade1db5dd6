//! Contacts of discs in the lists of the broad phase, and the links of what they press on. Strips of the room that have nothing in
//! common are projected at the same time, in an order that does not depend on the number of threads.

use super::block::{self, Block};
use super::constraint::Constraint;
use super::contact::{self, Impact};
use super::contact_record::ContactRecorder;
use super::relink::Pressed;
use crate::collision::Contacts;
use crate::instruction_set::Dispatch;
use crate::parallel;
use crate::particle::{DisjointPositions, Particles, PositionCells};

/// Passes over the links of what is pressed on, in a long substep.
const PASSES: usize = 2;
/// Passes over the blocks with hard contacts.
const HARD_PASSES: usize = 8;

/// What is kept from one substep to the next: memory only.
#[derive(Debug, Default)]
pub(crate) struct DiscContacts {
    /// By list.
    outcomes: Vec<Outcome>,
    /// By block: whether its links are projected.
    pressed: Vec<bool>,
}

/// What projecting a list leaves to be done.
#[derive(Debug, Default)]
struct Outcome {
    pressed: Pressed,
    impacts: Vec<Impact>,
    recorder: ContactRecorder,
}

/// The blocks of the world, and the rigid links of a template, by its index.
#[derive(Clone, Copy)]
pub(crate) struct LinkedBlocks<'a, F> {
    pub blocks: &'a [Block],
    pub links: F,
}

impl DiscContacts {
    /// Discs push each other apart in a substep of `h`; in long substeps, and where they press hard, bodies get their links back.
    pub(crate) fn project<'a>(
        &mut self,
        contacts: &mut Contacts,
        particles: &mut Particles,
        bodies: LinkedBlocks<'a, impl Fn(usize) -> &'a [Constraint]>,
        (impacts, recorder): (&mut Vec<Impact>, &mut ContactRecorder),
        h: f32,
        dispatch: Dispatch,
    ) {
        self.outcomes.resize_with(contacts.lists_mut().count(), Outcome::default);
        for outcome in &mut self.outcomes {
            outcome.pressed.begin(h);
            outcome.recorder.begin_like(recorder);
        }
        let count = contacts.len();
        let lists = contacts.lists_mut().zip(&mut self.outcomes);
        project_lists(lists, count, particles, |(contacts, Outcome { pressed, impacts, recorder }), p| {
            contact::project(contacts, p, impacts, recorder, |contact| pressed.note(contact, p));
        });
        self.relink(contacts, particles, bodies, dispatch);
        for outcome in &mut self.outcomes {
            impacts.append(&mut outcome.impacts);
            recorder.append(&mut outcome.recorder);
        }
    }

    fn relink<'a>(
        &mut self,
        contacts: &mut Contacts,
        particles: &mut Particles,
        bodies: LinkedBlocks<'a, impl Fn(usize) -> &'a [Constraint]>,
        dispatch: Dispatch,
    ) {
        let is_long = self.lists().any(|pressed| pressed.is_long);
        let has_hard = self.lists().any(Pressed::has_hard);
        if has_hard && !is_long {
            let lists = self.outcomes.iter_mut().zip(contacts.lists_mut());
            lists.for_each(|(outcome, contacts)| outcome.pressed.note_touched(contacts));
        }
        if self.lists().all(|pressed| pressed.contacts.is_empty()) {
            return;
        }
        self.outcomes.iter_mut().for_each(|outcome| outcome.pressed.find_blocks(bodies.blocks));
        if is_long {
            self.find_pressed(bodies.blocks.len(), false);
            (0..PASSES).for_each(|_| self.project_pressed(particles, &bodies, dispatch));
        }
        if has_hard {
            self.find_pressed(bodies.blocks.len(), true);
            let Self { outcomes, pressed } = self;
            outcomes.iter_mut().for_each(|outcome| outcome.pressed.keep_blocks(pressed));
            (0..HARD_PASSES).for_each(|_| self.project_pressed(particles, &bodies, dispatch));
        }
    }

    fn lists(&self) -> impl Iterator<Item = &Pressed> {
        self.outcomes.iter().map(|outcome| &outcome.pressed)
    }

    /// Finds the blocks that are pressed on, or pressed hard.
    fn find_pressed(&mut self, blocks: usize, hard_only: bool) {
        let Self { outcomes, pressed } = self;
        pressed.clear();
        pressed.resize(blocks, false);
        for outcome in outcomes {
            outcome.pressed.blocks(hard_only).for_each(|block| pressed[block] = true);
        }
    }

    /// Projects the links of the blocks that are pressed on, and then what presses on them.
    fn project_pressed<'a>(
        &mut self,
        particles: &mut Particles,
        bodies: &LinkedBlocks<'a, impl Fn(usize) -> &'a [Constraint]>,
        dispatch: Dispatch,
    ) {
        let pressed = bodies.blocks.iter().zip(&self.pressed).filter(|(_, is_pressed)| **is_pressed);
        let mut pressed: Vec<_> = pressed.map(|(block, _)| (block, ())).collect();
        for mut batch in block::batches(&mut pressed, particles) {
            let links = (bodies.links)(batch.template());
            batch.project_links(links, dispatch);
        }
        let count = self.lists().map(|pressed| pressed.contacts.len()).sum();
        project_lists(self.outcomes.iter_mut(), count, particles, |Outcome { pressed, recorder, .. }, p| {
            contact::project(&mut pressed.contacts, p, &mut Vec::new(), recorder, |_| {});
        });
    }
}

/// Does each list: the strips as [`parallel::for_each_strip`] does, then the last one alone.
fn project_lists<T: Send>(
    lists: impl Iterator<Item = T>,
    contacts: usize,
    particles: &mut Particles,
    work: impl Fn(T, PositionCells<'_>) + Send + Sync,
) {
    let counts = [particles.len(), contacts];
    #[expect(unsafe_code, reason = "strips are disjoint, but their particles do not lie side by side")]
    // SAFETY: a contact of a strip is of two bodies in the rows of the strip and the row after it, see `Bodies::pairs`; no
    // particle is in two bodies. So every second strip has particles of its own, and these run at the same time.
    let positions = unsafe { DisjointPositions::new(particles.position_cells()) };
    let mut strips: Vec<T> = lists.collect();
    let others = strips.pop();
    parallel::for_each_strip(strips.into_iter(), counts, |list| work(list, positions.cells()));
    others.into_iter().for_each(|list| work(list, positions.cells()));
}

#[cfg(test)]
mod tests {
    use super::super::constraint::Distance;
    use super::super::lanes::LANES;
    use super::super::relink::SHORT;
    use super::super::testing::disc;
    use super::*;
    use crate::collision::{Contact, Mobility};
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
        let contact = Contact::new(&p, heavy as usize, side, [Mobility::Single, mobility], 0.0);
        let stretch = |p: &Particles| {
            let ends = blocks.each_ref().map(|block| [0, 1].map(|slot| block.particle(slot, 0) as usize));
            ends.map(|[a, b]| (p.between(a, b).length() - 2.0).abs())
        };
        let mut pushed = p.clone();
        let (impacts, recorder) = (&mut Vec::new(), &mut ContactRecorder::default());
        contact::project(&mut [contact], pushed.position_cells(), impacts, recorder, |_| {});
        let before = stretch(&pushed);
        let links = [Constraint::from(LINK)];
        let bodies = LinkedBlocks { blocks: &blocks, links: |_| &links[..] };
        let contacts = &mut Contacts::of(vec![contact]);
        DiscContacts::default().project(contacts, &mut p, bodies, (impacts, recorder), h, Dispatch::default());
        let after = stretch(&p);
        assert!(p.between(heavy as usize, side).length() > contact.radius_sum - 0.05);
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
}
