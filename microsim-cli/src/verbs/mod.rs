//! The verbs of the command line: a file or folder for each, with its arguments and its work.

mod bench;
mod check;
mod diff;
mod inspect;
mod list;
mod manual;
mod new;
mod render;
mod replay;
mod report;
mod resume;
mod run;
mod schema;
#[cfg(feature = "serve")]
mod serve;
mod sweep;

#[cfg(any(test, fuzzing))]
pub(crate) use sweep::{Task, csv, lines, outcome_of};

use crate::console::Console;
use crate::failure::Failure;

/// A verb and its arguments.
#[derive(Debug, clap::Subcommand)]
pub(crate) enum Verb {
    /// Write a commented scenario to start from
    New(new::NewArgs),
    /// Check a scenario without running it: its text, values and placements
    Check(check::CheckArgs),
    /// Print the JSON Schema of scenario files, for editors
    Schema,
    /// List the built-in scenarios
    List,
    /// Run a scenario and print a summary
    Run(Box<run::RunArgs>),
    /// Continue a stopped run, bit for bit
    Resume(resume::ResumeArgs),
    /// Repeat a recorded run and compare it with the record
    Replay(replay::ReplayArgs),
    /// Compare two snapshots, checkpoints or replays: the first step and field that differ
    Diff(diff::DiffArgs),
    /// Describe a snapshot, a checkpoint or a replay
    Inspect(inspect::InspectArgs),
    /// Picture a scenario as a microscope would show it: stills, contact sheets and movies
    Render(render::RenderArgs),
    /// Run a scenario many times, each with other parameters and seeds
    #[command(subcommand)]
    Sweep(sweep::SweepVerb),
    /// Make one HTML page of a run or a sweep
    Report(report::ReportArgs),
    /// Measure the time of steps and their phases, and the errors of the constraints
    Bench(bench::BenchArgs),
    /// Serve the page and rooms to play in together, on the local network
    #[cfg(feature = "serve")]
    Serve(serve::ServeArgs),
    /// Print the completions of a shell
    Completions(manual::CompletionsArgs),
    /// Print the manual page of a verb, or write all of them
    Man(manual::ManArgs),
}

/// Performs a verb. `program` is the whole command line, for its completions and manual pages.
pub(crate) fn perform(verb: &Verb, program: clap::Command, console: &Console) -> Result<(), Failure> {
    match verb {
        Verb::New(args) => new::new(args, console),
        Verb::Check(args) => check::check(args),
        Verb::Schema => schema::schema(),
        Verb::List => list::list(),
        Verb::Run(args) => run::run(args, console),
        Verb::Resume(args) => resume::resume(args, console),
        Verb::Replay(args) => replay::replay(args, console),
        Verb::Diff(args) => diff::diff(args, console),
        Verb::Inspect(args) => inspect::inspect(args),
        Verb::Render(args) => render::render(args, console),
        Verb::Sweep(verb) => sweep::sweep(verb, console),
        Verb::Report(args) => report::report(args, console),
        Verb::Bench(args) => bench::bench(args, console),
        #[cfg(feature = "serve")]
        Verb::Serve(args) => serve::serve(args, console),
        Verb::Completions(args) => manual::completions(args, program),
        Verb::Man(args) => manual::man(args, program, console),
    }
}
