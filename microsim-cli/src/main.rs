//! `microsim`: runs, measures and pictures scenarios without a window.
//!
//! Results go to stdout, everything else to stderr. Exit codes: 0 done, 1 what the scenario says must hold
//! does not, 2 wrong usage, a scenario that is refused or an output that cannot be written, 130 interrupted.

// The command line, and how it talks.
mod args;
mod console;
mod diagnostics;
mod failure;
mod interrupt;
mod scenario_args;
mod value_parser;

// Verbs.
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

// What they are made of.
mod checkpoint;
mod draw;
mod output;
mod record;
mod saved;
mod session;
mod simulate;
mod source;
mod summary;

use args::{Args, Verb};
use clap::CommandFactory;
use console::Console;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = Args::from_command_line();
    let console = Console::new(args.color, args.quiet, args.verbose);
    match perform(&args.verb, &console) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(&console),
    }
}

fn perform(verb: &Verb, console: &Console) -> Result<(), Failure> {
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
        Verb::Completions(args) => manual::completions(args, Args::command()),
        Verb::Man(args) => manual::man(args, Args::command(), console),
    }
}
