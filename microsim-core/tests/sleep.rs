//! Sleep: what lies still costs little and stays as it is to the bit, and whatever would move it wakes it first (T78).
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::{happens, room_with, run, toward};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Controller, Event, Inputs, OrganismId, Placement, PlateletSpec, ProbeSpec, World,
    WorldConfig,
};
use proptest::prelude::*;

/// A room with a field of platelets, three wide, in one block and a bit.
fn field(config: WorldConfig) -> (World, Vec<OrganismId>) {
    let mut world = World::new(config).unwrap();
    let place = |k: u32| Placement::at(60.0 + 5.3 * (k % 3) as f32, 40.0 + 5.3 * (k / 3) as f32);
    let platelets = (0..12).map(|k| world.spawn(&PlateletSpec::default().into(), place(k)).unwrap()).collect();
    (world, platelets)
}

fn probe(world: &mut World, at: Vec2, to: Vec2) -> OrganismId {
    let placement = Placement::at(at.x, at.y).steered_by(Controller::patrol(vec![to], false));
    world.spawn(&ProbeSpec { radius: 2.0, speed: 6.0, ..ProbeSpec::default() }.into(), placement).unwrap()
}

fn are_at_rest(world: &World, all: &[OrganismId]) -> bool {
    all.iter().all(|&id| world.view().organism(id).unwrap().is_at_rest())
}

fn positions(world: &World, id: OrganismId) -> Vec<Vec2> {
    world.view().organism(id).unwrap().particles().map(|particle| particle.position).collect()
}

#[test]
fn what_lies_still_stays_to_the_bit() {
    let (mut world, platelets) = field(WorldConfig::default());
    run(&mut world, &Inputs::new(), 300);
    assert!(are_at_rest(&world, &platelets));
    let positions = |world: &World| platelets.iter().map(|&id| positions(world, id)).collect::<Vec<_>>();
    let before = positions(&world);
    run(&mut world, &Inputs::new(), 300);
    assert_eq!(before, positions(&world));
}

#[test]
fn nothing_sleeps_where_nothing_may() {
    let (mut world, platelets) = field(WorldConfig { sleeps: false, ..WorldConfig::default() });
    run(&mut world, &Inputs::new(), 300);
    assert!(!platelets.iter().any(|&id| are_at_rest(&world, &[id])));
}

/// How far platelets are from where they would be without sleep when a probe has got into them, and checks that it passes
/// without an overlap. After that the two runs part: in a crowd, small differences grow.
fn apart_after_a_probe(from: Vec2, to: Vec2, rest: u32) -> f32 {
    let swept = |sleeps: bool| {
        let (mut world, platelets) = field(WorldConfig { sleeps, ..WorldConfig::default() });
        run(&mut world, &Inputs::new(), rest);
        assert_eq!(are_at_rest(&world, &platelets), sleeps && rest > 100);
        probe(&mut world, from, to);
        run(&mut world, &Inputs::new(), 240);
        let places = platelets.iter().map(|&id| world.centroid(id).unwrap()).collect::<Vec<_>>();
        run(&mut world, &Inputs::new(), 360);
        assert!(world.quality().penetration_max < 0.5, "{:?}", world.quality());
        places
    };
    let apart = swept(true).into_iter().zip(swept(false)).map(|(a, b)| (a - b).length());
    apart.fold(0.0, f32::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn sleepers_wake_before_anything_reaches_them(y in 36.0f32..60.0, to in 36.0f32..60.0, rest in 200u32..260) {
        let apart = apart_after_a_probe(Vec2::new(40.0, y), Vec2::new(90.0, to), rest);
        prop_assert!(apart < 0.5, "a platelet is {apart} away from where it would be");
    }
}

#[test]
fn what_leans_on_something_falls_when_that_is_gone() {
    let gravity = Vec2::new(0.0, -5.0);
    let mut world = World::new(WorldConfig { gravity, ..WorldConfig::default() }).unwrap();
    let agar = |world: &mut World, y: f32| world.spawn(&AgarSpec::default().into(), Placement::at(50.0, y)).unwrap();
    let radius = AgarSpec::default().radius;
    let lower = agar(&mut world, radius);
    let upper = agar(&mut world, 3.0 * radius);
    run(&mut world, &Inputs::new(), 240);
    assert!(are_at_rest(&world, &[lower, upper]));
    for _ in 0..60 {
        world.step(&Inputs::new());
        assert!(!happens(&world, |event| matches!(event, Event::ContactEnded { .. })));
    }
    world.remove(lower).unwrap();
    run(&mut world, &Inputs::new(), 120);
    let height = world.centroid(upper).unwrap().y;
    assert!(height < 1.1 * radius, "it hangs at {height}");
}

#[test]
fn what_sinks_slowly_does_not_fall_asleep() {
    let gravity = Vec2::new(0.0, -0.02);
    let mut world = World::new(WorldConfig { gravity, damping: 2.0, ..WorldConfig::default() }).unwrap();
    let agar = world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 50.0)).unwrap();
    run(&mut world, &Inputs::new(), 1200);
    let sunk = 50.0 - world.centroid(agar).unwrap().y;
    assert!((0.17..0.21).contains(&sunk), "it has sunk by {sunk}");
}

#[test]
fn what_sinks_with_a_share_of_gravity_does_not_fall_asleep() {
    for (gravity, damping, scale) in [(-1.0, 0.0, 0.03), (-10.0, 10.0, 0.02)] {
        let gravity = Vec2::new(0.0, gravity);
        let mut world = World::new(WorldConfig { gravity, damping, ..WorldConfig::default() }).unwrap();
        let agar = world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 50.0)).unwrap();
        world.set_gravity_scale(agar, scale).unwrap();
        run(&mut world, &Inputs::new(), 300);
        let (sunk, fall) = (50.0 - world.centroid(agar).unwrap().y, -gravity.y * scale);
        let expected = if damping > 0.0 { fall / damping * (5.0 - 1.0 / damping) } else { 0.5 * fall * 25.0 };
        assert!((sunk / expected - 1.0).abs() < 0.05, "it has sunk by {sunk}, expected {expected}");
    }
}

#[test]
fn what_is_thrown_up_does_not_fall_asleep_at_the_top() {
    for (gravity, scale) in [(1.0, 0.03), (0.03, 1.0)] {
        let gravity = Vec2::new(0.0, -gravity);
        let mut world = World::new(WorldConfig { gravity, damping: 0.0, ..WorldConfig::default() }).unwrap();
        let agar = world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 50.0)).unwrap();
        world.set_gravity_scale(agar, scale).unwrap();
        world.push(agar, Vec2::new(0.0, 0.05)).unwrap();
        run(&mut world, &Inputs::new(), 600);
        let risen = world.centroid(agar).unwrap().y - 50.0;
        assert!((risen - (0.05 * 10.0 - 0.5 * 0.03 * 100.0)).abs() < 0.02, "gravity {gravity}, {scale} of it: {risen}");
    }
}

// One at a time: an agar and a probe share a block.
#[test]
fn a_push_wakes() {
    let (mut world, agar) = room_with(AgarSpec::default(), 50.0, 50.0);
    run(&mut world, &Inputs::new(), 120);
    assert!(are_at_rest(&world, &[agar]));
    world.push(agar, Vec2::new(1.0, 0.0)).unwrap();
    run(&mut world, &Inputs::new(), 30);
    assert!(world.centroid(agar).unwrap().x > 50.2);
}

#[test]
fn a_command_wakes() {
    let (mut world, probe) = room_with(ProbeSpec::default(), 90.0, 50.0);
    run(&mut world, &Inputs::new(), 120);
    assert!(are_at_rest(&world, &[probe]));
    run(&mut world, &toward(probe, Vec2::new(120.0, 50.0)), 30);
    assert!(world.centroid(probe).unwrap().x > 90.5);
}

#[test]
fn cells_take_sleeping_prey_in() {
    let (mut world, agar) = room_with(AgarSpec::default(), 60.0, 45.0);
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(30.0, 45.0)).unwrap();
    run(&mut world, &Inputs::new(), 120);
    assert!(are_at_rest(&world, &[agar]));
    run(&mut world, &toward(cell, Vec2::new(80.0, 45.0)), 900);
    assert!(world.view().organism(cell).unwrap().meals().any(|(prey, _)| prey == agar), "it lies where it was");
    assert_eq!(world.census().leaks, 0);
}

#[test]
fn a_clone_of_a_sleeping_world_has_the_same_future() {
    let (mut world, platelets) = field(WorldConfig::default());
    run(&mut world, &Inputs::new(), 300);
    let mut clone = world.clone();
    assert!(are_at_rest(&clone, &platelets));
    for world in [&mut world, &mut clone] {
        probe(world, Vec2::new(45.0, 42.0), Vec2::new(90.0, 55.0));
    }
    for _ in 0..300 {
        world.step(&Inputs::new());
        clone.step(&Inputs::new());
        assert_eq!(world.digest(), clone.digest());
    }
}
