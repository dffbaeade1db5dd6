//! Bacilli that grow and divide: one rod becomes a colony of 500.
//!
//! `cargo run --release -p microsim-core --example colony`; the toy `colony` of `microsim-game` shows it.
#![allow(clippy::disallowed_types, reason = "measures time, outside the world")]

mod rods;

use microsim_core::prelude::*;
use std::time::Instant;

fn main() -> Result<(), Error> {
    let (mut world, mut colony) = rods::colony()?;
    let mut inputs = Inputs::new();
    let begin = Instant::now();
    while world.organisms().count() < rods::COLONY {
        colony.grow(&mut world, &mut inputs)?;
        world.step(&inputs);
    }
    let per_step = begin.elapsed().as_secs_f64() * 1e3 / world.step_index() as f64;
    assert!(world.validate().is_ok());
    let overlap = world.quality().penetration_max;
    println!(
        "{} rods after {:.1} s, {per_step:.2} ms per step, overlap {overlap:.3} radii",
        world.organisms().count(),
        world.time()
    );
    Ok(())
}
