//! Flagella in a viscous medium: waves of bending run along them from head to tail, and they swim the other way.
//!
//! Muscles on both sides of a strand bend it; the drag of its links is greater across than along. Left and right turn them.

use super::Scene;
use microsim_core::{Distance, LinkDrag, prelude::*};
use std::f32::consts::TAU;

/// Columns of nodes in a wave, and in a flagellum.
const WAVE: u8 = 10;
const COLUMNS: u8 = 2 * WAVE + 1;

pub(crate) fn scene() -> Scene {
    let mut world = World::new(WorldConfig { size: Vec2::new(96.0, 54.0), damping: 0.0, ..WorldConfig::default() })?;
    let template = world.add_template(flagellum()?);
    let places = (0..6u8).map(|k| Placement::at(40.0 + 30.0 * f32::from(k % 2), 9.0 + 7.0 * f32::from(k)));
    let swimmers = places.map(|place| world.spawn_template(template, place)).collect::<Result<Vec<_>, _>>()?;
    let act = move |world: &mut World, inputs: &mut Inputs, keys: super::Keys| {
        let turn = 0.1 * (f32::from(u8::from(keys.left)) - f32::from(u8::from(keys.right)));
        for (&id, k) in swimmers.iter().zip(0u8..) {
            for channel in 0..WAVE {
                let phase = f32::from(channel) / f32::from(WAVE) - world.time() as f32 - 0.15 * f32::from(k);
                let bend = 0.4 * (TAU * phase).sin() + turn;
                inputs.activate(id, channel.into(), 0.5 - bend)?;
                inputs.activate(id, (WAVE + channel).into(), 0.5 + bend)?;
            }
        }
        Ok(())
    };
    Ok((world, Box::new(act)))
}

/// A head, and three strands behind it: muscles, the links that have the drag, muscles.
fn flagellum() -> Result<Template, Error> {
    let mut builder = Template::builder();
    for channel in 0..2 * WAVE {
        assert_eq!(builder.channel([0.85, 1.15]), u32::from(channel));
    }
    let rigid = |a, b, rest_length| Distance { a, b, rest_length, compliance: 0.0, damping: 0.0 };
    for column in 0..COLUMNS {
        let radius = if column == 0 { 1.2 } else { 0.3 };
        let nodes = [(0.5, 0.3), (0.0, radius), (-0.5, 0.3)]
            .map(|(y, radius)| builder.node(Node::disc(Vec2::new(f32::from(column), y), 0.03, radius)));
        let [left, middle, right] = nodes;
        builder.link(left, middle, 0.0).link(middle, right, 0.0).link(left, right, 0.0);
        if column > 0 {
            builder.muscle((column % WAVE).into(), rigid(left - 3, left, 1.0));
            builder.muscle((WAVE + column % WAVE).into(), rigid(right - 3, right, 1.0));
            builder.link(left - 3, right, 1e-4).link(right - 3, left, 1e-4).link(middle - 3, middle, 0.0);
            builder.constraint(LinkDrag { a: middle - 3, b: middle, along: 2.0, across: 4.0 });
        }
    }
    builder.build()
}
