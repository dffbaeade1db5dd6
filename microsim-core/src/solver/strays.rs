//! Safety net of membranes: discs that a ray finds on the wrong side of a whole ring.

use super::contact::shift;
use super::ring_contact::STANDOFF;
use super::ring_relation::Relation;
use crate::collision::ring::{Ring, RingContact, RingSide};
use crate::collision::ring_contacts::RingContacts;
use crate::geometry::polygon::contains_point;
use crate::particle::Particles;
use glam::Vec2;

/// Safety net: casts a ray from every disc near a ring and moves those on the wrong side back to the nearest link.
/// `place` is the ring's place among those that were searched, `outline` where its nodes are. Returns how many there were.
pub(crate) fn catch_strays(
    ring: Ring<'_>,
    place: usize,
    outline: &[Vec2],
    rings: &RingContacts,
    p: &mut Particles,
) -> u32 {
    let mut count = 0;
    for contact in near(rings, place, outline) {
        if is_across(contact, outline, p) {
            count += 1;
            return_to_side(contact, ring, outline, p);
        }
    }
    count
}

/// Whether [`catch_strays`] would find any.
pub(crate) fn has_strays(place: usize, outline: &[Vec2], rings: &RingContacts, p: &Particles) -> bool {
    near(rings, place, outline).any(|contact| is_across(contact, outline, p))
}

/// The discs near a ring; none if it is about to be frozen.
fn near<'a>(
    rings: &'a RingContacts,
    place: usize,
    outline: &[Vec2],
) -> impl Iterator<Item = &'a RingContact> + use<'a> {
    let is_finite = outline.iter().all(|at| at.is_finite());
    is_finite.then(|| rings.of_ring(place)).into_iter().flatten()
}

/// Whether a ray finds a disc on the wrong side of a whole ring.
fn is_across(contact: &RingContact, outline: &[Vec2], p: &Particles) -> bool {
    let is_inside = contains_point(outline, p.position(contact.particle as usize));
    match contact.side {
        RingSide::Inside => !is_inside,
        RingSide::Outside => is_inside,
        RingSide::Either => false,
    }
}

/// Moves a disc to its own side of the link of a whole ring that is nearest to it; where the ring is folded, closer to the link.
fn return_to_side(contact: &RingContact, ring: Ring<'_>, outline: &[Vec2], p: &mut Particles) {
    let relations = (0..ring.nodes.len()).map(|k| Relation::of(contact.particle, ring.link(k), p));
    let nearest = relations.reduce(|best, other| if other.is_nearer_than(&best) { other } else { best });
    let Some(relation) = nearest else { return };
    let (i, to) = (contact.particle as usize, relation.to_side(contact.side));
    shift(p, i, -relation.away);
    let on_link = p.position(i);
    for share in [1.0, 1.0 / 8.0, 1.0 / 64.0] {
        shift(p, i, on_link + to * (share * STANDOFF * contact.radius_sum) - p.position(i));
        if !is_across(contact, outline, p) {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::ring_and_disc;
    use super::*;
    use crate::geometry::arbitrary::star_polygon;
    use proptest::prelude::*;

    #[test]
    fn a_disc_is_returned_into_a_fold_that_is_thinner_than_the_standoff() {
        let fold = [[0.0, 0.0], [6.0, 0.0], [6.0, 0.06], [0.0, 0.06]].map(Vec2::from);
        for y in [-0.3, -0.01, 0.07, 0.4] {
            let (mut p, contacts, nodes) = ring_and_disc(&fold, Vec2::new(3.0, y), 0);
            let ring = Ring { owner: 0, nodes: &nodes, holds: None };
            assert_eq!(catch_strays(ring, 0, &fold, &contacts, &mut p), 1);
            assert!(contains_point(&fold, p.position(4)), "{}", p.position(4));
        }
    }

    proptest! {
        #[test]
        fn every_disc_on_the_wrong_side_is_returned(outline in star_polygon(), x in -12.0f32..12.0, y in -12.0f32..12.0) {
            let at = Vec2::new(x, y);
            let is_inside = contains_point(&outline, at);
            let (mut p, contacts, nodes) = ring_and_disc(&outline, at, 0);
            let found = contacts.iter().next();
            prop_assume!(found.is_some());
            let ring = Ring { owner: 0, nodes: &nodes, holds: None };
            prop_assert_eq!(catch_strays(ring, 0, &outline, &contacts, &mut p), u32::from(!is_inside));
            prop_assert_eq!(is_inside, p.position(found.unwrap().0.particle as usize) == at);
        }
    }
}
