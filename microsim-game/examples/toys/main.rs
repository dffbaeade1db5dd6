//! Toys: small worlds that a game could begin with.
//!
//! `cargo run --release -p microsim-game --example toys -- NAME` opens a window on one; with the name of a file after it, a picture
//! is written there of the world after half a minute. Without a name, a table is printed: each toy's lines, and how fast it runs.
//!
//! They use the platform's sine: what is only shown needs no equal bits.
#![allow(clippy::disallowed_types, reason = "measures time, outside the worlds")]

mod colony;
mod flagellum;
mod jellyfish;
mod rollback;
mod rope_and_wheel;
mod slime_platformer;
mod stenosis;
mod window;
mod worm;

use microsim_core::prelude::*;
use std::time::Instant;

/// What is held down: the arrow keys, and space or arrow up.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Keys {
    pub left: bool,
    pub right: bool,
    pub jump: bool,
}

/// Sets the inputs of each step, and may change the world before it.
type Act = Box<dyn FnMut(&mut World, &mut Inputs, Keys) -> Result<(), Error>>;
/// A world, and what acts on it.
pub(crate) type Scene = Result<(World, Act), Error>;

/// Steps that are timed.
const LAST: usize = 600;

struct Toy {
    name: &'static str,
    /// Its program.
    sources: &'static [&'static str],
    scene: fn() -> Scene,
}

macro_rules! toys {
    ($($name:ident $(with $($more:literal),+)?;)*) => {
        &[$(Toy {
            name: stringify!($name),
            sources: &[include_str!(concat!(stringify!($name), ".rs")) $($(, include_str!($more))+)?],
            scene: $name::scene,
        }),*]
    };
}

const TOYS: &[Toy] = toys! {
    slime_platformer;
    jellyfish;
    worm;
    flagellum;
    stenosis with "../../../microsim-core/examples/blood/vessel.rs";
    colony with "../../../microsim-core/examples/colony/rods.rs";
    rope_and_wheel;
    rollback;
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let Some(name) = arguments.next() else {
        println!("| toy | lines | organisms | steps/s | ms/step | errors |\n|---|---|---|---|---|---|");
        for toy in TOYS {
            println!("{}", row(toy)?);
        }
        return Ok(());
    };
    let Some(toy) = TOYS.iter().find(|toy| toy.name == name) else {
        let names: Vec<_> = TOYS.iter().map(|toy| toy.name).collect();
        return Err(format!("no toy is called {name}; there are {}", names.join(", ")).into());
    };
    let (world, act) = (toy.scene)()?;
    window::run(toy.name, world, act, arguments.next());
    Ok(())
}

/// Runs a toy for a minute without a window; the time of a step is the median of the last ten seconds. Errors are organisms that were
/// frozen, and seconds after which the state was not valid.
fn row(toy: &Toy) -> Result<String, Error> {
    let (mut world, mut act) = (toy.scene)()?;
    let (mut inputs, mut times, mut errors) = (Inputs::new(), Vec::new(), 0);
    while world.time() < 60.0 {
        let begin = Instant::now();
        act(&mut world, &mut inputs, Keys::default())?;
        world.step(&inputs);
        times.push(begin.elapsed().as_secs_f64());
        errors += world.events().iter().filter(|event| matches!(event, Event::Quarantined { .. })).count();
        errors += usize::from(world.step_index().is_multiple_of(60) && world.validate().is_err());
    }
    let last = times.len() - LAST;
    let (_, median, _) = times[last..].select_nth_unstable_by(LAST / 2, f64::total_cmp);
    let (per_second, per_step, count) = (1.0 / *median, 1e3 * *median, world.organisms().count());
    Ok(format!("| `{}` | {} | {count} | {per_second:.0} | {per_step:.3} | {errors} |", toy.name, lines(toy)))
}

/// Lines that are neither empty nor comments.
fn lines(toy: &Toy) -> usize {
    let is_code = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with("//");
    toy.sources.iter().flat_map(|source| source.lines()).filter(is_code).count()
}
