//! A slime that rolls and jumps.
//!
//! Arrows move it, space or arrow up lets it jump. Platforms are solid from above only; the last one is a lift.

use super::{Keys, Scene};
use microsim_core::{Area, prelude::*};

const NODES: u8 = 16;
const MASS: f32 = 4.0;
/// Units/s: 15 units high, v^2 / 2 g.
const JUMP: f32 = 30.0;
const GRAVITY: f32 = 30.0;

pub(crate) fn scene() -> Scene {
    let size = Vec2::new(96.0, 54.0);
    let gravity = Vec2::new(0.0, -GRAVITY);
    let mut world =
        World::new(WorldConfig { size, gravity, damping: 0.05, max_speed: 80.0, ..WorldConfig::default() })?;
    let platform = |x: f32, y: f32| {
        let bar = Obstacle::new(SharedShape::cuboid(7.0, 0.6), Pose::translation(x, y));
        Obstacle { one_way: Some(Vec2::Y), material: Material { friction: 0.8, restitution: 0.0 }, ..bar }
    };
    for (x, y) in [(24.0, 11.0), (42.0, 20.0), (24.0, 30.0), (60.0, 11.0)] {
        world.add_obstacle(platform(x, y))?;
    }
    let lift = world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..platform(78.0, 10.0) })?;
    let template = world.add_template(slime()?);
    let slime = world.spawn_template(template, Placement::at(24.0, 18.0))?;

    let mut is_held = false;
    let act = move |world: &mut World, inputs: &mut Inputs, Keys { left, right, jump }: Keys| {
        let height = 22.0 - 12.0 * (world.time() as f32).cos();
        world.move_obstacle(lift, Pose::translation(78.0, height))?;
        let direction = f32::from(u8::from(right)) - f32::from(u8::from(left));
        let mut push = Actuation::force(Vec2::new(direction * 25.0 * MASS, 0.0));
        if jump && !is_held && stands(world, slime) {
            push.impulse = Vec2::new(0.0, JUMP * MASS);
        }
        is_held = jump;
        inputs.actuate(slime, push)
    };
    Ok((world, Box::new(act)))
}

/// Whether something is right below it.
fn stands(world: &World, slime: OrganismId) -> bool {
    let Some((low, high)) = world.view().organism(slime).map(OrganismView::bounds) else { return false };
    let all = QueryFilter { excluded: Some(slime), ..QueryFilter::default() };
    let feet = Vec2::new(0.5 * (low.x + high.x), low.y + 0.5);
    world.queries().cast_disc(feet, Vec2::NEG_Y, 0.5, 0.4 * (high.x - low.x), &all).is_some()
}

/// A ring that keeps its length and its area.
fn slime() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let corner = |k: u8| 3.0 * Vec2::from_angle(f32::from(k) * std::f32::consts::TAU / f32::from(NODES));
    let material = Material { friction: 0.8, restitution: 0.0 };
    let disc = |k| Node { material, ..Node::disc(corner(k), MASS / f32::from(NODES), 0.6) };
    let ring: Vec<u32> = (0..NODES).map(|k| builder.node(disc(k))).collect();
    builder.ring(&ring, 1e-4).outline(&ring);
    builder.constraint(Area { ring, rest_area: 26.0, compliance: 1e-4, is_upper_bound: false });
    builder.build()
}
