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

use super::contact::{friction, no_heavier};
use super::contact_record::{ContactRecorder, Projected, Touched};
use super::lanes::ratio;
use super::ring_relation::{Relation, Relations, RingNodes};
use crate::collision::ring::{FoundLink, Link, RingContact};
use crate::collision::ring_contacts::{NodesOfRings, RingContactList, RingContacts};
use crate::instruction_set::Dispatch;
use crate::parallel;
use crate::particle::{DisjointPositions, Particles, PositionCells};
use glam::Vec2;

/// Share of the contact distance below which [`keep_sides`] moves a disc away from a link by itself.
pub(super) const STANDOFF: f32 = 0.25;

/// Pushes discs and links apart; returns how many discs were on the wrong side.
pub(crate) fn project(
    rings: &mut RingContacts,
    p: &mut Particles,
    recorder: &mut ContactRecorder,
    dispatch: Dispatch,
) -> u32 {
    for_each_list(rings, p, recorder, |list, of, recorder, p| {
        dispatch.run(
            #[inline(always)]
            || {
                let (mut wrong, mut nodes, p) = (0, RingNodes::default(), p.even());
                for of_ring in list.contacts.chunk_by_mut(|a, b| a.ring == b.ring) {
                    nodes.read(of.of(of_ring[0].ring), p);
                    for contact in of_ring {
                        let links = contact.links_in(list.links);
                        wrong += u32::from(project_disc(contact, links, &mut nodes, p, recorder));
                    }
                }
                wrong
            },
        )
    })
}

/// The lists of a strip, and what comes of them.
struct Part<'a> {
    lists: Vec<RingContactList<'a>>,
    recorder: ContactRecorder,
    count: u32,
}

/// Does each list of contacts: those of a strip one after the other, strips as [`parallel::for_each_strip`] does, then the others.
/// Returns the sum of what they give.
fn for_each_list(
    rings: &mut RingContacts,
    p: &mut Particles,
    recorder: &mut ContactRecorder,
    work: impl Fn(&mut RingContactList<'_>, &NodesOfRings, &mut ContactRecorder, PositionCells<'_>) -> u32 + Send + Sync,
) -> u32 {
    let counts = [p.len(), rings.in_disc_contacts()];
    #[expect(unsafe_code, reason = "strips are disjoint, but their particles do not lie side by side")]
    // SAFETY: a list of a strip has rings and discs of this strip and the next one, see `RingContacts::lists_mut`; a ring is in
    // one strip, with all its nodes, and so is a disc. Every second strip has particles of its own, and these run at the same time.
    let positions = unsafe { DisjointPositions::new(p.position_cells()) };
    let (strips, others, nodes) = rings.lists_mut();
    let part = |lists| {
        let mut own = ContactRecorder::default();
        own.begin_like(recorder);
        Part { lists, recorder: own, count: 0 }
    };
    let (mut strips, mut others): (Vec<Part<'_>>, _) = (strips.into_iter().map(part).collect(), part(others));
    let do_part = |part: &mut Part<'_>| {
        let Part { lists, recorder, count } = part;
        *count = lists.iter_mut().map(|list| work(list, nodes, recorder, positions.cells())).sum();
    };
    parallel::for_each_strip(strips.iter_mut(), counts, do_part);
    do_part(&mut others);
    strips.push(others);
    strips.iter_mut().for_each(|part| recorder.append(&mut part.recorder));
    strips.iter().map(|part| part.count).sum()
}

/// Pushes a disc and some links of a ring apart; returns whether the disc was on the wrong side.
#[inline(always)]
fn project_disc(
    contact: &mut RingContact,
    links: &[FoundLink],
    nodes: &mut RingNodes,
    p: PositionCells<'_>,
    recorder: &mut ContactRecorder,
) -> bool {
    let (disc, radius_sum) = (contact.particle as usize, contact.radius_sum);
    let mut relations = Relations::unknown();
    contact.is_close = touches_any(&mut relations, contact, links, nodes, p);
    if !contact.is_close {
        return false;
    }
    let (nearest, relation) = nearest_of(&mut relations, contact, links, nodes, p);
    let is_wrong = is_through(contact, nearest.link, &relation, links);
    if is_wrong {
        separate(contact, nearest.link, &relation, radius_sum + relation.squared.sqrt(), p, recorder);
        nodes.update(nearest, p);
        return true;
    }
    // Not if where it is is no number.
    contact.is_close = relation.squared < radius_sum * radius_sum;
    if !contact.is_close {
        return false;
    }
    for &found in links {
        let relation = relations.to(found.place as usize, disc, nodes, p);
        if relation.squared < radius_sum * radius_sum {
            separate(contact, found.link, &relation, radius_sum - relation.squared.sqrt(), p, recorder);
            nodes.update(found, p);
            relations.forget();
        }
    }
    false
}

/// The nearer node of a link, and how far the surfaces of disc and link are apart.
pub(crate) fn gap(particle: u32, link: Link, p: &Particles) -> (u32, f32) {
    let (i, a) = (particle as usize, link.a as usize);
    let relation = Relation::of(particle, link, p);
    (if relation.t < 0.5 { link.a } else { link.b }, relation.squared.sqrt() - (p.radius[i] + p.radius[a]))
}

/// Last in a substep: a disc that is on the wrong side or nearly in the middle of a link moves away; the link stays. Discs
/// that have touched no link in this substep cannot be there. Returns how many were on the wrong side.
pub(crate) fn keep_sides(rings: &mut RingContacts, p: &mut Particles, dispatch: Dispatch) -> u32 {
    for_each_list(rings, p, &mut ContactRecorder::default(), |list, of, _, p| {
        dispatch.run(
            #[inline(always)]
            || {
                let (mut wrong, mut nodes, p) = (0, RingNodes::default(), p.even());
                let mut read = usize::MAX;
                for contact in list.contacts.iter().filter(|contact| contact.is_close) {
                    if contact.ring != read {
                        read = contact.ring;
                        nodes.read(of.of(read), p);
                    }
                    wrong += u32::from(keep_side(contact, contact.links_in(list.links), &nodes, p));
                }
                wrong
            },
        )
    })
}

#[inline(always)]
fn keep_side(contact: &RingContact, links: &[FoundLink], nodes: &RingNodes, p: PositionCells<'_>) -> bool {
    let mut relations = Relations::unknown();
    if !touches_any(&mut relations, contact, links, nodes, p) {
        return false;
    }
    let (nearest, relation) = nearest_of(&mut relations, contact, links, nodes, p);
    let i = contact.particle as usize;
    let standoff = STANDOFF * contact.radius_sum;
    let is_wrong = is_through(contact, nearest.link, &relation, links);
    if p.inv_mass(i) > 0.0 && (is_wrong || relation.squared < standoff * standoff) {
        let length = relation.squared.sqrt();
        let direction = if is_wrong { -1.0 } else { 1.0 };
        p.shift(i, relation.to_side(contact.side) * (standoff - direction * length));
    }
    is_wrong
}

/// Whether a disc is within the contact distance of any of the links.
#[inline(always)]
fn touches_any(
    relations: &mut Relations,
    contact: &RingContact,
    links: &[FoundLink],
    nodes: &RingNodes,
    p: PositionCells<'_>,
) -> bool {
    let (disc, limit, mut touches) = (contact.particle as usize, contact.radius_sum * contact.radius_sum, false);
    for found in links {
        touches |= relations.squared(found.place as usize, disc, nodes, p) < limit;
    }
    touches
}

/// The nearest link; there is at least one.
#[inline(always)]
fn nearest_of(
    relations: &mut Relations,
    contact: &RingContact,
    links: &[FoundLink],
    nodes: &RingNodes,
    p: PositionCells<'_>,
) -> (FoundLink, Relation) {
    let disc = contact.particle as usize;
    let mut best = (links[0], relations.to(links[0].place as usize, disc, nodes, p));
    for &found in &links[1..] {
        let relation = relations.to(found.place as usize, disc, nodes, p);
        if relation.is_nearer_than(&best.1) {
            best = (found, relation);
        }
    }
    best
}

/// Whether a disc is on the wrong side of the link nearest to it, of those that were found: farther than the contact distance,
/// or at an end where the next link was not found, another one may be nearer.
#[inline(always)]
fn is_through(contact: &RingContact, nearest: Link, relation: &Relation, links: &[FoundLink]) -> bool {
    let is_known = || match relation.t {
        0.0 => links.iter().any(|found| found.link.b == nearest.a),
        1.0 => links.iter().any(|found| found.link.a == nearest.b),
        _ => true,
    };
    relation.is_wrong(contact.side) && relation.squared < contact.radius_sum * contact.radius_sum && is_known()
}

/// Moves disc and link `depth` apart, the disc to its own side.
#[inline(always)]
fn separate(
    contact: &mut RingContact,
    link: Link,
    relation: &Relation,
    depth: f32,
    p: PositionCells<'_>,
    recorder: &mut ContactRecorder,
) {
    let (i, a, b) = (contact.particle as usize, link.a as usize, link.b as usize);
    let normal = relation.to_side(contact.side);
    let (share_a, share_b) = (1.0 - relation.t, relation.t);
    let (wi, wa, wb) = (p.inv_mass(i), p.inv_mass(a) * share_a, p.inv_mass(b) * share_b);
    let wi = no_heavier(wi, p.inv_mass(a));
    let weight = wi + wa * share_a + wb * share_b;
    let weights = [(i, wi), (a, -wa), (b, -wb)];
    let node = if relation.t < 0.5 { link.a } else { link.b };
    recorder.note(|| Projected {
        particle: contact.particle,
        touched: Touched::Disc(node),
        point: p.position(i) - normal * p.radius(i),
        normal,
        depth,
        weight,
        restitution: 0.0,
        way: p.velocity(a) * share_a + p.velocity(b) * share_b - p.velocity(i),
    });
    push(normal * ratio(depth, weight), weights, p);
    contact.touched = Some(node);
    let slip = p.moved(i) - p.moved(a) * share_a - p.moved(b) * share_b;
    push(friction(slip, normal, contact.friction * depth) * ratio(1.0, weight), weights, p);
}

/// Moves particles along `by`, each by its weight.
#[inline(always)]
fn push(by: Vec2, weights: [(usize, f32); 3], p: PositionCells<'_>) {
    weights.into_iter().for_each(|(i, weight)| p.shift(i, by * weight));
}

#[cfg(test)]
mod tests {
    use super::super::testing::{momentum, ring_and_disc};
    use super::*;
    use crate::collision::exemptions::Exemptions;
    use crate::geometry::arbitrary::star_polygon;
    use crate::geometry::polygon::contains_point;
    use proptest::prelude::*;

    const RADIUS: f32 = 0.5;

    fn project(rings: &mut RingContacts, p: &mut Particles) -> u32 {
        super::project(rings, p, &mut ContactRecorder::default(), Dispatch::default())
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
                let (mut p, mut contacts, _) = ring_and_disc(&square(), Vec2::new(2.0, y), owner);
                // The disc of the ring's owner is no node of it.
                let before = momentum(&p);
                let wrong = project(&mut contacts, &mut p);
                assert_eq!(wrong, u32::from(y * home < 0.0), "owner {owner} at {y}");
                let height = p.position(4).y - 0.5 * (p.position(0).y + p.position(1).y);
                assert!((height * home - 2.0 * RADIUS).abs() < 1e-4, "owner {owner} at {y}: {height}");
                assert!((momentum(&p) - before).length() < 1e-4);
                assert!(contacts.iter().next().unwrap().0.touched.is_some());
            }
        }
    }

    #[test]
    fn prey_that_passes_stays_on_its_side_and_a_gate_lets_it_through() {
        for y in [0.3, -0.3] {
            let (mut p, mut contacts, _) = ring_and_disc(&square(), Vec2::new(2.0, y), 3);
            assert_eq!(project(&mut contacts, &mut p) + keep_sides(&mut contacts, &mut p, Dispatch::default()), 0);
            let height = p.position(4).y - 0.5 * (p.position(0).y + p.position(1).y);
            assert!(height * y > 0.0, "at {y}: {height}");
        }
        let (p, _, nodes) = ring_and_disc(&square(), Vec2::new(2.0, 0.3), 3);
        let mut exemptions = Exemptions::default();
        exemptions.open_gate(&nodes[..1], 3);
        let may_touch = |a, b| crate::collision::ring::may_touch(&p, 4, Link { a: nodes[a], b: nodes[b] }, &exemptions);
        assert!(!may_touch(0, 1) && may_touch(1, 2));
    }

    #[test]
    fn a_disc_in_a_narrow_passage_keeps_off_both_walls() {
        let narrow = [(0.0, 0.0), (8.0, 0.0), (8.0, 1.6), (0.0, 1.6)].map(Vec2::from);
        let (mut p, mut contacts, nodes) = ring_and_disc(&narrow, Vec2::new(4.0, 0.5), 0);
        (0..50).for_each(|_| assert_eq!(project(&mut contacts, &mut p), 0));
        assert!(distance(&nodes, &p, p.position(4)) > 2.0 * RADIUS - 1e-3);
    }

    #[test]
    fn keeping_sides_moves_the_disc_and_not_the_link() {
        for (owner, y) in [(0, -0.2), (0, 0.1), (1, 0.2), (1, -0.1)] {
            let (mut p, mut contacts, nodes) = ring_and_disc(&square(), Vec2::new(2.0, y), owner);
            let before: Vec<Vec2> = nodes.iter().map(|&i| p.position(i as usize)).collect();
            let home = if owner == 0 { 1.0 } else { -1.0 };
            assert_eq!(keep_sides(&mut contacts, &mut p, Dispatch::default()), u32::from(y * home < 0.0));
            assert!((p.position(4).y * home - STANDOFF * 2.0 * RADIUS).abs() < 1e-5, "{}", p.position(4));
            assert!(nodes.iter().zip(before).all(|(&i, at)| p.position(i as usize) == at));
        }
    }

    #[test]
    fn what_is_farther_on_the_wrong_side_than_the_contact_distance_is_not_through() {
        let (p, contacts, _) = ring_and_disc(&square(), Vec2::new(2.0, -0.7), 0);
        let (contact, links) = contacts.iter().next().unwrap();
        let relation = |found: &FoundLink| Relation::of(4, found.link, &p);
        let bottom = links.iter().find(|found| relation(found).squared < 0.5).unwrap();
        for (radius_sum, through) in [(0.6, false), (0.8, true), (2.0, true)] {
            let mut contact = contact.clone();
            contact.radius_sum = radius_sum;
            assert_eq!(is_through(&contact, bottom.link, &relation(bottom), links), through, "at {radius_sum}");
        }
    }

    #[test]
    fn a_heavy_disc_does_not_crush_a_light_ring() {
        let (mut p, mut contacts, _) = ring_and_disc(&square(), Vec2::new(2.0, -0.3), 1);
        p.inv_mass[4] = 1e-4;
        project(&mut contacts, &mut p);
        assert!(p.position(4).y < -0.3 - 0.01, "{}", p.position(4));
    }

    proptest! {
        #[test]
        fn the_nearest_link_and_the_ray_agree_on_the_side(
            outline in star_polygon(), x in -12.0f32..12.0, y in -12.0f32..12.0
        ) {
            let at = Vec2::new(x, y);
            let (p, contacts, nodes) = ring_and_disc(&outline, at, 0);
            let found = contacts.iter().next();
            prop_assume!(distance(&nodes, &p, at) > 1e-3 && found.is_some());
            let (contact, links) = found.unwrap();
            let relations = || links.iter().map(|found| Relation::of(contact.particle, found.link, &p));
            let relation = relations().reduce(|best, other| if other.is_nearer_than(&best) { other } else { best }).unwrap();
            // Of two links of which one is nearest almost at the node of both, roundings decide.
            let is_as_near = |other: &Relation| {
                other.squared != relation.squared && other.squared < (1.0 + 1e-6) * relation.squared
            };
            prop_assume!(relations().filter(is_as_near).all(|other| (other.height() > 0.0) == (relation.height() > 0.0)));
            prop_assert_eq!(relation.height() > 0.0, contains_point(&outline, at));
        }
    }
}
