//! Joints by the laws of mechanics, and what becomes of them.

use microsim_core::geometry::ring::unit_vector;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AmoeboidCellSpec, Error, Event, Inputs, JointEnd, JointId, JointKind, JointSpec, Node, Obstacle, ObstacleId,
    ObstacleMotion, OrganismId, Placement, Template, World, WorldConfig,
};
use std::f32::consts::TAU;

/// A room without drag.
fn room(gravity: f32, substeps: u32) -> World {
    let gravity = Vec2::new(0.0, -gravity);
    World::new(WorldConfig { gravity, substeps, damping: 0.0, max_speed: 100.0, ..WorldConfig::default() }).unwrap()
}

/// A disc of this mass.
fn disc(world: &mut World, at: Vec2, mass: f32) -> OrganismId {
    let mut builder = Template::builder();
    builder.node(Node::disc(Vec2::ZERO, mass, 0.5));
    let template = world.add_template(builder.build().unwrap());
    world.spawn_template(template, Placement::at(at.x, at.y)).unwrap()
}

fn node(organism: OrganismId) -> JointEnd {
    JointEnd::Node { organism, node: 0 }
}

fn join(world: &mut World, a: JointEnd, b: JointEnd, kind: JointKind) -> JointId {
    world.add_joint(JointSpec::new(a, b, kind)).unwrap()
}

fn run(world: &mut World, seconds: f32) {
    (0..(seconds * 60.0 + 0.5) as u32).for_each(|_| world.step(&Inputs::new()));
}

fn at(world: &World, id: OrganismId) -> Vec2 {
    world.centroid(id).unwrap()
}

/// Mean time between two passages of a coordinate through a value in one direction.
fn period(world: &mut World, seconds: f32, coordinate: impl Fn(&World) -> f32) -> f32 {
    let (mut before, mut passages) = (coordinate(world), Vec::new());
    for step in 1..=(seconds * 60.0) as u32 {
        world.step(&Inputs::new());
        let now = coordinate(world);
        if before < 0.0 && now >= 0.0 {
            passages.push((step as f32 - now / (now - before)) / 60.0);
        }
        before = now;
    }
    (passages.last().unwrap() - passages[0]) / (passages.len() - 1) as f32
}

#[test]
fn a_pendulum_has_its_period() {
    for substeps in [4, 8, 32] {
        let mut world = room(10.0, substeps);
        let bob = disc(&mut world, Vec2::new(81.0, 30.0), 2.0);
        let nail = JointEnd::Point(Vec2::new(80.0, 50.0));
        let length = Vec2::new(1.0, 20.0).length();
        join(&mut world, nail, node(bob), JointKind::Distance { length });
        let found = period(&mut world, 30.0, |world| at(world, bob).x - 80.0);
        let expected = TAU * (length / 10.0).sqrt();
        assert!((found / expected - 1.0).abs() < 0.01, "{substeps}: {found} instead of {expected}");
    }
}

#[test]
fn a_spring_has_its_frequency_with_the_masses_of_both() {
    for (substeps, frequency) in [(2, 1.0), (8, 1.0), (8, 3.0), (32, 3.0)] {
        let mut world = room(0.0, substeps);
        let [a, b] = [76.0, 84.0].map(|x| disc(&mut world, Vec2::new(x, 45.0), 1.0 + (x - 76.0) / 4.0));
        join(&mut world, node(a), node(b), JointKind::Spring { length: 7.0, frequency, damping_ratio: 0.0 });
        let found = period(&mut world, 6.0, |world| at(world, b).x - at(world, a).x - 7.0);
        assert!((found * frequency - 1.0).abs() < 0.02, "{substeps}: {found} s at {frequency} Hz");
        let (x, y) = (at(&world, a), at(&world, b));
        assert!(((x + 3.0 * y) / 4.0 - Vec2::new(82.0, 45.0)).length() < 1e-3, "momentum");
    }
}

#[test]
fn a_frequency_that_substeps_are_too_long_for_is_refused_and_those_below_keep_their_damping_ratio() {
    let mut world = room(0.0, 8);
    let body = disc(&mut world, Vec2::new(82.5, 45.0), 3.0);
    let place = JointEnd::Point(Vec2::new(60.0, 45.0));
    let spring = |frequency| JointKind::Spring { length: 22.0, frequency, damping_ratio: 0.0 };
    let joint = join(&mut world, place, node(body), spring(19.0));
    let refusal = world.set_joint(joint, JointSpec::new(place, node(body), spring(19.2))).unwrap_err();
    assert_eq!(refusal.field(), "kind.frequency");
    assert!(refusal.to_string().contains("0.01 to 19.1 with 8 substeps"), "{refusal}");
    (0..60).for_each(|_| world.step(&Inputs::new()));
    // Of 0.5 nineteen periods with a damping ratio of 0.01 leave 0.15.
    let swings = (0..6).any(|_| {
        world.step(&Inputs::new());
        (at(&world, body).x - 82.0).abs() > 0.15
    });
    assert!(swings);
}

#[test]
fn a_critically_damped_spring_does_not_swing() {
    let mut world = room(0.0, 8);
    let body = disc(&mut world, Vec2::new(84.0, 45.0), 3.0);
    let place = JointEnd::Point(Vec2::new(80.0, 45.0));
    join(&mut world, place, node(body), JointKind::Spring { length: 2.0, frequency: 2.0, damping_ratio: 1.0 });
    for _ in 0..120 {
        world.step(&Inputs::new());
        assert!(at(&world, body).x > 81.99);
    }
    assert!((at(&world, body).x - 82.0).abs() < 0.01);
}

#[test]
fn a_hanging_weight_has_its_force_and_breaks_what_is_weaker() {
    let hang = |break_force: f32| {
        let mut world = room(10.0, 8);
        let body = disc(&mut world, Vec2::new(80.0, 40.0), 3.0);
        let nail = JointEnd::Point(Vec2::new(80.0, 50.0));
        let spec = JointSpec::new(nail, JointEnd::Centre(body), JointKind::Rope { max_length: 10.0 });
        let joint = world.add_joint(spec.breaking_at(break_force)).unwrap();
        let mut broken = Vec::new();
        for _ in 0..60 {
            world.step(&Inputs::new());
            broken.extend(world.events().iter().copied());
        }
        world.validate().unwrap();
        (world.joint(joint).map(|joint| joint.force), broken, joint, body)
    };
    let (force, events, ..) = hang(31.0);
    assert!((force.unwrap() - 30.0).abs() < 0.3 && events.is_empty(), "{force:?} {events:?}");
    let (force, events, joint, body) = hang(29.0);
    assert_eq!((force, &events[..1]), (None, &[Event::JointBroken { joint, between: [None, Some(body)] }][..]));
}

#[test]
fn a_mouse_pulls_with_a_limited_force_and_follows_when_it_can() {
    let mut world = room(10.0, 8);
    let body = disc(&mut world, Vec2::new(80.0, 40.0), 2.0);
    let spec =
        |y: f32, force: f32| JointSpec::new(JointEnd::Point(Vec2::new(80.0, y)), node(body), JointKind::mouse(force));
    let joint = world.add_joint(spec(50.0, 10.0)).unwrap();
    run(&mut world, 1.0);
    assert!(at(&world, body).y < 38.0, "ten do not lift twenty");
    world.set_joint(joint, spec(45.0, 200.0)).unwrap();
    run(&mut world, 2.0);
    assert!((at(&world, body).y - 45.0).abs() < 0.1, "{}", at(&world, body));
}

#[test]
fn motors_reach_their_length_and_speed_with_a_limited_force() {
    let mut world = room(0.0, 8);
    let body = disc(&mut world, Vec2::new(70.0, 45.0), 2.0);
    let place = JointEnd::Point(Vec2::new(60.0, 45.0));
    let joint = join(&mut world, place, node(body), JointKind::SpeedMotor { speed: 4.0, max_force: 1e6 });
    run(&mut world, 1.0);
    assert!((at(&world, body).x - 74.0).abs() < 0.1, "{}", at(&world, body));
    let motor = |max_force: f32| JointSpec::new(place, node(body), JointKind::LengthMotor { length: 20.0, max_force });
    world.set_joint(joint, motor(1e6)).unwrap();
    run(&mut world, 1.0);
    assert!((at(&world, body).x - 80.0).abs() < 0.01, "{}", at(&world, body));
    let mut world = room(0.0, 8);
    let body = disc(&mut world, Vec2::new(70.0, 45.0), 2.0);
    join(&mut world, place, node(body), JointKind::SpeedMotor { speed: 50.0, max_force: 8.0 });
    run(&mut world, 1.0);
    assert!((at(&world, body).x - 72.0).abs() < 0.05, "half of 8 / 2: {}", at(&world, body));
}

#[test]
fn a_chain_of_joints_holds_two_bodies_together_and_keeps_their_momentum() {
    let mut world = room(0.0, 8);
    let bodies: Vec<_> = (0u8..6).map(|k| disc(&mut world, Vec2::new(60.0 + 2.0 * f32::from(k), 45.0), 1.0)).collect();
    for pair in bodies.windows(2) {
        join(&mut world, node(pair[0]), node(pair[1]), JointKind::Weld);
    }
    world.push(bodies[0], Vec2::new(0.0, 12.0)).unwrap();
    run(&mut world, 1.0);
    let velocity: Vec2 = bodies.iter().map(|&id| world.view().organism(id).unwrap().velocity()).sum();
    assert!((velocity - Vec2::new(0.0, 12.0)).length() < 0.01, "{velocity}");
    for joint in world.joints() {
        assert!((joint.ends[0].distance(joint.ends[1]) - 2.0).abs() < 0.02);
    }
}

#[test]
fn a_joint_ends_with_an_event_when_a_partner_goes() {
    let mut world = room(0.0, 8);
    let [a, b] = [70.0, 80.0].map(|x| disc(&mut world, Vec2::new(x, 45.0), 1.0));
    let joint = join(&mut world, JointEnd::Centre(a), node(b), JointKind::Weld);
    run(&mut world, 1.0);
    world.remove(b).unwrap();
    world.validate().unwrap();
    assert!(world.joint(joint).is_none());
    world.step(&Inputs::new());
    assert_eq!(world.events(), [Event::JointEnded { joint, between: [Some(a), Some(b)] }]);
    world.step(&Inputs::new());
    assert!(world.events().is_empty());
    assert_eq!(world.remove_joint(joint).unwrap_err().field(), "joint");
}

#[test]
fn what_moves_wakes_what_it_is_joined_to_and_what_rests_sleeps() {
    let mut world = room(0.0, 8);
    let [a, b] = [60.0, 80.0].map(|x| disc(&mut world, Vec2::new(x, 45.0), 1.0));
    // A block of its own for each: eight of one template sleep together.
    let mut builder = Template::builder();
    builder.node(Node::disc(Vec2::ZERO, 7.0, 0.4));
    let template = world.add_template(builder.build().unwrap());
    let c = world.spawn_template(template, Placement::at(100.0, 45.0)).unwrap();
    join(&mut world, node(b), node(c), JointKind::Rope { max_length: 20.0 });
    run(&mut world, 2.0);
    let rests = |world: &World, id| world.view().organism(id).unwrap().is_at_rest();
    assert!([a, b, c].iter().all(|&id| rests(&world, id)));
    world.push(b, Vec2::new(-4.0, 0.0)).unwrap();
    run(&mut world, 0.5);
    assert!(at(&world, c).x < 99.9 && !rests(&world, c), "{}", at(&world, c));
}

#[test]
fn what_a_joint_moves_slowly_does_not_fall_asleep() {
    let slow = JointKind::SpeedMotor { speed: 0.01, max_force: 1e6 };
    let soft = JointKind::Spring { length: 10.0, frequency: 0.01, damping_ratio: 0.0 };
    // In 20 s the motor moves it by 0.2 um, and the spring goes through 72 degrees, of which the cosine is this.
    for (kind, expected) in [(slow, 20.2), (soft, 10.0 + 10.0 * 0.309_017)] {
        let mut world = room(0.0, 8);
        let disc = disc(&mut world, Vec2::new(70.0, 45.0), 1.0);
        join(&mut world, JointEnd::Point(Vec2::new(50.0, 45.0)), node(disc), kind);
        run(&mut world, 20.0);
        let length = at(&world, disc).x - 50.0;
        assert!((length - expected).abs() < 0.1, "{kind:?}: {length} instead of {expected}");
    }
}

#[test]
fn a_slow_motor_moves_what_hangs_on_its_body_whatever_the_order_of_joints() {
    for motor_first in [true, false] {
        let mut world = room(0.0, 8);
        let near = disc(&mut world, Vec2::new(70.0, 45.0), 1.0);
        let far = disc(&mut world, Vec2::new(90.0, 45.0), 2.0);
        let pull = JointKind::SpeedMotor { speed: -0.01, max_force: 1e6 };
        let motor = (JointEnd::Point(Vec2::new(50.0, 45.0)), node(near), pull);
        let link = (node(near), node(far), JointKind::Distance { length: 20.0 });
        let order = if motor_first { [motor, link] } else { [link, motor] };
        for (a, b, kind) in order {
            join(&mut world, a, b, kind);
        }
        run(&mut world, 20.0);
        let moved = [at(&world, near).x - 70.0, at(&world, far).x - 90.0];
        assert!(moved.iter().all(|moved| (moved + 0.2).abs() < 0.02), "motor first {motor_first}: {moved:?}");
    }
}

#[test]
fn everything_that_cannot_be_joined_is_refused_by_name_and_changes_nothing() {
    let mut world = room(0.0, 8);
    let [a, gone] = [60.0, 80.0].map(|x| disc(&mut world, Vec2::new(x, 45.0), 1.0));
    world.remove(gone).unwrap();
    let place = JointEnd::Point(Vec2::ZERO);
    let digest = world.digest();
    let mut refused =
        |a, b| world.add_joint(JointSpec::new(a, b, JointKind::Pin)).map_err(|error: Error| error.field().to_owned());
    assert_eq!(refused(node(gone), place), Err("a.organism".to_owned()));
    assert_eq!(refused(place, JointEnd::Node { organism: a, node: 1 }), Err("b.node".to_owned()));
    assert_eq!(refused(place, JointEnd::Point(Vec2::ONE)), Err("b".to_owned()));
    assert_eq!(refused(node(a), node(a)), Err("b".to_owned()));
    assert_eq!(refused(node(a), JointEnd::Point(Vec2::NAN)), Err("b.x".to_owned()));
    assert_eq!(world.digest(), digest);
}

#[test]
fn clones_and_snapshots_have_the_same_joints_and_future() {
    let mut world = room(10.0, 8);
    let [a, b] = [78.0, 81.0].map(|x| disc(&mut world, Vec2::new(x, 30.0), 1.0));
    let nail = JointEnd::Point(Vec2::new(80.0, 50.0));
    join(&mut world, nail, node(a), JointKind::Rope { max_length: 21.0 });
    join(
        &mut world,
        node(a),
        JointEnd::Centre(b),
        JointKind::Spring { length: 2.0, frequency: 2.0, damping_ratio: 0.1 },
    );
    run(&mut world, 0.5);
    let mut others = vec![world.clone()];
    #[cfg(feature = "snapshot")]
    others.push(World::from_snapshot(&world.to_snapshot().unwrap()).unwrap());
    run(&mut world, 0.5);
    for mut other in others {
        run(&mut other, 0.5);
        assert_eq!(other.first_difference(&world), None);
        assert!(other.joints().eq(world.joints()));
    }
}

/// A kinematic bar at a place.
fn bar(world: &mut World, at: Vec2) -> ObstacleId {
    let shape = SharedShape::cuboid(2.0, 0.5);
    let motion = ObstacleMotion::Push;
    world.add_obstacle(Obstacle { motion, ..Obstacle::new(shape, Pose::translation(at.x, at.y)) }).unwrap()
}

#[test]
fn a_weight_hangs_on_an_obstacle_and_goes_where_that_goes() {
    let mut world = room(10.0, 8);
    let crane = bar(&mut world, Vec2::new(50.0, 60.0));
    let weight = disc(&mut world, Vec2::new(50.0, 50.0), 2.0);
    let end = JointEnd::Obstacle { obstacle: crane, at: Vec2::new(0.0, -0.5) };
    let rope = join(&mut world, end, node(weight), JointKind::Rope { max_length: 9.5 });
    run(&mut world, 5.0);
    assert!((world.joint(rope).unwrap().force - 20.0).abs() < 0.2, "{:?}", world.joint(rope));
    // Put elsewhere at once, it draws the weight after it, even if that is asleep.
    assert!(world.view().organism(weight).unwrap().is_at_rest());
    for y in [62.0, 60.0] {
        world.set_obstacle_pose(crane, Pose::translation(50.0, y)).unwrap();
        run(&mut world, 5.0);
        assert!((at(&world, weight).y - (y - 10.0)).abs() < 0.2, "{}", at(&world, weight));
    }
    for step in 1..=600 {
        world.move_obstacle(crane, Pose::translation(50.0 + 0.02 * step as f32, 60.0 + 0.01 * step as f32)).unwrap();
        world.step(&Inputs::new());
        let view = world.joint(rope).unwrap();
        assert!(view.ends[0].distance(view.ends[1]) < 9.51, "{view:?}");
    }
    assert!((at(&world, weight).x - 62.0).abs() < 1.0 && (at(&world, weight).y - 56.0).abs() < 0.2);
}

#[test]
fn a_wheel_is_driven_by_an_obstacle_that_turns() {
    let mut world = room(0.0, 8);
    let hub = bar(&mut world, Vec2::new(50.0, 50.0));
    let rim = disc(&mut world, Vec2::new(53.0, 50.0), 1.0);
    let end = JointEnd::Obstacle { obstacle: hub, at: Vec2::new(3.0, 0.0) };
    join(&mut world, end, node(rim), JointKind::Pin);
    for step in 1..=120 {
        let angle = step as f32 * TAU / 240.0;
        world.move_obstacle(hub, Pose::new(Vec2::new(50.0, 50.0), angle)).unwrap();
        world.step(&Inputs::new());
        let wanted = Vec2::new(50.0, 50.0) + 3.0 * unit_vector(angle);
        assert!(at(&world, rim).distance(wanted) < 0.01, "{} {wanted}", at(&world, rim));
    }
}

#[test]
fn a_joint_ends_with_its_obstacle_and_needs_one_that_is_there() {
    let mut world = room(10.0, 8);
    let [kept, gone] = [40.0, 60.0].map(|x| bar(&mut world, Vec2::new(x, 60.0)));
    let weight = disc(&mut world, Vec2::new(50.0, 50.0), 2.0);
    let spec = |obstacle| {
        let end = JointEnd::Obstacle { obstacle, at: Vec2::ZERO };
        JointSpec::new(node(weight), end, JointKind::Rope { max_length: 20.0 })
    };
    let joints = [kept, gone].map(|obstacle| world.add_joint(spec(obstacle)).unwrap());
    run(&mut world, 0.5);
    world.remove_obstacle(gone).unwrap();
    world.step(&Inputs::new());
    let ended = |joint| Event::JointEnded { joint, between: [Some(weight), None] };
    assert_eq!(world.events(), [ended(joints[1])]);
    assert_eq!(world.add_joint(spec(gone)).unwrap_err().field(), "b.obstacle");
    world.set_obstacle_enabled(kept, false).unwrap();
    assert_eq!(world.add_joint(spec(kept)).unwrap_err().field(), "b.obstacle");
    world.step(&Inputs::new());
    assert_eq!(world.events(), [ended(joints[0])]);
    assert_eq!(world.joints().count(), 0);
    run(&mut world, 0.5);
    assert!(at(&world, weight).y < 49.0, "it falls");
}

#[test]
fn a_joint_to_cytoplasm_that_is_gone_does_not_pass_to_what_grows_in_its_place() {
    let mut world = room(0.0, 8);
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 50.0)).unwrap();
    let particles = world.view().organism(cell).unwrap().particles().count() as u32;
    let end = |node| JointEnd::Node { organism: cell, node };
    let spec =
        |node| JointSpec::new(end(node), JointEnd::Point(Vec2::new(60.0, 50.0)), JointKind::Rope { max_length: 30.0 });
    let [kept, lost] = [particles - 2, particles - 1].map(|node| world.add_joint(spec(node)).unwrap());
    world.step(&Inputs::new());
    world.shrink(cell, 1).unwrap();
    world.grow(cell, 0, 1).unwrap();
    world.validate().unwrap();
    assert!(world.joint(kept).is_some() && world.joint(lost).is_none());
    world.step(&Inputs::new());
    assert!(world.events().contains(&Event::JointEnded { joint: lost, between: [Some(cell), None] }));
    assert_eq!(world.joints().map(|joint| joint.id).collect::<Vec<_>>(), [kept]);
}
