//! Continuous collision detection: discs that move farther than their own size in a substep meet as slow ones do.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::run;
use microsim_core::geometry::polygon::contains_point;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AgarSpec, Inputs, Material, Node, Obstacle, ObstacleMotion, OrganismId, Placement, RedCellSpec, Template, World,
    WorldConfig,
};

fn room(max_speed: f32, substeps: u32) -> World {
    let (size, damping) = (Vec2::new(300.0, 60.0), 0.0);
    World::new(WorldConfig { size, max_speed, substeps, damping, sleeps: false, ..WorldConfig::default() }).unwrap()
}

/// A disc of mass `mass` on its way.
fn disc(world: &mut World, mass: f32, radius: f32, restitution: f32, at: Vec2, speed: f32) -> OrganismId {
    let mut builder = Template::builder();
    let material = Material { friction: 0.0, restitution };
    builder.node(Node { material, ..Node::disc(Vec2::ZERO, mass, radius) });
    let template = world.add_template(builder.build().unwrap());
    let id = world.spawn_template(template, Placement::at(at.x, at.y)).unwrap();
    world.push(id, Vec2::new(speed, 0.0)).unwrap();
    id
}

fn velocity(world: &World, id: OrganismId) -> Vec2 {
    world.view().organism(id).unwrap().velocity()
}

#[test]
fn discs_that_meet_head_on_do_not_pass_each_other_and_keep_their_momentum() {
    for (speed, substeps, radius) in [(100.0, 2, 0.3), (400.0, 8, 0.5), (400.0, 6, 0.1), (400.0, 4, 1.0)] {
        for (mass, restitution) in [(1.0, 0.0), (1.0, 1.0), (5.0, 0.0), (5.0, 1.0)] {
            // From many distances, for the time of impact may be anywhere in a substep.
            for k in 0..20 {
                // The light one leaves at up to 7/3 of the speed.
                let mut world = room(2.4 * speed, substeps);
                let left = disc(&mut world, mass, radius, restitution, Vec2::new(130.0, 30.0), speed);
                let right =
                    disc(&mut world, 1.0, radius, restitution, Vec2::new(150.0 + 0.37 * k as f32, 30.0), -speed);
                let steps = (60.0 * 30.0 / speed) as u32;
                run(&mut world, &Inputs::new(), steps.max(2));
                let [a, b] = [left, right].map(|id| world.centroid(id).unwrap().x);
                let what =
                    format!("{speed} units/s, {substeps} substeps, radius {radius}, mass {mass}, e {restitution}, {k}");
                assert!(b - a > 1.99 * radius, "{what}: at {a} and {b}");
                let momentum = velocity(&world, left).x * mass + velocity(&world, right).x;
                let expected = (mass - 1.0) * speed;
                assert!((momentum - expected).abs() < 2e-3 * (mass + 1.0) * speed, "{what}: {momentum}");
                let apart = (velocity(&world, right) - velocity(&world, left)).x;
                let rebound = 2.0 * speed * restitution;
                assert!((apart - rebound).abs() < 0.01 * speed, "{what}: apart with {apart}");
            }
        }
    }
}

#[test]
fn a_fast_disc_is_stopped_by_a_row_and_glances_off_a_single_one() {
    let mut world = room(800.0, 4);
    let row: Vec<_> = (0..5).map(|k| disc(&mut world, 1.0, 0.5, 0.0, Vec2::new(100.0 + k as f32, 30.0), 0.0)).collect();
    let bullet = disc(&mut world, 1.0, 0.5, 0.0, Vec2::new(60.0, 30.0), 800.0);
    run(&mut world, &Inputs::new(), 10);
    let places: Vec<f32> = [bullet].iter().chain(&row).map(|&id| world.centroid(id).unwrap().x).collect();
    assert!(places.is_sorted(), "{places:?}");
    let momentum: f32 = [bullet].iter().chain(&row).map(|&id| velocity(&world, id).x).sum();
    assert!((momentum - 800.0).abs() < 2.0, "{momentum}");

    let mut world = room(800.0, 4);
    let struck = disc(&mut world, 1.0, 0.5, 0.0, Vec2::new(100.0, 30.0), 0.0);
    let bullet = disc(&mut world, 1.0, 0.5, 0.0, Vec2::new(60.0, 30.6), 800.0);
    run(&mut world, &Inputs::new(), 4);
    // Of discs without friction that do not bounce, the struck one moves along the line of centres: sin of its angle is 0.6.
    let [a, b] = [struck, bullet].map(|id| velocity(&world, id));
    assert!((a - Vec2::new(0.64, -0.48) * 400.0).length() < 12.0, "{a}");
    assert!((a + b - Vec2::new(800.0, 0.0)).length() < 2.0, "{a}, {b}");
}

#[test]
fn a_fast_disc_does_not_jump_into_a_cell() {
    for (speed, substeps, mass) in [(200.0, 4, 0.3), (400.0, 8, 0.3), (1000.0, 8, 0.1), (1000.0, 4, 0.03)] {
        for k in 0..40 {
            let mut world = room(speed, substeps);
            let cell = world.spawn(&RedCellSpec::default().into(), Placement::at(100.0, 30.0)).unwrap();
            let at = Vec2::new(80.0 + 0.37 * k as f32, 28.0 + 0.1 * k as f32);
            let bullet = disc(&mut world, mass, 0.3, 0.0, at, speed);
            for step in 0..(60.0 * 40.0 / speed) as u32 + 3 {
                run(&mut world, &Inputs::new(), 1);
                let outline: Vec<_> = world.view().organism(cell).unwrap().outline().collect();
                let place = world.centroid(bullet).unwrap();
                let is_out = !contains_point(&outline, place);
                assert!(is_out, "{speed} units/s, {substeps} substeps, mass {mass}, {k}, step {step}: {place}");
            }
        }
    }
}

/// Discs that get through a bar of this thickness, shot at it as fast as they may be, or met by it as fast as it may be.
fn shot_through(config: &WorldConfig, thickness: f32, radius: f32, is_bar_on_its_way: bool) -> usize {
    let mut world = World::new(config.clone()).unwrap();
    let bar = Obstacle::new(SharedShape::cuboid(0.5 * thickness, 45.0), Pose::translation(50.0, 45.0));
    let bar = world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..bar }).unwrap();
    let way = config.max_speed * config.dt / config.substeps as f32;
    let shoot = |k: u8| {
        let at = Placement::at(10.0 + way * f32::from(k) / 30.0, 3.0 + 2.5 * f32::from(k));
        let disc = world.spawn(&AgarSpec { radius, ..AgarSpec::default() }.into(), at).unwrap();
        if !is_bar_on_its_way {
            world.push(disc, Vec2::new(config.max_speed, 0.0)).unwrap();
        }
        disc
    };
    let discs: Vec<_> = (0..30).map(shoot).collect();
    if is_bar_on_its_way {
        world.move_obstacle(bar, Pose::translation(5.0, 45.0)).unwrap();
    }
    run(&mut world, &Inputs::new(), 120);
    let bar = world.obstacle(bar).unwrap().pose.translation.x;
    discs.into_iter().filter(|&disc| world.centroid(disc).unwrap().x > bar).count()
}

#[test]
fn nothing_gets_through_an_obstacle_however_thin_and_fast() {
    for (max_speed, substeps, radius) in [(200.0, 2, 0.3), (400.0, 8, 0.2), (1000.0, 32, 0.1), (1000.0, 3, 0.1)] {
        let config = WorldConfig { max_speed, substeps, damping: 0.0, ..WorldConfig::default() };
        for (thickness, is_bar_on_its_way) in [(0.002, false), (0.002, true), (0.5, false), (0.5, true)] {
            let through = shot_through(&config, thickness, radius, is_bar_on_its_way);
            assert_eq!(through, 0, "{config:?}, {thickness} thick, on its way {is_bar_on_its_way}");
        }
    }
}

#[test]
fn a_fast_disc_lands_on_a_one_way_platform_and_passes_it_from_below() {
    let config = WorldConfig { max_speed: 1000.0, damping: 0.0, ..WorldConfig::default() };
    for (from, speed, ends_above) in [(45.0, -900.0, true), (15.0, 900.0, true), (15.0, 0.0, false)] {
        let mut world = World::new(config.clone()).unwrap();
        let platform = Obstacle::new(SharedShape::cuboid(30.0, 0.01), Pose::translation(40.0, 30.0));
        world.add_obstacle(Obstacle { one_way: Some(Vec2::Y), ..platform }).unwrap();
        let disc = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, from)).unwrap();
        world.push(disc, Vec2::new(0.0, speed)).unwrap();
        run(&mut world, &Inputs::new(), 60);
        assert_eq!(world.centroid(disc).unwrap().y > 30.0, ends_above, "from {from} at {speed}");
    }
}
