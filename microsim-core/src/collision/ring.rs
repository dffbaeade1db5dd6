//! Discs near rings of linked particles: the links that each may touch during a step, and the side on which it stays.

use super::bodies::Bodies;
use super::combine;
use super::disc_grid::{Disc, DiscGrid};
use super::exemptions::Exemptions;
use crate::geometry::segment::nearest_on_segment;
use crate::particle::{NO_OWNER, Particles};
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
    /// From the origin of the ring's nodes, which they share, to that of the disc; origins stay during a step.
    pub between_origins: Vec2,
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
}

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
        for (k, ring) in rings.iter().enumerate() {
            self.found.clear();
            for link in 0..ring.nodes.len() {
                find_near_link(*ring, link, near, &mut self.found);
            }
            self.found.sort_unstable();
            self.group(*ring, k, near);
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
                between_origins: p.origin(i) - p.origin(node),
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

fn find_near_link(ring: Ring<'_>, k: usize, near: RingQuery<'_>, found: &mut Vec<(u32, u32)>) {
    let p = near.particles;
    let Link { a, b } = ring.link(k);
    let ends = [p.position(a as usize), p.position(b as usize)];
    let half_width = p.radius[a as usize] + 0.5 * near.margin;
    let (low, high) = (ends[0].min(ends[1]) - half_width, ends[0].max(ends[1]) + half_width);
    let is_near = |disc: &&Disc| {
        let distance = disc.swept_radius + half_width;
        (disc.at - nearest_on_segment(ends[0], ends[1], disc.at)).length_squared() < distance * distance
    };
    let in_bodies = near.bodies.in_box(low, high).flat_map(|body| near.bodies.discs_of(body));
    let in_grids = near.disc_grids.into_iter().flat_map(|grid| grid.in_box(low, high));
    let discs = in_bodies.chain(in_grids).filter(is_near);
    let touching = discs.filter(|disc| may_touch(p, disc.index as usize, ring, [a, b], near.exemptions));
    found.extend(touching.map(|disc| (disc.index, k as u32)));
}

/// Whether a disc collides with a link: not with its own ring's, whose nodes keep apart as discs, and not through a gate.
pub(crate) fn may_touch(p: &Particles, i: usize, ring: Ring<'_>, ends: [u32; 2], exemptions: &Exemptions) -> bool {
    let a = ends[0] as usize;
    let owners = [p.owner[i], p.owner[a]];
    let is_own_node = owners[0] == owners[1] && p.next_in_ring[i] != NO_OWNER && ring.nodes.contains(&(i as u32));
    !is_own_node
        && p.groups[i].meets(p.groups[a])
        && !exemptions.contains(owners[0], owners[1])
        && !ends.iter().any(|&node| exemptions.gate_is_open([i as u32, node], owners))
}
