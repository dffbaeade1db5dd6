//! Periodic sides and what else is in a room: obstacles that move, sensors, fields, drains, goals, division, files.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Actuation, AgarSpec, CoccusSpec, Collider, Distance, Drain, Emitter, Event, FieldKind, FluidBlockSpec, FluidParams,
    ForceField, Half, Inputs, Intent, JointEnd, JointKind, JointSpec, Node, Obstacle, ObstacleMotion, OrganismId,
    Placement, ProbeSpec, QueryFilter, Region, Side, Sides, Template, World, WorldConfig,
};

const SIZE: Vec2 = Vec2::new(80.0, 60.0);

fn around() -> Sides {
    Sides { left: Side::Periodic, right: Side::Periodic, ..Sides::default() }
}

fn room(gravity: f32) -> World {
    let sides = around();
    let gravity = Vec2::new(0.0, -gravity);
    World::new(WorldConfig { size: SIZE, gravity, damping: 0.0, sides, ..WorldConfig::default() }).unwrap()
}

fn run(world: &mut World, inputs: &Inputs, steps: u32) {
    for _ in 0..steps {
        world.step(inputs);
        world.validate().unwrap();
    }
}

fn agar(world: &mut World, x: f32, y: f32) -> OrganismId {
    world.spawn(&AgarSpec::default().into(), Placement::at(x, y)).unwrap()
}

fn at(world: &World, id: OrganismId) -> Vec2 {
    world.centroid(id).unwrap()
}

fn velocity(world: &World, id: OrganismId) -> Vec2 {
    world.view().organism(id).unwrap().velocity()
}

#[test]
fn an_obstacle_acts_on_both_sides_it_reaches_over() {
    let mut world = room(10.0);
    let shelf = Obstacle::new(SharedShape::cuboid(6.0, 1.0), Pose::translation(78.0, 20.0));
    let id = world.add_obstacle(shelf).unwrap();
    let balls = [76.0, 2.0].map(|x| world.spawn(&AgarSpec::default().into(), Placement::at(x, 25.0)).unwrap());
    let beside = world.spawn(&AgarSpec::default().into(), Placement::at(8.0, 25.0)).unwrap();
    assert!(world.spawn(&AgarSpec::default().into(), Placement::at(3.0, 20.0)).is_err(), "it is in the image");
    run(&mut world, &Inputs::new(), 180);
    for ball in balls {
        assert!((world.centroid(ball).unwrap().y - 22.0).abs() < 0.02, "{}", world.centroid(ball).unwrap());
    }
    assert!(world.centroid(beside).unwrap().y < 2.0);
    let hit = world.queries().cast_ray(Vec2::new(2.0, 15.0), Vec2::Y, 30.0, &QueryFilter::default()).unwrap();
    assert!(hit.collider == Collider::Obstacle(id) && (hit.distance - 4.0).abs() < 1e-3);
    world.remove_obstacle(id).unwrap();
    run(&mut world, &Inputs::new(), 120);
    assert!(balls.iter().all(|&ball| world.centroid(ball).unwrap().y < 2.1), "both fall");
}

#[test]
fn a_lift_wakes_and_raises_what_lies_on_its_image() {
    let mut world = room(10.0);
    let shelf = Obstacle {
        motion: ObstacleMotion::Push,
        ..Obstacle::new(SharedShape::cuboid(5.0, 1.0), Pose::translation(78.0, 20.0))
    };
    let lift = world.add_obstacle(shelf).unwrap();
    let ball = agar(&mut world, 1.5, 22.0);
    run(&mut world, &Inputs::new(), 90);
    assert!(world.view().organism(ball).unwrap().is_at_rest());
    for step in 1..=80u8 {
        world.move_obstacle(lift, Pose::translation(78.0, 20.0 + 0.05 * f32::from(step))).unwrap();
        run(&mut world, &Inputs::new(), 1);
    }
    run(&mut world, &Inputs::new(), 60);
    assert!((at(&world, ball).y - 26.0).abs() < 0.05, "{}", at(&world, ball));
}

#[test]
fn an_obstacle_moves_within_the_room_and_turns_if_it_is_short() {
    let mut world = room(0.0);
    let pushes =
        |shape, x| Obstacle { motion: ObstacleMotion::Push, ..Obstacle::new(shape, Pose::translation(x, 20.0)) };
    let block = world.add_obstacle(pushes(SharedShape::cuboid(4.0, 1.0), 70.0)).unwrap();
    let far = world.move_obstacle(block, Pose::translation(30.0 + 70.0 * SIZE.x, 20.0));
    assert_eq!(far.unwrap_err().field(), "target", "its images would be too far away");
    assert_eq!(world.move_obstacle(block, Pose::translation(84.5, 20.0)).unwrap_err().field(), "target");
    let long = world.add_obstacle(pushes(SharedShape::cuboid(79.5, 0.5), 40.0)).unwrap();
    let longer = world.add_obstacle(pushes(SharedShape::cuboid(1.0, 84.0), 40.0)).unwrap();
    let turned = |x: f32| Pose::new(Vec2::new(x, 20.0), 1.2);
    world.move_obstacle(long, turned(40.0)).unwrap();
    assert_eq!(world.move_obstacle(longer, turned(40.0)).unwrap_err().field(), "target.rotation");
    let hand = SharedShape::cuboid(1.0, 1.0);
    let hand = SharedShape::compound(vec![(Pose::translation(-70.0, 0.0), hand)]);
    let pose = Pose::new(Vec2::new(50.0, 20.0), -0.78);
    let hand = world.add_obstacle(Obstacle { pose, ..pushes(hand, 50.0) }).unwrap();
    world.move_obstacle(hand, Pose::new(Vec2::new(50.0, 20.0), 0.78)).unwrap();
    world.move_obstacle(block, Pose::translation(83.5, 20.0)).unwrap();
    let mut swings_out = false;
    for _ in 0..800 {
        run(&mut world, &Inputs::new(), 1);
        let hand = world.obstacle(hand).unwrap();
        swings_out |= hand.shape.compute_aabb(&hand.pose).maxs.x < 0.0;
        #[cfg(feature = "snapshot")]
        World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
    }
    assert!(swings_out, "and is read there");
    assert!([long, hand, block].iter().all(|&id| world.obstacle_target(id).is_none()), "they have arrived");
}

#[test]
fn a_sensor_is_entered_over_a_side() {
    let mut world = room(0.0);
    let zone =
        Obstacle { is_sensor: true, ..Obstacle::new(SharedShape::cuboid(3.0, 3.0), Pose::translation(79.0, 30.0)) };
    let zone = world.add_obstacle(zone).unwrap();
    let ball = agar(&mut world, 10.0, 30.0);
    world.push(ball, Vec2::new(-12.0, 0.0)).unwrap();
    let mut places = Vec::new();
    for _ in 0..90 {
        run(&mut world, &Inputs::new(), 1);
        let passes = |event: &&Event| matches!(event, Event::SensorEntered { .. } | Event::SensorLeft { .. });
        places.extend(world.events().iter().filter(passes).map(|_| at(&world, ball).x));
    }
    assert_eq!(places.len(), 2, "{places:?}");
    assert!((places[0] - 3.0).abs() < 0.3 && (places[1] - 75.0).abs() < 0.3, "{places:?}");
    assert_eq!(world.inside_sensor(zone).count(), 0);
}

#[test]
fn a_field_acts_on_what_reaches_over_a_side() {
    let mut world = room(0.0);
    let mut builder = Template::builder();
    let nodes = [-3.0, 3.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    builder.link(nodes[0], nodes[1], 0.0);
    let dumbbell = world.add_template(builder.build().unwrap());
    let id = world.spawn_template(dumbbell, Placement::at(79.0, 30.0)).unwrap();
    let region = Region::Box { low: Vec2::ZERO, high: Vec2::new(10.0, 60.0) };
    world.add_field(ForceField { region, kind: FieldKind::Uniform { acceleration: Vec2::new(0.0, 6.0) } }).unwrap();
    assert_eq!(world.field_at(Vec2::new(82.0, 30.0)), Vec2::new(0.0, 6.0));
    run(&mut world, &Inputs::new(), 20);
    let speed = velocity(&world, id).y;
    assert!((speed - 1.0).abs() < 0.02, "half of it is in the field: {speed}");
    assert!(world.view().organism(id).unwrap().angular_velocity() > 0.1);
}

#[test]
fn a_drain_takes_what_has_come_around() {
    let mut world = room(0.0);
    let ball = agar(&mut world, 75.0, 30.0);
    world.push(ball, Vec2::new(15.0, 0.0)).unwrap();
    world.add_drain(Drain { region: Region::Box { low: Vec2::ZERO, high: Vec2::new(5.0, 60.0) }, kind: None }).unwrap();
    run(&mut world, &Inputs::new(), 40);
    assert_eq!(world.organisms().count(), 0);
}

#[test]
fn an_emitter_finds_no_room_where_an_image_is() {
    let mut world = room(0.0);
    agar(&mut world, 79.5, 30.0);
    let inlet = Region::Box { low: Vec2::new(0.2, 29.5), high: Vec2::new(0.6, 30.5) };
    world.add_emitter(Emitter::new(inlet, microsim_core::Recipe::Organism(AgarSpec::default().into()), 50.0)).unwrap();
    run(&mut world, &Inputs::new(), 30);
    assert_eq!(world.organisms().count(), 1);
}

#[test]
fn goals_and_targets_are_reached_the_short_way() {
    let mut world = room(0.0);
    let probe = world.spawn(&ProbeSpec::default().into(), Placement::at(74.0, 30.0)).unwrap();
    let coccus = world.spawn(&CoccusSpec::default().into(), Placement::at(1.0, 50.0)).unwrap();
    let ball = agar(&mut world, 78.0, 10.0);
    let mut inputs = Inputs::new();
    inputs.set(probe, Intent::toward(Vec2::new(6.0, 30.0)).unwrap());
    inputs.set(coccus, Intent::toward(Vec2::new(-500.0, 50.0)).unwrap());
    inputs.actuate(ball, Actuation::target(Vec2::new(1.0, 10.0))).unwrap();
    let mut across = [false; 3];
    for _ in 0..120 {
        let before = [probe, coccus, ball].map(|id| at(&world, id).x);
        run(&mut world, &inputs, 1);
        for (k, id) in [probe, coccus, ball].into_iter().enumerate() {
            across[k] |= (at(&world, id).x - before[k]).abs() > 40.0;
            assert!((at(&world, id).x - 40.0).abs() > 20.0, "{k} is on a way through the middle");
        }
    }
    assert_eq!(across, [true; 3]);
    assert!((at(&world, ball) - Vec2::new(1.0, 10.0)).length() < 1e-3);
    assert!((at(&world, probe).x - 6.0).abs() < 3.0, "{}", at(&world, probe));
    let fluid = FluidBlockSpec { size: Vec2::splat(6.0), fluid: FluidParams::default() };
    let fluid = world.spawn(&fluid.into(), Placement::at(40.0, 30.0)).unwrap();
    inputs.actuate(fluid, Actuation::torque(5.0)).unwrap();
    assert_eq!(world.check_inputs(&inputs).unwrap_err().field(), "actuation");
    assert_eq!(world.set_angular_damping(fluid, 1.0).unwrap_err().field(), "damping");
    run(&mut world, &inputs, 5);
    assert!(velocity(&world, fluid).length() < 1e-3, "what has no centre is not turned");
}

#[test]
fn a_body_over_a_side_divides_unless_an_image_is_in_the_way() {
    let mut world = room(0.0);
    let mut builder = Template::builder();
    let nodes: Vec<u32> = (0..4u8).map(|k| builder.node(Node::disc(Vec2::new(f32::from(k), 0.0), 0.1, 0.5))).collect();
    for pair in nodes.windows(2) {
        builder.constraint(Distance { a: pair[0], b: pair[1], rest_length: 1.0, compliance: 0.0, damping: 0.0 });
    }
    builder.cut([Half::of(0..2).scaled(0.5).named("rod"), Half::of(2..4).scaled(0.5).named("rod")]).name("rod");
    let rod = world.add_template(builder.build().unwrap());
    let id = world.spawn_template(rod, Placement::at(78.5, 30.0)).unwrap();
    world.divide(id).unwrap();
    run(&mut world, &Inputs::new(), 2);
    assert_eq!(world.organisms().count(), 2);
    assert!(world.organisms().all(|id| (0.0..=SIZE.x).contains(&at(&world, id).x)));
}

#[test]
fn what_such_a_room_cannot_hold_is_refused_by_name() {
    use microsim_core::{AmoeboidCellSpec, ChemicalSpec, Controller, Substrate, YieldingDistance};
    let refused =
        |sides, size| World::new(WorldConfig { sides, size, ..WorldConfig::default() }).unwrap_err().field().to_owned();
    assert_eq!(refused(Sides { right: Side::Wall, ..around() }, SIZE), "sides.right");
    assert_eq!(refused(Sides { bottom: Side::Periodic, top: Side::Open, ..Sides::default() }, SIZE), "sides.top");
    assert_eq!(refused(around(), Vec2::new(80.001, 60.0)), "size.x");
    assert_eq!(refused(around(), Vec2::new(1.0, 60.0)), "size.x");
    World::new(WorldConfig { sides: around(), size: Vec2::new(80.0, 60.001), ..WorldConfig::default() }).unwrap();
    let config = WorldConfig { sides: around(), substrate: Substrate::Surfaces, ..WorldConfig::default() };
    assert_eq!(World::new(config).unwrap_err().field(), "substrate");

    let mut world = room(0.0);
    let before = world.digest();
    let at = || Placement::at(40.0, 30.0);
    let field = |error: microsim_core::Error| error.field().to_owned();
    assert_eq!(field(world.spawn(&AmoeboidCellSpec::default().into(), at()).unwrap_err()), "organism");
    let wide = AgarSpec { radius: 19.0, ..AgarSpec::default() };
    let wide_enough = AgarSpec { radius: 20.0, ..AgarSpec::default() };
    world.clone().spawn(&wide_enough.into(), at()).unwrap();
    assert_eq!(field(world.spawn(&wide.clone().into(), at().scaled(1.2)).unwrap_err()), "width");
    assert_eq!(field(world.spawn(&AgarSpec::default().into(), Placement::at(80.5, 30.0)).unwrap_err()), "at");
    assert_eq!(field(world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 0.5)).unwrap_err()), "at");
    let patrol = Controller::patrol(vec![Vec2::ZERO], false);
    let steered = world.spawn(&ProbeSpec::default().into(), at().steered_by(patrol));
    assert_eq!(field(steered.unwrap_err()), "controller");
    assert_eq!(field(world.add_chemical(ChemicalSpec::default()).unwrap_err()), "chemical");
    let mut builder = Template::builder();
    let [a, b] = [0.0, 2.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    builder.constraint(YieldingDistance::from(Distance { a, b, rest_length: 2.0, compliance: 1e-4, damping: 0.0 }));
    let clay = world.add_template(builder.build().unwrap());
    assert_eq!(field(world.spawn_template(clay, at()).unwrap_err()), "template");
    let fluid = FluidParams { spacing: 11.0, ..FluidParams::default() };
    let coarse = FluidBlockSpec { size: Vec2::splat(30.0), fluid };
    assert_eq!(field(world.spawn(&coarse.into(), at()).unwrap_err()), "spacing");
    assert_eq!(field(world.set_size(Vec2::new(90.0, 60.0)).unwrap_err()), "size.x");
    assert_eq!(field(world.set_max_speed(1000.0).and_then(|()| world.set_max_speed(1500.0)).unwrap_err()), "max_speed");
    let broad = Obstacle::new(SharedShape::cuboid(81.0, 1.0), Pose::translation(40.0, 10.0));
    assert_eq!(field(world.add_obstacle(broad).unwrap_err()), "shape");
    let outside = Obstacle::new(SharedShape::cuboid(1.0, 1.0), Pose::translation(99.0, 10.0));
    assert_eq!(field(world.add_obstacle(outside).unwrap_err()), "pose");
    world.set_max_speed(40.0).unwrap();

    let ball = world.spawn(&wide.into(), at()).unwrap();
    assert_eq!(field(world.set_scale(ball, 1.2).unwrap_err()), "width");
    let joint = |kind| JointSpec::new(JointEnd::Point(Vec2::ZERO), JointEnd::Centre(ball), kind);
    assert_eq!(field(world.add_joint(joint(JointKind::Rope { max_length: 40.0 })).unwrap_err()), "kind.max_length");
    let motor = JointKind::SpeedMotor { speed: 1.0, max_force: 1.0 };
    assert_eq!(field(world.add_joint(joint(motor)).unwrap_err()), "kind");
    let far = JointSpec { a: JointEnd::Point(Vec2::new(10.0, 1.0)), ..joint(JointKind::Weld) };
    assert_eq!(field(world.add_joint(far).unwrap_err()), "kind", "41.7 units, by which it could not turn");
    assert_eq!(field(world.set_controller(ball, Controller::thrash(0.1, 0.1)).unwrap_err()), "controller");
    world.remove(ball).unwrap();
    assert!(before != 0 && world.organisms().count() == 0);
}

#[cfg(all(feature = "scenario", feature = "snapshot"))]
#[test]
fn a_scenario_with_periodic_sides_is_recorded_and_played_again() {
    use microsim_core::replay::{Player, Recorder, Replay};
    use microsim_core::scenario::Scenario;
    use std::num::NonZeroU32;
    let text = r#"
schema = 1
name = "around"
[world]
size = [80.0, 60.0]
[world.sides]
left = "periodic"
right = "periodic"
[[spawn]]
of = "ball"
at = [79.5, 30.0]
[agar.ball]
radius = 1.0
"#;
    assert!(Scenario::parse(&text.replace("right = \"periodic\"\n", ""), &[]).is_err());
    let scenario = Scenario::parse(text, &[]).unwrap();
    let mut run = scenario.build().unwrap();
    let (mut recorder, mut file) = Recorder::new(scenario.origin(), NonZeroU32::MIN);
    for step in 0..60 {
        if step == 5 {
            let id = run.world.organisms().next().unwrap();
            run.world.push(id, Vec2::new(10.0, 0.0)).unwrap();
        }
        run.step(&Inputs::new());
        file.extend(recorder.step(&Inputs::new(), &run.world));
    }
    file.extend(recorder.finish(&run.world));
    let replay = Replay::read(&file).unwrap();
    let mut again = Player::new(&replay).unwrap();
    assert!(again.by_ref().all(|step| step.is_ok()));
    assert_eq!(again.world().digest(), run.world.digest());
    let id = run.world.organisms().next().unwrap();
    assert!(at(&run.world, id).x < 20.0, "{}", at(&run.world, id));
}

#[cfg(feature = "parallel")]
#[test]
fn any_number_of_threads_steps_alike() {
    let digest = || {
        let mut world = room(10.0);
        for k in 0..400u32 {
            let id = agar(&mut world, 2.0 * (k % 40) as f32, 2.0 + 2.5 * (k / 40) as f32);
            world.push(id, Vec2::new(8.0, 0.0)).unwrap();
        }
        let block = FluidBlockSpec { size: Vec2::new(80.0, 25.0), fluid: FluidParams::default() };
        world.spawn(&block.into(), Placement::at(40.0, 45.0)).unwrap();
        run(&mut world, &Inputs::new(), 60);
        world.digest()
    };
    let within = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(digest);
    assert_eq!(within(1), within(3));
}
