//! A long run of the demonstration in which every organism is told something else every now and then: goals anywhere, to
//! digest or not, to divide, to fuse. The whole state is validated after every step, and memory is watched.
//!
//! `cargo run --release -p microsim-core --features scenario --example soak -- [STEPS] [SEED]`
#![allow(clippy::disallowed_methods, reason = "reads the command line and looks at its own memory")]

use microsim_core::glam::Vec2;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Inputs, Intent, Kind, OrganismId, Rng, World};
use std::collections::BTreeMap;
use std::process::ExitCode;

/// Steps of a simulated minute, after which memory must no longer grow.
const MINUTE: u64 = 3600;
/// Steps between lines of output.
const REPORT: u64 = 10_000;

/// Tells organisms what to do.
struct Director {
    rng: Rng,
    inputs: Inputs,
    counts: BTreeMap<&'static str, u64>,
}

impl Director {
    fn direct(&mut self, world: &mut World) {
        for id in world.organisms().collect::<Vec<_>>() {
            if matches!(world.kind(id), Some(Kind::AmoeboidCell | Kind::RigidCell)) && self.rng.unit() < 0.01 {
                self.command(id, world);
            }
        }
    }

    fn command(&mut self, id: OrganismId, world: &mut World) {
        let size = world.config().size;
        let goal = Vec2::new(self.rng.range(0.0, size.x), self.rng.range(0.0, size.y));
        let intent = Intent::toward(goal).unwrap_or_default().digesting(self.rng.unit() < 0.5);
        self.inputs.set(id, if self.rng.unit() < 0.1 { Intent::REST } else { intent });
        // Who can do neither refuses; that is part of the test.
        let other = world.organisms().find(|_| self.rng.unit() < 0.05);
        let _ = if self.rng.unit() < 0.03 { world.divide(id) } else { world.fuse(id, other.unwrap_or(id)) };
    }

    fn count(&mut self, world: &World) {
        world.events().iter().for_each(|event| *self.counts.entry(event.name()).or_default() += 1);
    }
}

/// Memory in use, kB; 0 where it cannot be found out.
fn resident_kb() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.split_whitespace().next()).and_then(|kb| kb.parse().ok()).unwrap_or(0)
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).map(|text| text.parse().expect("a number"));
    let (steps, seed) = (arguments.next().unwrap_or(1_000_000), arguments.next().unwrap_or(1));
    let scenario = Scenario::parse(builtin("demo").expect("built in").text, &[]).expect("valid");
    let mut world = scenario.build().expect("valid").world;
    let mut director = Director { rng: Rng::new(seed, 7), inputs: Inputs::new(), counts: BTreeMap::new() };
    let mut after_a_minute = None;
    for step in 1..=steps {
        director.direct(&mut world);
        world.step(&director.inputs);
        director.count(&world);
        if let Err(violation) = world.validate() {
            println!("step {step}: {violation}");
            return ExitCode::FAILURE;
        }
        if step == MINUTE {
            after_a_minute = Some(resident_kb());
        }
        if step % REPORT == 0 || step == MINUTE {
            let (memory, census) = (resident_kb(), world.census());
            println!("step {step}: {memory} kB, {census:?}, events {:?}", director.counts);
        }
    }
    println!("{steps} steps are valid; {} kB, {after_a_minute:?} kB after a minute", resident_kb());
    if world.census().quarantined == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
