//! The scene that a program commands (`examples/digests/commanded`): its golden digests, the same with any number of threads and
//! any instruction set, and all that it is meant to show. The golden digests of a room that repeats (`examples/digests/periodic.rs`).
//!
//! `UPDATE_GOLDEN=1` writes them, as for `golden.rs`. `.ci/cross` compares its digests between platforms.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

#[path = "../examples/digests/commanded/mod.rs"]
mod commanded;
#[path = "../examples/digests/periodic.rs"]
mod periodic;

use commanded::Commanded;
use microsim_core::{Event, InstructionSet, World};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Steps after which every call of the scene was made.
const ALL_CALLED: u64 = 40;

/// Also of the lines that the example prints.
const STEPS: [u64; 2] = [1, 60];

#[test]
fn the_scene_ends_in_its_golden_digests_and_shows_everything() {
    let mut scene = Commanded::build().unwrap();
    assert!(
        scene.world.census().particles > 8192,
        "{} particles: threads share no work",
        scene.world.census().particles
    );
    let (mut lines, mut events) = (String::new(), BTreeSet::new());
    for steps in STEPS {
        while scene.world.step_index() < steps {
            scene.step().unwrap();
            events.extend(scene.world.events().iter().map(name));
        }
        scene.world.validate().unwrap();
        let census = scene.world.census();
        assert_eq!((census.leaks, census.quarantined), (0, 0));
        writeln!(lines, "step {steps} particles {} digest {:016x}", census.particles, scene.world.digest()).unwrap();
    }
    let expected =
        "ContactBegan Divided Drained Emitted Hit JointBroken LinkTorn SensorEntered SensorLeft TouchBegan TouchEnded";
    let missing: Vec<&str> = expected.split(' ').filter(|&name| !events.contains(name)).collect();
    assert!(missing.is_empty(), "nothing of {missing:?} happens, only {events:?}");
    assert_golden(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/commanded.txt"), &lines);
}

#[test]
fn a_room_that_repeats_ends_in_its_golden_digests() {
    let mut scene = periodic::Periodic::build().unwrap();
    let mut lines = String::new();
    for steps in [1, 60, 120] {
        while scene.world.step_index() < steps {
            scene.step().unwrap();
        }
        scene.world.validate().unwrap();
        let particles = scene.world.census().particles;
        writeln!(lines, "step {steps} particles {particles} digest {:016x}", scene.world.digest()).unwrap();
    }
    assert_eq!(scene.world.census().quarantined, 0);
    assert_golden(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/periodic.txt"), &lines);
}

fn assert_golden(file: &str, lines: &str) {
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(file, lines).unwrap();
    }
    let golden = std::fs::read_to_string(file).unwrap_or_default();
    assert_eq!(lines, golden, "{file} differs: if that is meant, write it with UPDATE_GOLDEN=1");
}

fn name(event: &Event) -> String {
    format!("{event:?}").split([' ', '{']).next().unwrap_or_default().to_owned()
}

/// The digest after all calls were made.
fn digest(mut scene: Commanded, set: InstructionSet) -> u64 {
    scene.world.set_instruction_set(set);
    (0..=ALL_CALLED).for_each(|_| scene.step().unwrap());
    scene.world.digest()
}

#[test]
fn digests_do_not_depend_on_the_instruction_set_and_the_number_of_threads() {
    let scene = Commanded::build().unwrap();
    let run = |set: InstructionSet| digest(scene.clone(), set);
    let alone = run(InstructionSet::Baseline);
    assert_eq!(run(InstructionSet::Best), alone);
    #[cfg(feature = "parallel")]
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| run(InstructionSet::Best)), alone, "{threads} threads");
    }
}

#[cfg(feature = "snapshot")]
#[test]
fn the_scene_goes_on_the_same_from_a_snapshot_at_any_time() {
    let mut scene = Commanded::build().unwrap();
    for step in 0..ALL_CALLED {
        if step % 8 == 5 {
            let mut read = scene.clone();
            read.world = World::from_snapshot(&scene.world.to_snapshot().unwrap()).unwrap();
            let mut goes_on = scene.clone();
            (0..3).for_each(|_| [&mut read, &mut goes_on].into_iter().for_each(|scene| scene.step().unwrap()));
            assert_eq!(read.world.digest(), goes_on.world.digest(), "from step {step}");
        }
        scene.step().unwrap();
    }
}
