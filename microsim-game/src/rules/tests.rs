//! The rules over whole rounds.

use super::bot::{Bot, Policy};
use super::round::Round;
use microsim_core::scenario::{Scenario, builtin};

fn scenario(seed: u64, time: f32) -> Scenario {
    let text = builtin("game").unwrap().text;
    let mut scenario = Scenario::parse(text, &[("game.time".to_owned(), time.to_string())]).unwrap();
    scenario.set_seed(seed);
    scenario
}

/// Plays a whole round.
fn play(policy: Policy, seed: u64, time: f32) -> Round {
    let mut round = Round::new(&scenario(seed, time)).unwrap();
    let mut bot = Bot::new(policy, seed);
    while !round.referee().is_over() {
        let intent = bot.intent(round.world(), round.player());
        round.step(intent);
    }
    round
}

#[test]
#[ignore = "a table for tuning"]
fn print_scores() {
    for seed in 1..=4 {
        for policy in Policy::ALL {
            let round = play(policy, seed, 90.0);
            let me = round.world().view().organism(round.player()).unwrap();
            let tallies: Vec<_> = round.referee().tallies().iter().map(|(k, t)| (k.name(), t.count, t.points)).collect();
            println!("{seed} {policy:?} {} {tallies:?} area {:.0} held {}", round.referee().score(), me.cytoplasm_area(), me.meals().count());
        }
    }
}
