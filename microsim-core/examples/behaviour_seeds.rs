//! Figures about behaviour over many seeds, as docs/behaviour.md states them:
//!
//! ```text
//! cargo run --release -p microsim-core --features scenario --example behaviour_seeds -- hunt 1-100 hunter=prowl
//! cargo run --release -p microsim-core --features scenario --example behaviour_seeds -- demo 1-100
//! ```
//!
//! A line for each seed.

use microsim_core::scenario::{Built, Scenario, builtin};
use microsim_core::{Event, Inputs};

fn build(name: &str, seed: u64, overrides: &[(String, String)]) -> Option<Built> {
    let mut scenario = Scenario::parse(builtin(name)?.text, overrides).ok()?;
    scenario.set_seed(seed);
    // A seed for which the organisms find no room is left out.
    scenario.build().ok()
}

/// Time until the hunter takes a coccus in, s, if it does within a minute.
fn catch_time(mut built: Built) -> Option<f64> {
    while built.world.time() < 60.0 {
        built.world.step(&Inputs::new());
        if built.world.events().iter().any(|event| matches!(event, Event::Ingested { .. })) {
            return Some(built.world.time());
        }
    }
    None
}

/// Longest time without progress in a minute, s, who had it and when, or what had become invalid.
fn longest_stall(mut built: Built) -> (f32, String) {
    let mut longest = (0.0, String::new());
    while built.world.time() < 60.0 {
        built.world.step(&Inputs::new());
        if let Err(violation) = built.world.validate() {
            return (f32::INFINITY, format!("invalid at {:.1} s: {violation}", built.world.time()));
        }
        let view = built.world.view();
        for organism in view.organisms().filter(|organism| organism.goal().is_some()) {
            if organism.stalled_for() > longest.0 {
                let what = format!("{} {:?} at {:.1} s", organism.kind().name(), organism.id(), built.world.time());
                longest = (organism.stalled_for(), what);
            }
        }
    }
    longest
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [name, seeds, changes @ ..] = args.as_slice() else {
        eprintln!("usage: behaviour_seeds demo|hunt FIRST-LAST [PARAMETER=VALUE]");
        std::process::exit(2);
    };
    let (first, last) = seeds.split_once('-').unwrap_or(("1", seeds));
    let [first, last] = [first, last].map(|seed| seed.parse::<u64>().unwrap_or(1));
    let overrides: Vec<(String, String)> =
        changes.iter().filter_map(|change| change.split_once('=')).map(|(k, v)| (k.into(), v.into())).collect();
    for seed in first..=last {
        match build(name, seed, &overrides) {
            None => println!("{name} {seed} no room"),
            Some(built) if name == "demo" => {
                let (stall, what) = longest_stall(built);
                println!("demo {seed} {stall:.2} s, {what}");
            }
            Some(built) => match catch_time(built) {
                Some(time) => println!("hunt {seed} caught {time:.1}"),
                None => println!("hunt {seed} not caught"),
            },
        }
    }
}
