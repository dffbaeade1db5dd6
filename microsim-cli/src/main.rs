//! `microsim`: runs, measures and pictures scenarios without a window.
//!
//! Results go to stdout, everything else to stderr. Exit codes: 0 done, 1 what the scenario says must hold
//! does not, 2 wrong usage, a scenario that is refused or an output that cannot be written, 130 interrupted.

mod args;
mod bench;
mod console;
mod diagnostics;
mod diff;
mod draw;
mod failure;
mod inspect;
mod interrupt;
mod moments;
mod output;
mod record;
mod render;
mod replay;
mod report;
mod run;
mod saved;
mod simulate;
mod source;

use args::{Args, Verb};
use console::Console;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = Args::from_command_line();
    let console = Console::new(args.color, args.quiet);
    match perform(&args.verb, &console) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(&console),
    }
}

fn perform(verb: &Verb, console: &Console) -> Result<(), Failure> {
    match verb {
        Verb::List => inspect::list(),
        Verb::Check(args) => inspect::check(args),
        Verb::Run(args) => run::run(args, console),
        Verb::Replay(args) => replay::replay(args, console),
        Verb::Diff(args) => diff::diff(args),
        Verb::Bench(args) => bench::bench(args, console),
        Verb::Render(args) => render::render(args, console),
    }
}
