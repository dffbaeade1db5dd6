//! `report`: one HTML page of a run or a sweep.

use crate::console::Console;
use crate::failure::Failure;
use std::path::PathBuf;

/// `report`.
#[derive(Debug, clap::Args)]
pub(crate) struct ReportArgs {
    /// The folder of a run, or the merged results of a sweep (.jsonl)
    #[arg(value_name = "DIR|FILE")]
    pub input: PathBuf,
    /// The page to write
    #[arg(short, long, value_name = "FILE", default_value = "report.html")]
    pub output: PathBuf,
}

/// Writes the page.
pub(crate) fn report(_args: &ReportArgs, _console: &Console) -> Result<(), Failure> {
    Err(Failure::No)
}
