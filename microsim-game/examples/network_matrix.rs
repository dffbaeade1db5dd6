//! What a match costs over networks of all kinds: `cargo run --release -p microsim-game --example network_matrix [FRAMES] [LATENCY]`,
//! over faulty ones: `... --example network_matrix [FRAMES] faults`, and in a round of small cells and little food, whose steps take
//! little time: `... --example network_matrix [FRAMES] light`. The same in a browser: `.ci/network-matrix`.
//!
//! The players of a row are computed on one thread, rows on all cores; they are printed as they are done. A row fails unless all
//! get the world that one process computes alone.

#[path = "../tests/common/virtual_match.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod virtual_match;

use microsim_core::scenario::Scenario;
use microsim_game::network::rollback_pacing::Pacing;
use microsim_game::platform;
use microsim_game::rules::round::Round;
use std::sync::Mutex;
use virtual_match::{Cut, Match, Weather};

/// What a light round has, and where its cells begin.
const LIGHT: &str = r#"
    schema = 1
    name = "light"
    [game]
    [world]
    size = [60.0, 60.0]
    [amoeboid_cell.hunter]
    radii = [3.5, 3.5]
    speed = 13.0
    [amoeboid_cell.hunter.phagocytosis]
    growth_yield = 0.0
    [agar.pellet]
    radius = 0.9
    [[spawn]]
    of = "pellet"
    count = 8
    respawn = 1.0
"#;
const PLACES: [(&str, [f32; 2]); 4] = [
    ("player = true", [15.0, 15.0]),
    ("name = 'player-2'", [45.0, 45.0]),
    ("name = 'player-3'", [15.0, 45.0]),
    ("name = 'player-4'", [45.0, 15.0]),
];

fn light_round(players: usize, seconds: f32) -> Round {
    let cells = PLACES[..players].iter().map(|(name, at)| format!("[[spawn]]\nof = 'hunter'\n{name}\nat = {at:?}\n"));
    let time = ("game.time".to_owned(), seconds.to_string());
    let text = LIGHT.to_owned() + &cells.collect::<String>();
    Round::new(&Scenario::parse(&text, &[time]).expect("the scenario is sound")).expect("it is a game")
}

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
    let mut words = platform::arguments().skip(1).filter_map(|word| word.into_string().ok());
    let frames: f32 = words.next().and_then(|text| text.parse().ok()).unwrap_or(10_000.0);
    let only = words.next();
    let (sky, rows) = match only.as_deref() {
        Some("faults") => ("fault", faults()),
        only => ("one way, ms | loss", matrix(only.and_then(|text| text.parse().ok()))),
    };
    platform::print(&format!(
        "| players | Hz | {sky} | frame p50/p99/max, ms | rollbacks | repeated a frame, most | waits, most | up, down B/s |"
    ));
    platform::print(&format!("|{}", "---:|".repeat(8 + sky.matches('|').count())));
    let rows = Mutex::new(rows.into_iter());
    let next = || rows.lock().expect("no row fails with it").next();
    let round = if only.as_deref() == Some("light") { light_round } else { virtual_match::round };
    let work = || {
        while let Some(row) = next() {
            row.print(frames, round);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
        work();
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

impl Row {
    fn print(self, frames: f32, round: fn(usize, f32) -> Round) {
        let Self { players, hz, sky, weather, silent } = self;
        let pacing = if hz == 60 { Pacing::QUICK } else { Pacing::USUAL };
        let seconds = frames / hz as f32;
        let mut game = Match::of(round(players, seconds), seconds, pacing, weather, 1);
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
        platform::print(&format!(
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
        ));
    }
}
