//! Which organisms touch: turns the solver's contacts into exactly one begin and one end event per pair.

use super::World;
use crate::collision::Contact;
use crate::event::Event;
use crate::id::OrganismId;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::solver::ring_contact;
use serde::{Deserialize, Serialize};

/// Pairs of organisms that touched in the last step, sorted.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Touching {
    pairs: Vec<(OrganismId, OrganismId)>,
    #[serde(skip)]
    now: Vec<(OrganismId, OrganismId)>,
}

/// Two particles of which the surfaces may have met in the last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearPair {
    pub i: u32,
    /// The other disc; of a link of a membrane the node that is nearer. Each link makes a pair of its own.
    pub j: u32,
    /// Distance of the surfaces now, negative where they overlap.
    pub gap: f32,
    pub touched: bool,
}

impl World {
    /// All pairs of live particles that the last step's search found.
    pub(crate) fn near_pairs(&self) -> impl Iterator<Item = NearPair> + '_ {
        let (p, near) = (&self.particles, &self.scratch.broad_phase);
        let discs = near.contacts.iter().map(|&Contact { i, j, touched, .. }| {
            let (a, b) = (i as usize, j as usize);
            NearPair { i, j, gap: p.between(a, b).length() - p.radius[a] - p.radius[b], touched }
        });
        let links = near.ring_contacts.contacts.iter().flat_map(|contact| {
            ring_contact::gaps(contact, &near.ring_contacts, p).map(|(j, gap)| NearPair {
                i: contact.particle,
                j,
                gap,
                touched: contact.touched == Some(j),
            })
        });
        discs.chain(links).filter(|pair| p.is_live(pair.i as usize) && p.is_live(pair.j as usize))
    }
}

impl Touching {
    /// The pairs.
    pub(crate) fn pairs(&self) -> &[(OrganismId, OrganismId)] {
        &self.pairs
    }

    /// Compares the pairs of particles that touched in this step with the last step's and reports what began and what ended.
    /// Of two that are asleep nothing changes.
    pub(crate) fn update(
        &mut self,
        touched: impl Iterator<Item = (u32, u32)>,
        is_asleep: impl Fn(OrganismId) -> bool,
        particles: &Particles,
        organisms: &Organisms,
        events: &mut Vec<Event>,
    ) {
        self.now.clear();
        for (i, j) in touched {
            let (a, b) = (particles.owner[i as usize], particles.owner[j as usize]);
            if a != b {
                let ids = (organisms.id_at(a.min(b)), organisms.id_at(a.max(b)));
                self.now.extend(ids.0.zip(ids.1));
            }
        }
        self.now.extend(self.pairs.iter().filter(|(a, b)| is_asleep(*a) && is_asleep(*b)));
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
