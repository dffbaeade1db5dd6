//! Figures about behaviour over many seeds, as docs/behaviour.md states them:
//!
//! ```text
//! cargo run --release -p microsim-core --features scenario --example behaviour_seeds -- hunt 100 scent
//! cargo run --release -p microsim-core --features scenario --example behaviour_seeds -- demo 100
//! ```

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

/// Longest time without progress in a minute, s, who had it and when.
fn longest_stall(mut built: Built) -> (f32, String) {
    let mut longest = (0.0, String::new());
    while built.world.time() < 60.0 {
        built.world.step(&Inputs::new());
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
    let (name, seeds) = (args[0].as_str(), args[1].parse::<u64>().expect("a number of seeds"));
    let overrides: Vec<(String, String)> = args[2..]
        .iter()
        .map(|value| value.split_once('=').unwrap_or(("hunter", value)))
        .map(|(k, v)| (k.into(), v.into()))
        .collect();
    let worlds = (1..=seeds).filter_map(|seed| build(name, seed, &overrides).map(|built| (seed, built)));
    if name == "demo" {
        let stalls: Vec<_> = worlds.map(|(seed, built)| (longest_stall(built), seed)).collect();
        for ((stall, what), seed) in &stalls {
            println!("seed {seed}: {stall:.2} s, {what}");
        }
        let longest = stalls.iter().map(|((stall, _), _)| *stall).fold(0.0, f32::max);
        println!("{} seeds, longest time without progress {longest:.2} s", stalls.len());
        return;
    }
    let mut times: Vec<Option<f64>> = worlds.map(|(_, built)| catch_time(built)).collect();
    let count = times.len();
    times.sort_by(|a, b| a.unwrap_or(f64::INFINITY).total_cmp(&b.unwrap_or(f64::INFINITY)));
    let caught: Vec<f64> = times.into_iter().flatten().collect();
    let median = caught.get(caught.len() / 2).copied().unwrap_or(f64::NAN);
    println!("{count} seeds {args:?}: caught {}, median of these {median:.1} s", caught.len());
}
