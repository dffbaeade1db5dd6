//! Golden digests: every built-in scenario ends in the state that is written down, on every platform and in every build.
//!
//! `UPDATE_GOLDEN=1 cargo test -p microsim-core --features scenario --test golden` writes them; a changed digest is
//! explained in CHANGELOG.md.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]
#![cfg(feature = "scenario")]

use microsim_core::scenario::{Built, Scenario, builtin, builtins};
use microsim_core::{Inputs, InstructionSet, Kind, OrganismView, Role, World};
use std::fmt::Write as _;
use std::path::PathBuf;

const STEPS: [u32; 3] = [1, 60, 300];

fn build(name: &str, seed: Option<u64>) -> World {
    let mut scenario = Scenario::parse(builtin(name).unwrap().text, &[]).unwrap();
    seed.into_iter().for_each(|seed| scenario.set_seed(seed));
    scenario.build().unwrap().world
}

fn golden_file(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests", "golden", &format!("{name}.txt")].iter().collect()
}

/// Digests and counts after some numbers of steps, a line each.
fn history(name: &str) -> String {
    let scenario = Scenario::parse(builtin(name).unwrap().text, &[]).unwrap();
    let Built { mut world, mut script, .. } = scenario.build().unwrap();
    let mut lines = String::new();
    for steps in STEPS {
        while world.step_index() < u64::from(steps) {
            let inputs = script.before_step(&mut world);
            world.step(inputs);
        }
        let census = world.census();
        writeln!(lines, "step {steps} particles {} digest {:016x}", census.particles, world.digest()).unwrap();
    }
    lines
}

#[test]
fn built_in_scenarios_end_in_their_golden_digests() {
    for scenario in builtins() {
        let file = golden_file(scenario.name);
        let now = history(scenario.name);
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            std::fs::write(&file, &now).unwrap();
        }
        let golden = std::fs::read_to_string(&file).unwrap_or_default();
        assert_eq!(now, golden, "{} differs: if that is meant, write it with UPDATE_GOLDEN=1", file.display());
    }
}

#[test]
fn every_behaviour_is_in_a_built_in_scenario() {
    let steers = |organism: OrganismView<'_>| format!("{:?} {:?}", organism.controller(), organism.exchanges());
    let built_in = builtins().iter().map(|scenario| build(scenario.name, None));
    let all: String = built_in.flat_map(|world| world.view().organisms().map(steers).collect::<Vec<_>>()).collect();
    let models = "Wander Patrol Thrash Ram PersistentWalk Chemotaxis RunAndTumble Brownian Avoidance Flee Pursue";
    let missing: Vec<&str> = models.split(' ').filter(|model| !all.contains(&format!("{model}({model}"))).collect();
    assert!(missing.is_empty(), "digests cover no {missing:?}");
}

#[test]
fn equal_seeds_give_equal_worlds_and_other_seeds_other_ones() {
    let run = |seed: u64| {
        let mut world = build("demo", Some(seed));
        (0..120).for_each(|_| world.step(&Inputs::new()));
        world.digest()
    };
    assert_eq!(run(5), run(5));
    assert_ne!(run(5), run(6));
}

#[test]
fn a_clone_has_the_same_future() {
    let mut world = build("demo", None);
    (0..60).for_each(|_| world.step(&Inputs::new()));
    let mut clone = world.clone();
    assert_eq!(world.digest(), clone.digest());
    for step in 0..60 {
        world.step(&Inputs::new());
        clone.step(&Inputs::new());
        assert_eq!(world.digest(), clone.digest(), "step {step}");
        assert_eq!(world.events(), clone.events(), "step {step}");
    }
}

#[test]
fn a_clone_in_the_place_of_another_world_has_the_same_future_and_answers_alike() {
    let answers = |world: &World| {
        let contacts: Vec<_> = world.view().contacts().collect();
        (world.digest(), format!("{:?} {:?}", world.quality(), world.census()), contacts)
    };
    let mut place = build("dam-break", None);
    (0..10).for_each(|_| place.step(&Inputs::new()));
    for name in ["demo", "empty", "platelets", "hunt"] {
        let mut world = build(name, None);
        (0..60).for_each(|_| world.step(&Inputs::new()));
        place.clone_from(&world);
        let (then, mut future) = (answers(&world), Vec::new());
        for _ in 0..30 {
            world.step(&Inputs::new());
            future.push(answers(&world));
        }
        assert!(answers(&place) == then, "{name}: what the original does shows in its clone");
        for (step, expected) in future.iter().enumerate() {
            place.step(&Inputs::new());
            assert!(answers(&place) == *expected, "{name}, {step} steps after");
        }
    }
}

/// Most nodes that the largest prey in the demonstration needs around it, as a fold and then as a phagosome.
const NODES_OF_A_FOLD: usize = 40;

/// Particles of all organisms but the membranes of cells that take prey in: those lengthen around it.
fn particles_but_membranes(world: &World) -> usize {
    let is_lengthening = |kind: Kind, role: Role| kind == Kind::AmoeboidCell && role == Role::Membrane;
    let count = |organism: OrganismView<'_>| {
        organism.particles().filter(|particle| !is_lengthening(organism.kind(), particle.role)).count()
    };
    world.view().organisms().map(count).sum()
}

#[test]
fn nothing_leaks_or_is_lost_in_the_demonstration() {
    let mut world = build("demo", None);
    let (all, others) = (world.census().particles, particles_but_membranes(&world));
    for step in 0..900 {
        world.step(&Inputs::new());
        let census = world.census();
        assert_eq!((census.leaks, census.improper_absorptions, census.quarantined), (0, 0, 0), "step {step}");
        assert_eq!(particles_but_membranes(&world), others, "step {step}");
        let meals: usize = world.view().organisms().map(|cell| cell.meals().count()).sum();
        let extra = census.particles.checked_sub(all).expect("membranes only lend out what they get");
        assert!(extra <= meals * NODES_OF_A_FOLD, "step {step}: {extra} more nodes for {meals} prey");
    }
}

#[test]
fn digests_do_not_depend_on_the_instruction_set() {
    for scenario in builtins() {
        let mut worlds = [InstructionSet::Baseline, InstructionSet::Best].map(|set| {
            let mut world = build(scenario.name, None);
            world.set_instruction_set(set);
            world
        });
        for step in 0..30 {
            let [baseline, best] = worlds.each_mut().map(|world| {
                world.step(&Inputs::new());
                world.digest()
            });
            assert_eq!(baseline, best, "{} at step {step}", scenario.name);
        }
    }
}

#[cfg(feature = "parallel")]
#[test]
fn digests_do_not_depend_on_the_number_of_threads() {
    let many = |name, count: &str| {
        let scenario = Scenario::parse(builtin(name).unwrap().text, &[("count".into(), count.into())]).unwrap();
        scenario.build().unwrap().world
    };
    // Enough platelets for several strips, batches and chunks, all stirred, and cells for several portions of rings and fluids.
    let worlds = [many("platelets", "400"), many("crowd", "100"), build("demo", None), build("dam-break", None)];
    for (which, world) in worlds.iter().enumerate() {
        let digest = || {
            let mut world = world.clone();
            (0..30).for_each(|_| world.step(&Inputs::new()));
            world.digest()
        };
        let within = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(digest);
        let alone = within(1);
        assert!([2, 3, 8].into_iter().all(|threads| within(threads) == alone), "world {which}");
        assert_eq!(digest(), alone, "world {which}, from outside of a pool");
    }
}
