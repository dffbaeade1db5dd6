//! Bots play all modes for hours, on all cores; four times a second what must never happen is looked for: leaks, prey on the wrong
//! side, organisms that are frozen. `cargo run --release -p microsim-game --example bot_hours HOURS [FIRST_SEED]`

use microsim_core::Intent;
use microsim_core::scenario::{Scenario, builtin};
use microsim_game::rules::bot::{Bot, Policy};
use microsim_game::rules::chain_bot::{ChainBot, Skill};
use microsim_game::rules::food_chain::{self, Deed};
use microsim_game::rules::round::Round;
use microsim_game::rules::slide_bot::SlideBot;
use microsim_game::rules::two_players;
use microsim_game::slides::{SHARED, SLIDES};
use std::process::ExitCode;
use std::sync::Mutex;

/// Steps between two looks.
const INTERVAL: u64 = 15;
/// Steps between two lunges.
const LUNGES: u64 = 240;
/// Longest life in the food chain, s.
const LONGEST: f64 = 300.0;

/// How all went so far.
#[derive(Debug)]
struct Tally {
    next_seed: u64,
    /// Time that was played, s.
    played: f64,
    rounds: u32,
    found: u32,
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let hours: f64 = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(0.5);
    let next_seed = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(1);
    let tally = Mutex::new(Tally { next_seed, played: 0.0, rounds: 0, found: 0 });
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(|| work(&tally, 3600.0 * hours)))));
    ExitCode::from(u8::from(tally.into_inner().map_or(1, |tally| tally.found) > 0))
}

/// Plays one seed after another.
fn work(tally: &Mutex<Tally>, wanted: f64) {
    loop {
        let seed = {
            let Ok(mut tally) = tally.lock() else { return };
            if tally.played >= wanted {
                return;
            }
            tally.next_seed += 1;
            tally.next_seed - 1
        };
        for (name, text, play) in modes() {
            let (time, found) = play(&round(&text, seed));
            let Ok(mut tally) = tally.lock() else { return };
            tally.played += time;
            tally.rounds += 1;
            if let Some(found) = found {
                tally.found += 1;
                println!("FOUND: {name}, seed {seed}, at {time:.2} s: {found}");
            }
        }
        if let Ok(Tally { played, rounds, found, .. }) = tally.lock().as_deref() {
            println!("{:.2} h in {rounds} rounds, {found} found; seed {seed} done", played / 3600.0);
        }
    }
}

fn round(text: &str, seed: u64) -> Round {
    let mut scenario = Scenario::parse(text, &[]).unwrap_or_else(|found| panic!("{found}"));
    scenario.set_seed(seed);
    Round::new(&scenario).unwrap_or_else(|problem| panic!("seed {seed}: {problem}"))
}

/// Plays a round: for how long, s, and what it found.
type Play = fn(&Round) -> (f64, Option<String>);

/// What is played with each seed: name, scenario, and who plays.
fn modes() -> Vec<(String, String, Play)> {
    let game = builtin("game").map_or("", |game| game.text);
    let of_chain: [(&str, Play); 3] = [
        ("random", |round| of_skill(round, Skill::Random)),
        ("novice", |round| of_skill(round, Skill::Novice)),
        ("forager", |round| of_skill(round, Skill::Forager)),
    ];
    let chains = of_chain.map(|(skill, play)| (format!("food chain, {skill}"), food_chain::TEXT.to_owned(), play));
    let slides = SLIDES.iter().map(|slide| (slide.name.to_owned(), slide.text.to_owned()));
    let shared = SHARED.iter().map(|shared| (shared.slide.name.to_owned(), shared.text(2)));
    let greedy: Play = |round| of_policy(round, Policy::Greedy);
    let random: Play = |round| of_policy(round, Policy::Random);
    let rounds = [
        ("game, greedy".to_owned(), game.to_owned(), greedy),
        ("game, random".to_owned(), game.to_owned(), random),
        ("two players".to_owned(), two_players::TEXT.to_owned(), greedy),
        ("food chain of four".to_owned(), food_chain::text(4), random),
    ];
    let slides = slides.chain(shared).flat_map(|(name, text)| {
        let both: [(&str, Play); 2] = [("skilled", skilled), ("random", random)];
        both.map(|(who, play)| (format!("{name}, {who}"), text.clone(), play))
    });
    chains.into_iter().chain(rounds).chain(slides).collect()
}

/// Plays a round to its end or for some time.
fn play(round: &Round, mut step: impl FnMut(&mut Round)) -> (f64, Option<String>) {
    let mut round = round.clone();
    while !round.is_over() && round.world().time() < LONGEST {
        if round.world().step_index().is_multiple_of(LUNGES) {
            // Refused where there are none, or not yet.
            (0..round.players().count()).for_each(|player| round.act(player, Deed::Lunge));
        }
        step(&mut round);
        if round.world().step_index().is_multiple_of(INTERVAL) {
            let census = round.world().census();
            if census.leaks + census.improper_absorptions + census.quarantined > 0 {
                return (round.world().time(), Some(format!("{census:?}")));
            }
        }
    }
    (round.world().time(), None)
}

fn of_skill(round: &Round, skill: Skill) -> (f64, Option<String>) {
    let mut bot = ChainBot::new(skill, round);
    play(round, |round| {
        bot.step(round);
    })
}

fn of_policy(round: &Round, policy: Policy) -> (f64, Option<String>) {
    let seed = round.world().config().seed;
    let mut bots: Vec<Bot> = (0..).map(|k| Bot::new(policy, seed + k)).take(round.players().count()).collect();
    play(round, |round| {
        let players = bots.iter_mut().zip(round.players());
        let intents = players.map(|(bot, cell)| bot.intent(round.world(), cell).digesting(true));
        let intents: Vec<Intent> = intents.collect();
        round.step_all(&intents);
    })
}

fn skilled(round: &Round) -> (f64, Option<String>) {
    let mut bots = SlideBot::all(round);
    play(round, |round| {
        let intents: Vec<Intent> = bots.iter_mut().map(|bot| bot.intent(round)).collect();
        round.step_all(&intents);
    })
}
