//! Discs near rings of linked particles: the links that each may touch during a step, and the side on which it stays.

use super::aabb::Aabb;
use super::bodies::Bodies;
use super::combine;
use super::disc_grid::{Disc, DiscGrid};
use super::exemptions::Exemptions;
use super::link_group::LinkGroup;
use crate::instruction_set::Dispatch;
use crate::parallel;
use crate::particle::{LANES, Particles};
use std::ops::Range;

/// A closed ring of linked particles, counter-clockwise: what is to the left of its links is inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring<'a> {
    pub owner: u32,
    pub nodes: &'a [u32],
    /// The one owner whose particles are inside; otherwise those of the ring's own owner are, and those that it contains.
    pub holds: Option<u32>,
}

impl Ring<'_> {
    /// The link from node `k` of the ring to the next one.
    pub(crate) fn link(&self, k: usize) -> Link {
        let next = if k + 1 < self.nodes.len() { k + 1 } else { 0 };
        Link { a: self.nodes[k], b: self.nodes[next] }
    }
}

/// Two neighbours in a ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub a: u32,
    pub b: u32,
}

/// A link that a disc may touch, and its place in the ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FoundLink {
    pub link: Link,
    pub place: u32,
}

/// Which ring holds an owner with all its particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Containment {
    /// Outside of every ring but its own.
    Free,
    /// Inside the ring of this owner.
    Inside(u32),
    /// On its way through the ring of this owner.
    Passing(u32),
}

/// A side of a ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RingSide {
    Inside,
    Outside,
    /// The one where it is.
    Either,
}

/// On which side of a ring an owner's particles stay. `containments` is indexed by owner; the others are free.
fn side_of(owner: u32, ring: Ring<'_>, containments: &[Containment]) -> RingSide {
    let is_inside = ring.holds.map_or(owner == ring.owner, |held| owner == held);
    match containments.get(owner as usize) {
        _ if is_inside => RingSide::Inside,
        Some(&Containment::Inside(holder)) if holder == ring.owner && ring.holds.is_none() => RingSide::Inside,
        Some(&Containment::Passing(holder)) if holder == ring.owner => RingSide::Either,
        _ => RingSide::Outside,
    }
}

/// A disc that may touch a ring during the step.
#[derive(Clone, Debug)]
pub(crate) struct RingContact {
    pub particle: u32,
    /// Place of the ring among those that were searched.
    pub ring: usize,
    /// Where it has to stay.
    pub side: RingSide,
    pub radius_sum: f32,
    pub friction: f32,
    /// The nearer node of the link that it touched last in any substep since it was found.
    pub touched: Option<u32>,
    /// Whether it touched a link, or was on the wrong side, when contacts were last projected.
    pub is_close: bool,
    links: Range<u32>,
}

/// Links of a group that a disc may touch.
#[derive(Clone, Copy, Debug)]
struct Hit {
    particle: u32,
    /// Place of the group's first link in the ring.
    first: u32,
    /// Which of its links, one bit each; at least one.
    lanes: u32,
}

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

/// Discs near the rings in a strip of the room, ring by ring, and scratch. A node of a ring is in the strip that its ring is in,
/// another disc where it is itself.
#[derive(Clone, Debug, Default)]
struct RingStrip {
    rings: Vec<u32>,
    /// Of discs in this strip or in the next one.
    own: Vec<RingContact>,
    /// Of discs in the strip before.
    below: Vec<RingContact>,
    /// Of discs elsewhere.
    far: Vec<RingContact>,
    links: Vec<FoundLink>,
    /// Links of a ring, discs in its box, and which of these are near which links.
    groups: Vec<LinkGroup>,
    discs: Vec<Disc>,
    hits: Vec<Hit>,
}

/// The rows of a room.
#[derive(Clone, Copy, Debug)]
struct Strips {
    low: f32,
    /// One over the height of a strip; 0: there is one only.
    inverse: f32,
    last: u32,
}

/// Height of a strip over the mean height of a ring.
const STRIP: f32 = 1.5;
/// Strips at most.
const MOST: f32 = 256.0;
/// In no ring.
const NO_RING: u32 = u32::MAX;

/// What the search needs to know.
#[derive(Clone, Copy)]
pub(super) struct RingQuery<'a> {
    pub particles: &'a Particles,
    pub exemptions: &'a Exemptions,
    pub containments: &'a [Containment],
    pub bodies: &'a Bodies,
    pub disc_grids: [&'a DiscGrid; 2],
    /// How much the gap between two particles may close in one step.
    pub margin: f32,
    pub dispatch: Dispatch,
}

impl RingContact {
    /// The links that the disc may touch, in the order of the ring, of those of its list.
    #[inline(always)]
    pub(crate) fn links_in<'a>(&self, links: &'a [FoundLink]) -> &'a [FoundLink] {
        &links[self.links.start as usize..self.links.end as usize]
    }
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

impl Strips {
    const ONE: Self = Self { low: 0.0, inverse: 0.0, last: 0 };

    /// Strips for rings that are this low and high.
    fn of(heights: impl Iterator<Item = [f32; 2]> + Clone) -> Self {
        let (mut all, mut sum, mut count) = ([f32::INFINITY, f32::NEG_INFINITY], 0.0, 0.0);
        for [low, high] in heights {
            all = [if low < all[0] { low } else { all[0] }, if high > all[1] { high } else { all[1] }];
            (sum, count) = (sum + (high - low), count + 1.0);
        }
        let [low, high] = all;
        let (usual, least) = (STRIP * sum / count, (high - low) / MOST);
        let height = if usual > least { usual } else { least };
        if height > 0.0 { Self { low, inverse: 1.0 / height, last: ((high - low) / height) as u32 } } else { Self::ONE }
    }

    /// The strip that a place at this height is in.
    fn at(self, y: f32) -> u32 {
        let strip = ((y - self.low) * self.inverse) as u32;
        if strip < self.last { strip } else { self.last }
    }
}

impl RingStrip {
    /// The lists, always in the same order.
    fn lists(&self) -> [&Vec<RingContact>; 3] {
        [&self.own, &self.below, &self.far]
    }

    /// Finds the discs near its rings.
    fn find(&mut self, rings: &[Ring<'_>], (strips, strip_of, ring_of): (Strips, &[u32], &[u32]), near: RingQuery<'_>) {
        self.own.clear();
        self.below.clear();
        self.far.clear();
        self.links.clear();
        for k in 0..self.rings.len() {
            let place = self.rings[k];
            let ring = rings[place as usize];
            self.find_near(ring, place, ring_of, near);
            let here = strip_of[place as usize];
            let strip_at = |particle: u32| match ring_of[particle as usize] {
                NO_RING => strips.at(near.particles.position(particle as usize).y),
                ring => strip_of[ring as usize],
            };
            self.add_contacts(ring, place as usize, (here, &strip_at), near);
        }
    }

    /// Finds the links of one ring that each disc is near to.
    fn find_near(&mut self, ring: Ring<'_>, place: u32, ring_of: &[u32], near: RingQuery<'_>) {
        let Self { groups, discs, hits, .. } = self;
        let p = near.particles;
        let link = |k: usize| {
            let Link { a, b } = ring.link(k);
            ([a, b].map(|node| p.position(node as usize)), p.radius[a as usize] + 0.5 * near.margin)
        };
        let count = ring.nodes.len();
        groups.clear();
        groups.extend((0..count).step_by(LANES).map(|first| LinkGroup::of(first, (first..count).map(link))));
        let aabb = groups.iter().fold(Aabb::EMPTY, |aabb, group| aabb.union(group.aabb));
        let (low, high) = (aabb.low(), aabb.high());
        discs.clear();
        // Nodes of a ring keep apart as discs.
        let mut add = |disc: &Disc| {
            if disc.aabb().overlaps(aabb) && ring_of[disc.index as usize] != place {
                discs.push(*disc);
            }
        };
        near.bodies.in_box(low, high).for_each(|body| near.bodies.discs_of(body, p).for_each(|disc| add(&disc)));
        near.disc_grids.into_iter().for_each(|grid| grid.in_box(low, high).for_each(&mut add));
        hits.clear();
        for disc in &*discs {
            let aabb = disc.aabb();
            for group in groups.iter().filter(|group| aabb.overlaps(group.aabb)) {
                let (particle, first, lanes) = (disc.index, group.first, group.near(disc, near.dispatch));
                hits.extend((lanes != 0).then_some(Hit { particle, first, lanes }));
            }
        }
        hits.sort_unstable_by_key(|hit| (hit.particle, hit.first));
    }

    /// Turns what was found near one ring into one contact for each disc that may touch it.
    fn add_contacts(
        &mut self,
        ring: Ring<'_>,
        place: usize,
        (here, strip_at): (u32, impl Fn(u32) -> u32),
        near: RingQuery<'_>,
    ) {
        let p = near.particles;
        let Self { own, below, far, links, hits, .. } = self;
        for hits in hits.chunk_by(|a, b| a.particle == b.particle) {
            let (particle, first) = (hits[0].particle, links.len() as u32);
            let (i, node) = (particle as usize, ring.nodes[0] as usize);
            if near.exemptions.contains(p.owner[i], ring.owner) {
                continue;
            }
            let places = hits.iter().flat_map(|hit| hit.places());
            let all = places.map(|place| FoundLink { link: ring.link(place as usize), place });
            links.extend(all.filter(|found| may_touch(p, particle, found.link, near.exemptions)));
            let last = links.len() as u32;
            if last == first {
                continue;
            }
            let contacts = match strip_at(particle) {
                there if there == here || there == here + 1 => &mut *own,
                there if there + 1 == here => &mut *below,
                _ => &mut *far,
            };
            contacts.push(RingContact {
                particle,
                ring: place,
                side: side_of(p.owner[i], ring, near.containments),
                radius_sum: p.radius[i] + p.radius[node],
                friction: combine(p.material[i], p.material[node]).0,
                touched: None,
                is_close: true,
                links: first..last,
            });
        }
    }
}

impl Hit {
    /// Places of the links in the ring, ascending.
    fn places(&self) -> impl Iterator<Item = u32> {
        let Self { first, lanes, .. } = *self;
        (0..LANES as u32).filter(move |lane| lanes >> lane & 1 == 1).map(move |lane| first + lane)
    }
}

/// Whether a disc collides with a link of a ring that it is no node of, and not through a gate. Exempt owners never do.
pub(crate) fn may_touch(p: &Particles, disc: u32, Link { a, b }: Link, exemptions: &Exemptions) -> bool {
    let (i, node) = (disc as usize, a as usize);
    let owners = [p.owner[i], p.owner[node]];
    p.groups[i].meets(p.groups[node]) && ![a, b].iter().any(|&node| exemptions.gate_is_open([disc, node], owners))
}

#[cfg(test)]
mod tests {
    use super::super::broad_phase::{BroadPhase, SearchInput};
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
        let particles = |strip: &Vec<RingContactList<'_>>| -> BTreeSet<u32> {
            let contacts = strip.iter().flat_map(|list| list.contacts.iter());
            contacts.flat_map(|contact| of_rings.of(contact.ring).iter().copied().chain([contact.particle])).collect()
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

    #[test]
    fn what_a_ring_holds_stays_inside_and_what_passes_is_free() {
        let of = |holds| Ring { owner: 0, nodes: &[10, 11, 12], holds };
        let containments = [0, 0, 9, 9].map(Containment::Inside);
        let side = |owner, holds| side_of(owner, of(holds), &containments);
        assert_eq!(
            [0, 1, 2, 4].map(|owner| side(owner, None)),
            [RingSide::Inside, RingSide::Inside, RingSide::Outside, RingSide::Outside]
        );
        assert_eq!(
            [0, 1, 2].map(|owner| side(owner, Some(1))),
            [RingSide::Outside, RingSide::Inside, RingSide::Outside]
        );
        let passing = [Containment::Free, Containment::Passing(0), Containment::Passing(9)];
        let sides = [1, 2].map(|owner| side_of(owner, of(None), &passing));
        assert_eq!(sides, [RingSide::Either, RingSide::Outside]);
        let links = [0, 1, 2].map(|k| of(None).link(k)).map(|Link { a, b }| (a, b));
        assert_eq!(links, [(10, 11), (11, 12), (12, 10)]);
    }
}
