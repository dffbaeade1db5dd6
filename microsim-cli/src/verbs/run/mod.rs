//! `run`: a whole scenario, with its files.

mod output_args;

use crate::console::Console;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::{Outputs, check_formats};
use crate::prepared::{Prepared, load};
use crate::record_args::RecordArgs;
use crate::scenario_args::Changes;
use crate::session::{Session, timed_step};
use crate::summary::{Table, median};
use crate::value_parser::{duration, whole};
use crate::verbs::sweep;
use output_args::OutputArgs;
use std::path::PathBuf;

/// Steps that are timed to estimate the time of a run.
const TRIED: u64 = 20;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Invariants and expectations are checked after every step; the first that fails is named on stderr, the run continues,\n\
and the exit code is 1. Equal scenario, seed and steps give equal bytes in all files but run.json."
)]
pub(crate) struct RunArgs {
    /// A built-in scenario, a TOML file, or `-` for stdin
    #[arg(value_name = "NAME|FILE", required_unless_present = "task")]
    pub scenario: Option<String>,
    #[command(flatten)]
    pub changes: Changes,
    /// Number of steps; without it, the scenario's duration
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole, conflicts_with = "seconds")]
    pub steps: Option<u64>,
    /// Simulated time, s
    #[arg(long, value_name = "S", value_parser = duration)]
    pub seconds: Option<f64>,
    /// Check the whole state after every step; the first violation is named on stderr, and the exit code is 1
    #[arg(long)]
    pub validate: bool,
    /// Write what the scenario's output table says into this folder; it must be empty or not exist
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Allow a folder that is not empty: files of the same names are replaced, all others stay
    #[arg(long, requires = "out")]
    pub force: bool,
    #[command(flatten)]
    pub outputs: OutputArgs,
    #[command(flatten)]
    pub keep: RecordArgs,
    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,
    /// Print what would be simulated and roughly how long it would take; write nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Run the tasks of a sweep, one a line, from a file or `-`; those in the store are skipped
    #[arg(long, value_name = "FILE", requires = "store", conflicts_with_all = ["scenario", "out", "dry_run", "json", "seed", "set", "steps", "seconds", "validate", "record", "save"])]
    pub task: Option<String>,
    /// Where the results of tasks are kept
    #[arg(long, value_name = "DIR", requires = "task")]
    pub store: Option<PathBuf>,
    /// Exit with 0 where checks of tasks fail; their results say so
    #[arg(long, requires = "task")]
    pub keep_going: bool,
}

/// Runs a scenario, writes its files and prints a summary.
pub(crate) fn run(args: &RunArgs, console: &Console) -> Result<(), Failure> {
    if let (Some(tasks), Some(store)) = (&args.task, &args.store) {
        return sweep::run_tasks(tasks, store, args.keep_going, console);
    }
    let mut changes = args.changes.clone();
    changes.set.extend(args.outputs.overrides());
    let prepared = Prepared::new(load(args.scenario.as_deref().unwrap_or_default())?, &changes)?;
    let steps = args.steps.unwrap_or_else(|| prepared.steps_in(args.seconds));
    check_formats(prepared.scenario.output())?;
    if args.dry_run {
        return estimate(&prepared, steps);
    }
    interrupt::listen();
    let is_resumable = args.out.is_some() && prepared.scenario.output().checkpoint_every > 0;
    args.keep.check(args.out.as_deref(), is_resumable)?;
    let outputs = args.out.as_deref().map(|folder| Outputs::open(folder, args.force)).transpose()?;
    Session::start(prepared, steps, outputs.as_ref(), args.validate, &args.keep)?.run(args.json, console)
}

/// Prints size and estimated time of a run.
fn estimate(prepared: &Prepared, steps: u64) -> Result<(), Failure> {
    let mut built = prepared.built.clone();
    let tried: Vec<f64> = (0..steps.min(TRIED)).map(|_| timed_step(&mut built).as_secs_f64()).collect();
    let seconds = median(&tried) * steps as f64;
    let census = prepared.built.world.census();
    let mut table = Table::default();
    table.row("scenario", prepared.name());
    table.row("seed", prepared.scenario.seed());
    table.row("steps", format!("{steps} ({:.2} s)", steps as f64 * f64::from(prepared.scenario.config().dt)));
    table.row("organisms", census.organisms);
    table.row("particles", census.particles);
    table.row("would take", format!("about {} on this machine", rough(seconds)));
    Ok(table.print()?)
}

/// A time in words, to one digit or so.
fn rough(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "a second or less".to_owned(),
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
