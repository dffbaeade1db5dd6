//! The state of every built-in scenario is valid after every step.
#![cfg(feature = "scenario")]

use microsim_core::scenario::{Built, Scenario, builtin, builtins};

/// The first violation in a scenario, if there is one.
fn first_violation(name: &str, steps: u64) -> Option<String> {
    let scenario = Scenario::parse(builtin(name).unwrap().text, &[]).unwrap();
    let Built { mut world, mut script, .. } = scenario.build().unwrap();
    for step in 0..=steps {
        if let Err(violation) = world.validate() {
            return Some(format!("{name} after step {step}: {violation}"));
        }
        let inputs = script.before_step(&mut world);
        world.step(inputs);
    }
    None
}

#[test]
fn built_in_scenarios_stay_valid() {
    let violations: Vec<String> =
        builtins().iter().filter_map(|scenario| first_violation(scenario.name, 300)).collect();
    assert!(violations.is_empty(), "{}", violations.join("\n"));
}
