//! The command line.

use crate::render::{FilmStock, OpticsList, Size, ViewSpec};
use clap::{ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::path::PathBuf;

/// Everything that the command line says.
#[derive(Debug, Parser)]
#[command(
    name = "microsim",
    version,
    about = "Runs, measures and pictures microsim scenarios without a window",
    after_help = "Exit codes: 0 done; 1 an invariant or expectation of the scenario broke; 2 wrong usage, a refused scenario or an output that cannot be written; 130 interrupted."
)]
pub(crate) struct Args {
    /// When to colour what goes to a terminal; NO_COLOR is obeyed
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub color: ColorChoice,
    /// Show no progress and no notes on stderr
    #[arg(short, long, global = true)]
    pub quiet: bool,
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// List the built-in scenarios
    List,
    /// Check a scenario without running it: its text, and that everything finds its place
    Check(ScenarioArgs),
    /// Run a scenario and say what came of it
    Run(RunArgs),
    /// Measure how long steps and their phases take, and how well the constraints hold
    Bench(BenchArgs),
    /// Picture a scenario as a microscope would show it: stills, contact sheets and movies
    Render(RenderArgs),
}

/// Which scenario, and what to change in it.
#[derive(Debug, clap::Args)]
pub(crate) struct ScenarioArgs {
    /// A built-in scenario, a TOML file, or `-` for stdin
    #[arg(value_name = "NAME|FILE")]
    pub scenario: String,
    /// Seed of all random numbers, in place of the scenario's own
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub seed: Option<u64>,
    /// Replace one value of the scenario, for example `step.substeps=12`; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_value)]
    pub set: Vec<(String, String)>,
}

/// `run`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "The scenario's invariants and expectations are checked after every step; the first that breaks is named on\n\
stderr, the run goes on to its end, and the exit code is 1. The census (leaks, improper absorptions) is taken after\n\
every step, outside the time that is measured.\n\
With --out, the files are: frame.svg and frame.png (the end), frames.png (six moments), measures.csv (one row per step),\n\
events.jsonl (one object per event), run.json. Equal scenario, seed and steps give equal bytes in all but run.json."
)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub scenario: ScenarioArgs,
    /// Number of steps; without it, the scenario's duration
    #[arg(long, value_name = "N", allow_negative_numbers = true, conflicts_with = "seconds")]
    pub steps: Option<u64>,
    /// Simulated time, s
    #[arg(long, value_name = "S", value_parser = duration)]
    pub seconds: Option<f64>,
    /// Write pictures, measures and events into this folder; it must be empty or not exist
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Allow a folder that is not empty: files of the same names are replaced, all others stay
    #[arg(long, requires = "out")]
    pub force: bool,
    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,
}

/// `bench`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Times, events and quality are those of the measured steps. Leaks and improper absorptions are the\n\
largest counts seen in any step, the warm-up included. Measures are taken outside the time that is measured."
)]
pub(crate) struct BenchArgs {
    #[command(flatten)]
    pub scenario: ScenarioArgs,
    /// Number of measured steps; without it, the scenario's duration
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(1..))]
    pub steps: Option<u64>,
    /// Number of steps before the measured ones
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 60)]
    pub warmup: u64,
    /// Print one JSON object instead of the table
    #[arg(long)]
    pub json: bool,
}

/// `render`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "The name of the file says what it is: .png is a still, .gif, .apng and .mp4 are movies (an mp4 needs ffmpeg).\n\
Several moments or several optics in one .png make a contact sheet. Equal scenario, seed and options give equal bytes,\n\
whatever the number of threads."
)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    pub scenario: ScenarioArgs,
    /// The picture or movie to write
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Simulated time of a still, s; without it, the scenario's duration
    #[arg(long, value_name = "S", value_parser = duration, conflicts_with_all = ["from", "to", "fps"])]
    pub at: Option<f64>,
    /// Simulated time of the first frame, s
    #[arg(long, value_name = "S", value_parser = duration)]
    pub from: Option<f64>,
    /// Simulated time of the last frame, s; without it, the scenario's duration
    #[arg(long, value_name = "S", value_parser = duration)]
    pub to: Option<f64>,
    /// Frames per second of simulated time, 24 unless said otherwise
    #[arg(long, value_name = "N", value_parser = frame_rate)]
    pub fps: Option<f64>,
    /// phase-contrast, negative-phase-contrast, dic, dark-field, bright-field, stained, fluorescence, classic; several
    /// with commas, or all
    #[arg(long, value_name = "MODE", default_value = "phase-contrast")]
    pub optics: OpticsList,
    /// What records the picture
    #[arg(long, value_enum, default_value_t = FilmStock::Cine)]
    pub film: FilmStock,
    /// Width and height, pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720")]
    pub size: Size,
    /// What is seen: middle and width in micrometres, or an organism's index or name and a width; without it, the room
    #[arg(long, value_name = "X,Y,WIDTH|follow:ID[,WIDTH]", allow_hyphen_values = true)]
    pub view: Option<ViewSpec>,
    /// Pictures side by side in a contact sheet
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub columns: Option<u32>,
    /// Threads to compute pictures on; without it, one for each processor
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Shade where chemicals are: each shade is half of the next
    #[arg(long)]
    pub chemicals: bool,
    /// Leave the scale bar out
    #[arg(long)]
    pub no_scale_bar: bool,
}

impl Args {
    /// Reads the command line; help, version and mistakes end the process, as clap does.
    pub(crate) fn from_command_line() -> Self {
        let command = Self::command().color(color_asked_for(std::env::args_os().skip(1)));
        let matches = command.get_matches();
        Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
    }
}

/// The value of `--color`, found before clap parses, so that clap's own messages obey it too.
fn color_asked_for(arguments: impl Iterator<Item = std::ffi::OsString>) -> ColorChoice {
    let arguments: Vec<String> = arguments.filter_map(|a| a.into_string().ok()).collect();
    let joined = arguments.iter().find_map(|a| a.strip_prefix("--color="));
    let separate = || arguments.windows(2).find(|pair| pair[0] == "--color");
    match joined.or_else(|| separate().map(|pair| pair[1].as_str())) {
        Some("always") => ColorChoice::Always,
        Some("never") => ColorChoice::Never,
        _ => ColorChoice::Auto,
    }
}

fn key_value(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err("expected KEY=VALUE, for example step.substeps=12".to_owned()),
    }
}

fn frame_rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(rate) if (0.001..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("expected frames per second, 0.001 to 1000".to_owned()),
    }
}

fn duration(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.0..=1e9).contains(&seconds) => Ok(seconds),
        _ => Err("expected a number of seconds, 0 to 1e9".to_owned()),
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
    fn a_value_may_contain_an_equals_sign() {
        assert_eq!(key_value("a = b=c"), Ok(("a".into(), "b=c".into())));
        assert!(key_value("a").is_err() && key_value("=1").is_err());
    }

    #[test]
    fn a_duration_is_finite_and_not_negative() {
        assert_eq!(duration("1.5"), Ok(1.5));
        assert!(["-1", "nan", "inf", "x"].iter().all(|t| duration(t).is_err()));
    }

    #[test]
    fn the_colour_is_found_in_both_spellings() {
        let asked = |arguments: &[&str]| color_asked_for(arguments.iter().map(Into::into));
        assert_eq!(asked(&["list", "--color", "never"]), ColorChoice::Never);
        assert_eq!(asked(&["--color=always", "list"]), ColorChoice::Always);
        assert_eq!(asked(&["list"]), ColorChoice::Auto);
    }
}
