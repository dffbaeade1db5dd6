//! Contacts between discs, with friction and restitution.
//!
//! `C = |x_j - x_i| - (r_i + r_j) >= 0`. Friction moves both along the contact by at most `mu` times the depth (Macklin
//! et al. 2014, "Unified Particle Physics", section 6.1, static and kinetic coefficient equal); restitution is a velocity
//! pass after the substep (Mueller et al. 2020, "Detailed Rigid Body Simulation", eq. 34).

use super::contact_record::{ContactRecorder, Projected, Touched};
use super::lanes::ratio;
use super::sweep::first_touch;
use crate::collision::{Contact, FAST, Mobility};
use crate::particle::{Particles, PositionCells};
use glam::Vec2;

/// What is bounded counts as at most so many times as heavy as a linked disc: a heavier one would stretch the links faster than a
/// substep's iterations can pass the load on. Above it the heavy side feels more than it should.
const HEAVIEST: f32 = 30.0;

/// An impact of this substep that has to bounce.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Impact {
    i: u32,
    /// The other disc; `None` if it is an obstacle.
    j: Option<u32>,
    /// From `i` to the other.
    normal: Vec2,
    /// Speed of separation that restitution asks for.
    rebound: f32,
    /// Velocity of the obstacle's surface.
    surface: Vec2,
}

/// How two discs overlap.
struct Penetration {
    /// From the first to the second.
    normal: Vec2,
    /// Along the normal, units.
    depth: f32,
    /// Whether they overlap only on their way, see [`super::sweep`].
    has_passed: bool,
}

/// Pushes overlapping discs apart, and tells of each two.
pub(crate) fn project(
    contacts: &mut [Contact],
    p: PositionCells<'_>,
    impacts: &mut Vec<Impact>,
    recorder: &mut ContactRecorder,
    mut projected: impl FnMut(&Contact),
) {
    for contact in contacts {
        let (i, j) = (contact.i as usize, contact.j as usize);
        let between = contact.between_origins + (p.offset(j) - p.offset(i));
        if let Some(penetration) = penetration(contact, between, p) {
            contact.touched = true;
            separate(contact, penetration, p, impacts, recorder);
            projected(contact);
        }
    }
}

#[inline(always)]
fn penetration(c: &Contact, between: Vec2, p: PositionCells<'_>) -> Option<Penetration> {
    let passed = if c.can_pass { passed(c, between, p) } else { None };
    let squared = between.length_squared();
    let overlap = || {
        let length = squared.sqrt();
        let normal = if length > 1e-6 { between / length } else { Vec2::X };
        Penetration { normal, depth: c.radius_sum - length, has_passed: false }
    };
    passed.or_else(|| (squared < c.radius_sum * c.radius_sum).then(overlap))
}

/// How far two discs on a long way are beyond where they met first, if they are.
#[cold]
fn passed(c: &Contact, between: Vec2, p: PositionCells<'_>) -> Option<Penetration> {
    let way = p.moved(c.j as usize) - p.moved(c.i as usize);
    let longest = FAST * c.radius_sum;
    let normal =
        if way.length_squared() > longest * longest { first_touch(between, way, c.radius_sum)? } else { return None };
    let depth = c.radius_sum - between.dot(normal);
    (depth > 0.0).then_some(Penetration { normal, depth, has_passed: true })
}

fn separate(
    c: &Contact,
    Penetration { normal, depth, has_passed }: Penetration,
    p: PositionCells<'_>,
    impacts: &mut Vec<Impact>,
    recorder: &mut ContactRecorder,
) {
    let (i, j) = (c.i as usize, c.j as usize);
    let (wi, wj) = weights(c, p);
    // What approach the projection leaves would carry discs past each other in the next substep.
    if c.restitution > 0.0 || has_passed {
        impacts.extend(Impact::of(c, normal, p));
    }
    recorder.note(|| Projected {
        particle: c.i,
        touched: Touched::Disc(c.j),
        point: p.position(i) + normal * p.radius(i),
        normal: -normal,
        depth,
        weight: wi + wj,
        restitution: c.restitution,
        way: p.velocity(j) - p.velocity(i),
    });
    let push = normal * ratio(depth, wi + wj);
    p.shift(i, -push * wi);
    p.shift(j, push * wj);
    let slip = p.moved(j) - p.moved(i);
    let rub = friction(slip, normal, c.friction * depth) * ratio(1.0, wi + wj);
    p.shift(i, -rub * wi);
    p.shift(j, rub * wj);
}

/// Inverse masses with which the two press on each other.
fn weights(c: &Contact, p: PositionCells<'_>) -> (f32, f32) {
    let (wi, wj) = (p.inv_mass(c.i as usize), p.inv_mass(c.j as usize));
    match c.mobility {
        [Mobility::Asleep, _] => (0.0, wj),
        [_, Mobility::Asleep] => (wi, 0.0),
        [Mobility::Bounded, _] => (no_heavier(wi, wj), wj),
        [_, Mobility::Bounded] => (wi, no_heavier(wj, wi)),
        _ => (wi, wj),
    }
}

/// Inverse mass with which something presses on something of inverse mass `other`, see [`HEAVIEST`].
#[inline(always)]
pub(crate) fn no_heavier(inv_mass: f32, other: f32) -> f32 {
    let least = other / HEAVIEST;
    if inv_mass > 0.0 && inv_mass < least { least } else { inv_mass }
}

/// Whether a disc of inverse mass `inv_mass` is so heavy on one of inverse mass `on` that links of the other need more than a
/// substep's iterations.
#[inline(always)]
pub(crate) fn is_heavy(inv_mass: f32, on: f32) -> bool {
    inv_mass * HEAVIEST < on
}

/// The move that takes back slip along a surface, by at most `most`.
#[inline(always)]
pub(crate) fn friction(slip: Vec2, normal: Vec2, most: f32) -> Vec2 {
    let along = slip - normal * slip.dot(normal);
    -along * super::ratio_limit(along.length_squared(), most)
}

#[inline(always)]
pub(crate) fn shift(p: &mut Particles, i: usize, by: Vec2) {
    p.x[i] += by.x;
    p.y[i] += by.y;
}

/// How far particle `i` has moved since the substep began.
#[inline(always)]
pub(crate) fn moved(p: &Particles, i: usize) -> Vec2 {
    Vec2::new(p.x[i] - p.prev_x[i], p.y[i] - p.prev_y[i])
}

impl Impact {
    /// An impact of two discs, if they approach each other; what sleeps is as if it were static.
    fn of(c: &Contact, normal: Vec2, p: PositionCells<'_>) -> Option<Self> {
        let [of_i, of_j] = [c.i, c.j].map(|i| p.velocity(i as usize));
        match c.mobility {
            [Mobility::Asleep, _] => return Self::on_surface(c.j, of_j, -normal, c.restitution, Vec2::ZERO),
            [_, Mobility::Asleep] => return Self::on_surface(c.i, of_i, normal, c.restitution, Vec2::ZERO),
            _ => {}
        }
        let approach = (of_j - of_i).dot(normal);
        let rebound = -c.restitution * approach;
        (approach < 0.0).then_some(Self { i: c.i, j: Some(c.j), normal, rebound, surface: Vec2::ZERO })
    }

    /// An impact of particle `i` on a surface of this velocity, which nothing moves, if it approaches it.
    pub(crate) fn on_surface(i: u32, velocity: Vec2, normal: Vec2, restitution: f32, surface: Vec2) -> Option<Self> {
        let approach = (surface - velocity).dot(normal);
        (approach < 0.0).then_some(Self { i, j: None, normal, rebound: -restitution * approach, surface })
    }
}

/// Gives every impact of the substep its speed of separation.
pub(crate) fn apply_restitution(impacts: &mut Vec<Impact>, p: &mut Particles) {
    for impact in impacts.drain(..) {
        let i = impact.i as usize;
        let (other, wj) = impact.j.map_or((impact.surface, 0.0), |j| (p.velocity(j as usize), p.inv_mass[j as usize]));
        let lacking = impact.rebound - (other - p.velocity(i)).dot(impact.normal);
        if lacking > 0.0 {
            let impulse = impact.normal * ratio(lacking, p.inv_mass[i] + wj);
            p.vx[i] -= impulse.x * p.inv_mass[i];
            p.vy[i] -= impulse.y * p.inv_mass[i];
            if let Some(j) = impact.j {
                p.vx[j as usize] += impulse.x * wj;
                p.vy[j as usize] += impulse.y * wj;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_pair_laws, line, momentum};
    use super::*;

    fn touching(friction: f32, restitution: f32) -> Contact {
        Contact { friction, restitution, ..Contact::new(&line(1.0, [1.0; 2]), 0, 1, [Mobility::Single; 2], 0.0) }
    }

    fn separate(contact: &mut Contact, p: &mut Particles) {
        super::project(
            std::slice::from_mut(contact),
            p.position_cells(),
            &mut Vec::new(),
            &mut ContactRecorder::default(),
            |_| {},
        );
    }

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        assert_pair_laws(&[0.6], 1.0, |p| {
            separate(&mut touching(0.0, 0.0), p);
        });
    }

    #[test]
    fn a_heavy_disc_presses_with_all_its_mass_unless_it_is_bounded() {
        for (ratio, own, mobility, counted) in [
            (10.0, Mobility::Single, Mobility::Linked, 10.0),
            (1e3, Mobility::Single, Mobility::Single, 1e3),
            (1e3, Mobility::Single, Mobility::Linked, 1e3),
            (1e3, Mobility::Bounded, Mobility::Linked, 30.0),
        ] {
            let mut p = line(0.6, [1.0, 1.0 / ratio]);
            let before = momentum(&p);
            let mut contact = Contact { mobility: [mobility, own], ..touching(0.0, 0.0) };
            separate(&mut contact, &mut p);
            assert!((p.x[0] + 0.4 * counted / (1.0 + counted)).abs() < 1e-6, "ratio {ratio}, {own:?}: {}", p.x[0]);
            let error = (momentum(&p) - before).length();
            assert_eq!(error < 1e-6 * ratio, counted == ratio, "ratio {ratio}, {own:?}: {error}");
        }
    }

    #[test]
    fn discs_apart_are_left_alone_and_not_touched() {
        let mut p = line(1.2, [1.0, 1.0]);
        let mut contact = touching(0.5, 0.0);
        separate(&mut contact, &mut p);
        assert!(!contact.touched && p.x[1] == 1.2);
    }

    #[test]
    fn friction_takes_back_slip_up_to_mu_times_depth() {
        for (mu, kept) in [(0.0, 0.3), (0.5, 0.25), (100.0, 1e-3)] {
            let mut p = line(0.9, [0.0, 1.0]);
            p.y[1] = 0.3;
            p.x[1] = (0.81f32 - 0.09).sqrt();
            p.prev_x[1] = p.x[1];
            let normal = p.position(1).normalize();
            separate(&mut touching(mu, 0.0), &mut p);
            let slip = (moved(&p, 1) - normal * moved(&p, 1).dot(normal)).length();
            assert!(slip <= kept + 1e-3, "mu {mu}: slip {slip}");
        }
    }

    #[test]
    fn restitution_returns_its_share_of_the_approach_speed() {
        let mut p = line(0.99, [1.0, 1.0]);
        p.vx = vec![1.0, -1.0];
        let mut impacts = Vec::new();
        project(&mut [touching(0.0, 0.5)], p.position_cells(), &mut impacts, &mut ContactRecorder::default(), |_| {});
        p.vx = vec![0.0, 0.0];
        apply_restitution(&mut impacts, &mut p);
        assert!((p.vx[1] - p.vx[0] - 1.0).abs() < 1e-6, "separation {}", p.vx[1] - p.vx[0]);
        assert!(impacts.is_empty() && momentum(&p).is_finite());
    }

    #[test]
    fn an_impact_leaves_its_rebound_whatever_the_masses_and_keeps_momentum() {
        let mut p = line(0.99, [1.0, 0.25]);
        p.vx = vec![1.0, -1.0];
        let mut impacts = Vec::new();
        project(&mut [touching(0.0, 0.5)], p.position_cells(), &mut impacts, &mut ContactRecorder::default(), |_| {});
        p.vx = vec![0.5, 0.25];
        let before = momentum(&p);
        apply_restitution(&mut impacts, &mut p);
        assert!((p.vx[1] - p.vx[0] - 1.0).abs() < 1e-6, "separation {}", p.vx[1] - p.vx[0]);
        assert!((momentum(&p) - before).length() < 1e-6);
    }

    #[test]
    fn only_what_approaches_a_surface_bounces_off_it() {
        let mut p = line(0.99, [1.0, 1.0]);
        p.vx[0] = 2.0;
        let of = |normal, restitution, surface| {
            Impact::on_surface(0, p.velocity(0), normal, restitution, surface).map(|impact| impact.rebound)
        };
        assert_eq!(of(Vec2::X, 0.5, Vec2::ZERO), Some(1.0));
        assert_eq!(of(Vec2::X, 0.5, Vec2::X), Some(0.5));
        assert_eq!(of(Vec2::X, 0.0, Vec2::ZERO), Some(0.0));
        assert_eq!([of(-Vec2::X, 0.5, Vec2::ZERO), of(Vec2::X, 0.5, 3.0 * Vec2::X)], [None; 2]);
    }

    #[test]
    fn only_what_is_more_than_the_largest_ratio_heavier_is_heavy() {
        for (inv_mass, heavy) in [(1.1, false), (1.0, false), (0.9, true)] {
            assert_eq!(is_heavy(inv_mass, HEAVIEST), heavy, "{inv_mass}");
        }
    }
}
