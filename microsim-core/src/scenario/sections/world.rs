//! Settings of the world: `seed` and the tables `[step]` and `[world]`.

use crate::WorldConfig;
use crate::error::Error;
use crate::scenario::reader::Fields;
use glam::Vec2;

/// The settings of the world but for its size, and the size if the file has it. What is wrong falls back to the default.
pub(crate) fn read(root: &mut Fields<'_>) -> (WorldConfig, Option<Vec2>) {
    let default = WorldConfig::default();
    let seed = root.or("seed", default.seed);
    let (mut step, mut world) = (root.table("step"), root.table("world"));
    let is_sized_by_field = root.has("field") && !world.has("size");
    if !is_sized_by_field {
        world.require("size", "[x, y], two numbers, or a [[field]] that sizes the room");
    }
    let mut size = None;
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
