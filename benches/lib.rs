//! Scenes and clocks that the benchmarks share.

use microsim_core::scenario::{self, Scenario};
use microsim_core::{Inputs, Phase, World};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Steps before measuring starts: things have met by then.
const WARM_UP: usize = 240;
/// Steps after which 200 platelets are still again.
const AT_REST: usize = 2400;
/// Steps after which a measurement starts over from the same state, so that its length does not change what is measured.
const STRETCH: u64 = 120;

/// A built-in scenario in full swing.
///
/// # Panics
/// When there is no such scenario, or it cannot be built.
#[must_use]
pub fn scene(name: &str, overrides: &[(&str, &str)]) -> World {
    let found = scenario::builtin(name).expect("the scenario is built in");
    let pairs: Vec<_> = overrides.iter().map(|&(key, value)| (key.to_owned(), value.to_owned())).collect();
    let scenario = Scenario::parse(found.text, &pairs).expect("the scenario is valid");
    warmed_up(scenario.build().expect("the scenario can be built").world)
}

/// `platelets` with this many of them, all awake.
#[must_use]
pub fn platelets(count: u32) -> World {
    scene("platelets", &[("count", &count.to_string()), ("world.sleeps", "false")])
}

/// `platelets` with this many of them, still again after the probe has passed.
///
/// # Panics
/// When the scenario cannot be built.
#[must_use]
pub fn platelets_at_rest(count: u32) -> World {
    let mut world = scene("platelets", &[("count", &count.to_string())]);
    (WARM_UP..AT_REST).for_each(|_| world.step(&Inputs::new()));
    world
}

/// The world some seconds later.
#[must_use]
pub fn warmed_up(mut world: World) -> World {
    (0..WARM_UP).for_each(|_| world.step(&Inputs::new()));
    world
}

/// Time of so many steps from this state, a stretch at a time.
#[must_use]
pub fn time_of_steps(start: &World, steps: u64) -> Duration {
    in_stretches(start, steps, |world| {
        let begin = Instant::now();
        world.step(&Inputs::new());
        begin.elapsed()
    })
}

/// The same with each step saved in a ring of eight worlds before.
#[must_use]
pub fn time_of_saved_steps(start: &World, steps: u64) -> Duration {
    let mut ring = vec![start.clone(); 8];
    in_stretches(start, steps, |world| {
        let begin = Instant::now();
        ring[world.step_index() as usize % 8].clone_from(world);
        world.step(&Inputs::new());
        begin.elapsed()
    })
}

/// Time of one phase in so many steps from this state.
#[must_use]
pub fn time_of_phase(start: &World, steps: u64, phase: Phase) -> Duration {
    in_stretches(start, steps, |world| {
        let (mut spent, mut last) = (Duration::ZERO, Instant::now());
        world.step_observed(&Inputs::new(), |finished| {
            let now = Instant::now();
            if finished == phase {
                spent += now - last;
            }
            last = now;
        });
        spent
    })
}

fn in_stretches(start: &World, steps: u64, mut timed: impl FnMut(&mut World) -> Duration + Send) -> Duration {
    on_one_thread(|| {
        let mut world = start.clone();
        (0..steps).fold(Duration::ZERO, |sum, step| {
            if step > 0 && step % STRETCH == 0 {
                world = start.clone();
            }
            sum + timed(&mut world)
        })
    })
}

/// Does work on one thread, whatever the machine has: the core is built with threads.
///
/// # Panics
/// When the system has no thread to give.
pub fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    static POOL: LazyLock<ThreadPool> =
        LazyLock::new(|| ThreadPoolBuilder::new().num_threads(1).build().expect("there is a thread"));
    POOL.install(work)
}

/// The examples of the workspace's README, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The examples of the guide for embedders.
#[cfg(doctest)]
#[doc = include_str!("../docs/embedding.md")]
struct Embedding;
