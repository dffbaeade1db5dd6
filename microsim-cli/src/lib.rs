//! `microsim`: runs, measures and pictures scenarios without a window.
//!
//! Results go to stdout, everything else to stderr. Exit codes: 0 success, 1 a check that failed, a difference or a
//! missing result, 2 wrong usage, a refused scenario or an output that cannot be written, 130 interrupted by Ctrl-C, 143 by
//! SIGTERM, 129 by SIGHUP.

mod args;
mod checkpoint;
mod console;
mod counted;
mod diagnostics;
mod draw;
mod failure;
#[cfg(test)]
mod fault_tests;
#[cfg(any(test, fuzzing))]
#[doc(hidden)]
pub mod hostile;
mod interrupt;
mod json;
mod output;
mod prepared;
mod read;
mod record_args;
mod sanitize;
mod scenario_args;
mod session;
mod summary;
mod tally;
mod value_parser;
mod verbs;
mod world_file;

use args::Args;
use clap::CommandFactory;
use console::Console;
use std::process::ExitCode;

/// Runs the program with the arguments of the command line.
#[must_use]
pub fn main() -> ExitCode {
    let args = match Args::from_command_line() {
        Ok(args) => args,
        Err(code) => return code,
    };
    let console = Console::new(args.color, args.quiet, args.verbose);
    match verbs::perform(&args.verb, Args::command(), &console) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(&console),
    }
}
