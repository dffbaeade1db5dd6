//! Rigid cells (thesis, 3.1.1): shape, nucleus and movement. The structure's tests are in `organism/rigid_cell`.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::{distances_from_centre, largest_change, outline, room_with, run, squeeze, toward};
use microsim_core::geometry::polygon::contains_point;
use microsim_core::glam::Vec2;
use microsim_core::{
    AmoeboidCellSpec, Controller, Event, Inputs, OrganismId, OrganismSpec, Placement, ProbeSpec, RigidCellSpec, Rng,
    World,
};
use proptest::prelude::*;

fn cell_in_room(spec: RigidCellSpec) -> (World, OrganismId) {
    room_with(spec, 80.0, 45.0)
}

fn nucleus_is_inside(world: &World, cell: OrganismId) -> bool {
    contains_point(&outline(world, cell), world.view().organism(cell).unwrap().nucleus().unwrap().position)
}

/// Direction from the nucleus to the first body of the outline.
fn axis(world: &World, cell: OrganismId) -> Vec2 {
    let view = world.view().organism(cell).unwrap();
    (view.outline().next().unwrap() - view.nucleus().unwrap().position).normalize()
}

#[test]
fn t03_amoeboid_cells_deform_more_than_rigid_cells_under_the_same_load() {
    let deformation = |spec: OrganismSpec| {
        let (mut world, cell) = squeeze(&spec);
        let before = distances_from_centre(&world, cell);
        run(&mut world, &Inputs::new(), 150);
        largest_change(&before, &distances_from_centre(&world, cell))
    };
    let rigid = deformation(RigidCellSpec { radii: Vec2::splat(8.0), ..RigidCellSpec::default() }.into());
    let amoeboid = deformation(AmoeboidCellSpec { radii: Vec2::splat(8.0), ..AmoeboidCellSpec::default() }.into());
    assert!(amoeboid > 2.0 * rigid, "amoeboid {amoeboid}, rigid {rigid}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn t10_nucleus_never_leaves_the_cell(seed in any::<u64>(), layers in 1u32..=2, ratio in 0.5f32..1.0) {
        let radii = Vec2::new(8.0, 8.0 * ratio);
        let (mut world, cell) = cell_in_room(RigidCellSpec { radii, layers, ..RigidCellSpec::default() });
        let mut rng = Rng::new(seed, 0);
        for k in 0..4 {
            let way = (0..20).map(|_| Vec2::new(rng.range(60.0, 100.0), rng.range(30.0, 60.0))).collect();
            let spec = ProbeSpec { speed: 15.0, radius: 3.0, ..ProbeSpec::default() };
            let corner = Placement::at(15.0 + 40.0 * k as f32, 12.0).steered_by(Controller::patrol(way, true));
            world.spawn(&spec.into(), corner).unwrap();
        }
        for step in 0..600 {
            run(&mut world, &Inputs::new(), 1);
            prop_assert!(nucleus_is_inside(&world, cell), "outside at step {step}");
        }
    }
}

#[test]
fn t11_shape_deviates_slightly_under_load_and_returns_to_rest() {
    for layers in [1, 2] {
        let spec = RigidCellSpec { radii: Vec2::splat(8.0), layers, ..RigidCellSpec::default() };
        let (mut world, cell) = squeeze(&spec.into());
        let rest = distances_from_centre(&world, cell);
        let mut worst: f32 = 0.0;
        for _ in 0..240 {
            run(&mut world, &Inputs::new(), 1);
            worst = worst.max(largest_change(&rest, &distances_from_centre(&world, cell)));
        }
        assert!(worst > 1e-3 && worst < 0.2, "{layers} layers: deviation {worst} under load");
        let others: Vec<OrganismId> = world.organisms().filter(|&id| id != cell).collect();
        others.into_iter().for_each(|probe| world.remove(probe).unwrap());
        run(&mut world, &Inputs::new(), 300);
        let left = largest_change(&rest, &distances_from_centre(&world, cell));
        assert!(left < 0.01, "{layers} layers: deviation {left} after the load");
    }
}

#[test]
fn t12_a_body_of_the_outermost_layer_is_the_front_and_the_cell_moves_the_way_it_faces() {
    let (mut world, cell) = cell_in_room(RigidCellSpec::default());
    let view = world.view().organism(cell).unwrap();
    assert_eq!(view.front_index(), Some(0));
    assert_eq!(view.front(), view.outline().next());
    let facing = axis(&world, cell);
    let start = world.centroid(cell).unwrap();
    run(&mut world, &toward(cell, Vec2::new(150.0, 45.0)), 120);
    let moved = world.centroid(cell).unwrap() - start;
    assert!(moved.normalize().dot(facing) > 0.99 && moved.length() > 3.0, "moved {moved}");
}

#[test]
fn t13_cell_rotates_until_it_faces_the_goal_and_reaches_it() {
    let (mut world, cell) = cell_in_room(RigidCellSpec::default());
    let goal = Vec2::new(95.0, 80.0);
    let inputs = toward(cell, goal);
    let mut nearest = f32::INFINITY;
    for step in 0..600 {
        run(&mut world, &inputs, 1);
        let front = world.view().organism(cell).unwrap().front().unwrap();
        nearest = nearest.min((goal - front).length());
        if step == 150 {
            let facing = axis(&world, cell).dot((goal - world.centroid(cell).unwrap()).normalize());
            assert!(facing > 0.9, "facing {facing}");
        }
    }
    assert!(nearest < 1.0, "came within {nearest}");
}

#[test]
fn t14_a_goal_behind_makes_the_opposite_body_the_front_without_a_turn() {
    let (mut world, cell) = cell_in_room(RigidCellSpec::default());
    let before = axis(&world, cell);
    let inputs = toward(cell, Vec2::new(10.0, 40.0));
    world.step(&inputs);
    assert_eq!(world.events(), [Event::FrontSwitched { organism: cell }]);
    assert_eq!(world.view().organism(cell).unwrap().front_index(), Some(14), "opposite of body 0 of 28");
    let start = world.centroid(cell).unwrap();
    run(&mut world, &inputs, 180);
    assert!(axis(&world, cell).dot(before) > 0.9, "no turn");
    assert!(world.centroid(cell).unwrap().x < start.x - 3.0, "it moves backwards");
    assert!(world.events().is_empty());
}

#[test]
fn t13_speed_does_not_depend_on_the_distance_of_the_goal() {
    let travelled = |goal_x: f32| {
        let (mut world, cell) = cell_in_room(RigidCellSpec::default());
        run(&mut world, &toward(cell, Vec2::new(goal_x, 45.0)), 60);
        world.centroid(cell).unwrap().x
    };
    assert!((travelled(110.0) - travelled(1000.0)).abs() < 0.05);
}
