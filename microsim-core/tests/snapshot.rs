//! Snapshots: what is restored has the same future to the bit, and nothing else is accepted.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]
#![cfg(all(feature = "scenario", feature = "snapshot"))]

use microsim_core::scenario::{Built, Origin, Scenario, builtin, builtins};
use microsim_core::snapshot::Checkpoint;

fn build(name: &str) -> (Origin, Built) {
    let scenario = Scenario::parse(builtin(name).unwrap().text, &[]).unwrap();
    (scenario.origin(), scenario.build().unwrap())
}

fn step(built: &mut Built) {
    let inputs = built.script.before_step(&mut built.world);
    built.world.step(inputs);
}

/// Steps until an event of this name has happened; false if it does not within so many steps.
fn run_until(built: &mut Built, event: &str, most: u32) -> bool {
    (0..most).any(|_| {
        step(built);
        built.world.events().iter().any(|found| found.name() == event)
    })
}

/// Restores the run from its bytes, and checks that both go on alike.
fn check_future(origin: &Origin, run: &Built, steps: u32, when: &str) {
    let checkpoint = Checkpoint { origin: origin.clone(), run: run.clone() };
    let bytes = checkpoint.to_bytes().unwrap();
    let restored = Checkpoint::from_bytes(&bytes).unwrap();
    assert_eq!(restored.to_bytes().unwrap(), bytes, "{when}");
    assert_eq!((restored.origin, restored.run.player), (checkpoint.origin, run.player), "{when}");
    let (mut built, mut restored) = (checkpoint.run, restored.run);
    assert_eq!(restored.world.digest(), built.world.digest(), "{when}");
    assert_eq!(restored.world.events(), built.world.events(), "{when}");
    assert_eq!(restored.world.census(), built.world.census(), "{when}");
    for k in 0..steps {
        step(&mut built);
        step(&mut restored);
        assert_eq!(restored.world.digest(), built.world.digest(), "{when}, {k} steps later");
        assert_eq!(restored.world.events(), built.world.events(), "{when}, {k} steps later");
        assert_eq!(restored.checks.after_step(&restored.world), built.checks.after_step(&built.world), "{when}");
    }
    assert_eq!(restored.script.refusals(), built.script.refusals(), "{when}");
    assert_eq!(restored.world.quality(), built.world.quality(), "{when}");
}

#[test]
fn every_built_in_scenario_goes_on_alike() {
    for scenario in builtins() {
        let (origin, mut built) = build(scenario.name);
        check_future(&origin, &built, 5, &format!("{} at the start", scenario.name));
        (0..40).for_each(|_| step(&mut built));
        check_future(&origin, &built, 20, &format!("{} after 40 steps", scenario.name));
    }
}

#[test]
fn cups_divisions_and_fusions_go_on_alike() {
    let moments = [
        ("absorb-agar", ["ingestion_began", "ingested"]),
        ("absorb-rigid", ["ingestion_began", "ingested"]),
        ("grow", ["ingested", "consumed"]),
        ("divide", ["division_began", "divided"]),
    ];
    for (name, events) in moments {
        let (origin, mut built) = build(name);
        for event in events {
            assert!(run_until(&mut built, event, 3000), "{name}: {event}");
            check_future(&origin, &built, 10, &format!("{name} when {event}"));
            (0..5).for_each(|_| step(&mut built));
            check_future(&origin, &built, 40, &format!("{name} after {event}"));
        }
    }
}

#[test]
fn a_particle_takes_less_than_64_bytes() {
    let count = ("count".to_owned(), "323".to_owned());
    let scenario = Scenario::parse(builtin("platelets").unwrap().text, &[count]).unwrap();
    let mut built = scenario.build().unwrap();
    (0..30).for_each(|_| step(&mut built));
    let (bytes, particles) = (built.world.to_snapshot().unwrap().len(), built.world.census().particles);
    assert!(particles > 10_000 && bytes < 64 * particles, "{bytes} bytes for {particles} particles");
}
