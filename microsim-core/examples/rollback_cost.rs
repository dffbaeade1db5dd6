//! Cost of saving a world and restoring it, relative to its step, as rollback netcode does: each step is saved into a ring
//! of worlds, and the world is restored when a prediction was wrong. All variants take turns, in one process.
//!
//! `cargo run --release -p microsim-core --features scenario --example rollback_cost -- [SCENARIO] [KEY=VALUE]...`
#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "reads the command line and the clock")]

use cap::Cap;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Inputs, World};
use std::alloc::System;
use std::mem::replace;
use std::time::Instant;

/// Counts what is allocated.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Worlds that are kept: the steps of a rollback.
const RING: usize = 8;
/// Steps before measuring starts.
const WARM_UP: u32 = 240;
/// Steps of each turn.
const TURN: usize = 3 * RING;
const TURNS: usize = 100;

/// How steps are made.
#[derive(Clone, Copy)]
enum Way {
    Plain,
    /// Before each step `clone_from` into the oldest of so many.
    Saving(usize),
    /// Before each step a `clone` that takes the place of the oldest of so many.
    Cloning(usize),
    /// Saving into the ring, and after each time round `clone_from` what was saved first.
    GoingBack,
}

const WAYS: [(Way, &str); 6] = [
    (Way::Plain, "step"),
    (Way::Saving(1), "clone_from, one world"),
    (Way::Saving(RING), "clone_from, ring of 8"),
    (Way::Cloning(1), "clone, one world"),
    (Way::Cloning(RING), "clone, ring of 8"),
    (Way::GoingBack, "back by clone_from, every 8 steps"),
];

/// Times of one turn, µs.
struct Turn {
    /// Of what is not a step, each.
    extra: f64,
    /// Of all, per step.
    whole: f64,
}

fn turn(way: Way, world: &mut World, ring: &mut [World]) -> Turn {
    let (begin, mut extra, mut extras) = (Instant::now(), 0.0, 0.0);
    let mut timed = |work: &mut dyn FnMut()| {
        let begin = Instant::now();
        work();
        extra += micros(begin);
        extras += 1.0;
    };
    for k in 0..TURN {
        let oldest = k % RING;
        match way {
            Way::Plain => {}
            Way::Saving(count) => timed(&mut || ring[k % count].clone_from(world)),
            Way::Cloning(count) => timed(&mut || drop(replace(&mut ring[k % count], world.clone()))),
            Way::GoingBack if oldest == 0 && k > 0 => timed(&mut || world.clone_from(&ring[0])),
            Way::GoingBack => ring[oldest].clone_from(world),
        }
        world.step(&Inputs::new());
    }
    Turn { extra: extra / extras, whole: micros(begin) / TURN as f64 }
}

fn micros(begin: Instant) -> f64 {
    begin.elapsed().as_secs_f64() * 1e6
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Worlds of the last steps, and the bytes that each of them takes.
fn ring_of(world: &mut World) -> (Vec<World>, usize) {
    world.step(&Inputs::new());
    let before = ALLOCATOR.allocated();
    let mut ring = Vec::with_capacity(RING);
    for _ in 0..RING {
        ring.push(world.clone());
        world.step(&Inputs::new());
    }
    (ring, (ALLOCATOR.allocated() - before) / RING)
}

/// The name of the scenario that the command line asks for, and its world after some steps.
fn world_to_measure() -> (String, World) {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "platelets".to_owned());
    let mut overrides: Vec<_> = arguments
        .map(|pair| pair.split_once('=').map(|(key, value)| (key.to_owned(), value.to_owned())).expect("KEY=VALUE"))
        .collect();
    if name == "platelets" && overrides.is_empty() {
        let all_awake = [("count", "333"), ("world.sleeps", "false")];
        overrides.extend(all_awake.map(|(key, value)| (key.to_owned(), value.to_owned())));
    }
    let text = builtin(&name).expect("a built-in scenario").text;
    let mut world = Scenario::parse(text, &overrides).unwrap().build().unwrap().world;
    (0..WARM_UP).for_each(|_| world.step(&Inputs::new()));
    (name, world)
}

fn print(turns: &[Vec<Turn>; WAYS.len()]) {
    let plain: Vec<f64> = turns[0].iter().map(|turn| turn.whole).collect();
    let share = |times: Vec<f64>| 100.0 * median(times.iter().zip(&plain).map(|(time, step)| time / step).collect());
    println!("{:<34} {:>6.1} us", WAYS[0].1, median(plain.clone()));
    for ((_, name), turns) in WAYS.iter().zip(turns).skip(1) {
        let extra = || turns.iter().map(|turn| turn.extra).collect::<Vec<_>>();
        let whole = turns.iter().map(|turn| turn.whole).collect();
        let (micros, of_step, more) = (median(extra()), share(extra()), share(whole) - 100.0);
        println!("{name:<34} {micros:>6.1} us, {of_step:>5.2} % of a step; steps with it {more:>5.2} % longer");
    }
}

fn main() {
    let (name, mut world) = world_to_measure();
    let bodies = world.census().bodies;
    let (mut ring, bytes) = ring_of(&mut world);
    println!("{name}: {bodies} bodies; each world of a ring takes {:.1} bytes per body", bytes as f64 / bodies as f64);
    let start = world.clone();
    let mut turns = WAYS.map(|_| Vec::new());
    for _ in 0..TURNS {
        for ((way, _), turns) in WAYS.iter().zip(&mut turns) {
            world.clone_from(&start);
            ring.iter_mut().for_each(|saved| saved.clone_from(&world));
            world.step(&Inputs::new());
            turns.push(turn(*way, &mut world, &mut ring));
        }
    }
    print(&turns);
}
