//! What every constraint must obey, as a shared check for the tests of each.

use crate::collision::broad_phase::{BroadPhase, SearchInput};
use crate::collision::exemptions::Exemptions;
use crate::collision::ring::{Containment, Ring};
use crate::collision::ring_contacts::RingContacts;
use crate::collision::speculative_margin::DisplacementLimits;
use crate::geometry::period::Period;
use crate::geometry::ring::unit_vector;
use crate::instruction_set::Dispatch;
use crate::particle::sleep::Sleep;
use crate::particle::{CollisionGroups, Material, Particle, Particles};
use glam::Vec2;

/// A disc of radius 0.5 at rest.
pub(crate) fn disc(position: Vec2, inv_mass: f32) -> Particle {
    Particle {
        origin: Vec2::ZERO,
        offset: position,
        velocity: Vec2::ZERO,
        inv_mass,
        radius: 0.5,
        groups: CollisionGroups::ALL,
        material: Material { friction: 0.0, restitution: 0.0 },
        role: 0,
        owner: 0,
        fluid: 0,
    }
}

/// A search among discs in a room of 40 by 30 units without blocks, obstacles or rings.
pub(crate) fn search_input<'a>(
    particles: &'a Particles,
    exemptions: &'a Exemptions,
    limits: DisplacementLimits,
) -> SearchInput<'a> {
    let size = Vec2::new(40.0, 30.0);
    SearchInput {
        particles,
        blocks: &[],
        obstacles: &[],
        paths: &[],
        exemptions,
        rings: &[],
        containments: &[],
        size,
        period: Period::NONE,
        walls: 0,
        limits,
        dispatch: Dispatch::default(),
    }
}

/// Two particles on the x axis, the first at the origin.
pub(crate) fn line(distance: f32, inv_mass: [f32; 2]) -> Particles {
    let mut particles = Particles::default();
    particles.insert(&disc(Vec2::ZERO, inv_mass[0]));
    particles.insert(&disc(Vec2::new(distance, 0.0), inv_mass[1]));
    particles
}

/// Particles evenly on a circle.
pub(crate) fn ring(count: usize, radius: f32) -> Particles {
    let mut particles = Particles::default();
    for k in 0..count {
        let angle = std::f32::consts::TAU * k as f32 / count as f32;
        particles.insert(&disc(unit_vector(angle) * radius, 1.0));
    }
    particles
}

/// Sum of mass times position, which no inner constraint may change.
pub(crate) fn momentum(particles: &Particles) -> Vec2 {
    let moving = particles.live().filter(|&i| particles.inv_mass[i] > 0.0);
    moving.map(|i| particles.position(i) / particles.inv_mass[i]).sum()
}

/// Checks a pair constraint that asks for `target` between particles 0 and 1: the error shrinks, momentum stays, the
/// target is a fixed point, and coincident or immovable particles give no NaN.
pub(crate) fn assert_pair_laws(violated: &[f32], target: f32, project: impl Fn(&mut Particles)) {
    for &length in violated {
        let mut p = line(length, [1.0, 0.25]);
        let before = momentum(&p);
        project(&mut p);
        let after = (p.position(1) - p.position(0)).length();
        assert!((after - target).abs() < (length - target).abs(), "{length} -> {after}, wanted {target}");
        assert!((momentum(&p) - before).length() < 1e-5, "momentum");
        let mut pinned = line(length, [0.0, 0.0]);
        project(&mut pinned);
        assert_eq!((pinned.x[0], pinned.x[1]), (0.0, length), "pinned particles stay");
    }
    let mut rest = line(target, [1.0, 1.0]);
    project(&mut rest);
    assert_eq!((rest.x[0], rest.x[1]), (0.0, target), "the target is a fixed point");
    let mut coincident = line(0.0, [1.0, 1.0]);
    project(&mut coincident);
    assert!(coincident.position(0).is_finite() && coincident.position(1).is_finite(), "coincident particles");
}

/// Pairs of discs of different owners that overlap, of those that collide and can move, by brute force.
pub(crate) fn overlapping(p: &Particles) -> Vec<(u32, u32)> {
    let all: Vec<usize> = p.live().filter(|&i| p.groups[i].memberships != 0 && p.inv_mass[i] > 0.0).collect();
    let touch = |i: usize, j: usize| p.between(i, j).length() < p.radius[i] + p.radius[j];
    let mut found = Vec::new();
    for (k, &i) in all.iter().enumerate() {
        let others = all[k + 1..].iter().filter(|&&j| p.owner[i] != p.owner[j] && touch(i, j));
        found.extend(others.map(|&j| (i as u32, j as u32)));
    }
    found
}

/// A ring of owner 0 and a disc of owner `owner` at some place; the contacts between them.
pub(crate) fn ring_and_disc(outline: &[Vec2], at: Vec2, owner: u32) -> (Particles, RingContacts, Vec<u32>) {
    let mut p = Particles::default();
    let particle = |at, owner| Particle { owner, ..disc(at, 1.0) };
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
