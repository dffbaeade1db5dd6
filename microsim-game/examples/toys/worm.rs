//! Worms on the ground: waves of contraction run through them from tail to head.
//!
//! Each link is a muscle. While one shortens, the one behind it grows long again: one node slides, and all others hold on by their
//! friction.

use super::Scene;
use microsim_core::{Bend, Distance, prelude::*};
use std::f32::consts::{PI, TAU};

const NODES: u8 = 12;
/// Time in which a wave passes one link, s.
const PACE: f32 = 0.06;

pub(crate) fn scene() -> Scene {
    let gravity = Vec2::new(0.0, -30.0);
    let config = WorldConfig { size: Vec2::new(96.0, 54.0), gravity, damping: 0.2, ..WorldConfig::default() };
    let mut world = World::new(config)?;
    let material = Material { friction: 1.0, restitution: 0.0 };
    let hill = Obstacle::new(SharedShape::ball(70.0), Pose::translation(60.0, -66.0));
    let branch = Obstacle::new(SharedShape::cuboid(30.0, 1.0), Pose::new(Vec2::new(40.0, 30.0), 0.1));
    for obstacle in [hill, branch] {
        world.add_obstacle(Obstacle { material, ..obstacle })?;
    }
    let template = world.add_template(worm()?);
    let places =
        [Placement::at(15.0, 2.0), Placement::at(26.0, 31.3).turned(0.1), Placement::at(46.0, 33.3).turned(0.1)];
    let worms = places.into_iter().map(|place| world.spawn_template(template, place)).collect::<Result<Vec<_>, _>>()?;
    let act = move |world: &mut World, inputs: &mut Inputs, _| {
        for (&worm, k) in worms.iter().zip(0u8..) {
            for link in 0..NODES - 1 {
                let wave = world.time() as f32 / PACE - f32::from(link) + 3.0 * f32::from(k);
                let since = wave.rem_euclid(f32::from(NODES));
                let activation = if since < 2.0 { 0.5 - 0.5 * (PI * since).cos() } else { 0.0 };
                inputs.activate(worm, link.into(), activation)?;
            }
        }
        Ok(())
    };
    Ok((world, Box::new(act)))
}

/// A chain of discs; each link has a channel of its own.
fn worm() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let material = Material { friction: 1.0, restitution: 0.0 };
    let at = |k: u8| Vec2::new(f32::from(k) - 0.5 * f32::from(NODES - 1), 0.0);
    let chain: Vec<u32> = (0..NODES).map(|k| builder.node(Node { material, ..Node::disc(at(k), 1.0, 0.6) })).collect();
    for pair in chain.windows(2) {
        let link = builder.channel([1.0, 0.6]);
        builder.muscle(link, Distance { a: pair[0], b: pair[1], rest_length: 1.0, compliance: 0.0, damping: 0.0 });
    }
    for part in chain.windows(3) {
        builder.constraint(Bend::new([part[0], part[1], part[2]], 0.0, 1.0 / (100.0 * TAU)));
    }
    builder.build()
}
