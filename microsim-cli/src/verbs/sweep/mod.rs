//! `sweep`: a scenario many times, each with other parameters and seeds.
//!
//! A plan has one task a line, complete in itself. The result of a task is a file whose name is a hash of the task, so it
//! does not matter who runs which task, where, in what order and how often.

mod grid;
mod merge;
mod plan;
mod run;
mod store;
mod task;

use grid::{Axis, Seeds};
pub(crate) use run::run_tasks;
pub(crate) use task::TaskOutcome;
#[cfg(any(test, fuzzing))]
pub(crate) use {
    merge::{csv, lines},
    store::outcome_of,
    task::Task,
};

use run::Shard;

use crate::console::Console;
use crate::failure::Failure;
use crate::value_parser::{duration, key_value, whole};
use std::path::PathBuf;

#[derive(Debug, clap::Subcommand)]
pub(crate) enum SweepVerb {
    /// Print one task a line for every combination of parameters and seeds
    Plan(PlanArgs),
    /// Run the tasks of a plan that are not in the store yet
    Run(SweepRunArgs),
    /// Say which tasks of a plan are in the store
    Status(StatusArgs),
    /// Put the results of a plan into one table, in the order of the plan
    Merge(MergeArgs),
}

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Each --grid is one axis: whole numbers a..b, so many evenly spaced numbers a..b/n, or values with commas.\n\
  microsim sweep plan hunt --grid platelets=0..20/5 --grid amoeboid_cell.neutrophil.speed=3,5,8 --seeds 0..9 > plan.jsonl\n\
One task alone: sed -n 7p plan.jsonl | microsim run --task - --store results"
)]
pub(crate) struct PlanArgs {
    /// A built-in scenario, a TOML file, or `-` for stdin
    #[arg(value_name = "NAME|FILE")]
    pub scenario: String,
    /// Values of one parameter or field; may be repeated
    #[arg(long, value_name = "KEY=VALUES")]
    pub grid: Vec<Axis>,
    /// Seeds, for example 0..99; without it, the scenario's own
    #[arg(long, value_name = "SEEDS")]
    pub seeds: Option<Seeds>,
    /// A value that is the same in all tasks; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_value)]
    pub set: Vec<(String, String)>,
    /// Number of steps; without it, the scenario's duration
    #[arg(long, value_name = "N", value_parser = whole, conflicts_with = "seconds")]
    pub steps: Option<u64>,
    /// Simulated time, s
    #[arg(long, value_name = "S", value_parser = duration)]
    pub seconds: Option<f64>,
}

/// A plan and its results.
#[derive(Debug, clap::Args)]
pub(crate) struct PlanAndStore {
    /// The plan
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// Where results are kept
    #[arg(long, value_name = "DIR")]
    pub store: PathBuf,
}

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Ctrl-C loses only the tasks in progress; run it again to continue. Shards may run anywhere that sees the store,\n\
at any time: microsim sweep run plan.jsonl --store results --shard $SLURM_ARRAY_TASK_ID/100\n\
The exit code is 1 if a check fails in any task of this shard."
)]
pub(crate) struct SweepRunArgs {
    #[command(flatten)]
    pub from: PlanAndStore,
    /// Tasks at once; without it, one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
    /// Only every n-th task, from the i-th on: i from 0 to n-1
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
}

#[derive(Debug, clap::Args)]
#[command(after_help = "Keys of missing tasks are printed one a line. The exit code is 1 if there are any.")]
pub(crate) struct StatusArgs {
    #[command(flatten)]
    pub from: PlanAndStore,
}

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The file name ends in .csv or .jsonl; `-` is JSON lines on stdout. Where results are missing, they are listed, nothing\n\
is written, and the exit code is 1; with --partial the table has the others."
)]
pub(crate) struct MergeArgs {
    #[command(flatten)]
    pub from: PlanAndStore,
    /// The table to write
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Write the table even if results are missing
    #[arg(long)]
    pub partial: bool,
}

pub(crate) fn sweep(verb: &SweepVerb, console: &Console) -> Result<(), Failure> {
    match verb {
        SweepVerb::Plan(args) => plan::plan(args, console),
        SweepVerb::Run(args) => run::run(args, console),
        SweepVerb::Status(args) => merge::status(args, console),
        SweepVerb::Merge(args) => merge::merge(args, console),
    }
}
