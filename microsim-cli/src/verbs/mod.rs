//! What the program can be told to do, one file or folder for each verb: its arguments and its work.

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
mod sweep;

use crate::console::Console;
use crate::failure::Failure;

/// What to do.
#[derive(Debug, clap::Subcommand)]
pub(crate) enum Verb {
    /// Write a commented scenario to start from
    New(new::NewArgs),
    /// Check a scenario without running it: its text, and that everything finds its place
    Check(check::CheckArgs),
    /// Print the JSON Schema of scenario files, for editors
    Schema,
    /// List the built-in scenarios
    List,
    /// Run a scenario and say what came of it
    Run(Box<run::RunArgs>),
    /// Go on with a run that was stopped, bit for bit
    Resume(resume::ResumeArgs),
    /// Make a recorded run again and compare it with the record
    Replay(replay::ReplayArgs),
    /// Say where two snapshots, checkpoints or replays differ: the first step and the first field
    Diff(diff::DiffArgs),
    /// Say what is in a snapshot, a checkpoint or a replay
    Inspect(inspect::InspectArgs),
    /// Picture a scenario as a microscope would show it: stills, contact sheets and movies
    Render(render::RenderArgs),
    /// Run a scenario many times, with other parameters and seeds each time
    #[command(subcommand)]
    Sweep(sweep::SweepVerb),
    /// Make one HTML page of a run or a sweep
    Report(report::ReportArgs),
    /// Measure how long steps and their phases take, and how well the constraints hold
    Bench(bench::BenchArgs),
    /// Print the completions of a shell
    Completions(manual::CompletionsArgs),
    /// Print the manual page of a verb, or write all of them
    Man(manual::ManArgs),
}

/// Does what a verb asks for. `program` is the whole command line, for its completions and manual pages.
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
        Verb::Completions(args) => manual::completions(args, program),
        Verb::Man(args) => manual::man(args, program, console),
    }
}
