//! Cells that divide and fuse.

use super::{assert_sound, happens, room_with, run, toward};
use microsim_core::geometry::polygon::{is_simple, signed_area};
use microsim_core::glam::Vec2;
use microsim_core::{AmoeboidCellSpec, Event, Inputs, Intent, OrganismId, Role, World};

/// The middle of the room.
pub(crate) const CENTRE: Vec2 = Vec2::new(80.0, 45.0);

pub(crate) fn cell_in_room(spec: AmoeboidCellSpec) -> (World, OrganismId) {
    let (mut world, cell) = room_with(spec, CENTRE.x, CENTRE.y);
    run(&mut world, &Inputs::new(), 30);
    (world, cell)
}

pub(crate) fn count(world: &World, cell: OrganismId, role: Role) -> usize {
    world.view().organism(cell).unwrap().particles().filter(|p| p.role == role).count()
}

/// What must hold in every step: every membrane simple and counter-clockwise, nothing lost, no link too long.
pub(crate) fn check(world: &World, what: &str) {
    assert_sound(world, what);
    assert!(world.quality().edge_stretch_max < 0.5, "{what}: {:?}", world.quality());
    for organism in world.view().organisms().filter(|organism| organism.kind() == microsim_core::Kind::AmoeboidCell) {
        let ring: Vec<Vec2> = organism.outline().collect();
        assert!(is_simple(&ring) && signed_area(&ring) > 0.0, "{what}: {ring:?}");
    }
}

/// Takes `steps` steps and checks the world after each.
pub(crate) fn run_checked(world: &mut World, inputs: &Inputs, steps: u32, what: &str) {
    for step in 0..steps {
        run(world, inputs, 1);
        check(world, &format!("{what}, step {step}"));
    }
}

/// Steps until an event says how the division of a cell ended.
pub(crate) fn finish(world: &mut World, what: &str) -> Option<Event> {
    for step in 0..2000 {
        run(world, &Inputs::new(), 1);
        check(world, &format!("{what}, step {step}"));
        let ends = |event: &&Event| {
            matches!(event, Event::Divided { .. } | Event::DivisionRefused { .. } | Event::DivisionAbandoned { .. })
        };
        if let Some(event) = world.events().iter().find(ends) {
            return Some(*event);
        }
    }
    None
}

pub(crate) fn divide(world: &mut World, cell: OrganismId, what: &str) -> OrganismId {
    world.divide(cell).unwrap();
    match finish(world, what) {
        Some(Event::Divided { parent, daughter }) if parent == cell => daughter,
        other => panic!("{what}: {other:?}"),
    }
}

/// Lets two cells crawl towards each other until they are one, which it returns.
pub(crate) fn fuse(world: &mut World, a: OrganismId, b: OrganismId, what: &str) -> OrganismId {
    for step in 0..900 {
        let mut inputs = toward(a, world.centroid(b).unwrap());
        inputs.set(b, Intent::toward(world.centroid(a).unwrap()).unwrap());
        world.fuse(a, b).unwrap();
        world.step(&inputs);
        check(world, &format!("{what}, fusing, step {step}"));
        if happens(world, |event| matches!(event, Event::Fused { .. })) {
            let (has_a, has_b) = (world.kind(a).is_some(), world.kind(b).is_some());
            assert!(has_a != has_b, "one handle is stale");
            return if has_a { a } else { b };
        }
    }
    panic!("{what}: not fused");
}
