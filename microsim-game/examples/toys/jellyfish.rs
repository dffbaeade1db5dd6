//! Eight jellyfish of one template beat out of phase.
//!
//! A bell contracts by its muscles. The drag of the medium is the same at all times, so that what a stroke gains would be lost
//! again: the thrust of the water that a bell throws out is a force of its own.

use super::Scene;
use microsim_core::{Distance, MinDistance, prelude::*};
use std::f32::consts::PI;

const NODES: u8 = 15;
/// Time of a beat, s, and the share of it in which the bell contracts.
const BEAT: f32 = 1.6;
const STROKE: f32 = 0.3;
const THRUST: f32 = 220.0;

pub(crate) fn scene() -> Scene {
    let mut world = World::new(WorldConfig { size: Vec2::new(128.0, 72.0), damping: 1.5, ..WorldConfig::default() })?;
    world.set_gravity(Vec2::new(0.0, -4.0))?;
    let template = world.add_template(bell()?);
    let jellyfish = (0..8u8)
        .map(|k| {
            world.spawn_template(template, Placement::at(16.0 + 14.0 * f32::from(k), 14.0 + 6.0 * f32::from(k % 3)))
        })
        .collect::<Result<Vec<_>, _>>()?;

    let act = move |world: &mut World, inputs: &mut Inputs, _| {
        for (&id, k) in jellyfish.iter().zip(0u8..) {
            let phase = (world.time() as f32 / BEAT + f32::from(k) / 8.0).fract();
            let contracts = phase < STROKE;
            let activation = if contracts { phase / STROKE } else { 1.0 - (phase - STROKE) / (1.0 - STROKE) };
            inputs.activate(id, 0, activation)?;
            let jelly = world.view().organism(id);
            let up = Vec2::from_angle(jelly.and_then(OrganismView::angle).unwrap_or(0.0) + 0.5 * PI);
            let upright = jelly.map_or(0.0, |jelly| 150.0 * up.perp_dot(Vec2::Y) - 60.0 * jelly.angular_velocity());
            let force = if contracts { up * THRUST } else { Vec2::ZERO };
            inputs.actuate(id, Actuation { force, torque: upright, ..Actuation::default() })?;
        }
        Ok(())
    };
    Ok((world, Box::new(act)))
}

/// An arch of discs. Muscles draw its halves together; what is not a muscle keeps its length and its curvature.
fn bell() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let corner = |k: u8| 5.0 * Vec2::from_angle(PI * (1.2 * f32::from(k) / f32::from(NODES - 1) - 0.1));
    let arch: Vec<u32> = (0..NODES).map(|k| builder.node(Node::disc(corner(k), 0.5, 0.65))).collect();
    for pair in arch.windows(2) {
        builder.link(pair[0], pair[1], 0.0);
    }
    for pair in arch.windows(4) {
        builder.link(pair[0], pair[3], 1e-3);
    }
    let beat = builder.channel([1.0, 0.55]);
    for k in 0..3 {
        let (a, b) = (k, NODES - 1 - k);
        let rest_length = corner(a).distance(corner(b));
        let (a, b) = (u32::from(a), u32::from(b));
        builder.muscle(beat, Distance { a, b, rest_length, compliance: 1e-4, damping: 0.0 });
        builder.constraint(MinDistance { a, b, min_length: 2.0 });
    }
    builder.build()
}
