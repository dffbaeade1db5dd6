//! Rings of linked particles, and discs that may touch their links.

use super::exemptions::Exemptions;
use crate::particle::Particles;
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
pub(super) fn side_of(owner: u32, ring: Ring<'_>, containments: &[Containment]) -> RingSide {
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
    /// Its links in those of its list.
    pub links: Range<u32>,
}

impl RingContact {
    /// The links that the disc may touch, in the order of the ring, of those of its list.
    #[inline(always)]
    pub(crate) fn links_in<'a>(&self, links: &'a [FoundLink]) -> &'a [FoundLink] {
        &links[self.links.start as usize..self.links.end as usize]
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
