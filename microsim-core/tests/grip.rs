//! Crawling needs a grip where the world says that the slide gives none.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Crawl, FluidBlockSpec, Inputs, Intent, OrganismId, OrganismSpec, Placement,
    RigidCellSpec, Substrate, World, WorldConfig,
};

const GRAVITY: f32 = 30.0;

fn room(gravity: f32) -> World {
    let config = WorldConfig {
        gravity: Vec2::new(0.0, -gravity),
        damping: 0.0,
        max_speed: 60.0,
        substrate: Substrate::Surfaces,
        ..WorldConfig::default()
    };
    World::new(config).unwrap()
}

/// Each kind of cell that crawls.
fn cells() -> [OrganismSpec; 3] {
    let neutrophil = AmoeboidCellSpec { crawl: Crawl::Neutrophil, ..AmoeboidCellSpec::default() };
    [AmoeboidCellSpec::default().into(), neutrophil.into(), RigidCellSpec::default().into()]
}

fn to(id: OrganismId, x: f32, y: f32) -> Inputs {
    let mut inputs = Inputs::new();
    inputs.set(id, Intent::toward(Vec2::new(x, y)).unwrap());
    inputs
}

fn run(world: &mut World, inputs: &Inputs, steps: u32) {
    (0..steps).for_each(|_| world.step(inputs));
    world.validate().unwrap();
}

/// A cell that lies on the floor.
fn lying(spec: &OrganismSpec) -> (World, OrganismId) {
    let mut world = room(GRAVITY);
    let cell = world.spawn(spec, Placement::at(60.0, spec.extent().unwrap() + 0.2)).unwrap();
    run(&mut world, &Inputs::new(), 240);
    (world, cell)
}

/// How high a cell rises after a push of 30 units/s, over how high a ball of its velocity would fly.
fn jump(spec: &OrganismSpec, is_driven: bool) -> f32 {
    let (mut world, cell) = lying(spec);
    world.push(cell, Vec2::new(0.0, 30.0)).unwrap();
    let view = |world: &World| world.view().organism(cell).map(|it| (it.centre_of_mass().y, it.velocity().y)).unwrap();
    let (ground, speed) = view(&world);
    let inputs = if is_driven { to(cell, 150.0, 80.0) } else { Inputs::new() };
    let heights = (0..80).map(|_| {
        world.step(&inputs);
        view(&world).0 - ground
    });
    heights.fold(0.0, f32::max) / (speed * speed / (2.0 * GRAVITY))
}

#[test]
fn a_jump_is_as_high_as_a_ball_would_fly_however_the_cell_is_driven() {
    for spec in cells() {
        let heights = [false, true].map(|is_driven| jump(&spec, is_driven));
        println!("{:?}: {heights:?} of the ballistic height", spec.kind());
        assert!(heights.iter().all(|height| (height - 1.0).abs() < 0.1), "{:?}: {heights:?}", spec.kind());
    }
}

#[test]
fn a_driven_cell_in_the_air_falls_like_any_other() {
    for spec in cells() {
        let mut world = room(GRAVITY);
        let cell = world.spawn(&spec, Placement::at(60.0, 75.0)).unwrap();
        run(&mut world, &to(cell, 150.0, 80.0), 60);
        let fallen = Vec2::new(60.0, 75.0) - world.centroid(cell).unwrap();
        println!("{:?} fallen {fallen}", spec.kind());
        assert!((fallen.y / (0.5 * GRAVITY) - 1.0).abs() < 0.05 && fallen.x.abs() < 0.5, "{:?}: {fallen}", spec.kind());
    }
}

#[test]
fn a_cell_crawls_along_the_floor_and_does_not_leave_it() {
    for spec in cells() {
        let (mut world, cell) = lying(&spec);
        let before = world.centroid(cell).unwrap();
        run(&mut world, &to(cell, 150.0, before.y), 240);
        let along = world.centroid(cell).unwrap() - before;
        let above = to(cell, world.centroid(cell).unwrap().x, 85.0);
        run(&mut world, &above, 240);
        let up = world.centroid(cell).unwrap().y - before.y;
        println!("{:?} along {along} up {up}", spec.kind());
        assert!(along.x > 8.0 && along.y < 1.0, "{:?}: {along} in 4 s", spec.kind());
        assert!(up < 1.0, "{:?}: {up}", spec.kind());
    }
}

#[test]
fn who_holds_on_to_another_pulls_it_the_other_way() {
    for other in [OrganismSpec::from(AgarSpec::default()), AmoeboidCellSpec::default().into()] {
        let mut world = room(0.0);
        let cell = world.spawn(&RigidCellSpec::default().into(), Placement::at(60.0, 40.0)).unwrap();
        let beside = |k: u8| Placement::at(60.0, 40.0 + 0.1 * f32::from(k));
        let other = (0..200).find_map(|k| world.spawn(&other, beside(k)).ok()).unwrap();
        let view = |world: &World, id| world.view().organism(id).map(|it| (it.velocity(), it.mass())).unwrap();
        let mut fastest = 0.0f32;
        for _ in 0..60 {
            run(&mut world, &to(cell, 150.0, 40.0), 1);
            let [(own, mass), (others, other_mass)] = [cell, other].map(|id| view(&world, id));
            let sum = own * mass + others * other_mass;
            assert!(sum.length() < 1e-3 * 8.0 * mass, "momentum {sum} of {own} and {others}");
            fastest = fastest.max((own - others).length());
        }
        assert!(fastest > 1.0 && fastest < 20.0, "{:?}: {fastest}", world.kind(other));
    }
}

#[test]
fn fluid_is_no_ground() {
    let mut world = room(0.0);
    let spec = OrganismSpec::from(AmoeboidCellSpec::default());
    let cell = world.spawn(&spec, Placement::at(60.0, 45.0)).unwrap();
    let block = FluidBlockSpec { size: Vec2::new(4.0, 24.0), ..FluidBlockSpec::default() };
    let beside = 60.0 - spec.extent().unwrap() - 2.5;
    world.spawn(&block.into(), Placement::at(beside, 45.0)).unwrap();
    world.push(cell, Vec2::new(-1.0, 0.0)).unwrap();
    run(&mut world, &to(cell, 60.0, 85.0), 120);
    let moved = world.centroid(cell).unwrap().y - 45.0;
    assert!(moved.abs() < 0.5, "it pulled itself along by {moved}");
}
