//! Platelets, agar and walls (thesis, 3.1.4 and 3.3.1). The structure's tests are beside `platelet.rs` and `agar.rs`.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::{everything_is_inside, outline, room_with, run, toward};
use microsim_core::geometry::is_simple;
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Controller, FluidBlockSpec, Inputs, OrganismId, Placement, PlateletSpec, ProbeSpec,
    RigidCellSpec, Role, World, WorldConfig,
};
use proptest::prelude::*;

fn with_role(world: &World, id: OrganismId, role: Role) -> Vec2 {
    let view = world.view().organism(id).unwrap();
    view.particles().find(|p| p.role == role).unwrap().position
}

/// How far a platelet's nucleus is from its anchor.
fn offset(world: &World, id: OrganismId) -> f32 {
    (with_role(world, id, Role::Nucleus) - with_role(world, id, Role::Anchor)).length()
}

/// A probe that moves through the given points once.
fn probe_through(world: &mut World, start: Vec2, way: &[Vec2]) -> OrganismId {
    let placement = Placement::at(start.x, start.y).steered_by(Controller::patrol(way.to_vec(), false));
    world.spawn(&ProbeSpec { radius: 3.0, speed: 8.0, ..ProbeSpec::default() }.into(), placement).unwrap()
}

#[test]
fn t45_interlayer_stays_at_the_nucleus_and_holds_the_ring_out() {
    let spec = PlateletSpec::default();
    let (mut world, platelet) = room_with(spec.clone(), 80.0, 45.0);
    probe_through(&mut world, Vec2::new(70.0, 45.0), &[Vec2::new(100.0, 45.0)]);
    for _ in 0..240 {
        run(&mut world, &Inputs::new(), 1);
        let interlayer = with_role(&world, platelet, Role::Interlayer);
        assert!((with_role(&world, platelet, Role::Nucleus) - interlayer).length() < 0.1 * spec.radius, "concentric");
        let ring = outline(&world, platelet).into_iter();
        let nearest = ring.map(|at| (at - interlayer).length()).fold(f32::INFINITY, f32::min);
        assert!(nearest > 0.75 * spec.radius, "ring comes within {nearest}");
    }
}

#[test]
fn t46_rope_bounds_the_distance_and_contracts() {
    let spec = PlateletSpec { rope_length: 2.0, ..PlateletSpec::default() };
    let (mut world, platelet) = room_with(spec.clone(), 60.0, 45.0);
    let probe = probe_through(&mut world, Vec2::new(50.0, 45.0), &[Vec2::new(120.0, 45.0)]);
    let mut farthest: f32 = 0.0;
    for _ in 0..300 {
        run(&mut world, &Inputs::new(), 1);
        farthest = farthest.max(offset(&world, platelet));
    }
    let bound = spec.rope_length * spec.radius;
    assert!(farthest > 0.5 * bound && farthest < 1.05 * bound, "farthest {farthest} of {bound}");
    world.remove(probe).unwrap();
    run(&mut world, &Inputs::new(), 1200);
    assert!(offset(&world, platelet) < 0.02 * spec.radius, "contracts to minimal length");
}

#[test]
fn t47_cells_push_through_platelets_which_return_to_their_places() {
    let (mut world, cell) = room_with(AmoeboidCellSpec::default(), 30.0, 45.0);
    let column = |k: u32| Placement::at(65.0, 6.0 + 7.0 * k as f32);
    let platelets: Vec<OrganismId> =
        (0..12).map(|k| world.spawn(&PlateletSpec::default().into(), column(k)).unwrap()).collect();
    let inputs = toward(cell, Vec2::new(200.0, 45.0));
    let mut pushed: f32 = 0.0;
    for _ in 0..900 {
        run(&mut world, &inputs, 1);
        pushed = platelets.iter().map(|&id| offset(&world, id)).fold(pushed, f32::max);
    }
    assert!(world.centroid(cell).unwrap().x > 90.0, "through a gap of 2 between discs of 5, a cell of 22");
    assert!(pushed > 0.5, "platelets gave way by {pushed}");
    run(&mut world, &Inputs::new(), 900);
    for id in platelets {
        assert!(offset(&world, id) < 0.05 * 2.5, "back within 5 % of a radius, {}", offset(&world, id));
    }
}

#[test]
fn t49_agar_can_be_placed_densely() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    for k in 0..400 {
        let at = Placement::at(20.0 + 1.25 * (k % 20) as f32, 20.0 + 1.25 * (k / 20) as f32);
        world.spawn(&AgarSpec { radius: 0.6, ..AgarSpec::default() }.into(), at).unwrap();
    }
    run(&mut world, &Inputs::new(), 30);
    let census = world.census();
    assert_eq!((census.organisms, census.bodies, census.particles), (400, 400, 400), "one body each");
    assert!(world.quality().penetration_max < 0.01);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]
    #[test]
    fn t50_nothing_ever_leaves_the_walls(seed in any::<u64>(), gravity in -200.0f32..200.0) {
        let config = WorldConfig { size: Vec2::new(70.0, 50.0), gravity: Vec2::new(gravity, -gravity), seed, ..WorldConfig::default() };
        let mut world = World::new(config).unwrap();
        let out = || Controller::patrol(vec![Vec2::new(500.0, 20.0), Vec2::new(-500.0, 30.0)], true);
        let at = |x, y| Placement::at(x, y).steered_by(out());
        world.spawn(&AmoeboidCellSpec { speed: 30.0, ..AmoeboidCellSpec::default() }.into(), at(15.0, 15.0)).unwrap();
        world.spawn(&RigidCellSpec { speed: 60.0, ..RigidCellSpec::default() }.into(), at(40.0, 10.0)).unwrap();
        world.spawn(&ProbeSpec { speed: 1000.0, mass: 1e5, ..ProbeSpec::default() }.into(), at(60.0, 25.0)).unwrap();
        world.spawn(&PlateletSpec::default().into(), Placement::at(64.0, 45.0)).unwrap();
        world.spawn(&AgarSpec::default().into(), Placement::at(5.0, 45.0)).unwrap();
        let fluid = FluidBlockSpec { size: Vec2::new(10.0, 10.0), ..FluidBlockSpec::default() };
        world.spawn(&fluid.into(), Placement::at(45.0, 40.0)).unwrap();
        for step in 0..300 {
            run(&mut world, &Inputs::new(), 1);
            prop_assert!(everything_is_inside(&world, 0.05), "outside at step {step}");
        }
    }
}

#[test]
fn t50_walls_hold_at_the_extremes_of_every_setting() {
    let config = WorldConfig {
        size: Vec2::splat(20.0),
        gravity: Vec2::new(1000.0, -1000.0),
        dt: 0.1,
        substeps: 6,
        max_speed: 1000.0,
        ..WorldConfig::default()
    };
    let mut world = World::new(config).unwrap();
    world.spawn(&AgarSpec::default().into(), Placement::at(10.0, 10.0)).unwrap();
    for step in 0..100 {
        run(&mut world, &Inputs::new(), 1);
        assert!(everything_is_inside(&world, 0.05), "outside at step {step}");
    }
}

/// Worst relative error of a ring's link while a probe goes through a block of platelets; no ring folds meanwhile.
fn worst_link_under(mass: f32, max_acceleration: f32) -> f32 {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let place = |k: u16| Vec2::new(40.0 + 5.6 * f32::from(k % 8), 25.0 + 5.6 * f32::from(k / 8));
    let platelets: Vec<OrganismId> = (0..56)
        .map(|k| world.spawn(&PlateletSpec::default().into(), Placement::at(place(k).x, place(k).y)).unwrap())
        .collect();
    let way = vec![Vec2::new(75.0, 48.0), Vec2::new(45.0, 55.0), Vec2::new(75.0, 30.0)];
    let placement = Placement::at(30.0, 30.0).steered_by(Controller::patrol(way, true));
    let probe = ProbeSpec { radius: 3.75, mass, speed: 5.0, max_acceleration };
    world.spawn(&probe.into(), placement).unwrap();
    let mut worst: f32 = 0.0;
    for step in 0..900 {
        run(&mut world, &Inputs::new(), 1);
        worst = worst.max(world.quality().ring_error_max);
        for &id in platelets.iter().filter(|_| step % 10 == 0) {
            assert!(is_simple(&outline(&world, id)), "step {step}: folded");
        }
    }
    worst
}

#[test]
fn no_probe_folds_a_platelet_and_one_of_finite_force_hardly_stretches_its_links() {
    let (finite, kinematic) = (worst_link_under(243.0, 400.0), worst_link_under(1e5, 1e6));
    assert!(finite > 0.005 && finite < 0.1, "finite force: {finite}");
    assert!(kinematic < 1.0, "as good as kinematic: {kinematic}");
}
