//! Emitters, drains and open sides.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::{
    Actuation, AgarSpec, AmoeboidCellSpec, Drain, Emitter, Event, FluidBlockSpec, FluidParams, Inputs, Kind, Node,
    OrganismId, Outlet, Placement, PlateletSpec, Recipe, Region, Side, Sides, Template, Wall, World, WorldConfig,
};

fn room(sides: Sides, gravity: Vec2) -> World {
    World::new(WorldConfig { size: Vec2::new(80.0, 40.0), damping: 0.0, gravity, sides, ..WorldConfig::default() })
        .unwrap()
}

fn ball() -> Recipe {
    Recipe::Organism(AgarSpec { radius: 0.5, ..AgarSpec::default() }.into())
}

fn area(x: [f32; 2], y: [f32; 2]) -> Region {
    Region::Box { low: Vec2::new(x[0], y[0]), high: Vec2::new(x[1], y[1]) }
}

/// Takes steps and counts what is emitted and drained, organisms and particles.
fn run(world: &mut World, steps: u32) -> (usize, usize, u32) {
    let (mut emitted, mut drained, mut particles) = (0, 0, 0);
    for _ in 0..steps {
        world.step(&Inputs::new());
        for event in world.events() {
            match event {
                Event::Emitted { .. } => emitted += 1,
                Event::Drained { particles: count, .. } => (drained, particles) = (drained + 1, particles + count),
                _ => {}
            }
        }
        world.validate().unwrap();
    }
    (emitted, drained, particles)
}

#[test]
fn an_emitter_keeps_its_rate_and_a_drain_takes_what_comes() {
    let mut world = room(Sides::default(), Vec2::ZERO);
    let velocity = Vec2::new(15.0, 0.0);
    let emitter = Emitter { velocity, ..Emitter::new(area([2.0, 4.0], [2.0, 38.0]), ball(), 6.0) };
    let emitter = world.add_emitter(emitter).unwrap();
    let drain = world.add_drain(Drain { region: area([60.0, 80.0], [0.0, 40.0]), kind: None }).unwrap();
    let (emitted, drained, _) = run(&mut world, 600);
    assert!((58..=60).contains(&emitted), "{emitted} in 10 s at 6 a second");
    assert_eq!(world.organisms().count(), emitted - drained);
    // 57 units at 15 units/s.
    assert!((drained as f32 / (6.0 * (10.0 - 3.8)) - 1.0).abs() < 0.1, "{drained}");
    world.remove_emitter(emitter).unwrap();
    let balls = world.organisms().count();
    world.set_drain(drain, Drain { region: Region::All, kind: Some(Kind::Platelet) }).unwrap();
    let platelet = world.spawn(&PlateletSpec::default().into(), Placement::at(10.0, 20.0)).unwrap();
    world.step(&Inputs::new());
    let gone = |event: &Event| match *event {
        Event::Drained { outlet, organism, kind, .. } => Some((outlet, organism, kind)),
        _ => None,
    };
    let gone: Vec<_> = world.events().iter().filter_map(gone).collect();
    assert_eq!(gone, [(Outlet::Drain(drain), platelet, Kind::Platelet)]);
    assert_eq!((world.kind(platelet), world.organisms().count()), (None, balls), "no ball goes");
}

#[test]
fn an_emitter_without_room_waits_and_makes_up_for_nothing() {
    let mut world = room(Sides::default(), Vec2::ZERO);
    let spot = Region::Circle { centre: Vec2::new(20.0, 20.0), radius: 0.0 };
    world.add_emitter(Emitter::new(spot, ball(), 30.0)).unwrap();
    assert_eq!(run(&mut world, 120).0, 1);
    let first = world.organisms().next().unwrap();
    world.remove(first).unwrap();
    assert_eq!(run(&mut world, 4).0, 1);
}

#[test]
fn a_template_is_emitted_in_its_direction_at_its_speed() {
    let mut world = room(Sides::default(), Vec2::ZERO);
    let mut builder = Template::builder();
    let _ = [0.0, 2.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    let template = world.add_template(builder.build().unwrap());
    let (velocity, angle) = (Vec2::new(0.0, 3.0), Some(0.0));
    let spot = Region::Circle { centre: Vec2::new(20.0, 20.0), radius: 0.0 };
    world.add_emitter(Emitter { velocity, angle, ..Emitter::new(spot, Recipe::Template(template), 60.0) }).unwrap();
    run(&mut world, 1);
    let body = world.view().organisms().next().unwrap();
    assert_eq!((body.kind(), body.velocity(), body.angle()), (Kind::Custom(template), velocity, Some(0.0)));
}

fn water(world: &mut World, x: f32, y: f32) -> OrganismId {
    let fluid = FluidParams { spacing: 1.0, ..FluidParams::default() };
    world.spawn(&FluidBlockSpec { size: Vec2::new(8.0, 8.0), fluid }.into(), Placement::at(x, y)).unwrap()
}

#[test]
fn fluid_goes_particle_by_particle_and_its_organism_with_the_last() {
    let mut world = room(Sides::default(), Vec2::ZERO);
    let water = water(&mut world, 20.0, 20.0);
    let all = world.view().organism(water).unwrap().particles().count() as u32;
    let drain = world.add_drain(Drain { region: area([20.0, 80.0], [0.0, 40.0]), kind: None }).unwrap();
    let (_, drained, half) = run(&mut world, 1);
    assert!(drained == 1 && half.abs_diff(all / 2) <= all / 8, "{half} of {all}");
    assert_eq!(world.view().organism(water).unwrap().particles().count() as u32, all - half);
    world.set_drain(drain, Drain { region: Region::All, kind: Some(Kind::FluidBlock) }).unwrap();
    assert_eq!(run(&mut world, 1), (0, 1, all - half));
    assert_eq!((world.kind(water), world.census().particles), (None, 0));
}

#[test]
fn what_is_beyond_an_open_side_is_gone_and_other_sides_hold() {
    let right = Sides { right: Side::Open, ..Sides::default() };
    let mut world = room(right, Vec2::new(30.0, 0.0));
    let ball = world.spawn(&AgarSpec::default().into(), Placement::at(70.0, 20.0)).unwrap();
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(50.0, 20.0)).unwrap();
    let water = water(&mut world, 20.0, 30.0);
    let all = world.census().particles;
    let (_, _, gone) = run(&mut world, 300);
    assert_eq!([ball, cell, water].map(|id| world.kind(id)), [None; 3]);
    assert_eq!((gone as u64, world.organisms().count()), (all as u64, 0));
    let mut world = room(right, Vec2::new(-30.0, 0.0));
    let ball = world.spawn(&AgarSpec::default().into(), Placement::at(70.0, 20.0)).unwrap();
    run(&mut world, 300);
    assert!(world.centroid(ball).is_some_and(|at| at.x < 2.0), "the left side is a wall");
    world.push(ball, Vec2::new(20.0, 0.0)).unwrap();
    world.set_gravity(Vec2::ZERO).unwrap();
    let mut last = Vec::new();
    for _ in 0..400 {
        world.step(&Inputs::new());
        last.extend(world.events().iter().filter(|event| matches!(event, Event::Drained { .. })).copied());
    }
    assert_eq!(
        last,
        [Event::Drained { outlet: Outlet::Side(Wall::Right), organism: ball, kind: Kind::Agar, particles: 1 }]
    );
}

#[test]
fn supplies_are_part_of_the_future_and_of_the_digest() {
    let build = || {
        let mut world = room(Sides { top: Side::Open, ..Sides::default() }, Vec2::new(0.0, 5.0));
        world.add_emitter(Emitter::new(area([2.0, 78.0], [2.0, 10.0]), ball(), 25.0)).unwrap();
        world.add_drain(Drain { region: area([30.0, 50.0], [20.0, 30.0]), kind: None }).unwrap();
        world
    };
    let (mut one, mut other) = (build(), build());
    run(&mut one, 200);
    run(&mut other, 100);
    let mut other = other.clone();
    assert_ne!(one.digest(), other.digest());
    run(&mut other, 100);
    assert_eq!(one.digest(), other.digest());
    let id = one.emitters().next().unwrap().0;
    let emitter = one.emitters().next().unwrap().1.clone();
    one.set_emitter(id, Emitter { rate: 26.0, ..emitter }).unwrap();
    assert_ne!(one.digest(), other.digest());
}

#[test]
fn a_drain_takes_a_cell_by_its_centre_not_by_one_of_its_nodes() {
    let mut world = room(Sides::default(), Vec2::ZERO);
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 20.0)).unwrap();
    let right = world.add_drain(Drain { region: area([43.0, 80.0], [0.0, 40.0]), kind: None }).unwrap();
    assert_eq!(run(&mut world, 2).1, 0, "only its right half is in the drain");
    world.set_drain(right, Drain { region: area([39.0, 41.0], [19.0, 21.0]), kind: None }).unwrap();
    assert_eq!(run(&mut world, 1).1, 1);
    assert!(world.view().organism(cell).is_none());
}

/// One of many regions that overlap.
fn region(k: u32) -> Region {
    match (k % 3, (k * 17 % 80) as f32, (k * 7 % 40) as f32) {
        (0, x, y) => Region::Circle { centre: Vec2::new(x, y), radius: 6.0 },
        (1, x, _) => area([x, x + 3.0], [0.0, 40.0]),
        (_, x, y) => area([x - 5.0, x], [y - 5.0, y]),
    }
}

#[test]
fn of_many_drains_the_first_that_holds_something_takes_it() {
    let mut world = room(Sides::default(), Vec2::ZERO);
    let places = (0..150).map(|k| Vec2::new(2.0 + 3.9 * (k % 15) as f32, 2.0 + 3.9 * (k / 15) as f32));
    let balls: Vec<(OrganismId, Vec2)> =
        places.map(|at| (world.spawn(&AgarSpec::default().into(), Placement::at(at.x, at.y)).unwrap(), at)).collect();
    let water = water(&mut world, 70.0, 20.0);
    let regions: Vec<Region> = (0..60).map(region).collect();
    let drains = regions.iter().map(|&region| world.add_drain(Drain { region, kind: None }).unwrap());
    let drains: Vec<_> = drains.collect();
    let (mut left, mut taken) = (0, 0);
    world.step(&Inputs::new());
    for (ball, at) in balls {
        let drained = world.events().iter().find_map(|event| match *event {
            Event::Drained { outlet, organism, .. } if organism == ball => Some(outlet),
            _ => None,
        });
        let first = regions.iter().position(|region| region.contains(at)).map(|k| Outlet::Drain(drains[k]));
        assert_eq!((drained, world.kind(ball).is_none()), (first, first.is_some()), "{at}");
        (left, taken) = (left + usize::from(first.is_none()), taken + usize::from(first.is_some()));
    }
    assert!(left > 20 && taken > 20, "{left} left, {taken} taken");
    let in_drain = |at: Vec2| regions.iter().any(|region| region.contains(at));
    let water = world.view().organism(water).unwrap();
    assert!(water.particles().count() > 0 && water.particles().all(|particle| !in_drain(particle.position)));
    world.validate().unwrap();
}

#[test]
fn a_body_longer_than_the_room_leaves_by_an_open_side() {
    let sides = Sides { top: Side::Open, ..Sides::default() };
    let size = Vec2::new(40.0, 6.0);
    let mut world = World::new(WorldConfig { size, damping: 0.0, sides, ..WorldConfig::default() }).unwrap();
    let mut builder = Template::builder();
    let [left, right] = [-5.0, 5.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.6)));
    builder.link(left, right, 0.0);
    let template = world.add_template(builder.build().unwrap());
    let rod = world.spawn_template(template, Placement::at(20.0, 5.0)).unwrap();
    // It goes up at 4 units/s and turns by 2.6 radians/s: it is upright when its middle is out.
    let mut inputs = Inputs::new();
    let throw = Actuation { impulse: Vec2::new(0.0, 8.0), torque: 2.6 * 50.0 * 60.0, ..Actuation::default() };
    inputs.actuate(rod, throw).unwrap();
    world.step(&inputs);
    let mut events = Vec::new();
    for _ in 0..120 {
        world.step(&Inputs::new());
        world.validate().unwrap();
        events.extend(world.events().iter().copied());
    }
    let gone =
        Event::Drained { outlet: Outlet::Side(Wall::Top), organism: rod, kind: Kind::Custom(template), particles: 2 };
    assert_eq!(events, [gone]);
}

#[test]
fn an_emitter_of_what_cannot_be_spawned_is_refused() {
    let mut world = World::new(WorldConfig { dt: 0.1, substeps: 8, ..WorldConfig::default() }).unwrap();
    let cell = Recipe::Organism(AmoeboidCellSpec::default().into());
    assert_eq!(world.add_emitter(Emitter::new(Region::All, cell, 10.0)).unwrap_err().field(), "substeps");
    assert!(world.add_emitter(Emitter::new(Region::All, ball(), 10.0)).is_ok());
}
