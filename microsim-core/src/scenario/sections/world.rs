//! Settings of the world: `seed` and the tables `[step]` and `[world]`.

use crate::error::Error;
use crate::scenario::reader::{Fields, Keyword};
use crate::{Side, Sides, Substrate, WorldConfig};
use glam::Vec2;

impl Keyword for Substrate {
    const KEYWORDS: &'static [(&'static str, Self)] = &[("slide", Self::Slide), ("surfaces", Self::Surfaces)];
}

impl Keyword for Side {
    const KEYWORDS: &'static [(&'static str, Self)] =
        &[("wall", Self::Wall), ("open", Self::Open), ("periodic", Self::Periodic)];
}

/// The settings of the world but for its size, and the size if the file has it. What is wrong falls back to the default.
pub(crate) fn read(root: &mut Fields<'_>) -> (WorldConfig, Option<Vec2>) {
    let default = WorldConfig::default();
    let seed = root.or("seed", default.seed);
    let (mut step, mut world) = (root.table("step"), root.table("world"));
    let is_sized_by_field = root.has("field") && !world.has("size");
    if !is_sized_by_field {
        world.require("size", "[x, y], two numbers, or a [[field]] that sizes the room");
    }
    let (mut size, sides) = (None, read_sides(&mut world));
    let read = || {
        size = world.get::<Vec2>("size");
        let config = WorldConfig {
            size: size.unwrap_or(default.size),
            dt: step.or("dt", default.dt),
            substeps: step.or("substeps", default.substeps),
            gravity: world.or("gravity", default.gravity),
            damping: world.or("damping", default.damping),
            max_speed: world.or("max_speed", default.max_speed),
            seed,
            protects_membranes: world.or("protects_membranes", default.protects_membranes),
            sleeps: world.or("sleeps", default.sleeps),
            max_particles: world.or("max_particles", default.max_particles),
            substrate: world.or("substrate", default.substrate),
            sides,
        };
        let table = |error: &Error| if matches!(error.field(), "dt" | "substeps") { "step" } else { "world" };
        config.validate().map(|()| config).map_err(|error| error.clone().within(table(&error)))
    };
    let config = root.context.check_all("", read).unwrap_or_default();
    step.finish();
    world.finish();
    let size = if is_sized_by_field { None } else { Some(config.size) };
    (config, size)
}

fn read_sides(world: &mut Fields<'_>) -> Sides {
    let mut fields = world.table("sides");
    let Sides { bottom, top, left, right } = Sides::default();
    let sides = Sides {
        bottom: fields.or("bottom", bottom),
        top: fields.or("top", top),
        left: fields.or("left", left),
        right: fields.or("right", right),
    };
    fields.finish();
    sides
}
