//! What an embedder relies on: handles, checked input, queries, events, exemptions.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::{outline, room_with, run, toward};
use microsim_core::glam::Vec2;
use microsim_core::parry2d::math::Pose;
use microsim_core::parry2d::shape::SharedShape;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Collider, Controller, ErrorKind, Event, FluidBlockSpec, Inputs, Kind, Material, Node,
    Obstacle, OrganismId, OrganismSpec, Placement, PlateletSpec, ProbeSpec, QueryFilter, RigidCellSpec, Role, Template,
    World, WorldConfig,
};

fn room() -> World {
    World::new(WorldConfig::default()).unwrap()
}

fn agar(world: &mut World, x: f32, y: f32) -> OrganismId {
    world.spawn(&AgarSpec::default().into(), Placement::at(x, y)).unwrap()
}

#[test]
fn every_bad_setting_of_a_world_is_refused_by_name() {
    let refuse = |config: WorldConfig, field: &str| assert_eq!(World::new(config).unwrap_err().field(), field);
    let config = WorldConfig::default;
    refuse(WorldConfig { size: Vec2::new(f32::NAN, 1.0), ..config() }, "size.x");
    refuse(WorldConfig { size: Vec2::new(10.0, 1e9), ..config() }, "size.y");
    refuse(WorldConfig { dt: 0.0, ..config() }, "dt");
    refuse(WorldConfig { substeps: 0, ..config() }, "substeps");
    refuse(WorldConfig { gravity: Vec2::new(0.0, f32::INFINITY), ..config() }, "gravity.y");
    refuse(WorldConfig { damping: -1.0, ..config() }, "damping");
    refuse(WorldConfig { max_speed: 0.0, ..config() }, "max_speed");
    refuse(WorldConfig { max_particles: 0, ..config() }, "max_particles");
    let message = World::new(WorldConfig { substeps: 99, ..config() }).unwrap_err().to_string();
    assert_eq!(message, "`substeps` is 99, accepted: 1 to 64");
    let damped = |damping| WorldConfig { damping, dt: 0.01, substeps: 10, ..config() };
    assert!(World::new(damped(49.0)).is_ok());
    let message = World::new(damped(51.0)).unwrap_err().to_string();
    assert_eq!(message, "`damping` is 51, accepted: 0 to 50.0 with 10 substeps of a step of 0.01 s");
}

#[test]
fn a_refused_spawn_changes_nothing() {
    let mut world = room();
    agar(&mut world, 50.0, 50.0);
    let before = world.digest();
    let mut refuse = |spec: microsim_core::OrganismSpec, placement: Placement, field: &str| {
        let error = world.spawn(&spec, placement).unwrap_err();
        assert_eq!(error.field(), field, "{error}");
        assert_eq!(world.digest(), before);
        error
    };
    let cell = AmoeboidCellSpec::default;
    let overlap = refuse(cell().into(), Placement::at(55.0, 50.0), "at");
    assert!(overlap.to_string().contains("the agar at [50.0, 50.0]"), "{overlap}");
    let outside = refuse(cell().into(), Placement::at(5.0, 50.0), "at");
    assert!(outside.to_string().contains("0 to 160 by 0 to 90"), "{outside}");
    refuse(AgarSpec { radius: f32::NAN, ..AgarSpec::default() }.into(), Placement::at(9.0, 9.0), "radius");
    refuse(AgarSpec { density: 0.0, ..AgarSpec::default() }.into(), Placement::at(9.0, 9.0), "density");
    refuse(PlateletSpec { satellites: 3, ..PlateletSpec::default() }.into(), Placement::at(9.0, 9.0), "satellites");
    refuse(ProbeSpec { mass: -1.0, ..ProbeSpec::default() }.into(), Placement::at(9.0, 9.0), "mass");
    let fluid = FluidBlockSpec { size: Vec2::new(0.0, 5.0), ..FluidBlockSpec::default() };
    refuse(fluid.into(), Placement::at(9.0, 9.0), "size.x");
    refuse(AgarSpec::default().into(), Placement::at(f32::NAN, 9.0), "at.x");
    refuse(AgarSpec::default().into(), Placement::at(9.0, 9.0).turned(f32::NAN), "angle");
    refuse(AgarSpec::default().into(), Placement::at(9.0, 9.0).scaled(0.0), "scale");
    let wander = Controller::wander([0.0, 1.0], 0.0);
    refuse(AgarSpec::default().into(), Placement::at(9.0, 9.0).steered_by(wander), "controller.interval[0]");
}

#[test]
fn too_many_particles_are_refused() {
    let mut world = World::new(WorldConfig { max_particles: 2, ..WorldConfig::default() }).unwrap();
    agar(&mut world, 10.0, 10.0);
    agar(&mut world, 20.0, 10.0);
    let error = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 10.0)).unwrap_err();
    assert_eq!(error.kind(), &ErrorKind::TooMany { asked: 3, limit: 2 });
}

#[test]
fn stale_handles_name_nothing() {
    let mut world = room();
    let first = agar(&mut world, 10.0, 10.0);
    world.remove(first).unwrap();
    let second = agar(&mut world, 10.0, 10.0);
    assert_eq!(first.index(), second.index(), "the place is used again");
    assert_ne!(first, second);
    assert_eq!((world.kind(first), world.centroid(first)), (None, None));
    assert_eq!(world.kind(second), Some(Kind::Agar));
    assert!(world.view().organism(first).is_none());
    assert_eq!(world.remove(first).unwrap_err().kind(), &ErrorKind::Stale);
    assert_eq!(world.set_exempt(first, second, true).unwrap_err().field(), "a");
    run(&mut world, &toward(first, Vec2::ONE), 3);
    assert_eq!(world.organisms().collect::<Vec<_>>(), [second]);
}

#[test]
fn removal_frees_the_particles_of_every_kind() {
    let mut world = room();
    let specs: [microsim_core::OrganismSpec; 6] = [
        AgarSpec::default().into(),
        PlateletSpec::default().into(),
        ProbeSpec::default().into(),
        RigidCellSpec::default().into(),
        AmoeboidCellSpec::default().into(),
        FluidBlockSpec::default().into(),
    ];
    let spawn_all = |world: &mut World| -> Vec<OrganismId> {
        let place = |k: usize| Placement::at(25.0 + 50.0 * (k % 3) as f32, 25.0 + 40.0 * (k / 3) as f32);
        specs.iter().enumerate().map(|(k, spec)| world.spawn(spec, place(k)).unwrap()).collect()
    };
    let organisms = spawn_all(&mut world);
    let full = world.census();
    for id in organisms {
        world.remove(id).unwrap();
        run(&mut world, &Inputs::new(), 1);
    }
    assert_eq!(world.census(), microsim_core::Census::default());
    spawn_all(&mut world);
    assert_eq!(world.census(), full, "the same again in the freed places");
}

#[test]
fn contacts_begin_once_and_end_once_even_by_removal() {
    let (mut world, a) = room_with(PlateletSpec::default(), 60.0, 45.0);
    let way = Controller::patrol(vec![Vec2::new(54.0, 45.0), Vec2::new(30.0, 45.0)], false);
    let b = world.spawn(&ProbeSpec::default().into(), Placement::at(40.0, 45.0).steered_by(way)).unwrap();
    let mut seen = Vec::new();
    for _ in 0..600 {
        run(&mut world, &Inputs::new(), 1);
        seen.extend_from_slice(world.events());
    }
    assert_eq!(seen, [Event::ContactBegan { a, b }, Event::ContactEnded { a, b }]);

    let mut world = room();
    let a = agar(&mut world, 50.0, 50.0);
    let b = agar(&mut world, 52.0 - 0.02, 50.0);
    run(&mut world, &Inputs::new(), 1);
    assert_eq!(world.events(), [Event::ContactBegan { a, b }]);
    world.remove(b).unwrap();
    run(&mut world, &Inputs::new(), 1);
    assert_eq!(world.events(), [Event::ContactEnded { a, b }]);
    run(&mut world, &Inputs::new(), 1);
    assert!(world.events().is_empty());
}

#[test]
fn nothing_is_spawned_inside_a_membrane() {
    let mut world = room();
    let radii = Vec2::splat(20.0);
    let cell = OrganismSpec::from(AmoeboidCellSpec { radii, node_radius: 1.5, ..AmoeboidCellSpec::default() });
    world.spawn(&cell, Placement::at(50.0, 50.0)).unwrap();
    // Small enough for the gaps of the cytoplasm.
    let dust = OrganismSpec::from(ProbeSpec { radius: 0.1, ..ProbeSpec::default() });
    for k in 0..400 {
        let at = Placement::at(40.0 + (k % 20) as f32, 40.0 + 0.98 * (k / 20) as f32);
        let error = world.spawn(&dust, at).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::Overlap { .. }), "{error}");
    }
    world.spawn(&dust, Placement::at(75.0, 50.0)).unwrap();
    for k in 0..25 {
        let at = Placement::at(96.0 + 0.3 * (k % 5) as f32, 30.0 + 0.3 * (k / 5) as f32);
        let mut world = room();
        world.spawn(&dust, Placement::at(96.0, 30.0)).unwrap();
        let error = world.spawn(&cell, at).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::Overlap { .. }), "around dust: {error}");
    }
}

#[test]
fn exempt_organisms_pass_through_each_other() {
    let passes = |is_exempt: bool| {
        let mut world = room();
        let way = Controller::patrol(vec![Vec2::new(120.0, 45.0)], false);
        let spec = ProbeSpec { mass: 1.0, radius: 2.0, ..ProbeSpec::default() };
        let probe = world.spawn(&spec.into(), Placement::at(40.0, 45.0).steered_by(way)).unwrap();
        let heavy = ProbeSpec { mass: 1e4, ..ProbeSpec::default() };
        let post = world.spawn(&heavy.into(), Placement::at(70.0, 45.0)).unwrap();
        world.set_exempt(probe, post, is_exempt).unwrap();
        run(&mut world, &Inputs::new(), 600);
        world.centroid(probe).unwrap().x > world.centroid(post).unwrap().x
    };
    assert!(passes(true) && !passes(false));
}

#[test]
fn obstacles_of_any_shape_hold_organisms_back() {
    let shapes = [
        SharedShape::cuboid(2.0, 20.0),
        SharedShape::capsule(Vec2::new(0.0, -20.0), Vec2::new(0.0, 20.0), 2.0),
        SharedShape::convex_hull(&[Vec2::new(-2.0, -20.0), Vec2::new(2.0, 0.0), Vec2::new(-2.0, 20.0)]).unwrap(),
        SharedShape::compound(vec![
            (Pose::translation(0.0, 10.0), SharedShape::cuboid(2.0, 10.0)),
            (Pose::translation(0.0, -10.0), SharedShape::cuboid(2.0, 10.0)),
        ]),
    ];
    for shape in shapes {
        let mut world = room();
        world.add_obstacle(Obstacle::new(shape, Pose::translation(70.0, 45.0))).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 45.0)).unwrap();
        run(&mut world, &toward(cell, Vec2::new(150.0, 45.0)), 300);
        let view = world.view().organism(cell).unwrap();
        assert!(view.particles().all(|p| p.position.x < 70.0), "behind the obstacle");
        assert_eq!(world.obstacles().count(), 1);
        let error = world.spawn(&AgarSpec::default().into(), Placement::at(70.0, 45.0)).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::Overlap { with } if with == "an obstacle"), "{error}");
    }
}

#[test]
fn bad_obstacles_are_refused_by_name() {
    let mut world = room();
    let good = || Obstacle::new(SharedShape::ball(1.0), Pose::translation(10.0, 10.0));
    let mut refuse = |obstacle: Obstacle, field: &str| {
        assert_eq!(world.add_obstacle(obstacle).unwrap_err().field(), field);
    };
    refuse(Obstacle { pose: Pose::translation(f32::NAN, 0.0), ..good() }, "pose.translation.x");
    refuse(Obstacle { material: Material { friction: -1.0, restitution: 0.0 }, ..good() }, "material.friction");
    refuse(Obstacle { material: Material { friction: 0.0, restitution: 2.0 }, ..good() }, "material.restitution");
    refuse(Obstacle { shape: SharedShape::ball(f32::INFINITY), ..good() }, "shape");
}

#[test]
fn queries_find_what_is_there() {
    let (mut world, cell) = room_with(AmoeboidCellSpec::default(), 40.0, 45.0);
    let pellet = agar(&mut world, 60.0, 45.0);
    let at = |x, y| world.organisms_at(Vec2::new(x, y)).collect::<Vec<_>>();
    assert_eq!(at(40.0, 45.0), [cell]);
    assert_eq!(at(60.5, 45.0), [pellet]);
    assert!(at(80.0, 45.0).is_empty());
    let near = |radius| world.organisms_in_circle(Vec2::new(55.0, 45.0), radius).collect::<Vec<_>>();
    assert!(near(3.0).is_empty());
    assert_eq!(near(4.5), [cell, pellet]);
    let boxed: Vec<_> = world.organisms_in_box(Vec2::new(58.0, 40.0), Vec2::new(90.0, 50.0)).collect();
    assert_eq!(boxed, [pellet]);
    let (queries, filter) = (world.queries(), QueryFilter::organisms());
    let hit = queries.cast_ray(Vec2::new(100.0, 45.0), Vec2::NEG_X, 1000.0, &filter).unwrap();
    assert_eq!(hit.collider, Collider::Organism(pellet));
    assert!((hit.distance - 39.0).abs() < 1e-3 && (hit.normal - Vec2::X).length() < 1e-4);
    assert_eq!(queries.cast_ray(Vec2::new(100.0, 45.0), Vec2::NEG_X, 30.0, &filter), None);
    assert_eq!(queries.cast_ray(Vec2::new(100.0, 45.0), Vec2::ZERO, 30.0, &filter), None);
    assert_eq!(queries.cast_ray(Vec2::NAN, Vec2::X, 30.0, &filter), None);
}

#[test]
fn templates_of_equal_shape_are_shared_and_scaled() {
    let mut world = room();
    let mut builder = Template::builder();
    let ring: Vec<u32> = [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y]
        .into_iter()
        .map(|at| builder.node(Node { role: Role::Membrane, ..Node::disc(at, 1.0, 0.5) }))
        .collect();
    builder.ring(&ring, 0.0).outline(&ring);
    let template = builder.build().unwrap();
    let id = world.add_template(template.clone());
    assert_eq!(world.add_template(template), id);
    let small = world.spawn_template(id, Placement::at(20.0, 20.0)).unwrap();
    let large = world.spawn_template(id, Placement::at(40.0, 20.0).scaled(3.0)).unwrap();
    run(&mut world, &Inputs::new(), 60);
    let side = |world: &World, organism| {
        let outline = outline(world, organism);
        (outline[1] - outline[0]).length()
    };
    assert!((side(&world, large) / side(&world, small) - 3.0).abs() < 1e-3);
    assert_eq!(world.kind(small), Some(Kind::Custom(id)));
    let other = World::new(WorldConfig::default()).unwrap().spawn_template(id, Placement::at(20.0, 20.0));
    assert_eq!(other.unwrap_err().kind(), &ErrorKind::Stale);
}

/// A disc of radius 1 and this material.
fn spawn_ball(world: &mut World, material: Material, placement: Placement) -> OrganismId {
    let mut builder = Template::builder();
    builder.node(Node { material, ..Node::disc(Vec2::ZERO, 1.0, 1.0) });
    let ball = world.add_template(builder.build().unwrap());
    world.spawn_template(ball, placement).unwrap()
}

#[test]
fn restitution_and_friction_are_material_parameters() {
    let bounce = |restitution: f32| {
        let config = WorldConfig { gravity: Vec2::new(0.0, -20.0), damping: 0.0, ..WorldConfig::default() };
        let mut world = World::new(config).unwrap();
        let ball = spawn_ball(&mut world, Material { friction: 0.0, restitution }, Placement::at(80.0, 6.0));
        let mut heights = Vec::new();
        for _ in 0..120 {
            run(&mut world, &Inputs::new(), 1);
            heights.push(world.centroid(ball).unwrap().y - 1.0);
        }
        let lowest = (0..120).find(|&k| heights[k] < 0.1).unwrap();
        heights[lowest..].iter().copied().fold(0.0, f32::max)
    };
    assert!(bounce(0.0) < 0.1, "{}", bounce(0.0));
    // A drop of 5 with e = 0.8 comes back to 0.64 of it.
    assert!((bounce(0.8) - 3.2).abs() < 0.4, "{}", bounce(0.8));
}

#[test]
fn a_slope_holds_what_is_rough_and_lets_slide_what_is_smooth() {
    let slide = |friction: f32| {
        let config = WorldConfig { gravity: Vec2::new(3.0, -10.0), damping: 0.0, ..WorldConfig::default() };
        let mut world = World::new(config).unwrap();
        let mut floor = Obstacle::new(SharedShape::cuboid(80.0, 2.0), Pose::translation(80.0, 2.0));
        let material = Material { friction, restitution: 0.0 };
        floor.material = material;
        world.add_obstacle(floor).unwrap();
        let ball = spawn_ball(&mut world, material, Placement::at(30.0, 5.0));
        run(&mut world, &Inputs::new(), 120);
        world.centroid(ball).unwrap().x - 30.0
    };
    assert!(slide(0.0) > 5.0, "{}", slide(0.0));
    assert!(slide(1.0) < 0.2, "{}", slide(1.0));
}

#[test]
fn what_is_spawned_with_an_overlap_is_pushed_apart() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let pellet = OrganismSpec::from(AgarSpec { radius: 1.0, ..AgarSpec::default() });
    let first = world.spawn(&pellet, Placement::at(40.0, 40.0)).unwrap();
    let near = Placement::at(41.85, 40.0);
    assert_eq!(world.spawn(&pellet, near.clone()).unwrap_err().field(), "at");
    assert_eq!(world.spawn(&pellet, near.clone().overlapping(0.6)).unwrap_err().field(), "overlap");
    let second = world.spawn(&pellet, near.overlapping(0.1)).unwrap();
    let apart = |world: &World| world.centroid(first).unwrap().distance(world.centroid(second).unwrap());
    assert!(apart(&world) < 1.86);
    world.step(&Inputs::new());
    assert!(apart(&world) > 1.99, "{}", apart(&world));
    // A cell could be entered, and an obstacle too: they keep to a touch.
    let cell = OrganismSpec::from(AmoeboidCellSpec::default());
    assert_eq!(world.spawn(&cell, Placement::at(46.0, 40.0).overlapping(0.1)).unwrap_err().field(), "at");
    world.add_obstacle(Obstacle::new(SharedShape::ball(2.0), Pose::translation(80.0, 40.0))).unwrap();
    let inside = Placement::at(82.9, 40.0).overlapping(0.1);
    assert_eq!(world.spawn(&pellet, inside).unwrap_err().field(), "at");
}
