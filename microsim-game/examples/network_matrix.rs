//! What a match costs over networks of all kinds: `cargo run --release -p microsim-game --example network_matrix [FRAMES] [LATENCY]`,
//! and over faulty ones: `... --example network_matrix [FRAMES] faults`. What going back costs in a food chain and in a match for
//! points, without a network, on Linux: `... --example network_matrix chain`.
//!
//! The players of a row are computed on one thread, rows on all cores; they are printed as they are done. A row fails unless all
//! get the world that one process computes alone.

#[path = "../tests/common/virtual_match.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod virtual_match;

use microsim_core::Intent;
use microsim_core::scenario::Scenario;
use microsim_game::network::pacing::Pacing;
use microsim_game::rules::bot::{Bot, Policy};
use microsim_game::rules::food_chain::{self, Deed};
use microsim_game::rules::round::Round;
use microsim_game::rules::two_players;
use std::sync::Mutex;
use std::time::Instant;
use virtual_match::{Cut, Match, Weather};

/// Frames that are taken again at most, and the part of a match that has a row of its own, s.
const WINDOW: usize = Pacing::USUAL.window as usize;
const PART: f64 = 30.0;

/// A match of so many players at so many frames a second.
struct Row {
    players: usize,
    hz: u32,
    /// What is said of the weather.
    sky: String,
    weather: Weather,
    /// Who says nothing to whom for a second, every five seconds.
    silent: Vec<(usize, usize)>,
}

fn main() {
    if std::env::args().nth(1).as_deref() == Some("chain") {
        return going_back();
    }
    let frames: f32 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(10_000.0);
    let only = std::env::args().nth(2);
    let (sky, rows) = match only.as_deref() {
        Some("faults") => ("fault", faults()),
        only => ("one way, ms | loss", matrix(only.and_then(|text| text.parse().ok()))),
    };
    println!(
        "| players | Hz | {sky} | frame p50/p99/max, ms | rollbacks | repeated a frame, most | waits, most | up, down B/s |"
    );
    println!("|{}", "---:|".repeat(8 + sky.matches('|').count()));
    let rows = Mutex::new(rows.into_iter());
    let next = || rows.lock().expect("no row fails with it").next();
    let work = || {
        while let Some(row) = next() {
            row.print(frames);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
}

/// All latencies, or one, with all losses.
fn matrix(only: Option<f32>) -> Vec<Row> {
    let latencies = [150.0, 80.0, 20.0].into_iter().filter(|latency| only.is_none_or(|only| only == *latency));
    let crowds = latencies.flat_map(|latency| [30, 60].map(|hz| (latency, hz)));
    let crowds = crowds.flat_map(|(latency, hz)| [4, 3, 2].map(|players| (latency, hz, players)));
    let row = |((latency, hz, players), loss): ((f32, u32, usize), f32)| {
        let weather = Weather { latency, jitter: 0.25 * latency, loss, ..Weather::default() };
        Row { players, hz, sky: format!("{latency} | {:.0} %", 100.0 * loss), weather, silent: Vec::new() }
    };
    crowds.flat_map(|crowd| [0.0, 0.03, 0.1].map(|loss| (crowd, loss))).map(row).collect()
}

/// Each fault for itself, and all at once.
fn faults() -> Vec<Row> {
    let fair = Weather { latency: 80.0, jitter: 20.0, ..Weather::default() };
    let all = Weather { latency: 80.0, jitter: 80.0, loss: 0.1, doubled: 0.2, bursts: 0.1 };
    let kinds = [
        ("none", fair, 0),
        ("20 % come twice", Weather { doubled: 0.2, ..fair }, 0),
        ("0 to 160 ms: out of order", Weather { jitter: 80.0, ..fair }, 0),
        ("10 % of the time all is lost, 200 ms each", Weather { bursts: 0.1, ..fair }, 0),
        ("nothing from the first to the last for 1 s of 5", fair, 1),
        ("nothing from the first to anybody for 1 s of 5", fair, 2),
        ("all of these, and 10 % loss", all, 2),
    ];
    let row = |players: usize, (sky, weather, cuts): (&str, Weather, u32)| {
        let to = if cuts == 1 { players - 1..players } else { 1..players };
        let silent = to.filter(|_| cuts > 0).map(|to| (0, to)).collect();
        Row { players, hz: 30, sky: sky.to_owned(), weather, silent }
    };
    [2, 4].into_iter().flat_map(|players| kinds.map(|kind| row(players, kind))).collect()
}

/// Prints what it costs to keep a moment, and to go back by the longest way, by match and part of it.
fn going_back() {
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

impl Row {
    fn print(self, frames: f32) {
        let Self { players, hz, sky, weather, silent } = self;
        let pacing = if hz == 60 { Pacing::QUICK } else { Pacing::USUAL };
        let mut game = Match::new(players, frames / hz as f32, pacing, weather, 1);
        let times = (2000..).step_by(5000).take(200);
        let cut = |(from, to): (usize, usize)| times.clone().map(move |at| Cut { from, to, time: at..at + 1000 });
        game.cuts = silent.into_iter().flat_map(cut).collect();
        game.play();
        game.check();
        game.frame_ms.sort_by(f64::total_cmp);
        let part = |share: f64| game.frame_ms[((game.frame_ms.len() - 1) as f64 * share) as usize];
        // Of those who hear the first one, if that is what fails.
        let (session, seconds) = (&game.sessions[players - 1], game.now / 1000.0);
        let (tally, taken) = (session.tally(), session.frame() as f32);
        println!(
            "| {players} | {hz} | {sky} | {:.1}/{:.1}/{:.1} | {:.0} % | {:.2}, {} | {:.1} %, {} | {:.0}, {:.0} |",
            part(0.5),
            part(0.99),
            part(1.0),
            100.0 * tally.rollbacks as f32 / taken,
            tally.repeated as f32 / taken,
            tally.deepest,
            100.0 * tally.waits as f32 / taken,
            game.longest_wait[players - 1],
            tally.sent as f32 / seconds,
            tally.received as f32 / seconds,
        );
    }
}
