//! The search for discs near the rings in a strip of the room.

use super::aabb::Aabb;
use super::bodies::Bodies;
use super::combine;
use super::disc::Disc;
use super::disc_grid::DiscGrid;
use super::exemptions::Exemptions;
use super::link_group::{Lanes, LinkGroup, Node, finite};
use super::ring::{Containment, FoundLink, Ring, RingContact, may_touch, side_of};
use crate::instruction_set::Dispatch;
use crate::particle::{LANES, Particles};
use std::ops::Range;

/// Discs near the rings in a strip of the room, ring by ring, and scratch. A node of a ring is in the strip that its ring is in,
/// another disc where it is itself.
#[derive(Clone, Debug, Default)]
pub(super) struct RingStrip {
    pub rings: Vec<u32>,
    /// Of discs in this strip or in the next one.
    pub own: Vec<RingContact>,
    /// Of discs in the strip before.
    pub below: Vec<RingContact>,
    /// Of discs elsewhere.
    pub far: Vec<RingContact>,
    pub links: Vec<FoundLink>,
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

/// Links of a group that a disc may touch.
#[derive(Clone, Copy, Debug)]
struct Hit {
    particle: u32,
    /// Place of the group's first link in the ring.
    first: u32,
    /// Which of its links, one bit each; at least one.
    lanes: u32,
}

/// The rows of a room.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strips {
    low: f32,
    /// One over the height of a strip; 0: there is one only.
    inverse: f32,
    pub last: u32,
}

/// Height of a strip over the mean height of a ring.
const STRIP: f32 = 1.5;
/// Strips at most.
const MOST: f32 = 256.0;
/// In no ring.
pub(super) const NO_RING: u32 = u32::MAX;

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

impl Strips {
    pub(super) const ONE: Self = Self { low: 0.0, inverse: 0.0, last: 0 };

    /// Strips for rings that are this low and high.
    pub(super) fn of(heights: impl Iterator<Item = [f32; 2]> + Clone) -> Self {
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
    pub(super) fn at(self, y: f32) -> u32 {
        let strip = ((y - self.low) * self.inverse) as u32;
        if strip < self.last { strip } else { self.last }
    }
}

impl RingStrip {
    /// The lists, always in the same order.
    pub(super) fn lists(&self) -> [&Vec<RingContact>; 3] {
        [&self.own, &self.below, &self.far]
    }

    /// Finds the discs near its rings.
    pub(super) fn find(
        &mut self,
        rings: &[Ring<'_>],
        (strips, strip_of, ring_of): (Strips, &[u32], &[u32]),
        near: RingQuery<'_>,
    ) {
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
            discs.extend(near.bodies.discs_of(body).filter(is_near));
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
        let Self { first, mut lanes, .. } = *self;
        std::iter::from_fn(move || {
            let lane = (lanes != 0).then(|| lanes.trailing_zeros())?;
            lanes &= lanes - 1;
            Some(first + lane)
        })
    }
}
