//! The last resort of membranes: rings that cross themselves are untangled, and discs that a ray finds on the wrong side of a ring
//! are returned.

use super::strays::{catch_strays, has_strays};
use super::untangle::{Midpoints, is_tangled, untangle};
use crate::collision::ring::Ring;
use crate::collision::ring_contacts::RingContacts;
use crate::parallel;
use crate::particle::Particles;

/// Rings that are looked at in one go, a fixed number whatever the number of threads.
const PORTION: usize = 16;

/// Repairs the rings, which are those that were searched for contacts; returns how many crossings and strays there were.
pub(crate) fn repair_rings(rings: &[Ring<'_>], contacts: &RingContacts, p: &mut Particles) -> u32 {
    let (mut outline, mut midpoints, mut count) = (Vec::new(), Midpoints::default(), 0);
    for (place, &ring) in rings.iter().enumerate().skip(whole(rings, contacts, p)) {
        count += untangle(ring.nodes, p, &mut outline, &mut midpoints);
        count += catch_strays(ring, place, &outline, contacts, p);
    }
    count
}

/// How many of the rings, the first ones, need no repair: most often all. A repair may move what is near any other.
fn whole(rings: &[Ring<'_>], contacts: &RingContacts, p: &Particles) -> usize {
    let portions = rings.chunks(PORTION).zip((0..).step_by(PORTION)).collect();
    let are_whole = parallel::map(portions, |(rings, first): (&[Ring<'_>], usize)| {
        let (mut outline, mut midpoints) = (Vec::new(), Midpoints::default());
        rings.iter().zip(first..).all(|(ring, place)| {
            !is_tangled(ring.nodes, p, &mut outline, &mut midpoints) && !has_strays(place, &outline, contacts, p)
        })
    });
    rings.len().min(PORTION * are_whole.iter().take_while(|is_whole| **is_whole).count())
}

#[cfg(test)]
mod tests {
    use super::super::testing::disc;
    use super::*;
    use glam::Vec2;

    #[test]
    fn only_rings_from_the_first_broken_one_on_are_repaired() {
        let mut p = Particles::default();
        let mut ring = |corners: [(f32, f32); 8]| corners.map(|at| p.insert(&disc(Vec2::from(at), 1.0)));
        let round = [(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (6.0, 1.0), (6.0, 3.0), (4.0, 4.0), (2.0, 4.0), (0.0, 2.0)];
        let crossed = [(0.0, 0.0), (4.0, 0.0), (3.0, 1.0), (3.0, -1.0), (6.0, 0.0), (6.0, 4.0), (3.0, 4.0), (0.0, 4.0)];
        let nodes: Vec<_> = (0..40).map(|k| ring(if k == 20 { crossed } else { round })).collect();
        let rings: Vec<_> = nodes.iter().map(|nodes| Ring { owner: 0, nodes, holds: None }).collect();
        let contacts = RingContacts::default();
        assert_eq!(whole(&rings, &contacts, &p), PORTION, "the second portion has the broken one");
        let before = p.clone();
        let count = repair_rings(&rings, &contacts, &mut p);
        let mut expected = before.clone();
        assert_eq!(count, untangle(rings[20].nodes, &mut expected, &mut Vec::new(), &mut Midpoints::default()));
        assert!(count > 0 && p.x != before.x);
        assert_eq!((&p.x, &p.y), (&expected.x, &expected.y));
        assert_eq!((whole(&rings, &contacts, &p), repair_rings(&rings, &contacts, &mut p)), (40, 0));
    }
}
