//! What several test files share.
#![allow(dead_code, reason = "each test file uses its part")]

use microsim_core::glam::Vec2;
use microsim_core::{
    Controller, Event, Inputs, Intent, OrganismId, OrganismSpec, Placement, ProbeSpec, World, WorldConfig,
};

pub(crate) mod chase;
pub(crate) mod lobes;

/// Takes a step and checks all that holds between steps.
pub(crate) fn step_soundly(world: &mut World, inputs: &Inputs, what: &str) {
    world.step(inputs);
    assert_eq!(world.validate(), Ok(()), "{what}");
    assert_sound(world, what);
}

/// A world of the default size with one organism.
pub(crate) fn room_with(spec: impl Into<OrganismSpec>, x: f32, y: f32) -> (World, OrganismId) {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let organism = world.spawn(&spec.into(), Placement::at(x, y)).unwrap();
    (world, organism)
}

/// Inputs with one intent.
pub(crate) fn tell(organism: OrganismId, intent: Intent) -> Inputs {
    let mut inputs = Inputs::new();
    inputs.set(organism, intent);
    inputs
}

/// Inputs that steer one organism towards a point.
pub(crate) fn toward(organism: OrganismId, goal: Vec2) -> Inputs {
    tell(organism, Intent::toward(goal).unwrap())
}

/// Whether an event of the last step matches.
pub(crate) fn happens(world: &World, is_it: fn(&Event) -> bool) -> bool {
    world.events().iter().any(is_it)
}

/// Takes `steps` steps.
pub(crate) fn run(world: &mut World, inputs: &Inputs, steps: u32) {
    for _ in 0..steps {
        world.step(inputs);
    }
}

/// An organism in the middle of the room with a probe on each side that presses towards it.
pub(crate) fn squeeze(spec: &OrganismSpec) -> (World, OrganismId) {
    let (mut world, organism) = room_with(spec.clone(), 80.0, 45.0);
    for side in [-1.0, 1.0] {
        let press = Controller::patrol(vec![Vec2::new(80.0, 45.0)], false);
        let probe = ProbeSpec { radius: 6.0, speed: 2.0, mass: 100.0, max_acceleration: 40.0 };
        let beside = Placement::at(80.0 + 16.0 * side, 45.0).steered_by(press);
        world.spawn(&probe.into(), beside).unwrap();
    }
    (world, organism)
}

pub(crate) fn outline(world: &World, organism: OrganismId) -> Vec<Vec2> {
    world.view().organism(organism).unwrap().outline().collect()
}

/// No particle has leaked, no prey is partly inside, nothing is quarantined.
pub(crate) fn assert_sound(world: &World, what: &str) {
    let census = world.census();
    assert_eq!((census.leaks, census.improper_absorptions, census.quarantined), (0, 0, 0), "{what}");
}

/// Distance of each body of the outline from the outline's centre.
pub(crate) fn distances_from_centre(world: &World, organism: OrganismId) -> Vec<f32> {
    let centre = world.centroid(organism).unwrap();
    outline(world, organism).into_iter().map(|at| (at - centre).length()).collect()
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
