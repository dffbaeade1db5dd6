//! What a match costs over networks of all kinds: `cargo run --release -p microsim-game --example network_matrix [FRAMES] [LATENCY]`.
//!
//! The players of a row are computed on one thread, rows on all cores; they are printed as they are done. A row fails unless all
//! get the world that one process computes alone.

#[path = "../tests/common/virtual_match.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod virtual_match;

use microsim_game::network::pacing::Pacing;
use std::sync::Mutex;
use virtual_match::{Match, Weather};

fn main() {
    let number = |k: usize| std::env::args().nth(k).and_then(|text| text.parse().ok());
    let (frames, only): (f32, Option<f32>) = (number(1).unwrap_or(10_000.0), number(2));
    println!(
        "| players | Hz | one way, ms | loss | frame p50/p99/max, ms | rollbacks | repeated a frame, most | waits | up, down B/s |"
    );
    println!("|---:|---:|---:|---:|---:|---:|---:|---:|---:|");
    let latencies = [150.0, 80.0, 20.0].into_iter().filter(|latency| only.is_none_or(|only| only == *latency));
    let paces = || [(30, Pacing::USUAL), (60, Pacing::QUICK)].into_iter();
    let crowds =
        latencies.flat_map(|latency| paces().flat_map(move |pace| [4, 3, 2].map(|players| (latency, pace, players))));
    let all = Mutex::new(crowds.flat_map(|crowd| [0.0, 0.03, 0.1].map(|loss| (crowd, loss))));
    let next = || all.lock().expect("no row fails with it").next();
    let work = || {
        while let Some(((latency, (hz, pacing), players), loss)) = next() {
            let weather = Weather { latency, jitter: 0.25 * latency, loss, ..Weather::default() };
            row(players, hz, frames, pacing, weather);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
}

fn row(players: usize, hz: u32, frames: f32, pacing: Pacing, weather: Weather) {
    let mut game = Match::new(players, frames / hz as f32, pacing, weather, 1);
    game.play();
    game.check();
    game.frame_ms.sort_by(f64::total_cmp);
    let part = |share: f64| game.frame_ms[((game.frame_ms.len() - 1) as f64 * share) as usize];
    let (session, seconds) = (&game.sessions[0], game.now / 1000.0);
    let (tally, taken) = (session.tally(), session.frame() as f32);
    let Weather { latency, loss, .. } = weather;
    println!(
        "| {players} | {hz} | {latency} | {:.0} % | {:.1}/{:.1}/{:.1} | {:.0} % | {:.2}, {} | {:.1} % | {:.0}, {:.0} |",
        100.0 * loss,
        part(0.5),
        part(0.99),
        part(1.0),
        100.0 * tally.rollbacks as f32 / taken,
        tally.repeated as f32 / taken,
        tally.deepest,
        100.0 * tally.waits as f32 / taken,
        tally.sent as f32 / seconds,
        tally.received as f32 / seconds,
    );
}
