//! A wheel drives over a bridge of rope, and a crane carries a load.
//!
//! Arrows drive the wheel; without them it turns by itself.

use super::{Keys, Scene};
use microsim_core::prelude::*;
use std::f32::consts::TAU;

const PLANKS: u8 = 24;
const PITCH: f32 = 2.0;
const SPOKES: u8 = 14;
const TORQUE: f32 = 150.0;

pub(crate) fn scene() -> Scene {
    let gravity = Vec2::new(0.0, -20.0);
    let size = Vec2::new(96.0, 54.0);
    let mut world = World::new(WorldConfig { size, gravity, damping: 0.1, max_speed: 80.0, ..WorldConfig::default() })?;
    for x in [12.0, 84.0] {
        let cliff = SharedShape::cuboid(12.0, 10.0);
        world.add_obstacle(Obstacle::new(cliff, Pose::translation(x, 10.0)))?;
    }
    bridge(&mut world)?;
    let template = world.add_template(wheel()?);
    let wheel = world.spawn_template(template, Placement::at(10.0, 24.5))?;
    let crane = crane(&mut world)?;

    let act = move |world: &mut World, inputs: &mut Inputs, Keys { left, right, .. }: Keys| {
        let turn = 0.5 * (0.5 * world.time() as f32).sin();
        world.move_obstacle(crane, Pose::translation(48.0 + 40.0 * turn, 50.0))?;
        let torque = if left { TORQUE } else { -TORQUE };
        let is_at_end = world.centroid(wheel).is_some_and(|at| at.x > 78.0);
        let torque = if is_at_end && !(left || right) { 0.0 } else { torque };
        inputs.actuate(wheel, Actuation::torque(torque))
    };
    Ok((world, Box::new(act)))
}

/// Discs on a rope from cliff to cliff.
fn bridge(world: &mut World) -> Result<(), Error> {
    let mut builder = Template::builder();
    builder.node(Node { material: Material { friction: 0.9, restitution: 0.0 }, ..Node::disc(Vec2::ZERO, 2.0, 0.8) });
    let plank = world.add_template(builder.build()?);
    let mut last = JointEnd::Point(Vec2::new(24.0, 19.0));
    for k in 0..PLANKS {
        let x = 24.0 + PITCH * (f32::from(k) + 0.5);
        let next = JointEnd::Centre(world.spawn_template(plank, Placement::at(x, 19.0))?);
        world.add_joint(JointSpec::new(
            last,
            next,
            JointKind::Distance { length: if k == 0 { 1.0 } else { PITCH } },
        ))?;
        last = next;
    }
    world.add_joint(JointSpec::new(
        last,
        JointEnd::Point(Vec2::new(72.0, 19.0)),
        JointKind::Rope { max_length: 1.5 },
    ))?;
    Ok(())
}

/// A rim and a hub, linked.
fn wheel() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let rim = |k: u8| 3.2 * Vec2::from_angle(f32::from(k) * TAU / f32::from(SPOKES));
    let material = Material { friction: 1.0, restitution: 0.0 };
    let hub = builder.node(Node::disc(Vec2::ZERO, 1.0, 0.8));
    let ring: Vec<u32> = (0..SPOKES).map(|k| builder.node(Node { material, ..Node::disc(rim(k), 0.4, 0.8) })).collect();
    builder.ring(&ring, 0.0).outline(&ring);
    for &node in &ring {
        builder.link(hub, node, 0.0);
    }
    builder.build()
}

/// A bar that is moved from side to side, with a load on a rope.
fn crane(world: &mut World) -> Result<ObstacleId, Error> {
    let bar = Obstacle::new(SharedShape::cuboid(4.0, 1.0), Pose::translation(48.0, 50.0));
    let crane = world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..bar })?;
    let load = world.spawn(&AgarSpec { radius: 2.0, ..AgarSpec::default() }.into(), Placement::at(48.0, 38.0))?;
    let hook = JointEnd::Obstacle { obstacle: crane, at: Vec2::new(0.0, -1.0) };
    world.add_joint(JointSpec::new(hook, JointEnd::Centre(load), JointKind::Rope { max_length: 11.0 }))?;
    Ok(crane)
}
