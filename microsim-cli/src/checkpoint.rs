//! The file that an unfinished run can be resumed from: one line of JSON about its files, then the run as bytes.

use crate::failure::Failure;
use crate::output::{FileProgress, Outputs};
use crate::tally::Tally;
use microsim_core::snapshot::Checkpoint;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// Its name in the folder of the run.
pub(crate) const FILE: &str = "checkpoint";

/// The part of a checkpoint beside the run itself.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct CheckpointHeader {
    /// Origin of the scenario.
    pub source: String,
    /// Total number of steps.
    pub steps: u64,
    /// Lengths and names of its files.
    pub progress: FileProgress,
    pub tally: Tally,
    /// Whether the whole state is checked after every step.
    pub validates: bool,
    /// The first failed check or violation of the state.
    pub broken: Option<String>,
    pub digest_at_start: String,
}

/// Writes the checkpoint in place of the one before.
pub(crate) fn write(outputs: &Outputs, header: &CheckpointHeader, run: &Checkpoint) -> Result<(), Failure> {
    let mut bytes = serde_json::to_vec(header).map_err(std::io::Error::from)?;
    bytes.push(b'\n');
    let run = run.to_bytes().map_err(|error| Failure::Message(format!("cannot write a checkpoint: {error}")))?;
    bytes.extend(run);
    outputs.replace(FILE, &bytes)
}

/// Reads the checkpoint of a folder.
pub(crate) fn read(folder: &Path) -> Result<(CheckpointHeader, Checkpoint), Failure> {
    let path = folder.join(FILE);
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let is_done = folder.join("run.json").exists();
            let why = if is_done { "its run is finished" } else { "there is no checkpoint in it" };
            let accepted = "accepted: the folder of a run with output.checkpoint_every that was stopped";
            return Err(Failure::Message(format!("{}: {why}, {accepted}", folder.display())));
        }
        Err(error) => return Err(Failure::file("read", &path, &error)),
    };
    parse(&bytes).map_err(|why| Failure::Message(format!("{}: {why}; run the scenario again", path.display())))
}

/// The two parts of a checkpoint.
fn parse(bytes: &[u8]) -> Result<(CheckpointHeader, Checkpoint), String> {
    let run = run_of(bytes).ok_or("not a checkpoint")?;
    let header = &bytes[..bytes.len() - run.len()];
    let header = serde_json::from_slice(header).map_err(|error| format!("not a checkpoint: {error}"))?;
    let run = Checkpoint::from_bytes(run).map_err(|error| error.to_string())?;
    Ok((header, run))
}

/// The run behind the line about its files; `None` where there is no such line.
pub(crate) fn run_of(bytes: &[u8]) -> Option<&[u8]> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    bytes.starts_with(b"{").then(|| &bytes[end + 1..])
}

/// Removes the files of an unfinished run: the checkpoint first, which cannot be resumed without the `others`.
pub(crate) fn remove(folder: &Path, others: Vec<PathBuf>) {
    for path in std::iter::once(folder.join(FILE)).chain(others) {
        // It does no harm where it cannot be removed: `run.json` says that the run is finished.
        let _ = fs::remove_file(path);
    }
}
