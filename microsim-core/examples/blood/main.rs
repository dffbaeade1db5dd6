//! Blood in a narrowed vessel for ten minutes: what is in it, what comes and what goes in each.
//!
//! `cargo run --release -p microsim-core --example blood [MINUTES]`; the toy `stenosis` of `microsim-game` shows it.
#![allow(clippy::disallowed_types, clippy::disallowed_methods, reason = "measures time, outside the world")]

mod vessel;

use microsim_core::prelude::*;
use std::time::Instant;

/// What came, what went, and the mean number of organisms that were there.
#[derive(Default)]
struct Flow {
    emitted: u32,
    drained: u32,
    mean: f64,
}

/// Takes the steps of a simulated minute.
fn minute(world: &mut World) -> Flow {
    let steps = (60.0 / world.config().dt).round() as u32;
    let mut flow = Flow::default();
    for _ in 0..steps {
        world.step(&Inputs::new());
        for event in world.events() {
            match event {
                Event::Emitted { .. } => flow.emitted += 1,
                Event::Drained { .. } => flow.drained += 1,
                _ => {}
            }
        }
        flow.mean += world.organisms().count() as f64 / f64::from(steps);
    }
    flow
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let minutes = std::env::args().nth(1).map_or(Ok(10), |count| count.parse::<u32>())?;
    let mut world = vessel::vessel()?;
    let begin = Instant::now();
    for k in 1..=minutes {
        let Flow { emitted, drained, mean } = minute(&mut world);
        world.validate()?;
        let overlap = world.quality().penetration_max;
        println!("minute {k}: {emitted} came, {drained} went, {mean:.1} there, overlap {overlap:.3} radii");
    }
    let per_step = begin.elapsed().as_secs_f64() * 1e3 / world.step_index() as f64;
    println!("{per_step:.3} ms per step, digest {:016x}", world.digest());
    Ok(())
}
