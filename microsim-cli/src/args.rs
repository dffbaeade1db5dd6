//! The command line: the options that all verbs share. Those of one verb are in its file under `verbs`.

use crate::console::Console;
use crate::failure::Failure;
use crate::sanitize;
use crate::verbs::Verb;
use clap::{ColorChoice, CommandFactory, FromArgMatches, Parser};
use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "microsim",
    version,
    about = "Runs, measures and pictures microsim scenarios without a window",
    after_help = "Exit codes: 0 success; 1 a check that failed, a difference or a missing result; 2 wrong usage, a refused scenario or\n\
an output that cannot be written; 130 interrupted by Ctrl-C, 143 by SIGTERM, 129 by SIGHUP."
)]
pub(crate) struct Args {
    /// When to colour what goes to a terminal; NO_COLOR is obeyed
    #[arg(long, global = true, display_order = 900, value_name = "WHEN", default_value = "auto")]
    pub color: ColorChoice,
    /// Show no progress and no notes on stderr
    #[arg(short, long, global = true, display_order = 901, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more on stderr
    #[arg(short, long, global = true, display_order = 902)]
    pub verbose: bool,
    #[command(subcommand)]
    pub verb: Verb,
}

impl Args {
    /// Reads the command line. Prints help, version and mistakes as clap does, and returns the exit code.
    pub(crate) fn from_command_line() -> Result<Self, ExitCode> {
        let color = color_asked_for(std::env::args_os().skip(1));
        let read = Self::command().color(color).try_get_matches();
        read.and_then(|matches| Self::from_arg_matches(&matches)).map_err(|said| {
            let printed = harmless(color).as_ref().unwrap_or(&said).print().and_then(|()| std::io::stdout().flush());
            let code = ExitCode::from(u8::try_from(said.exit_code()).unwrap_or(2));
            printed.map_or_else(|error| Failure::from(error).report(&Console::new(color, false, false)), |()| code)
        })
    }
}

/// What clap says of the same arguments without what controls a terminal, which it would quote: one may be the name of a file.
fn harmless(color: ColorChoice) -> Option<clap::Error> {
    let clean = |argument: OsString| sanitize::line(&argument.to_string_lossy()).into_owned();
    Args::command().color(color).try_get_matches_from(std::env::args_os().map(clean)).err()
}

/// The value of `--color`, found before clap parses, so that clap's own messages obey it too.
fn color_asked_for(arguments: impl Iterator<Item = OsString>) -> ColorChoice {
    let arguments: Vec<String> = arguments.filter_map(|a| a.into_string().ok()).collect();
    let joined = arguments.iter().find_map(|a| a.strip_prefix("--color="));
    let separate = || arguments.windows(2).find(|pair| pair[0] == "--color");
    match joined.or_else(|| separate().map(|pair| pair[1].as_str())) {
        Some("always") => ColorChoice::Always,
        Some("never") => ColorChoice::Never,
        _ => ColorChoice::Auto,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Args::command().debug_assert();
    }

    #[test]
    fn the_colour_is_found_in_both_spellings() {
        let asked = |arguments: &[&str]| color_asked_for(arguments.iter().map(Into::into));
        assert_eq!(asked(&["list", "--color", "never"]), ColorChoice::Never);
        assert_eq!(asked(&["--color=always", "list"]), ColorChoice::Always);
        assert_eq!(asked(&["list"]), ColorChoice::Auto);
    }
}
