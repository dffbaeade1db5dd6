//! What it costs to keep a moment, and to go back by the longest way, in a food chain and in a match for points, without a network:
//! `cargo run --release -p microsim-game --example chain_rollback`, on Linux.

use microsim_core::Intent;
use microsim_core::scenario::Scenario;
use microsim_game::network::rollback_pacing::Pacing;
use microsim_game::rules::bot::{Bot, Policy};
use microsim_game::rules::food_chain::{self, Deed};
use microsim_game::rules::round::Round;
use microsim_game::rules::two_players;
use std::time::Instant;

/// Frames that are taken again at most, and the part of a match that has a row of its own, s.
const WINDOW: usize = Pacing::USUAL.window as usize;
const PART: f64 = 30.0;

fn main() {
    println!("| match | players | from, s | keep, ms: p50 | back by ten frames, ms: p50/p99/max |");
    println!("|---|---:|---:|---:|---:|");
    for (name, players, text) in [2, 4].into_iter().flat_map(|players| {
        [("points", players, two_players::text(players)), ("food chain", players, food_chain::text(players))]
    }) {
        let mut scenario = Scenario::parse(&text, &[]).expect("the scenario is sound");
        scenario.set_seed(5);
        let mut round = Round::new(&scenario).expect("it is a game");
        let mut bots: Vec<Bot> = (0..players).map(|k| Bot::new(Policy::Greedy, k as u64)).collect();
        let mut kept = vec![round.clone(); WINDOW + 1];
        for part in 0.. {
            let costs = played(&mut round, &mut bots, &mut kept, PART * f64::from(part + 1));
            let [keep, back] = costs.map(|mut times| {
                times.sort_by(f64::total_cmp);
                times
            });
            let at = |times: &[f64], share: f64| times[((times.len() - 1) as f64 * share) as usize];
            if back.is_empty() {
                break;
            }
            println!(
                "| {name} | {players} | {:.0} | {:.2} | {:.1}/{:.1}/{:.1} |",
                PART * f64::from(part),
                at(&keep, 0.5),
                at(&back, 0.5),
                at(&back, 0.99),
                at(&back, 1.0),
            );
        }
    }
}

/// Time that this thread has had on a processor, ms: other work on the machine does not count.
fn processor_ms() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux says how long a thread ran");
    stat.split(' ').next().and_then(|nanoseconds| nanoseconds.parse().ok()).map_or(0.0, |time: f64| time / 1e6)
}

/// Plays until some time, and returns the times of keeping a moment, and of going back and taking all frames again.
fn played(round: &mut Round, bots: &mut [Bot], kept: &mut [Round], until: f64) -> [Vec<f64>; 2] {
    let mut times = [Vec::new(), Vec::new()];
    while !round.is_over() && round.world().time() < until {
        let cells: Vec<_> = round.players().collect();
        let intents: Vec<Intent> =
            bots.iter_mut().zip(cells).map(|(bot, cell)| bot.intent(round.world(), cell)).collect();
        (0..bots.len()).for_each(|player| round.act(player, Deed::Choose(0)));
        kept[0].clone_from(round);
        let before = processor_ms();
        round.clone_from(&kept[0]);
        for moment in &mut kept[1..] {
            (0..Pacing::USUAL.steps).for_each(|_| round.step_all(&intents));
            let began = Instant::now();
            moment.clone_from(round);
            times[0].push(1000.0 * began.elapsed().as_secs_f64());
        }
        times[1].push(processor_ms() - before);
    }
    times
}
