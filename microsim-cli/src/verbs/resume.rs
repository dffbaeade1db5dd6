//! `resume`: continues a stopped run.

use crate::console::Console;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::{Outputs, check_formats};
use crate::session::Session;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The run continues from its last checkpoint, bit for bit: digests and data files are those of a run that was never\n\
stopped. Checkpoints are written by microsim run --out DIR --checkpoint-every N."
)]
pub(crate) struct ResumeArgs {
    /// The folder of the run
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,
}

pub(crate) fn resume(args: &ResumeArgs, console: &Console) -> Result<(), Failure> {
    if !args.folder.is_dir() {
        let message = format!("{}: there is no such folder, accepted: the folder of a run", args.folder.display());
        return Err(Failure::Message(message));
    }
    interrupt::listen();
    let outputs = Outputs::reopen(&args.folder)?;
    let session = Session::resume(&outputs)?;
    check_formats(session.plan())?;
    session.run(args.json, console)
}
