//! microsim-core and other physics engines on the same scenes.
//!
//! `scene` says in numbers what every engine is given, `engines` gives it to them, `measure` runs them side by side,
//! `quality` looks at the positions that come out, `memory` at the processes, `report` and `plot` tell.

mod engines;
mod measure;
mod memory;
mod plot;
mod quality;
mod report;
mod scene;

use clap::{Parser, ValueEnum};
use measure::{Plan, Row};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::process::ExitCode;

/// Compares microsim-core with other physics engines on the same scenes.
#[derive(Debug, Parser)]
#[command(version)]
struct Args {
    /// Fewer and shorter runs: less than a minute.
    #[arg(long)]
    quick: bool,
    /// Print one JSON array of rows in place of tables.
    #[arg(long)]
    json: bool,
    /// Draw ms per step against bodies into this SVG file.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Only this scene.
    #[arg(long, value_enum)]
    scene: Option<Scene>,
    /// Only runs with this many platelets, particles or cells.
    #[arg(long)]
    count: Option<usize>,
    /// Only engines whose names contain this, and ours to compare with.
    #[arg(long, default_value = "")]
    engine: String,
    /// Run nothing; tell and draw what an earlier run printed with `--json`. May be given several times.
    #[arg(long, value_name = "FILE.json")]
    rows: Vec<PathBuf>,
    /// In place of all this: print the bytes that the engine of this name takes for `--scene` and `--count`.
    #[arg(long, hide = true, value_name = "ENGINE", requires_all = ["scene", "count"])]
    memory_of: Option<String>,
}

/// What is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Scene {
    /// Platelets that pushers stir.
    Platelets,
    /// A block of fluid that collapses and comes to rest.
    Fluid,
    /// Amoeboid cells that are driven about and jostle.
    Crowd,
}

impl Scene {
    /// Its name in arguments and rows.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Platelets => "platelets",
            Self::Fluid => "fluid",
            Self::Crowd => "crowd",
        }
    }
}

/// Platelets of the runs, and how long each is.
const FULL: &[(usize, Plan)] = &[
    (90, Plan { warm_up: 240, repeats: 9, steps: 30, rest: 600 }),
    (200, Plan { warm_up: 240, repeats: 9, steps: 30, rest: 600 }),
    (800, Plan { warm_up: 180, repeats: 7, steps: 15, rest: 0 }),
    (1600, Plan { warm_up: 180, repeats: 7, steps: 15, rest: 0 }),
    (3300, Plan { warm_up: 120, repeats: 5, steps: 15, rest: 0 }),
];
const QUICK: &[(usize, Plan)] = &[
    (90, Plan { warm_up: 60, repeats: 5, steps: 10, rest: 300 }),
    (200, Plan { warm_up: 40, repeats: 5, steps: 15, rest: 0 }),
    (1600, Plan { warm_up: 15, repeats: 5, steps: 2, rest: 0 }),
];
/// Particles of the runs.
const FULL_FLUID: &[(usize, Plan)] = &[
    (10_000, Plan { warm_up: 0, repeats: 12, steps: 75, rest: 0 }),
    (40_000, Plan { warm_up: 0, repeats: 12, steps: 75, rest: 0 }),
];
const QUICK_FLUID: &[(usize, Plan)] = &[(10_000, Plan { warm_up: 20, repeats: 5, steps: 5, rest: 0 })];
/// Cells of the runs: 11 s of the crowd up to 200 cells, 3 s of 1000.
const FULL_CROWD: &[(usize, Plan)] = &[
    (10, Plan { warm_up: 60, repeats: 20, steps: 30, rest: 0 }),
    (50, Plan { warm_up: 60, repeats: 20, steps: 30, rest: 0 }),
    (200, Plan { warm_up: 60, repeats: 20, steps: 30, rest: 0 }),
    (1000, Plan { warm_up: 60, repeats: 8, steps: 15, rest: 0 }),
];
const QUICK_CROWD: &[(usize, Plan)] = &[
    (10, Plan { warm_up: 30, repeats: 6, steps: 20, rest: 0 }),
    (50, Plan { warm_up: 30, repeats: 6, steps: 20, rest: 0 }),
];

fn main() -> ExitCode {
    let args = Args::parse();
    // One thread for everything that does not ask for more: this one.
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global();
    single.expect("nobody has made threads yet");
    let done = match (&args.memory_of, args.scene, args.count) {
        (Some(engine), Some(scene), Some(count)) => memory::report(engine, scene, count),
        _ => compare(&args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn compare(args: &Args) -> Result<(), String> {
    let rows = if args.rows.is_empty() { run(args) } else { read(&args.rows)? };
    if let Some(path) = &args.plot {
        plot::draw(&rows, path)?;
    }
    if args.json { report::json(&rows) } else { report::tables(&rows) }.map_err(|error| error.to_string())
}

fn run(args: &Args) -> Vec<Row> {
    let (platelets, fluid, crowd) =
        if args.quick { (QUICK, QUICK_FLUID, QUICK_CROWD) } else { (FULL, FULL_FLUID, FULL_CROWD) };
    let scenes = [(Scene::Platelets, platelets), (Scene::Fluid, fluid), (Scene::Crowd, crowd)];
    let runs = scenes.into_iter().flat_map(|(scene, plans)| plans.iter().map(move |run| (scene, run)));
    let is_asked = |scene, count| args.scene.is_none_or(|s| s == scene) && args.count.is_none_or(|c| c == count);
    let mut rows = Vec::new();
    for (scene, &(count, plan)) in runs.filter(|&(scene, run)| is_asked(scene, run.0)) {
        eprintln!("{} {count} ...", scene.name());
        rows.extend(measure::run(scene, count, plan, &args.engine));
    }
    if !args.quick {
        eprintln!("memory ...");
        memory::measure(&mut rows);
    }
    rows
}

fn read(files: &[PathBuf]) -> Result<Vec<Row>, String> {
    let mut rows: Vec<Row> = Vec::new();
    for file in files {
        let told = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
        let text = std::fs::read_to_string(file).map_err(|error| told(&error))?;
        rows.extend(serde_json::from_str::<Vec<Row>>(&text).map_err(|error| told(&error))?);
    }
    Ok(rows)
}
