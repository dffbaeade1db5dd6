//! Contacts of discs with the links of a ring, as capsules, that know on which side of the ring a disc has to be.
//!
//! ```text
//!            inside: left of a -> b
//!        ( i )  away = x_i - c,  c = (1 - t) x_a + t x_b the nearest point of the link
//!      a--c----b
//! ```
//!
//! `C = n . (x_i - c) - (r_i + r_a) >= 0`, where `n` points to the disc's own side: along `away` while the disc is on
//! that side, against it otherwise, so that a disc is pushed back through the ring and never out on the wrong side. Both
//! move, the link by its barycentric shares `1 - t` and `t`. The nearest link decides the side; of two that share the
//! nearest node, the one that the disc stands over more squarely (Baerentzen, Aanaes 2005, section 2: the sign at a vertex
//! is that of an angle-weighted normal; in the plane it is that of the more orthogonal edge).

use super::contact::{friction, moved, no_heavier, shift};
use super::contact_record::{ContactRecorder, Projected, Touched};
use super::lanes::ratio;
use crate::collision::ring::{Link, Ring, RingContact, RingContacts, Side};
use crate::geometry::polygon::contains_point;
use crate::particle::Particles;
use glam::Vec2;

/// Share of the contact distance below which [`keep_sides`] moves a disc away from a link by itself.
const STANDOFF: f32 = 0.25;

/// Where a disc is with respect to a link.
#[derive(Clone, Copy)]
struct Relation {
    /// Place of the nearest point on the link, 0 at its first node and 1 at its second.
    t: f32,
    /// From the nearest point to the disc.
    away: Vec2,
    squared: f32,
    /// From the link's first node to its second.
    along: Vec2,
}

impl Relation {
    /// Unit vector across the link, to the inside.
    #[inline(always)]
    fn inwards(&self) -> Vec2 {
        self.along.perp() * ratio(1.0, self.along.length())
    }

    /// Sine of the angle between link and way, positive inside, times the way's length.
    #[inline(always)]
    fn height(&self) -> f32 {
        self.inwards().dot(self.away)
    }
}

/// Pushes discs and links apart; returns how many discs were on the wrong side.
pub(crate) fn project(rings: &mut RingContacts, p: &mut Particles, recorder: &mut ContactRecorder) -> u32 {
    let (contacts, links) = rings.parts();
    let mut wrong = 0;
    for contact in contacts {
        let links = &links[contact.range()];
        let Some((nearest, relation)) = nearest_link(contact, links, p) else { continue };
        let radius_sum = contact.radius_sum;
        let is_wrong = is_through(contact, nearest, &relation, links);
        contact.is_close = is_wrong || relation.squared < radius_sum * radius_sum;
        if is_wrong {
            wrong += 1;
            separate(contact, nearest, &relation, radius_sum + relation.squared.sqrt(), p, recorder);
        } else if contact.is_close {
            for &link in links {
                let relation = relate(contact.particle, link, p);
                if relation.squared < radius_sum * radius_sum {
                    separate(contact, link, &relation, radius_sum - relation.squared.sqrt(), p, recorder);
                }
            }
        }
    }
    wrong
}

/// The nearer node of a link, and how far the surfaces of disc and link are apart.
pub(crate) fn gap(particle: u32, link: Link, p: &Particles) -> (u32, f32) {
    let (i, a) = (particle as usize, link.a as usize);
    let relation = relate(particle, link, p);
    (if relation.t < 0.5 { link.a } else { link.b }, relation.squared.sqrt() - (p.radius[i] + p.radius[a]))
}

/// Last in a substep: a disc that is on the wrong side or nearly in the middle of a link moves away; the link stays. Discs
/// that have touched no link in this substep cannot be there. Returns how many were on the wrong side.
pub(crate) fn keep_sides(rings: &RingContacts, p: &mut Particles) -> u32 {
    let mut wrong = 0;
    for contact in rings.contacts.iter().filter(|contact| contact.is_close) {
        let links = rings.links_of(contact);
        let Some((link, relation)) = nearest_link(contact, links, p) else { continue };
        let i = contact.particle as usize;
        let standoff = STANDOFF * contact.radius_sum;
        let is_wrong = is_through(contact, link, &relation, links);
        wrong += u32::from(is_wrong);
        if p.inv_mass[i] > 0.0 && (is_wrong || relation.squared < standoff * standoff) {
            let length = relation.squared.sqrt();
            let direction = if is_wrong { -1.0 } else { 1.0 };
            shift(p, i, to_own_side(contact.side, &relation) * (standoff - direction * length));
        }
    }
    wrong
}

/// Safety net: casts a ray from every disc near a ring and moves those on the wrong side back to the nearest link.
/// `place` is the ring's place among those that were searched, `outline` where its nodes are. Returns how many there were.
pub(crate) fn catch_strays(
    ring: Ring<'_>,
    place: usize,
    outline: &[Vec2],
    rings: &RingContacts,
    p: &mut Particles,
) -> u32 {
    // Such a ring is about to be frozen.
    if !outline.iter().all(|at| at.is_finite()) {
        return 0;
    }
    let mut count = 0;
    for contact in rings.of_ring(place) {
        if is_across(contact, outline, p) {
            count += 1;
            return_to_side(contact, ring, outline, p);
        }
    }
    count
}

/// Whether a ray finds a disc on the wrong side of a whole ring.
fn is_across(contact: &RingContact, outline: &[Vec2], p: &Particles) -> bool {
    let is_inside = contains_point(outline, p.position(contact.particle as usize));
    match contact.side {
        Side::Inside => !is_inside,
        Side::Outside => is_inside,
        Side::Either => false,
    }
}

/// Moves a disc to its own side of the link of a whole ring that is nearest to it; where the ring is folded, closer to the link.
fn return_to_side(contact: &RingContact, ring: Ring<'_>, outline: &[Vec2], p: &mut Particles) {
    let links: Vec<Link> = (0..ring.nodes.len()).map(|k| ring.link(k)).collect();
    let Some((_, relation)) = nearest_link(contact, &links, p) else { return };
    let (i, to) = (contact.particle as usize, to_own_side(contact.side, &relation));
    shift(p, i, -relation.away);
    let on_link = p.position(i);
    for share in [1.0, 1.0 / 8.0, 1.0 / 64.0] {
        shift(p, i, on_link + to * (share * STANDOFF * contact.radius_sum) - p.position(i));
        if !is_across(contact, outline, p) {
            return;
        }
    }
}

/// Whether a disc is on the wrong side of the link nearest to it, of those that were found: farther than the contact distance,
/// or at an end where the next link was not found, another one may be nearer.
fn is_through(contact: &RingContact, nearest: Link, relation: &Relation, links: &[Link]) -> bool {
    let is_known = || match relation.t {
        0.0 => links.iter().any(|link| link.b == nearest.a),
        1.0 => links.iter().any(|link| link.a == nearest.b),
        _ => true,
    };
    is_wrong(contact.side, relation) && relation.squared < contact.radius_sum * contact.radius_sum && is_known()
}

fn is_wrong(side: Side, relation: &Relation) -> bool {
    match side {
        Side::Inside => relation.height() < 0.0,
        Side::Outside => relation.height() > 0.0,
        Side::Either => false,
    }
}

/// Unit vector across the link, to the disc's own side.
fn to_own_side(side: Side, relation: &Relation) -> Vec2 {
    let length = relation.squared.sqrt();
    if length > 1e-6 {
        let away = relation.away / length;
        if is_wrong(side, relation) { -away } else { away }
    } else if side == Side::Inside {
        relation.inwards()
    } else {
        -relation.inwards()
    }
}

/// The link nearest to a disc. Ends of two links in the same node are equally far; then the more orthogonal link wins.
#[inline(always)]
fn nearest_link(contact: &RingContact, links: &[Link], p: &Particles) -> Option<(Link, Relation)> {
    let mut best: Option<(Link, Relation)> = None;
    for &link in links {
        let relation = relate(contact.particle, link, p);
        let is_better = best.is_none_or(|(_, best)| {
            relation.squared < best.squared
                || (relation.squared == best.squared && relation.height().abs() > best.height().abs())
        });
        if is_better {
            best = Some((link, relation));
        }
    }
    best
}

#[inline(always)]
fn relate(particle: u32, link: Link, p: &Particles) -> Relation {
    let [disc, a, b] = [particle, link.a, link.b].map(|i| i as usize);
    let (along, from_a) = (p.between(a, b), p.between(a, disc));
    let (place, squared_length) = (from_a.dot(along), along.length_squared());
    // At an end, relative to that end exactly, so that both links of a node find the same distance.
    let (t, away) = if place > 0.0 && place < squared_length {
        let t = place / squared_length;
        (t, from_a - along * t)
    } else if place > 0.0 {
        (1.0, p.between(b, disc))
    } else {
        (0.0, from_a)
    };
    Relation { t, away, squared: away.length_squared(), along }
}

/// Moves disc and link `depth` apart, the disc to its own side.
fn separate(
    contact: &mut RingContact,
    link: Link,
    relation: &Relation,
    depth: f32,
    p: &mut Particles,
    recorder: &mut ContactRecorder,
) {
    let (i, a, b) = (contact.particle as usize, link.a as usize, link.b as usize);
    let normal = to_own_side(contact.side, relation);
    let (share_a, share_b) = (1.0 - relation.t, relation.t);
    let (wi, wa, wb) = (p.inv_mass[i], p.inv_mass[a] * share_a, p.inv_mass[b] * share_b);
    let wi = no_heavier(wi, p.inv_mass[a]);
    let weight = wi + wa * share_a + wb * share_b;
    let push = |by: Vec2, p: &mut Particles| {
        shift(p, i, by * wi);
        shift(p, a, -by * wa);
        shift(p, b, -by * wb);
    };
    let node = if relation.t < 0.5 { link.a } else { link.b };
    recorder.note(p, || Projected {
        particle: contact.particle,
        touched: Touched::Disc(node),
        normal,
        depth,
        weight,
        restitution: 0.0,
        velocity: p.velocity(a) * share_a + p.velocity(b) * share_b,
    });
    push(normal * ratio(depth, weight), p);
    contact.touched = Some(node);
    let slip = moved(p, i) - moved(p, a) * share_a - moved(p, b) * share_b;
    push(friction(slip, normal, contact.friction * depth) * ratio(1.0, weight), p);
}

#[cfg(test)]
mod tests {
    use super::super::testing::{disc, momentum, search_input};
    use super::*;
    use crate::collision::broad_phase::{BroadPhase, SearchInput};
    use crate::collision::exemptions::Exemptions;
    use crate::collision::ring::Containment;
    use crate::collision::speculative_margin::DisplacementLimits;
    use crate::geometry::arbitrary::star_polygon;
    use crate::geometry::polygon::contains_point;
    use crate::particle::Particle;
    use crate::particle::sleep::Sleep;
    use proptest::prelude::*;

    const RADIUS: f32 = 0.5;

    fn project(rings: &mut RingContacts, p: &mut Particles) -> u32 {
        super::project(rings, p, &mut ContactRecorder::default())
    }

    /// A ring of owner 0 and a disc of owner `owner` at some place; the contacts between them.
    fn scene(outline: &[Vec2], at: Vec2, owner: u32) -> (Particles, RingContacts, Vec<u32>) {
        let mut p = Particles::default();
        let particle = |at, owner| Particle { owner, radius: RADIUS, ..disc(at, 1.0) };
        let nodes: Vec<u32> = outline.iter().map(|&at| p.insert(&particle(at, 0))).collect();
        p.link_ring(&nodes);
        p.insert(&particle(at, owner));
        let mut broad_phase = BroadPhase::default();
        let exemptions = Exemptions::default();
        let input = SearchInput {
            rings: &[Ring { owner: 0, nodes: &nodes, holds: None }],
            containments: &[Containment::Free, Containment::Free, Containment::Inside(0), Containment::Passing(0)],
            size: Vec2::ONE,
            ..search_input(&p, &exemptions, DisplacementLimits { step: 50.0, substep: 50.0, dt: 1.0 })
        };
        broad_phase.find_pairs(input, &mut Sleep::default(), 1);
        (p, broad_phase.ring_contacts.into_inner(), nodes)
    }

    fn square() -> Vec<Vec2> {
        [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(Vec2::from).to_vec()
    }

    fn distance(outline: &[u32], p: &Particles, at: Vec2) -> f32 {
        let ends = |k: usize| (p.position(outline[k] as usize), p.position(outline[(k + 1) % outline.len()] as usize));
        let gap = |k| (crate::geometry::segment::nearest_on_segment(ends(k).0, ends(k).1, at) - at).length();
        (0..outline.len()).map(gap).fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn a_disc_is_pushed_to_its_own_side_from_either_side() {
        // Own particle, stranger, prey that is held; inside and outside of the lower side.
        for (owner, home) in [(0, 1.0), (1, -1.0), (2, 1.0)] {
            for y in [0.3, -0.3, 0.0] {
                let (mut p, mut contacts, _) = scene(&square(), Vec2::new(2.0, y), owner);
                // The disc of the ring's owner is no node of it.
                let before = momentum(&p);
                let wrong = project(&mut contacts, &mut p);
                assert_eq!(wrong, u32::from(y * home < 0.0), "owner {owner} at {y}");
                let height = p.position(4).y - 0.5 * (p.position(0).y + p.position(1).y);
                assert!((height * home - 2.0 * RADIUS).abs() < 1e-4, "owner {owner} at {y}: {height}");
                assert!((momentum(&p) - before).length() < 1e-4);
                assert!(contacts.contacts[0].touched.is_some());
            }
        }
    }

    #[test]
    fn prey_that_passes_stays_on_its_side_and_a_gate_lets_it_through() {
        for y in [0.3, -0.3] {
            let (mut p, mut contacts, _) = scene(&square(), Vec2::new(2.0, y), 3);
            assert_eq!(project(&mut contacts, &mut p) + keep_sides(&contacts, &mut p), 0);
            let height = p.position(4).y - 0.5 * (p.position(0).y + p.position(1).y);
            assert!(height * y > 0.0, "at {y}: {height}");
        }
        let (p, _, nodes) = scene(&square(), Vec2::new(2.0, 0.3), 3);
        let mut exemptions = Exemptions::default();
        exemptions.open_gate(&nodes[..1], 3);
        let may_touch = |a, b| crate::collision::ring::may_touch(&p, 4, Link { a: nodes[a], b: nodes[b] }, &exemptions);
        assert!(!may_touch(0, 1) && may_touch(1, 2));
    }

    #[test]
    fn a_disc_in_a_narrow_passage_keeps_off_both_walls() {
        let narrow = [(0.0, 0.0), (8.0, 0.0), (8.0, 1.6), (0.0, 1.6)].map(Vec2::from);
        let (mut p, mut contacts, nodes) = scene(&narrow, Vec2::new(4.0, 0.5), 0);
        (0..50).for_each(|_| assert_eq!(project(&mut contacts, &mut p), 0));
        assert!(distance(&nodes, &p, p.position(4)) > 2.0 * RADIUS - 1e-3);
    }

    #[test]
    fn keeping_sides_moves_the_disc_and_not_the_link() {
        for (owner, y) in [(0, -0.2), (0, 0.1), (1, 0.2), (1, -0.1)] {
            let (mut p, contacts, nodes) = scene(&square(), Vec2::new(2.0, y), owner);
            let before: Vec<Vec2> = nodes.iter().map(|&i| p.position(i as usize)).collect();
            let home = if owner == 0 { 1.0 } else { -1.0 };
            assert_eq!(keep_sides(&contacts, &mut p), u32::from(y * home < 0.0));
            assert!((p.position(4).y * home - STANDOFF * 2.0 * RADIUS).abs() < 1e-5, "{}", p.position(4));
            assert!(nodes.iter().zip(before).all(|(&i, at)| p.position(i as usize) == at));
        }
    }

    #[test]
    fn a_heavy_disc_does_not_crush_a_light_ring() {
        let (mut p, mut contacts, _) = scene(&square(), Vec2::new(2.0, -0.3), 1);
        p.inv_mass[4] = 1e-4;
        project(&mut contacts, &mut p);
        assert!(p.position(4).y < -0.3 - 0.01, "{}", p.position(4));
    }

    #[test]
    fn a_disc_is_returned_into_a_fold_that_is_thinner_than_the_standoff() {
        let fold = [[0.0, 0.0], [6.0, 0.0], [6.0, 0.06], [0.0, 0.06]].map(Vec2::from);
        for y in [-0.3, -0.01, 0.07, 0.4] {
            let (mut p, contacts, nodes) = scene(&fold, Vec2::new(3.0, y), 0);
            let ring = Ring { owner: 0, nodes: &nodes, holds: None };
            assert_eq!(catch_strays(ring, 0, &fold, &contacts, &mut p), 1);
            assert!(contains_point(&fold, p.position(4)), "{}", p.position(4));
        }
    }

    proptest! {
        #[test]
        fn the_nearest_link_and_the_ray_agree_on_the_side(
            outline in star_polygon(), x in -12.0f32..12.0, y in -12.0f32..12.0
        ) {
            let at = Vec2::new(x, y);
            let (p, contacts, nodes) = scene(&outline, at, 0);
            prop_assume!(distance(&nodes, &p, at) > 1e-3 && !contacts.contacts.is_empty());
            let contact = &contacts.contacts[0];
            let (_, relation) = nearest_link(contact, contacts.links_of(contact), &p).unwrap();
            prop_assert_eq!(relation.height() > 0.0, contains_point(&outline, at));
        }

        #[test]
        fn every_disc_on_the_wrong_side_is_returned(outline in star_polygon(), x in -12.0f32..12.0, y in -12.0f32..12.0) {
            let at = Vec2::new(x, y);
            let is_inside = contains_point(&outline, at);
            let (mut p, contacts, nodes) = scene(&outline, at, 0);
            prop_assume!(!contacts.contacts.is_empty());
            let ring = Ring { owner: 0, nodes: &nodes, holds: None };
            prop_assert_eq!(catch_strays(ring, 0, &outline, &contacts, &mut p), u32::from(!is_inside));
            prop_assert_eq!(is_inside, p.position(contacts.contacts[0].particle as usize) == at);
        }
    }
}
