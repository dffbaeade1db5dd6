//! Obstacles that live: moved, replaced, disabled and removed; one-way platforms; sensors.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::run;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AgarSpec, Event, FluidBlockSpec, Inputs, Material, Obstacle, ObstacleId, ObstacleMotion, OrganismId, OrganismSpec,
    Placement, PlateletSpec, RigidCellSpec, World, WorldConfig,
};

const DT: f32 = 1.0 / 60.0;

fn room(gravity: f32) -> World {
    let config = WorldConfig { gravity: Vec2::new(0.0, gravity), damping: 0.0, ..WorldConfig::default() };
    World::new(config).unwrap()
}

fn bar(half: Vec2, at: Vec2, motion: ObstacleMotion) -> Obstacle {
    let material = Material { friction: 1.0, restitution: 0.0 };
    Obstacle { motion, material, ..Obstacle::new(SharedShape::cuboid(half.x, half.y), Pose::translation(at.x, at.y)) }
}

fn small_cell() -> OrganismSpec {
    RigidCellSpec { radii: Vec2::new(5.0, 3.0), ..RigidCellSpec::default() }.into()
}

/// Lets an obstacle go at a velocity for some steps.
fn drive(world: &mut World, id: ObstacleId, velocity: Vec2, steps: u32) {
    for _ in 0..steps {
        let at = world.obstacle(id).unwrap().pose;
        world.move_obstacle(id, Pose { translation: at.translation + velocity * DT, ..at }).unwrap();
        world.step(&Inputs::new());
    }
}

fn count(world: &World, is_it: impl Fn(&Event) -> bool) -> usize {
    world.events().iter().filter(|event| is_it(event)).count()
}

/// The lowest and the highest place of an organism's discs.
fn extent(world: &World, id: OrganismId) -> (f32, f32) {
    let organism = world.view().organism(id).unwrap();
    let ends =
        organism.particles().filter(|p| p.radius > 0.0).map(|p| (p.position.y - p.radius, p.position.y + p.radius));
    ends.fold((f32::MAX, f32::MIN), |(low, high), (a, b)| (low.min(a), high.max(b)))
}

#[test]
fn a_lift_carries_a_cell_up_and_a_belt_carries_it_along() {
    let mut world = room(-30.0);
    let lift = world.add_obstacle(bar(Vec2::new(60.0, 1.0), Vec2::new(80.0, 10.0), ObstacleMotion::Push)).unwrap();
    let cell = world.spawn(&small_cell(), Placement::at(80.0, 14.3)).unwrap();
    run(&mut world, &Inputs::new(), 120);
    let start = world.centroid(cell).unwrap();
    drive(&mut world, lift, Vec2::new(0.0, 3.0), 120);
    let top = world.centroid(cell).unwrap();
    assert!((top.y - start.y - 6.0).abs() < 0.1, "up: {}", top.y - start.y);
    let gap = extent(&world, cell).0 - (world.obstacle(lift).unwrap().pose.translation.y + 1.0);
    assert!(gap.abs() < 0.1, "gap {gap}");
    drive(&mut world, lift, Vec2::new(4.0, 0.0), 180);
    let along = world.centroid(cell).unwrap().x - top.x;
    assert!((along - 12.0).abs() < 1.5, "along: {along}");
    drive(&mut world, lift, Vec2::new(0.0, -3.0), 120);
    assert!((world.centroid(cell).unwrap().y - start.y).abs() < 0.2, "down");
    world.validate().unwrap();
}

#[test]
fn a_wheel_that_turns_carries_by_friction() {
    let mut world = room(-30.0);
    let shape = SharedShape::cuboid(20.0, 2.0);
    let material = Material { friction: 1.0, restitution: 0.0 };
    let wheel =
        Obstacle { motion: ObstacleMotion::Push, material, ..Obstacle::new(shape, Pose::translation(80.0, 20.0)) };
    let wheel = world.add_obstacle(wheel).unwrap();
    let disc = world.spawn(&AgarSpec::default().into(), Placement::at(90.0, 23.0)).unwrap();
    run(&mut world, &Inputs::new(), 60);
    for step in 1..=60 {
        let angle = 0.2 * step as f32 * DT;
        world.move_obstacle(wheel, Pose::new(Vec2::new(80.0, 20.0), angle)).unwrap();
        world.step(&Inputs::new());
    }
    // The far end of the bar rises by its distance times the angle.
    assert!(world.centroid(disc).unwrap().y > 23.0 + 1.5, "{}", world.centroid(disc).unwrap());
}

#[test]
fn a_door_at_the_speed_limit_pushes_everything_and_lets_nothing_through() {
    for half in [0.2, 2.0] {
        let mut world = room(0.0);
        let door = world.add_obstacle(bar(Vec2::new(half, 44.0), Vec2::new(10.0, 45.0), ObstacleMotion::Push)).unwrap();
        let mut pushed = Vec::new();
        for k in 0..30 {
            let at = Placement::at(30.0 + 10.0 * (k % 3) as f32, 6.0 + 2.6 * k as f32);
            pushed.push(world.spawn(&AgarSpec { radius: 0.3, ..AgarSpec::default() }.into(), at).unwrap());
        }
        let cell = world.spawn(&small_cell(), Placement::at(70.0, 40.0)).unwrap();
        drive(&mut world, door, Vec2::new(1000.0, 0.0), 240);
        let front = world.obstacle(door).unwrap().pose.translation.x + half;
        assert!(front - half > 10.0 + 70.0, "at most 20 units/s for 4 s: {front}");
        for id in pushed.into_iter().chain([cell]) {
            assert!(world.centroid(id).unwrap().x > front, "half width {half}");
        }
        world.validate().unwrap();
    }
}

/// A press that comes down on a body on the floor; how high it comes to a halt above the floor.
fn press(spec: &OrganismSpec, height: f32, motion: ObstacleMotion) -> (World, ObstacleId, OrganismId, Vec<Event>) {
    let mut world = room(-10.0);
    let id = world.spawn(spec, Placement::at(80.0, height)).unwrap();
    let press = world.add_obstacle(bar(Vec2::new(20.0, 2.0), Vec2::new(80.0, 20.0), motion)).unwrap();
    run(&mut world, &Inputs::new(), 60);
    let mut events = Vec::new();
    world.move_obstacle(press, Pose::translation(80.0, 1.0)).unwrap();
    for _ in 0..240 {
        world.step(&Inputs::new());
        world.validate().unwrap();
        events.extend(world.events());
    }
    (world, press, id, events)
}

#[test]
fn a_press_does_not_crush() {
    let disc = AgarSpec { radius: 1.5, ..AgarSpec::default() };
    let specs: [(OrganismSpec, f32); 3] =
        [(disc.into(), 1.6), (small_cell(), 3.5), (PlateletSpec::default().into(), 6.0)];
    for (spec, height) in specs {
        for motion in [ObstacleMotion::Push, ObstacleMotion::Stop] {
            let (mut world, press, id, events) = press(&spec, height, motion);
            let (low, high) = extent(&world, id);
            let bottom = world.obstacle(press).unwrap().pose.translation.y - 2.0;
            assert!(low > -0.05 && high < bottom + 0.05, "{spec:?}: {low} to {high} under {bottom}");
            assert!(bottom > 2.9, "{spec:?}: {bottom}");
            let stops = events.iter().filter(|event| **event == Event::ObstacleBlocked { obstacle: press }).count();
            let is_going = world.obstacle_target(press).is_some();
            assert_eq!((stops, is_going), if motion == ObstacleMotion::Stop { (1, false) } else { (0, true) });
            world.remove(id).unwrap();
            run(&mut world, &Inputs::new(), 120);
            let way = world.obstacle(press).unwrap().pose.translation.y;
            assert_eq!(way == 1.0, motion == ObstacleMotion::Push, "{way}");
        }
    }
}

#[test]
fn a_one_way_platform_holds_what_falls_on_it_and_lets_pass_what_jumps() {
    let mut world = room(-20.0);
    let platform = bar(Vec2::new(20.0, 0.5), Vec2::new(80.0, 20.0), ObstacleMotion::Push);
    let platform = world.add_obstacle(Obstacle { one_way: Some(Vec2::Y), ..platform }).unwrap();
    let disc = world.spawn(&AgarSpec::default().into(), Placement::at(80.0, 14.0)).unwrap();
    world.push(disc, Vec2::new(0.0, 20.0)).unwrap();
    run(&mut world, &Inputs::new(), 240);
    assert!((world.centroid(disc).unwrap().y - 21.5).abs() < 0.05, "{}", world.centroid(disc).unwrap());
    drive(&mut world, platform, Vec2::new(0.0, 2.0), 60);
    assert!((world.centroid(disc).unwrap().y - 23.5).abs() < 0.1, "on its way it holds too");
    let beside = world.spawn(&AgarSpec::default().into(), Placement::at(57.0, 22.0)).unwrap();
    world.push(beside, Vec2::new(19.0, 6.0)).unwrap();
    run(&mut world, &Inputs::new(), 20);
    assert!(world.centroid(beside).unwrap().x > 61.0, "{}", world.centroid(beside).unwrap());
}

fn sensor(half: f32, at: Vec2) -> Obstacle {
    Obstacle { is_sensor: true, ..bar(Vec2::splat(half), at, ObstacleMotion::Push) }
}

#[test]
fn a_sensor_reports_each_entry_and_each_exit_once_and_touches_nothing() {
    let mut world = room(0.0);
    let zone = world.add_obstacle(sensor(6.0, Vec2::new(60.0, 45.0))).unwrap();
    let cell = world.spawn(&small_cell(), Placement::at(40.0, 45.0)).unwrap();
    world.push(cell, Vec2::new(10.0, 0.0)).unwrap();
    let (mut entered, mut left) = (0, 0);
    for step in 0..300 {
        world.step(&Inputs::new());
        let is_inside = world.inside_sensor(zone).next() == Some((cell, None));
        entered +=
            count(&world, |event| *event == Event::SensorEntered { sensor: zone, organism: cell, particle: None });
        left += count(&world, |event| *event == Event::SensorLeft { sensor: zone, organism: cell, particle: None });
        assert_eq!(is_inside, entered > left, "step {step}");
    }
    assert_eq!((entered, left), (1, 1));
    assert!((world.centroid(cell).unwrap().x - 90.0).abs() < 0.5, "nothing held it");
}

#[test]
fn what_is_removed_has_left_and_what_sleeps_has_not() {
    let mut world = room(0.0);
    let disc: OrganismSpec = PlateletSpec::default().into();
    let [a, b] = [40.0, 60.0].map(|x| world.spawn(&disc, Placement::at(x, 45.0)).unwrap());
    run(&mut world, &Inputs::new(), 120);
    let zone = world.add_obstacle(sensor(30.0, Vec2::new(50.0, 45.0))).unwrap();
    let (mut entered, mut left) = (0, 0);
    let mut watch = |world: &mut World, steps: u32| {
        for _ in 0..steps {
            world.step(&Inputs::new());
            entered += count(world, |event| matches!(event, Event::SensorEntered { .. }));
            left += count(world, |event| matches!(event, Event::SensorLeft { .. }));
        }
        (entered, left)
    };
    assert_eq!(watch(&mut world, 200), (2, 0), "they sleep inside");
    world.remove(a).unwrap();
    assert_eq!(watch(&mut world, 5), (2, 1));
    world.set_obstacle_pose(zone, Pose::translation(120.0, 45.0)).unwrap();
    assert_eq!(watch(&mut world, 5), (2, 2));
    world.set_obstacle_pose(zone, Pose::translation(60.0, 45.0)).unwrap();
    assert_eq!(watch(&mut world, 5), (3, 2));
    world.remove_obstacle(zone).unwrap();
    assert_eq!(watch(&mut world, 5), (3, 3));
    assert!(world.kind(b).is_some() && world.inside_sensor(zone).next().is_none());
}

#[test]
fn particles_of_fluid_enter_a_sensor_one_by_one() {
    let mut world = room(-20.0);
    let zone = world.add_obstacle(sensor(3.0, Vec2::new(40.0, 3.0))).unwrap();
    let block = FluidBlockSpec { size: Vec2::new(8.0, 8.0), ..FluidBlockSpec::default() };
    let fluid = world.spawn(&block.into(), Placement::at(40.0, 14.0)).unwrap();
    let mut inside = std::collections::BTreeSet::new();
    for _ in 0..90 {
        world.step(&Inputs::new());
        for event in world.events() {
            match *event {
                Event::SensorEntered { sensor, organism, particle: Some(i) } if (sensor, organism) == (zone, fluid) => {
                    assert!(inside.insert(i));
                }
                Event::SensorLeft { particle: Some(i), .. } => assert!(inside.remove(&i)),
                _ => {}
            }
        }
        let now: Vec<u32> = world.inside_sensor(zone).filter_map(|(_, particle)| particle).collect();
        assert!(now.iter().copied().eq(inside.iter().copied()));
    }
    assert!(inside.len() > 10, "{}", inside.len());
}

#[test]
fn what_rested_on_an_obstacle_that_is_gone_falls() {
    let take: [fn(&mut World, ObstacleId); 4] = [
        |world, id| world.remove_obstacle(id).unwrap(),
        |world, id| world.set_obstacle_pose(id, Pose::translation(30.0, 10.0)).unwrap(),
        |world, id| world.set_obstacle_enabled(id, false).unwrap(),
        |world, id| world.set_obstacle_shape(id, SharedShape::ball(0.5)).unwrap(),
    ];
    for take in take {
        let mut world = room(-10.0);
        let shelf = world.add_obstacle(bar(Vec2::new(9.0, 1.0), Vec2::new(80.0, 40.0), ObstacleMotion::Fixed)).unwrap();
        let disc = world.spawn(&AgarSpec::default().into(), Placement::at(85.0, 42.1)).unwrap();
        run(&mut world, &Inputs::new(), 200);
        assert!(world.centroid(disc).unwrap().y > 41.5);
        take(&mut world, shelf);
        run(&mut world, &Inputs::new(), 60);
        assert!(world.centroid(disc).unwrap().y < 40.0, "{}", world.centroid(disc).unwrap());
    }
}

/// A world in which obstacles move, push, are blocked and watch.
fn busy() -> (World, [ObstacleId; 3]) {
    let mut world = room(-10.0);
    let lift = world.add_obstacle(bar(Vec2::new(10.0, 1.0), Vec2::new(40.0, 10.0), ObstacleMotion::Push)).unwrap();
    let gone = world.add_obstacle(bar(Vec2::ONE, Vec2::new(10.0, 80.0), ObstacleMotion::Fixed)).unwrap();
    let press = world.add_obstacle(bar(Vec2::new(9.0, 2.0), Vec2::new(100.0, 20.0), ObstacleMotion::Stop)).unwrap();
    let zone = world.add_obstacle(sensor(9.0, Vec2::new(40.0, 20.0))).unwrap();
    world.remove_obstacle(gone).unwrap();
    world.spawn(&small_cell(), Placement::at(100.0, 3.5)).unwrap();
    for k in 0..8 {
        world.spawn(&AgarSpec::default().into(), Placement::at(20.0 + 9.0 * k as f32, 40.0)).unwrap();
    }
    (world, [lift, press, zone])
}

/// A step with new targets.
fn tick(world: &mut World, [lift, press, _]: [ObstacleId; 3], step: u32) {
    let angle = 0.4 * (step as f32 / 40.0).sin();
    world.move_obstacle(lift, Pose::new(Vec2::new(40.0, 10.0 + step as f32 * 0.05), angle)).unwrap();
    if step.is_multiple_of(50) {
        world.move_obstacle(press, Pose::translation(100.0, 2.0)).unwrap();
    }
    world.step(&Inputs::new());
}

#[test]
fn clones_have_the_same_future_while_obstacles_move() {
    let (mut world, ids) = busy();
    let mut kept = world.clone();
    for step in 0..160 {
        if step == 77 {
            kept.clone_from(&world);
        }
        tick(&mut world, ids, step);
        world.validate().unwrap();
    }
    assert!(world.inside_sensor(ids[2]).next().is_some(), "the zone is entered");
    (77..160).for_each(|step| tick(&mut kept, ids, step));
    assert_eq!(world.first_difference(&kept), None);
    assert_eq!(world.digest(), kept.digest());
}

#[cfg(feature = "snapshot")]
#[test]
fn snapshots_keep_obstacles_handles_targets_and_what_sensors_hold() {
    let (mut world, ids) = busy();
    for step in 0..160 {
        tick(&mut world, ids, step);
        if step % 20 == 3 {
            let read = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
            assert_eq!(read.first_difference(&world), None, "step {step}");
            assert!(read.obstacles().eq(world.obstacles()));
            let is_going = |world: &World| ids.map(|id| world.obstacle_target(id).is_some());
            assert_eq!(is_going(&read), is_going(&world));
            world = read;
        }
    }
    let (mut other, ids) = busy();
    (0..160).for_each(|step| tick(&mut other, ids, step));
    assert_eq!(world.digest(), other.digest());
}

#[test]
fn the_digest_sees_every_property_of_an_obstacle() {
    let with = |change: fn(&mut Obstacle)| {
        let mut world = room(0.0);
        let mut obstacle = bar(Vec2::ONE, Vec2::new(20.0, 20.0), ObstacleMotion::Push);
        change(&mut obstacle);
        world.add_obstacle(obstacle).unwrap();
        world.digest()
    };
    let changes: [fn(&mut Obstacle); 8] = [
        |_| {},
        |o| o.shape = SharedShape::ball(1.0),
        |o| o.pose = Pose::translation(20.0, 21.0),
        |o| o.material.friction = 0.7,
        |o| o.motion = ObstacleMotion::Stop,
        |o| o.one_way = Some(Vec2::X),
        |o| o.is_sensor = true,
        |o| o.is_enabled = false,
    ];
    let digests: std::collections::BTreeSet<u64> = changes.map(with).into_iter().collect();
    assert_eq!(digests.len(), changes.len());
}

#[test]
fn a_half_space_is_moved_and_not_turned() {
    let mut world = room(0.0);
    let floor = Obstacle::new(SharedShape::halfspace(Vec2::Y), Pose::translation(40.0, 5.0));
    let floor = world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..floor }).unwrap();
    let pellet = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 7.0)).unwrap();
    for step in 1..=120 {
        world.move_obstacle(floor, Pose::translation(40.0, 5.0 + 0.05 * step as f32)).unwrap();
        world.step(&Inputs::new());
    }
    assert!(world.centroid(pellet).unwrap().y > 11.5, "it is lifted: {:?}", world.centroid(pellet));
    let turned = Pose::new(Vec2::new(40.0, 11.0), 0.1);
    assert_eq!(world.move_obstacle(floor, turned).unwrap_err().field(), "target.rotation");
}

#[test]
fn shapes_inside_out_are_refused() {
    let mut world = room(0.0);
    for shape in [SharedShape::ball(-1.0), SharedShape::cuboid(-1.0, 1.0)] {
        let refused = world.add_obstacle(Obstacle::new(shape, Pose::translation(30.0, 30.0)));
        assert_eq!(refused.unwrap_err().field(), "shape");
    }
}
