//! What several test files share.
#![allow(dead_code, reason = "each test file uses its part")]

use microsim_core::glam::Vec2;
use microsim_core::{Controller, Inputs, OrganismId, OrganismSpec, Placement, ProbeSpec, World, WorldConfig};

/// Takes `steps` steps.
pub(crate) fn run(world: &mut World, inputs: &Inputs, steps: u32) {
    for _ in 0..steps {
        world.step(inputs);
    }
}

/// An organism in the middle of the room with a probe on each side that presses towards it.
pub(crate) fn squeeze(spec: &OrganismSpec) -> (World, OrganismId) {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let organism = world.spawn(spec, Placement::at(80.0, 45.0)).unwrap();
    for side in [-1.0, 1.0] {
        let press = Controller::patrol(vec![Vec2::new(80.0, 45.0)], false);
        let probe = ProbeSpec { radius: 6.0, speed: 2.0, mass: 100.0, max_acceleration: 40.0 };
        let beside = Placement::at(80.0 + 16.0 * side, 45.0).steered_by(press);
        world.spawn(&probe.into(), beside).unwrap();
    }
    (world, organism)
}

/// Distance of each body of the outline from the outline's centre.
pub(crate) fn distances_from_centre(world: &World, organism: OrganismId) -> Vec<f32> {
    let centre = world.centroid(organism).unwrap();
    world.view().organism(organism).unwrap().outline().map(|at| (at - centre).length()).collect()
}

/// Largest relative change between two lists.
pub(crate) fn largest_change(before: &[f32], after: &[f32]) -> f32 {
    before.iter().zip(after).map(|(b, a)| (a / b - 1.0).abs()).fold(0.0, f32::max)
}

/// Whether every disc of every organism is within the walls, with `tolerance`.
pub(crate) fn everything_is_inside(world: &World, tolerance: f32) -> bool {
    let size = world.config().size;
    world.view().organisms().flat_map(|organism| organism.particles()).all(|p| {
        let margin = Vec2::splat(p.radius - tolerance);
        p.position.cmpge(margin).all() && p.position.cmple(size - margin).all()
    })
}
