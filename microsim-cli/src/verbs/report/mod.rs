//! `report`: one HTML page of a run or a sweep, complete in itself.

mod chart;
mod data;
mod heat_map;
mod page;
mod run_page;
mod scale;
mod sweep_page;

use crate::console::{Console, print};
use crate::failure::Failure;
use crate::output::Outputs;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The page needs no network: plots are SVG, pictures lie in it. Of a run it shows what the folder has, so the more\n\
outputs were chosen, the more there is to see:\n\
  microsim run hunt --out hunt --trajectories csv && microsim report hunt -o hunt.html\n\
  microsim sweep merge plan.jsonl --store results -o merged.jsonl && microsim report merged.jsonl -o sweep.html"
)]
pub(crate) struct ReportArgs {
    /// The folder of a run, or the merged results of a sweep (.jsonl)
    #[arg(value_name = "DIR|FILE")]
    pub input: PathBuf,
    /// The page to write, or `-` for stdout
    #[arg(short, long, value_name = "FILE", default_value = "report.html")]
    pub output: PathBuf,
}

/// Writes the page.
pub(crate) fn report(args: &ReportArgs, console: &Console) -> Result<(), Failure> {
    let page = if args.input.is_dir() { run_page::make(&args.input)? } else { sweep_page::make(&args.input)? };
    if args.output == Path::new("-") {
        return Ok(print(page)?);
    }
    let (outputs, name) = Outputs::beside(&args.output)?;
    outputs.write(&name, page.as_bytes())?;
    console.note(&format!("wrote {}", args.output.display()));
    Ok(())
}
