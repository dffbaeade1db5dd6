//! Which organisms touch: turns the solver's contacts into exactly one begin and one end event per pair.

use crate::collision::Contact;
use crate::event::Event;
use crate::id::OrganismId;
use crate::organism::table::Organisms;
use crate::particle::Particles;

/// Pairs of organisms that touched in the last step, sorted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touching {
    pairs: Vec<(OrganismId, OrganismId)>,
    now: Vec<(OrganismId, OrganismId)>,
}

impl Touching {
    pub(crate) fn pairs(&self) -> &[(OrganismId, OrganismId)] {
        &self.pairs
    }

    /// Compares this step's contacts with the last step's and reports what began and what ended.
    pub(crate) fn update(
        &mut self,
        contacts: &[Contact],
        particles: &Particles,
        organisms: &Organisms,
        events: &mut Vec<Event>,
    ) {
        self.now.clear();
        for contact in contacts.iter().filter(|contact| contact.touched) {
            let (a, b) = (particles.owner[contact.i as usize], particles.owner[contact.j as usize]);
            if a != b {
                let ids = (organisms.id_at(a.min(b)), organisms.id_at(a.max(b)));
                self.now.extend(ids.0.zip(ids.1));
            }
        }
        self.now.sort_unstable();
        self.now.dedup();
        let only = |from: &[(OrganismId, OrganismId)], other: &[_]| {
            let missing = |pair: &&_| other.binary_search(*pair).is_err();
            from.iter().filter(missing).copied().collect::<Vec<_>>()
        };
        events.extend(only(&self.pairs, &self.now).into_iter().map(|(a, b)| Event::ContactEnded { a, b }));
        events.extend(only(&self.now, &self.pairs).into_iter().map(|(a, b)| Event::ContactBegan { a, b }));
        std::mem::swap(&mut self.pairs, &mut self.now);
    }
}
