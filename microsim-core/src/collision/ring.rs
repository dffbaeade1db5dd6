//! Discs near rings of linked particles: the links that each may touch during a step, and the side on which it stays.

use super::aabb::Aabb;
use super::bodies::{Bodies, BodyProxy};
use super::combine;
use super::disc_grid::{Disc, DiscGrid};
use super::exemptions::Exemptions;
use crate::geometry::segment::nearest_on_segment;
use crate::particle::Particles;
use glam::Vec2;
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
        Link { a: self.nodes[k], b: self.nodes[(k + 1) % self.nodes.len()] }
    }
}

/// Two neighbours in a ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub a: u32,
    pub b: u32,
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
pub(crate) enum Side {
    Inside,
    Outside,
    /// The one where it is.
    Either,
}

/// On which side of a ring an owner's particles stay. `containments` is indexed by owner; the others are free.
fn side_of(owner: u32, ring: Ring<'_>, containments: &[Containment]) -> Side {
    let is_inside = ring.holds.map_or(owner == ring.owner, |held| owner == held);
    match containments.get(owner as usize) {
        _ if is_inside => Side::Inside,
        Some(&Containment::Inside(holder)) if holder == ring.owner && ring.holds.is_none() => Side::Inside,
        Some(&Containment::Passing(holder)) if holder == ring.owner => Side::Either,
        _ => Side::Outside,
    }
}

/// A disc that may touch a ring during the step.
#[derive(Clone, Debug)]
pub(crate) struct RingContact {
    pub particle: u32,
    /// Place of the ring among those that were searched.
    pub ring: usize,
    /// Where it has to stay.
    pub side: Side,
    pub radius_sum: f32,
    pub friction: f32,
    /// The nearer node of the link that it touched last in any substep since it was found.
    pub touched: Option<u32>,
    /// Whether it touched a link, or was on the wrong side, when contacts were last projected.
    pub is_close: bool,
    links: Range<u32>,
}

/// All discs near rings, found once per step.
#[derive(Clone, Debug, Default)]
pub(crate) struct RingContacts {
    pub contacts: Vec<RingContact>,
    links: Vec<Link>,
    found: Vec<(u32, u32)>,
    /// The ring that each particle is a node of, by particle.
    ring_of: Vec<u32>,
}

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
}

impl RingContacts {
    /// The links that a disc may touch.
    pub(crate) fn links_of(&self, contact: &RingContact) -> &[Link] {
        &self.links[contact.range()]
    }

    /// The contacts of the ring in this place, which lie side by side.
    pub(crate) fn of_ring(&self, place: usize) -> &[RingContact] {
        let first = self.contacts.partition_point(|contact| contact.ring < place);
        let count = self.contacts[first..].partition_point(|contact| contact.ring == place);
        &self.contacts[first..first + count]
    }

    /// The contacts, to be worked on, and all links.
    pub(crate) fn parts(&mut self) -> (&mut [RingContact], &[Link]) {
        (&mut self.contacts, &self.links)
    }

    /// Finds the discs near some rings.
    pub(super) fn find(&mut self, rings: &[Ring<'_>], near: RingQuery<'_>) {
        self.contacts.clear();
        self.links.clear();
        self.note_nodes(rings, near.particles.len());
        for (ring, k) in rings.iter().zip(0..) {
            self.find_near(*ring, k, near);
            self.group(*ring, k as usize, near);
        }
    }

    /// Finds the links of one ring that each disc may touch, disc by disc.
    fn find_near(&mut self, ring: Ring<'_>, place: u32, near: RingQuery<'_>) {
        let Self { found, ring_of, .. } = self;
        let links: Vec<LinkProxy> = (0..ring.nodes.len()).map(|link| LinkProxy::of(ring, link, near)).collect();
        let aabb = links.iter().fold(Aabb::EMPTY, |aabb, link| aabb.union(link.aabb));
        let bodies: Vec<&BodyProxy> = near.bodies.in_box(aabb.low(), aabb.high()).collect();
        found.clear();
        for (link, k) in links.iter().zip(0..) {
            // Nodes of a ring keep apart as discs.
            let discs = link.near_discs(&bodies, near).filter(|disc| ring_of[disc.index as usize] != place);
            let touching = discs.filter(|disc| may_touch(near.particles, disc.index, link.nodes, near.exemptions));
            // Nested loops; `extend` would ask the nested iterators for one disc after the other.
            touching.for_each(|disc| found.push((disc.index, k)));
        }
        found.sort_unstable();
    }

    fn note_nodes(&mut self, rings: &[Ring<'_>], particles: usize) {
        self.ring_of.clear();
        self.ring_of.resize(if rings.is_empty() { 0 } else { particles }, NO_RING);
        for (ring, k) in rings.iter().zip(0..) {
            ring.nodes.iter().for_each(|&node| self.ring_of[node as usize] = k);
        }
    }

    /// Turns what was found near one ring into one contact for each disc.
    fn group(&mut self, ring: Ring<'_>, place: usize, near: RingQuery<'_>) {
        let p = near.particles;
        for group in self.found.chunk_by(|a, b| a.0 == b.0) {
            let (particle, first) = (group[0].0, self.links.len() as u32);
            self.links.extend(group.iter().map(|&(_, k)| ring.link(k as usize)));
            let (i, node) = (particle as usize, ring.nodes[0] as usize);
            self.contacts.push(RingContact {
                particle,
                ring: place,
                side: side_of(p.owner[i], ring, near.containments),
                radius_sum: p.radius[i] + p.radius[node],
                friction: combine(p.material[i], p.material[node]).0,
                touched: None,
                is_close: true,
                links: first..self.links.len() as u32,
            });
        }
    }
}

impl RingContact {
    /// Its links in the list of all.
    pub(crate) fn range(&self) -> Range<usize> {
        self.links.start as usize..self.links.end as usize
    }
}

/// A link as the search sees it.
struct LinkProxy {
    nodes: Link,
    ends: [Vec2; 2],
    /// Radius of its nodes and half of the margin.
    half_width: f32,
    /// The box around all places within that of it, and some more: rounding takes nothing away that is near.
    aabb: Aabb,
}

impl LinkProxy {
    fn of(ring: Ring<'_>, k: usize, near: RingQuery<'_>) -> Self {
        let (p, nodes) = (near.particles, ring.link(k));
        let ends = [p.position(nodes.a as usize), p.position(nodes.b as usize)];
        let half_width = p.radius[nodes.a as usize] + 0.5 * near.margin;
        let (low, high) = (ends[0].min(ends[1]) - half_width, ends[0].max(ends[1]) + half_width);
        Self { nodes, ends, half_width, aabb: Aabb::new(low, high).shrunk(0.0) }
    }

    /// Discs of these bodies and of the grids that may touch it.
    fn near_discs<'a>(
        &'a self,
        bodies: &'a [&'a BodyProxy],
        near: RingQuery<'a>,
    ) -> impl Iterator<Item = &'a Disc> + 'a {
        let bodies = bodies.iter().filter(|body| body.aabb.overlaps(self.aabb));
        let in_bodies = bodies.flat_map(move |body| near.bodies.discs_of(body));
        let in_grids = near.disc_grids.into_iter().flat_map(|grid| grid.in_box(self.aabb.low(), self.aabb.high()));
        in_bodies.chain(in_grids).filter(|disc| self.is_near(disc))
    }

    #[inline(always)]
    fn is_near(&self, disc: &Disc) -> bool {
        let distance = disc.swept_radius + self.half_width;
        let way = || disc.at - nearest_on_segment(self.ends[0], self.ends[1], disc.at);
        disc.aabb().overlaps(self.aabb) && way().length_squared() < distance * distance
    }
}

/// Whether a disc that is no node of a link's ring collides with the link, and not through a gate.
pub(crate) fn may_touch(p: &Particles, disc: u32, Link { a, b }: Link, exemptions: &Exemptions) -> bool {
    let (i, node) = (disc as usize, a as usize);
    let owners = [p.owner[i], p.owner[node]];
    p.groups[i].meets(p.groups[node])
        && !exemptions.contains(owners[0], owners[1])
        && ![a, b].iter().any(|&node| exemptions.gate_is_open([disc, node], owners))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contacts_of_a_ring_lie_side_by_side() {
        let contact = |(particle, ring)| RingContact {
            particle,
            ring,
            side: Side::Either,
            radius_sum: 1.0,
            friction: 0.0,
            touched: None,
            is_close: true,
            links: 0..0,
        };
        let contacts = [(7, 0), (8, 0), (5, 2), (6, 3), (7, 3), (9, 3)].map(contact).to_vec();
        let rings = RingContacts { contacts, ..RingContacts::default() };
        let particles = |ring| rings.of_ring(ring).iter().map(|contact| contact.particle).collect::<Vec<_>>();
        assert_eq!([0, 1, 2, 3, 4].map(particles), [vec![7, 8], vec![], vec![5], vec![6, 7, 9], vec![]]);
    }
}
