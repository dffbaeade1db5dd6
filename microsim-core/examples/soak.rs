//! A long run of the demonstration in which every organism is told something else every now and then: other controllers,
//! goals anywhere, to digest or not, to divide, to fuse. The whole state is validated after every step, and memory is
//! watched: what the process has allocated, to the byte, and what it has of the machine.
//!
//! `cargo run --release -p microsim-core --features scenario,snapshot --example soak -- [STEPS] [SEED]`
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "reads the command line and the clock, and looks at its own memory"
)]

use cap::Cap;
use microsim_core::glam::Vec2;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{
    AvoidanceParams, BrownianParams, Controller, FleeParams, Inputs, Intent, Kind, OrganismId, PersistentWalkParams,
    PursueParams, Rng, RunAndTumbleParams, World,
};
use std::alloc::System;
use std::collections::BTreeMap;
use std::process::ExitCode;
use std::time::Instant;

/// Counts what is allocated.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Steps of a simulated minute, after which no memory may be allocated beyond what the world needs.
const MINUTE: u64 = 3600;
/// Steps between lines of output.
const REPORT: u64 = 10_000;
/// Most memory that may be allocated, relative to what a copy of the world takes: lists double when they are full, and do
/// not shrink.
const MOST_SLACK: usize = 2;

/// Tells organisms what to do.
struct Director {
    rng: Rng,
    inputs: Inputs,
    /// Events by name, and calls that were refused.
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
        let goal = self.place(world);
        match self.rng.next_u32() % 8 {
            0 => self.inputs.set(id, Intent::REST),
            1..=4 => {
                let digests = self.rng.unit() < 0.5;
                self.inputs.set(id, Intent::toward(goal).unwrap_or_default().digesting(digests));
            }
            _ => {
                self.inputs.remove(id);
                let controller = self.controller(world);
                self.try_to("set_controller", world.set_controller(id, controller));
            }
        }
        // Organisms that cannot do it refuse; that is part of the test.
        let other = world.organisms().find(|_| self.rng.unit() < 0.05);
        if self.rng.unit() < 0.03 {
            self.try_to("divide", world.divide(id));
        } else {
            self.try_to("fuse", world.fuse(id, other.unwrap_or(id)));
        }
    }

    fn controller(&mut self, world: &World) -> Controller {
        let goals = vec![self.place(world), self.place(world)];
        let otherwise = Controller::wander([0.5, 3.0], 0.1);
        match self.rng.next_u32() % 10 {
            0 => Controller::Still,
            1 => otherwise,
            2 => Controller::patrol(goals, true),
            3 => Controller::thrash(0.2, 0.5),
            4 => Controller::ram(0.5, 0.5, 20.0),
            5 => Controller::persistent_walk(PersistentWalkParams::default()),
            6 => Controller::run_and_tumble(RunAndTumbleParams::default()),
            7 => Controller::avoidance(AvoidanceParams::default()),
            8 => Controller::flee(FleeParams::default(), otherwise),
            _ => Controller::pursue(PursueParams::default(), Controller::brownian(BrownianParams::default())),
        }
    }

    fn place(&mut self, world: &World) -> Vec2 {
        let size = world.config().size;
        Vec2::new(self.rng.range(0.0, size.x), self.rng.range(0.0, size.y))
    }

    fn try_to(&mut self, name: &'static str, outcome: Result<(), microsim_core::Error>) {
        *self.counts.entry(name).or_default() += u64::from(outcome.is_err());
    }

    /// Counts what happened, and forgets who is gone.
    fn look(&mut self, world: &World) {
        world.events().iter().for_each(|event| *self.counts.entry(event.name()).or_default() += 1);
        let gone: Vec<_> = self.inputs.iter().map(|(id, _)| id).filter(|&id| world.kind(id).is_none()).collect();
        for id in gone {
            self.inputs.remove(id);
        }
    }
}

/// Memory in use, kB; 0 where it cannot be found out.
fn resident_kb() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.split_whitespace().next()).and_then(|kb| kb.parse().ok()).unwrap_or(0)
}

/// Bytes that a new world of this state takes: one that was read from a snapshot (a clone would share) and has taken a step.
fn needed(world: &World) -> usize {
    let snapshot = world.to_snapshot().expect("all shapes are known");
    let before = ALLOCATOR.allocated();
    let mut copy = World::from_snapshot(&snapshot).expect("a sound world");
    copy.step(&Inputs::new());
    ALLOCATOR.allocated() - before
}

/// Prints a line of the table. Memory is in bytes.
fn report(world: &World, start: Instant, [allocated, needed]: [usize; 2], counts: &BTreeMap<&'static str, u64>) {
    let (step, census) = (world.step_index(), world.census());
    let rate = step as f64 / start.elapsed().as_secs_f64();
    let nodes: usize = world.view().organisms().map(|organism| organism.outline().len()).sum();
    print!("{step}\t{rate:.0}\t{}\t{}\t{nodes}\t", census.organisms, census.particles);
    println!("{}\t{}\t{}\t{counts:?}", allocated / 1000, needed / 1000, resident_kb());
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).map(|text| text.parse().expect("a number"));
    let (steps, seed) = (arguments.next().unwrap_or(1_000_000), arguments.next().unwrap_or(1));
    let scenario = Scenario::parse(builtin("demo").expect("built in").text, &[]).expect("valid");
    let mut world = scenario.build().expect("valid").world;
    drop(scenario);
    let mut director = Director { rng: Rng::new(seed, 7), inputs: Inputs::new(), counts: BTreeMap::new() };
    let start = Instant::now();
    println!("step\tsteps/s\torganisms\tparticles\tnodes\tallocated, kB\tneeded, kB\tresident, kB\twhat happened");
    for step in 1..=steps {
        director.direct(&mut world);
        world.step(&director.inputs);
        director.look(&world);
        if let Err(violation) = world.validate() {
            println!("step {step}: {violation}");
            return ExitCode::FAILURE;
        }
        if step % REPORT == 0 || step == MINUTE || step == steps {
            let (allocated, needed) = (ALLOCATOR.allocated(), needed(&world));
            report(&world, start, [allocated, needed], &director.counts);
            if world.census().quarantined > 0 || (step >= MINUTE && allocated > MOST_SLACK * needed) {
                println!("step {step}: somebody is in quarantine, or memory is lost");
                return ExitCode::FAILURE;
            }
        }
    }
    println!("{steps} steps: all valid, nobody in quarantine, no memory lost");
    ExitCode::SUCCESS
}
