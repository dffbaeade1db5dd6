//! Lets bots play the game and prints what they score, for tuning it:
//! `cargo run --release -p microsim-game --example bots [SEEDS [FILE.toml]]`.

use microsim_core::scenario::{Scenario, builtin};
use microsim_game::rules::bot::{Bot, Policy};
use microsim_game::rules::round::Round;
use std::time::Instant;

fn main() -> Result<(), String> {
    let mut arguments = std::env::args().skip(1);
    let seeds = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(4);
    let file = arguments.next().map(std::fs::read_to_string).transpose().map_err(|error| error.to_string())?;
    let text = file.as_deref().or_else(|| builtin("game").map(|game| game.text)).unwrap_or_default();
    println!("seed policy        score  area  step_ms  points by kind; score at 15, 30, ... s");
    for seed in 1..=seeds {
        for policy in Policy::ALL {
            play(text, seed, policy)?;
        }
    }
    Ok(())
}

fn play(text: &str, seed: u64, policy: Policy) -> Result<(), String> {
    let mut scenario = Scenario::parse(text, &[]).map_err(|diagnostics| diagnostics.to_string())?;
    scenario.set_seed(seed);
    let mut round = Round::new(&scenario)?;
    let mut bot = Bot::new(policy, seed);
    let (start, mut curve) = (Instant::now(), Vec::new());
    while !round.referee().is_over() {
        let intent = bot.intent(round.world(), round.player());
        round.step(intent);
        if round.world().step_index().is_multiple_of(900) {
            curve.push(round.referee().score());
        }
    }
    let step_ms = start.elapsed().as_secs_f64() * 1000.0 / round.world().step_index() as f64;
    let area = round.world().view().organism(round.player()).map_or(0.0, |cell| cell.cytoplasm_area());
    let kinds = round.referee().kinds().iter().map(|(kind, t)| format!("{} x {} = {}", t.count, kind.name(), t.points));
    let kinds = kinds.collect::<Vec<_>>().join(", ");
    let score = round.referee().score();
    println!("{seed:4} {:13} {score:5} {area:5.0} {step_ms:7.2}   {kinds}; {curve:?}", format!("{policy:?}"));
    Ok(())
}
