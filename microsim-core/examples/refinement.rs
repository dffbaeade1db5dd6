//! What refining the step changes: a table over the time of a step and the number of substeps.
//!
//! ```text
//! cargo run --release -p microsim-core --features scenario --example refinement [-- SEEDS [DT]]
//! ```
#![allow(clippy::disallowed_methods, reason = "measures; only stepping has to be bit-exact")]

use microsim_core::geometry::polygon::signed_area;
use microsim_core::glam::Vec2;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Error, Event, Inputs, Intent, Measure, OrganismId, Placement, World, WorldConfig,
};

const STEPS: [f32; 4] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0, 0.001];
const SUBSTEPS: [u32; 6] = [1, 4, 8, 16, 32, 64];

fn config(dt: f32, substeps: u32) -> WorldConfig {
    WorldConfig { dt, substeps, ..WorldConfig::default() }
}

/// Steps until a time, s.
fn steps(dt: f32, time: f32) -> u32 {
    (time / dt).round() as u32
}

/// Speed after a second of free fall at 10 units/s2, relative to 10 units/s, less 1.
fn free_fall(dt: f32, substeps: u32) -> Result<f32, Error> {
    let gravity = Vec2::new(0.0, -10.0);
    let mut world = World::new(WorldConfig { gravity, damping: 0.0, ..config(dt, substeps) })?;
    let probe = world.spawn(&AgarSpec::default().into(), Placement::at(80.0, 60.0))?;
    (0..steps(dt, 1.0)).for_each(|_| world.step(&Inputs::new()));
    let speed = world.view().organism(probe).and_then(|disc| disc.particles().next()).map_or(0.0, |p| -p.velocity.y);
    Ok(speed / 10.0 - 1.0)
}

fn area(world: &World, cell: OrganismId) -> f32 {
    let outline: Vec<Vec2> = world.view().organism(cell).map(|cell| cell.outline().collect()).unwrap_or_default();
    signed_area(&outline)
}

/// How far a cell that nobody drives gets in 20 s, units, and the largest deviation of its area from that of its spec, as a
/// share, for a time between 0.1 s and 20 s.
fn rest(dt: f32, substeps: u32) -> Result<(f32, f32, f32), Error> {
    let mut world = World::new(config(dt, substeps))?;
    let spec = AmoeboidCellSpec::default();
    let nodes = spec.radii - Vec2::splat(spec.node_radius);
    let wanted = std::f32::consts::PI * nodes.x * nodes.y;
    let cell = world.spawn(&spec.into(), Placement::at(80.0, 45.0))?;
    let start = world.centroid(cell).unwrap_or_default();
    let (mut low, mut high) = (0.0f32, 0.0f32);
    for step in 0..steps(dt, 20.0) {
        world.step(&Inputs::new());
        if step % steps(dt, 0.1).max(1) == 0 {
            let error = area(&world, cell) / wanted - 1.0;
            (low, high) = (low.min(error), high.max(error));
        }
    }
    Ok(((world.centroid(cell).unwrap_or_default() - start).length(), low, high))
}

/// Way and area of a cell that is driven for 4 s, the area relative to that of its spec.
fn driven(dt: f32, substeps: u32) -> Result<(f32, f32), Error> {
    let mut world = World::new(config(dt, substeps))?;
    let spec = AmoeboidCellSpec::default();
    let nodes = spec.radii - Vec2::splat(spec.node_radius);
    let wanted = std::f32::consts::PI * nodes.x * nodes.y;
    let cell = world.spawn(&spec.into(), Placement::at(40.0, 45.0))?;
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(Vec2::new(150.0, 45.0))?);
    (0..steps(dt, 4.0)).for_each(|_| world.step(&inputs));
    Ok((world.centroid(cell).unwrap_or_default().x - 40.0, area(&world, cell) / wanted - 1.0))
}

fn stretch_of(world: &World) -> f32 {
    Measure::named("membrane_stretch_max").map_or(0.0, |measure| measure.of(world) as f32)
}

/// Runs a built-in scenario; says when prey was taken in, and what was broken.
fn absorb(name: &str, seed: u64, dt: f32, substeps: u32) -> String {
    let overrides = [("step.dt".to_owned(), dt.to_string()), ("step.substeps".to_owned(), substeps.to_string())];
    let Some(text) = builtin(name).map(|builtin| builtin.text) else { return "none".to_owned() };
    let mut scenario = match Scenario::parse(text, &overrides) {
        Ok(scenario) => scenario,
        Err(error) => return error.to_string(),
    };
    scenario.set_seed(seed);
    let Ok(mut built) = scenario.build() else { return "no room".to_owned() };
    let (mut ingested, mut released, mut stretch, mut improper) = (None, 0, 0.0f32, 0);
    for _ in 0..steps(dt, 15.0) {
        built.step(&Inputs::new());
        for event in built.world.events() {
            match event {
                Event::Ingested { .. } => ingested = ingested.or(Some(built.world.time())),
                Event::Released { .. } => released += 1,
                _ => {}
            }
        }
        stretch = stretch.max(stretch_of(&built.world));
        if built.world.step_index() % 10 == 0 {
            let census = built.world.census();
            improper = improper.max(census.improper_absorptions + census.partial_absorptions + census.leaks);
        }
        if ingested.is_some_and(|time| built.world.time() > time + 1.0) {
            break;
        }
    }
    let census = built.world.census();
    let mut flaws = String::new();
    for (name, count) in [
        ("released", released),
        ("improper", improper as u64),
        ("wrong_side", census.wrong_side),
        ("net_fired", census.net_fired),
        ("stretch%", if stretch > 0.25 { (stretch * 100.0) as u64 } else { 0 }),
    ] {
        if count > 0 {
            flaws += &format!(" {name}={count}");
        }
    }
    let time = ingested.map_or("never".to_owned(), |time| format!("{time:.1}"));
    format!("{time}{flaws}")
}

fn row(dt: f32, substeps: u32, seeds: u64) -> String {
    let fall = free_fall(dt, substeps).map_or_else(|error| error.to_string(), |error| format!("{:+.4}", error));
    let rest = rest(dt, substeps).map_or_else(
        |error| error.to_string(),
        |(way, low, high)| format!("way {way:.3} area {:+.1}% {:+.1}%", 100.0 * low, 100.0 * high),
    );
    let driven = driven(dt, substeps)
        .map_or_else(|error| error.to_string(), |(way, area)| format!("{way:.1} {:+.1}%", 100.0 * area));
    let absorb = |name: &str| (1..=seeds).map(|seed| absorb(name, seed, dt, substeps)).collect::<Vec<_>>().join(", ");
    let (agar, rigid) = (absorb("absorb-agar"), absorb("absorb-rigid"));
    format!("{dt:.5} {substeps:2} | fall {fall} | rest {rest} | driven {driven} | agar {agar} | rigid {rigid}")
}

fn main() {
    let mut args = std::env::args().skip(1);
    let seeds: u64 = args.next().and_then(|seeds| seeds.parse().ok()).unwrap_or(5);
    let only: Option<f32> = args.next().and_then(|dt| dt.parse().ok());
    let cells = STEPS.iter().flat_map(|&dt| SUBSTEPS.map(|substeps| (dt, substeps)));
    for (dt, substeps) in cells.filter(|(dt, _)| only.is_none_or(|only| (only - dt).abs() < 1e-4)) {
        println!("{}", row(dt, substeps, seeds));
    }
}
