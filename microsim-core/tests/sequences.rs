//! Random sequences of API calls: nothing panics, and the world stays valid.
//!
//! `MICROSIM_SEQUENCES=10000 cargo test --release -p microsim-core --features snapshot --test sequences` for more of them,
//! `MICROSIM_LONG_SEQUENCES=20` for more of the long ones.
#![cfg(feature = "snapshot")]
#![allow(clippy::disallowed_methods, reason = "how many sequences there are is asked of the environment")]

#[path = "common/sequence/mod.rs"]
mod sequence;

use microsim_core::Rng;
use sequence::Limits;
use std::panic::catch_unwind;

/// How many are run when nobody asks for more.
const COUNT: u32 = 150;

/// The first seed of the long ones.
const LONG_SEED: u32 = 2;

/// Bytes of a call are some ten; of these no sequence of 2,500 runs out.
const LONG: u32 = 100_000;

fn bytes(seed: u32, least: u32) -> Vec<u8> {
    let mut rng = Rng::new(u64::from(seed), 0);
    let length = least + rng.next_u32() % 600;
    (0..length).map(|_| (rng.next_u32() >> 24) as u8).collect()
}

#[test]
fn random_sequences_of_calls_neither_panic_nor_break_the_world() {
    let asked = std::env::var("MICROSIM_SEQUENCES").ok().map(|count| count.parse().unwrap());
    let (mut calls, mut refusals, mut steps, mut wrong) = (0, 0, 0, Vec::new());
    for seed in 0..asked.unwrap_or(COUNT) {
        match catch_unwind(|| sequence::run(&bytes(seed, 20), Limits::SHORT)) {
            Ok(Ok(tally)) => {
                (calls, refusals, steps) = (calls + tally.calls, refusals + tally.refusals, steps + tally.steps);
            }
            Ok(Err(violation)) => wrong.push(format!("seed {seed}: {violation}")),
            Err(_) => wrong.push(format!("seed {seed}: panicked")),
        }
    }
    println!("{calls} calls, {refusals} of them refused, {steps} steps");
    assert!(wrong.is_empty(), "{} sequences:\n{}", wrong.len(), wrong[..wrong.len().min(20)].join("\n"));
    assert!(refusals > calls / 50 && refusals < calls / 2 && steps > calls / 3, "the mixture is no good");
}

/// A room of an ordinary size that holds all kinds of organisms, then 2,500 calls, each checked, and each step.
#[test]
fn a_world_stands_a_long_sequence_of_calls() {
    let asked = std::env::var("MICROSIM_LONG_SEQUENCES").ok().map_or(1, |count| count.parse().unwrap());
    for seed in 0..asked {
        let seed = LONG_SEED + seed;
        let tally =
            sequence::run(&bytes(seed, LONG), Limits::LONG).unwrap_or_else(|flaw| panic!("seed {seed}: {flaw}"));
        println!("seed {seed}: {tally:?}");
        assert!(seed > LONG_SEED || tally.calls == 2500 && tally.steps == 800 && tally.organisms > 15, "{tally:?}");
    }
}
