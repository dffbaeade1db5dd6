//! How well membranes hold up in cells of different sizes: at rest, crawling and after a squeeze through a gap of half
//! the cell's diameter. For tuning; takes a few minutes in a release build.
//!
//! `cargo run --release -p microsim-core --example membrane_quality [PARTICLES ...]`

#![allow(clippy::disallowed_types, clippy::disallowed_methods, reason = "measures time, outside the world")]

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AmoeboidCellSpec, Error, Inputs, Intent, MembraneQuality, Obstacle, OrganismId, OrganismSpec, Placement, World,
    WorldConfig,
};
use std::f32::consts::PI;
use std::time::{Duration, Instant};

/// Cytoplasm particles of the cells that are measured.
const SIZES: [usize; 4] = [200, 500, 1000, 5000];
/// Drive of the cells, units/s.
const SPEED: f32 = 6.0;
/// Longest time for a squeeze, s.
const TIMEOUT: f64 = 60.0;

fn main() -> Result<(), Error> {
    let asked: Result<Vec<usize>, _> = std::env::args().skip(1).map(|argument| argument.parse()).collect();
    let sizes = asked.ok().filter(|sizes| !sizes.is_empty()).unwrap_or(SIZES.to_vec());
    println!(
        "particles nodes |  voids %: rest  crawl mean   max  squeezed | turning: mean   max | width  speed | edge | ms/step"
    );
    for size in sizes {
        measure(size)?;
    }
    Ok(())
}

fn measure(size: usize) -> Result<(), Error> {
    let spec = cell_of(size);
    let (mut world, cell) = room(&spec, 12.0)?;
    let nodes = world.view().organism(cell).map_or(0, |view| view.outline().len());
    let particles = OrganismSpec::from(spec.clone()).particle_count()? - nodes;
    let mut inputs = Inputs::new();
    run(&mut world, &inputs, 5.0, |_| {});
    let rest = quality(&world, cell);
    inputs.set(cell, Intent::toward(Vec2::new(1e4, 0.5 * world.config().size.y))?);
    let (crawl, step_ms) = crawl(&mut world, cell, &inputs);
    let (squeezed, squeeze_edge) = squeeze(&spec)?.map_or(("stuck".into(), 0.0), |(q, edge)| (percent(q.voids), edge));
    let mean = |value: fn(&MembraneQuality) -> f32| crawl.iter().map(value).sum::<f32>() / crawl.len() as f32;
    let most = |value: fn(&MembraneQuality) -> f32| crawl.iter().map(value).fold(f32::MIN, f32::max);
    println!(
        "{particles:9} {nodes:5} | {:>14} {:>11} {:>5} {:>9} | {:13.2} {:5.2} | {:5.2} {:6.2} | {:.2} {:.2} | {step_ms:7.2}",
        percent(rest.voids),
        percent(mean(|q| q.voids)),
        percent(most(|q| q.voids)),
        squeezed,
        mean(|q| q.excess_turning),
        most(|q| q.excess_turning),
        mean(|q| q.crawl.unwrap_or_default().width_ratio),
        mean(|q| q.crawl.unwrap_or_default().speed_kept),
        1.0 + most(|q| q.edge_stretch),
        1.0 + squeeze_edge,
    );
    Ok(())
}

/// The round cell with about so many particles of cytoplasm: a hexagonal lattice within the membrane.
fn cell_of(particles: usize) -> AmoeboidCellSpec {
    let spec = AmoeboidCellSpec { speed: SPEED, ..AmoeboidCellSpec::default() };
    let spacing = spec.cytoplasm_spacing * spec.node_radius;
    let room = (particles as f32 * 0.75f32.sqrt() / PI).sqrt() * spacing;
    AmoeboidCellSpec { radii: Vec2::splat(room + 2.0 * spec.node_radius + 0.5 * spacing), ..spec }
}

/// A cell alone at the left end of a room so many radii long.
fn room(spec: &AmoeboidCellSpec, length: f32) -> Result<(World, OrganismId), Error> {
    let radius = spec.radii.x;
    let size = Vec2::new(length * radius + 9.0 * SPEED, 6.0 * radius);
    let mut world = World::new(WorldConfig { size, max_speed: 20.0, ..WorldConfig::default() })?;
    let cell = world.spawn(&spec.clone().into(), Placement::at(1.5 * radius, 0.5 * size.y))?;
    Ok((world, cell))
}

/// The membrane after each step in five seconds of crawling, and the time of a step, ms.
fn crawl(world: &mut World, cell: OrganismId, inputs: &Inputs) -> (Vec<MembraneQuality>, f64) {
    run(world, inputs, 3.0, |_| {});
    let (mut qualities, start, mut measuring) = (Vec::new(), Instant::now(), Duration::ZERO);
    let steps = run(world, inputs, 5.0, |world| {
        let now = Instant::now();
        qualities.push(quality(world, cell));
        measuring += now.elapsed();
    });
    (qualities, 1e3 * (start.elapsed() - measuring).as_secs_f64() / f64::from(steps))
}

/// The membrane two seconds after the cell has come through a gap of half its diameter between two discs, and the
/// largest stretch on the way; `None` if it did not get through.
fn squeeze(spec: &AmoeboidCellSpec) -> Result<Option<(MembraneQuality, f32)>, Error> {
    let radius = spec.radii.x;
    let (mut world, cell) = room(spec, 9.0)?;
    let middle = Vec2::new(4.5 * radius, 0.5 * world.config().size.y);
    for side in [-1.0, 1.0] {
        let pose = Pose::translation(middle.x, middle.y + side * 1.5 * radius);
        world.add_obstacle(Obstacle::new(SharedShape::ball(radius), pose))?;
    }
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(Vec2::new(1e4, middle.y))?);
    let (mut stretch, mut is_through) = (0.0f32, false);
    while !is_through && world.time() < TIMEOUT {
        world.step(&inputs);
        stretch = stretch.max(quality(&world, cell).edge_stretch);
        is_through = world.view().organism(cell).is_some_and(|view| view.outline().all(|node| node.x > middle.x));
    }
    inputs.set(cell, Intent::REST);
    run(&mut world, &inputs, 2.0, |_| {});
    Ok(is_through.then(|| (quality(&world, cell), stretch)))
}

/// Runs for so long, s; returns the number of steps.
fn run(world: &mut World, inputs: &Inputs, seconds: f32, mut after: impl FnMut(&World)) -> u32 {
    let steps = (seconds / world.config().dt).round() as u32;
    for _ in 0..steps {
        world.step(inputs);
        after(world);
    }
    steps
}

fn quality(world: &World, cell: OrganismId) -> MembraneQuality {
    world.membrane_quality(cell).unwrap_or_default()
}

fn percent(share: f32) -> String {
    format!("{:.2}", 100.0 * share)
}
