//! Fluid that comes to rest.

use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, particles, run, value_at};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, FluidBlockSpec, FluidParams, OrganismId, ParticleView, Placement, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "hydrostatic_rest",
    title: "Hydrostatic rest",
    source: "Stevin 1586, De Beghinselen des Waterwichts: still water is level, and its density is that of rest at any depth",
    words: "A column as in the dam break collapses in a closed room of twice its width and comes to rest, with a viscosity of \
            8 1/s and little drag. A pool is a block of 19 x 19 spacings of the default fluid in a room 20 wide with the default \
            drag, after 30 s; speeds are root mean squares over its particles.",
    run: measure,
    order: Order::None(
        "the level is that of particles of a finite size, and in substeps below 1/480 s fluid has the compressibility of a substep of that \
         length, by choice",
    ),
};

/// Level of the fluid in a strip of width 4: most of its particles lie below.
fn level(particles: &[ParticleView], left: f32) -> f64 {
    let mut heights: Vec<f64> = particles
        .iter()
        .filter(|p| p.position.x > left && p.position.x < left + 4.0)
        .map(|p| f64::from(p.position.y) + 0.5)
        .collect();
    heights.sort_by(f64::total_cmp);
    let ranks: Vec<[f64; 2]> = heights.iter().enumerate().map(|(k, y)| [k as f64, *y]).collect();
    value_at(&ranks, 0.97 * ranks.len() as f64)
}

/// Root mean square of the speeds in a pool so long after it was filled.
pub(crate) fn speed_of_pool(stepping: Stepping, seconds: f32) -> Result<f64, Error> {
    let room = stepping.room(Vec2::new(20.0, 60.0), GRAVITY);
    let WorldConfig { damping, max_speed, .. } = WorldConfig::default();
    let mut world = World::new(WorldConfig { damping, max_speed, ..room })?;
    let block = FluidBlockSpec { size: Vec2::splat(19.0), fluid: FluidParams::default() };
    let pool = world.spawn(&block.into(), Placement::at(10.0, 9.5))?;
    run(&mut world, seconds);
    Ok(speed(&particles(&world, pool)))
}

/// A column of this height, half as wide, in a room twice as wide as it, after so many seconds.
pub(crate) fn settle(height: f32, seconds: f32) -> Result<(World, OrganismId), Error> {
    let room = Stepping::DEFAULT.room(Vec2::new(height, 1.5 * height), GRAVITY);
    let mut world = World::new(WorldConfig { damping: 0.2, ..room })?;
    let fluid = FluidParams { viscosity: 8.0, ..FluidParams::default() };
    let size = Vec2::new(0.5 * height, height);
    let column = world.spawn(&FluidBlockSpec { size, fluid }.into(), Placement::at(0.25 * height, 0.5 * height))?;
    run(&mut world, seconds);
    Ok((world, column))
}

/// Root mean square of the speed of some particles.
pub(crate) fn speed(particles: &[ParticleView]) -> f64 {
    let squares = particles.iter().map(|p| f64::from(p.velocity.length_squared()));
    (squares.sum::<f64>() / particles.len() as f64).sqrt()
}

fn measure() -> Result<Outcome, Error> {
    let (world, column) = settle(40.0, 40.0)?;
    let at_rest = particles(&world, column);
    let count = at_rest.len() as f64;
    let levels: Vec<f64> = (0..10u8).map(|k| level(&at_rest, 4.0 * f32::from(k))).collect();
    let mean = levels.iter().sum::<f64>() / 10.0;
    let spread = levels.iter().map(|level| (level - mean).abs()).fold(0.0, f64::max);
    let compression = f64::from(world.quality().fluid_compression_mean);
    let free_fall = f64::from(2.0 * GRAVITY * 20.0).sqrt();
    let lies = count * 0.75f64.sqrt() / 40.0;
    let profile = levels.iter().enumerate().map(|(k, level)| [4.0 * k as f64 + 2.0, *level]).collect();
    let curves = vec![
        Curve::line("area over width", vec![[0.0, lies], [40.0, lies]]),
        Curve::dots("level, ours", profile),
        Curve::line("floor", vec![[0.0, 0.0], [40.0, 0.0]]),
    ];
    let mut rows = vec![
        Row::near("mean level: area over width, units", lies, 0.05, mean),
        Row::between("largest difference of the level, units of one spacing", "0", [0.0, 1.0], spread),
        Row::between("speed at rest over that of a fall from the level", "0", [0.0, 0.01], speed(&at_rest) / free_fall),
        Row::between("mean compression", "0", [0.0, 0.03], compression),
    ];
    for (dt, substeps) in [(60.0, 4), (60.0, 8), (60.0, 12), (60.0, 16), (60.0, 32), (240.0, 8), (1000.0, 5)] {
        let speed = speed_of_pool(Stepping { dt: 1.0 / dt, substeps }, 30.0)?;
        let name = format!("speed in a pool, {substeps} substeps of 1/{dt} s, units/s");
        rows.push(Row::between(name, "0", [0.0, 0.02], speed));
    }
    Ok(Outcome {
        plot: Some(Plot { axes: ["x, units", "level, units"], is_logarithmic: false, curves }),
        rows,
        ..Outcome::default()
    })
}
