//! Prints a line for each built-in scenario, a scene that a program commands and a room that repeats, and each of some numbers of
//! steps: what `.ci/cross` compares.
//!
//! `digests [baseline|best] [THREADS]` where there is a command line; without one, everything at its default.
#![allow(clippy::disallowed_methods, reason = "compares what differs between platforms, and reads the command line")]

mod arithmetic;
mod commanded;
mod output;
mod periodic;

use commanded::Commanded;
use microsim_core::scenario::{Built, Scenario, builtins};
use microsim_core::{InstructionSet, World};
use output::print;
use periodic::Periodic;

/// After so many steps; the lines of 1 and 60 are also in the core's golden files.
const STEPS: [u64; 3] = [1, 60, 120];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let set = arguments.next().map_or(InstructionSet::Best, |name| instruction_set(&name));
    let threads = arguments.next().map_or(1, |count| count.parse().expect("a number of threads"));
    arithmetic::run();
    on_threads(threads, || {
        builtins().iter().for_each(|scenario| run(scenario.name, scenario.text, set));
        run_commanded(set);
        run_periodic(set);
    });
}

fn instruction_set(name: &str) -> InstructionSet {
    match name {
        "baseline" => InstructionSet::Baseline,
        "best" => InstructionSet::Best,
        _ => panic!("`{name}` is neither baseline nor best"),
    }
}

#[cfg(feature = "parallel")]
fn on_threads(threads: usize, work: impl FnOnce() + Send) {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(work);
}

#[cfg(not(feature = "parallel"))]
fn on_threads(threads: usize, work: impl FnOnce()) {
    assert_eq!(threads, 1, "built without threads");
    work();
}

fn run(name: &str, text: &str, set: InstructionSet) {
    let Built { mut world, mut script, .. } = Scenario::parse(text, &[]).expect(name).build().expect(name);
    world.set_instruction_set(set);
    for steps in STEPS {
        while world.step_index() < steps {
            let inputs = script.before_step(&mut world);
            world.step(inputs);
        }
        print(&line(name, &world));
    }
}

fn run_commanded(set: InstructionSet) {
    let mut scene = Commanded::build().expect("a scene");
    scene.world.set_instruction_set(set);
    for steps in STEPS {
        while scene.world.step_index() < steps {
            scene.step().expect("calls that are accepted");
        }
        print(&line("commanded", &scene.world));
    }
}

fn run_periodic(set: InstructionSet) {
    let mut scene = Periodic::build().expect("a scene");
    scene.world.set_instruction_set(set);
    for steps in STEPS {
        while scene.world.step_index() < steps {
            scene.step().expect("inputs that are accepted");
        }
        print(&line("periodic", &scene.world));
    }
}

fn line(name: &str, world: &World) -> String {
    let particles = world.census().particles;
    format!("{name}: step {} particles {particles} digest {:016x}", world.step_index(), world.digest())
}
