//! All discs near rings: the links that each may touch during a step, in strips of the room.

use super::ring::{FoundLink, Ring, RingContact};
use super::ring_search::{NO_RING, RingQuery, RingStrip, Strips};
use crate::parallel;
use crate::particle::Particles;

/// A disc near links takes as long as so many contacts of two discs, most of which do not touch.
const EACH: usize = 10;

/// All discs near rings, found once per step.
#[derive(Clone, Debug, Default)]
pub(crate) struct RingContacts {
    strips: Vec<RingStrip>,
    nodes: NodesOfRings,
    /// The strip that each ring is in.
    strip_of: Vec<u32>,
    /// The ring that each particle is a node of, by particle.
    ring_of: Vec<u32>,
}

/// Nodes of one ring after the other.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodesOfRings {
    nodes: Vec<u32>,
    /// Where each ring ends.
    ends: Vec<usize>,
}

/// Some contacts, ring by ring, and the links that their discs may touch.
#[derive(Debug)]
pub(crate) struct RingContactList<'a> {
    pub contacts: &'a mut [RingContact],
    pub links: &'a [FoundLink],
}

impl NodesOfRings {
    /// Those of the ring in this place.
    pub(crate) fn of(&self, place: usize) -> &[u32] {
        &self.nodes[if place > 0 { self.ends[place - 1] } else { 0 }..self.ends[place]]
    }
}

impl RingContacts {
    /// All of them with the links that each may touch, in the order of the ring.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&RingContact, &[FoundLink])> {
        self.strips.iter().flat_map(|strip| {
            let contacts = strip.lists().into_iter().flatten();
            contacts.map(|contact| (contact, contact.links_in(&strip.links)))
        })
    }

    /// How many contacts of two discs take as long as all of them.
    pub(crate) fn in_disc_contacts(&self) -> usize {
        EACH * self.strips.iter().flat_map(RingStrip::lists).map(Vec::len).sum::<usize>()
    }

    /// The contacts of each strip, which are of nodes and discs in this strip and the next one, and then those between strips that
    /// are no neighbours.
    pub(crate) fn lists_mut(&mut self) -> (Vec<Vec<RingContactList<'_>>>, Vec<RingContactList<'_>>, &NodesOfRings) {
        let (mut lists, mut others): (Vec<Vec<_>>, _) = (Vec::with_capacity(self.strips.len()), Vec::new());
        for RingStrip { own, below, far, links, .. } in &mut self.strips {
            let [own, below, far] = [own, below, far].map(|contacts| RingContactList { contacts, links });
            if let Some(before) = lists.last_mut() {
                before.push(below);
            }
            lists.push(vec![own]);
            others.push(far);
        }
        (lists, others, &self.nodes)
    }

    /// The contacts of the ring in this place.
    pub(crate) fn of_ring(&self, place: usize) -> impl Iterator<Item = &RingContact> {
        let strip = self.strip_of.get(place).map(|&strip| &self.strips[strip as usize]);
        strip.into_iter().flat_map(RingStrip::lists).flat_map(move |list| {
            let first = list.partition_point(|contact| contact.ring < place);
            list[first..].iter().take_while(move |contact| contact.ring == place)
        })
    }

    /// Finds the discs near some rings.
    pub(super) fn find(&mut self, rings: &[Ring<'_>], near: RingQuery<'_>) {
        self.note_nodes(rings, near.particles.len());
        let strips = self.sort(rings, near.particles);
        let Self { strips: searches, strip_of, ring_of, .. } = self;
        parallel::for_each(searches.iter_mut().collect(), |strip: &mut RingStrip| {
            strip.find(rings, (strips, strip_of, ring_of), near);
        });
    }

    fn note_nodes(&mut self, rings: &[Ring<'_>], particles: usize) {
        let Self { nodes: NodesOfRings { nodes, ends }, ring_of, .. } = self;
        ring_of.clear();
        ring_of.resize(if rings.is_empty() { 0 } else { particles }, NO_RING);
        nodes.clear();
        ends.clear();
        for (ring, k) in rings.iter().zip(0..) {
            ring.nodes.iter().for_each(|&node| ring_of[node as usize] = k);
            nodes.extend_from_slice(ring.nodes);
            ends.push(nodes.len());
        }
    }

    /// Sorts the rings into strips by their middles.
    fn sort(&mut self, rings: &[Ring<'_>], p: &Particles) -> Strips {
        let Self { strips: sorted, strip_of, .. } = self;
        sorted.iter_mut().for_each(|strip| strip.rings.clear());
        let heights = rings.iter().map(|ring| heights_of(ring, p));
        let strips = if parallel::is_large(p.len()) { Strips::of(heights.clone()) } else { Strips::ONE };
        sorted.resize_with(if rings.is_empty() { 0 } else { strips.last as usize + 1 }, RingStrip::default);
        strip_of.clear();
        for ([low, high], place) in heights.zip(0..) {
            let strip = strips.at(0.5 * (low + high));
            strip_of.push(strip);
            sorted[strip as usize].rings.push(place);
        }
        strips
    }
}

/// Lowest and highest place of a ring's nodes.
fn heights_of(ring: &Ring<'_>, p: &Particles) -> [f32; 2] {
    let heights = ring.nodes.iter().map(|&node| p.position(node as usize).y);
    heights.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], y| {
        [if y < low { y } else { low }, if y > high { y } else { high }]
    })
}

#[cfg(test)]
mod tests {
    use super::super::broad_phase::{BroadPhase, SearchInput};
    use super::super::exemptions::Exemptions;
    use super::super::speculative_margin::DisplacementLimits;
    use super::*;
    use crate::geometry::ring::unit_vector;
    use crate::particle::sleep::Sleep;
    use crate::particle::{CollisionGroups, Particle};
    use crate::rng::Rng;
    use crate::solver::testing::{disc, search_input};
    use glam::Vec2;
    use std::collections::BTreeSet;
    use std::f32::consts::TAU;

    /// Rings of 24 nodes with a disc inside and one outside of each, and as many particles that touch nothing.
    fn crowd(rings: u32, others: usize) -> (Particles, Vec<Vec<u32>>) {
        let (mut p, mut rng) = (Particles::default(), Rng::new(4, 4));
        let nodes = (0..rings).map(|owner| {
            let middle = Vec2::new(rng.range(0.0, 40.0), rng.range(0.0, 200.0));
            let mut disc = |distance: f32, k: u32| {
                let at = middle + unit_vector(TAU * k as f32 / 24.0) * distance;
                p.insert(&Particle { owner, ..disc(at, 1.0) })
            };
            let nodes: Vec<u32> = (0..24).map(|k| disc(4.0, k)).collect();
            disc(3.0, 7);
            disc(5.0, 20);
            p.link_ring(&nodes);
            nodes
        });
        let nodes = nodes.collect();
        (0..others).for_each(|_| {
            p.insert(&Particle { groups: CollisionGroups::NONE, ..disc(Vec2::ZERO, 1.0) });
        });
        (p, nodes)
    }

    fn found_in(p: &Particles, nodes: &[Vec<u32>]) -> RingContacts {
        let rings: Vec<_> = nodes.iter().zip(0..).map(|(nodes, owner)| Ring { owner, nodes, holds: None }).collect();
        let exemptions = Exemptions::default();
        let limits = DisplacementLimits { step: 0.5, substep: 0.5, dt: 1.0 };
        let input = SearchInput { rings: &rings, size: Vec2::new(40.0, 200.0), ..search_input(p, &exemptions, limits) };
        let mut broad_phase = BroadPhase::default();
        broad_phase.find_pairs(input, &mut Sleep::default(), 1);
        broad_phase.ring_contacts.into_inner()
    }

    #[test]
    fn every_second_strip_has_rings_and_discs_of_its_own() {
        let (p, nodes) = crowd(300, 2000);
        let mut found = found_in(&p, &nodes);
        let (strips, others, of_rings) = found.lists_mut();
        assert!(strips.len() > 10 && others.iter().all(|list| list.contacts.is_empty()));
        // A node stands for all nodes of its ring: which of them is near is chance.
        let all = |i: u32| nodes.iter().find(|ring| ring.contains(&i)).map_or(vec![i], Vec::clone);
        let particles = |strip: &Vec<RingContactList<'_>>| -> BTreeSet<u32> {
            let contacts = strip.iter().flat_map(|list| list.contacts.iter());
            contacts.flat_map(|contact| [of_rings.of(contact.ring).to_vec(), all(contact.particle)].concat()).collect()
        };
        let particles: Vec<_> = strips.iter().map(particles).collect();
        assert!(particles.windows(2).any(|pair| !pair[0].is_disjoint(&pair[1])), "no strip has to do with the next");
        for (k, one) in particles.iter().enumerate() {
            assert!(particles[k + 1..].iter().skip(1).step_by(2).all(|other| one.is_disjoint(other)), "strip {k}");
        }
    }

    #[test]
    fn strips_find_what_one_search_finds() {
        let [in_strips, at_once] = [2000, 0].map(|others| {
            let (p, nodes) = crowd(300, others);
            let found = found_in(&p, &nodes);
            let of_ring = |ring| found.of_ring(ring).map(|contact| contact.particle).collect::<BTreeSet<_>>();
            assert_eq!((0..300).map(|ring| found.of_ring(ring).count()).sum::<usize>(), found.iter().count());
            (0..301).map(of_ring).collect::<Vec<_>>()
        });
        assert_eq!(in_strips, at_once);
        assert!(at_once[300].is_empty() && at_once[..300].iter().all(|of_ring| of_ring.len() >= 2));
    }
}
