//! Discs near rings of linked particles: the links that each may touch during a step, and the side on which it stays.

use super::aabb::Aabb;
use super::bodies::Bodies;
use super::combine;
use super::disc_grid::{Disc, DiscGrid};
use super::exemptions::Exemptions;
use super::link_group::{Lanes, LinkGroup, Node, finite};
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
    /// Those of a ring lie side by side.
    pub contacts: Vec<RingContact>,
    /// Where those of each ring begin, and where the last ones end.
    starts: Vec<usize>,
    pub found: FoundLinks,
    /// The ring that each particle is a node of, by particle.
    ring_of: Vec<u32>,
    searches: Vec<Search>,
}

/// The search near some of the rings: what it found, as [`RingContacts`] has it for all, and scratch.
#[derive(Clone, Debug, Default)]
struct Search {
    contacts: Vec<RingContact>,
    links: Vec<FoundLink>,
    /// Where the contacts of each ring end.
    ends: Vec<usize>,
    /// A ring and its links, discs in its box, and which of these are near which links.
    nodes: Vec<Node>,
    groups: Vec<LinkGroup>,
    discs: Vec<Disc>,
    rows: Vec<Range<usize>>,
    hits: Vec<Hit>,
    /// Discs and groups whose boxes overlap, by their places, and what [`LinkGroup::squared_distances`] finds for them.
    candidates: Vec<(u32, u32)>,
    squared: Vec<Lanes>,
}

/// The links near discs, and the rings that they are of.
#[derive(Clone, Debug, Default)]
pub(crate) struct FoundLinks {
    links: Vec<FoundLink>,
    /// Of one ring after the other.
    nodes: Vec<u32>,
    /// Where each ring ends there.
    ends: Vec<usize>,
}

impl FoundLinks {
    /// The links that a disc may touch, in the order of the ring.
    #[inline(always)]
    pub(crate) fn links_of(&self, contact: &RingContact) -> &[FoundLink] {
        &self.links[contact.links.start as usize..contact.links.end as usize]
    }

    /// The nodes of the ring in this place.
    pub(crate) fn nodes_of(&self, place: usize) -> &[u32] {
        &self.nodes[if place > 0 { self.ends[place - 1] } else { 0 }..self.ends[place]]
    }

    fn clear(&mut self) {
        self.links.clear();
        self.nodes.clear();
        self.ends.clear();
    }
}

/// Rings near which discs are searched at a time, a fixed number whatever the number of threads.
const PORTION: usize = 16;
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

impl RingContacts {
    /// The contacts of the ring in this place, which lie side by side.
    pub(crate) fn of_ring(&self, place: usize) -> &[RingContact] {
        self.starts.get(place..place + 2).map_or(&[], |ends| &self.contacts[ends[0]..ends[1]])
    }

    /// Finds the discs near some rings.
    pub(super) fn find(&mut self, rings: &[Ring<'_>], near: RingQuery<'_>) {
        self.note_nodes(rings, near.particles.len());
        let Self { contacts, starts, found, ring_of, searches } = self;
        contacts.clear();
        found.clear();
        starts.clear();
        starts.push(0);
        searches.resize_with(rings.len().div_ceil(PORTION), Search::default);
        let portions = rings.chunks(PORTION).zip(&mut *searches).zip((0..).step_by(PORTION)).collect();
        parallel::for_each(portions, |((rings, search), first): ((&[Ring<'_>], &mut Search), usize)| {
            search.find(rings, first, ring_of, near);
        });
        for search in searches {
            starts.extend(search.ends.drain(..).map(|end| contacts.len() + end));
            let first = found.links.len() as u32;
            found.links.append(&mut search.links);
            let moved = |links: Range<u32>| links.start + first..links.end + first;
            contacts
                .extend(search.contacts.drain(..).map(|one| RingContact { links: moved(one.links.clone()), ..one }));
        }
        for ring in rings {
            found.nodes.extend_from_slice(ring.nodes);
            found.ends.push(found.nodes.len());
        }
    }

    fn note_nodes(&mut self, rings: &[Ring<'_>], particles: usize) {
        self.ring_of.clear();
        self.ring_of.resize(if rings.is_empty() { 0 } else { particles }, NO_RING);
        for (ring, k) in rings.iter().zip(0..) {
            ring.nodes.iter().for_each(|&node| self.ring_of[node as usize] = k);
        }
    }
}

impl Search {
    /// Finds the discs near rings, of which the first one is in this place.
    fn find(&mut self, rings: &[Ring<'_>], first: usize, ring_of: &[u32], near: RingQuery<'_>) {
        for (ring, place) in rings.iter().zip(first..) {
            self.find_near(*ring, place as u32, ring_of, near);
            self.add_contacts(*ring, place, near);
            self.ends.push(self.contacts.len());
        }
    }

    /// Finds the links of one ring that each disc is near to.
    fn find_near(&mut self, ring: Ring<'_>, place: u32, ring_of: &[u32], near: RingQuery<'_>) {
        self.read_links(ring, near);
        self.gather_discs(place, ring_of, near);
        self.find_hits(near.dispatch);
    }

    fn read_links(&mut self, ring: Ring<'_>, near: RingQuery<'_>) {
        let Self { nodes, groups, .. } = self;
        let (p, count) = (near.particles, ring.nodes.len());
        let node = |&i: &u32| Node { at: p.position(i as usize), half_width: p.radius[i as usize] + 0.5 * near.margin };
        nodes.clear();
        nodes.extend(ring.nodes.iter().chain(ring.nodes.first()).map(node));
        groups.clear();
        let some = |first: usize| &nodes[first..(first + LANES).min(count) + 1];
        groups.extend((0..count).step_by(LANES).map(|first| LinkGroup::of(first, some(first))));
    }

    /// Gathers the discs in the box of the ring in this place.
    fn gather_discs(&mut self, place: u32, ring_of: &[u32], near: RingQuery<'_>) {
        let Self { groups, discs, rows, .. } = self;
        let aabb = groups.iter().fold(Aabb::EMPTY, |aabb, group| aabb.union(group.aabb));
        let (low, high) = (aabb.low(), aabb.high());
        // Nodes of a ring keep apart as discs.
        let is_near = |disc: &Disc| disc.aabb().overlaps(aabb) && ring_of[disc.index as usize] != place;
        discs.clear();
        for body in near.bodies.in_box(low, high) {
            discs.extend(near.bodies.discs_of(body, near.particles).filter(is_near));
        }
        for grid in near.disc_grids {
            // All at once: where they lie does not have to be waited for then.
            rows.clear();
            rows.extend(grid.rows_in_box(low, high));
            rows.iter().for_each(|row| discs.extend(grid.row(row).iter().filter(|disc| is_near(disc))));
        }
    }

    fn find_hits(&mut self, dispatch: Dispatch) {
        let Self { groups, discs, candidates, squared, hits, .. } = self;
        // Whether boxes overlap is hard to foresee: each pair is written, and the next one over it if they do not.
        candidates.resize(discs.len() * groups.len() + 1, (0, 0));
        let mut count = 0;
        for (disc, d) in discs.iter().zip(0..) {
            let aabb = disc.aabb();
            for (group, g) in groups.iter().zip(0..) {
                candidates[count] = (d, g);
                count += usize::from(aabb.overlaps(group.aabb));
            }
        }
        candidates.truncate(count);
        squared.resize(count, [0.0; LANES]);
        dispatch.run(
            #[inline(always)]
            || {
                for (&(d, g), squared) in candidates.iter().zip(&mut *squared) {
                    *squared = groups[g as usize].squared_distances(&discs[d as usize]);
                }
            },
        );
        hits.clear();
        for (&(d, g), squared) in candidates.iter().zip(squared) {
            let (particle, first, lanes) = (discs[d as usize].index, groups[g as usize].first, finite(squared));
            hits.extend((lanes != 0).then_some(Hit { particle, first, lanes }));
        }
        hits.sort_unstable_by_key(|hit| u64::from(hit.particle) << 32 | u64::from(hit.first));
    }

    /// Turns what was found near one ring into one contact for each disc that may touch it.
    fn add_contacts(&mut self, ring: Ring<'_>, place: usize, near: RingQuery<'_>) {
        let p = near.particles;
        let Self { contacts, links, hits, .. } = self;
        for hits in hits.chunk_by(|a, b| a.particle == b.particle) {
            let (particle, first) = (hits[0].particle, links.len() as u32);
            let (i, node) = (particle as usize, ring.nodes[0] as usize);
            if near.exemptions.contains(p.owner[i], ring.owner) {
                continue;
            }
            for hit in hits {
                for place in hit.places() {
                    let link = ring.link(place as usize);
                    if may_touch(p, particle, link, near.exemptions) {
                        links.push(FoundLink { link, place });
                    }
                }
            }
            let last = links.len() as u32;
            if last == first {
                continue;
            }
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
        let Self { first, mut lanes, .. } = *self;
        std::iter::from_fn(move || {
            let lane = (lanes != 0).then(|| lanes.trailing_zeros())?;
            lanes &= lanes - 1;
            Some(first + lane)
        })
    }
}

/// Whether a disc collides with a link of a ring that it is no node of, and not through a gate. Exempt owners never do.
#[inline]
pub(crate) fn may_touch(p: &Particles, disc: u32, Link { a, b }: Link, exemptions: &Exemptions) -> bool {
    let (i, node) = (disc as usize, a as usize);
    let owners = [p.owner[i], p.owner[node]];
    p.groups[i].meets(p.groups[node]) && ![a, b].iter().any(|&node| exemptions.gate_is_open([disc, node], owners))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contacts_of_a_ring_lie_side_by_side() {
        let contact = |(particle, ring)| RingContact {
            particle,
            ring,
            side: RingSide::Either,
            radius_sum: 1.0,
            friction: 0.0,
            touched: None,
            is_close: true,
            links: 0..0,
        };
        let contacts = [(7, 0), (8, 0), (5, 2), (6, 3), (7, 3), (9, 3)].map(contact).to_vec();
        let rings = RingContacts { contacts, starts: vec![0, 2, 2, 3, 6], ..RingContacts::default() };
        let particles = |ring| rings.of_ring(ring).iter().map(|contact| contact.particle).collect::<Vec<_>>();
        assert_eq!([0, 1, 2, 3, 4].map(particles), [vec![7, 8], vec![], vec![5], vec![6, 7, 9], vec![]]);
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
