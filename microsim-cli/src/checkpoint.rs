//! The file that an unfinished run can be resumed from: one line of JSON about its files, the run as bytes, and a SHA-256 of
//! both.

use crate::failure::Failure;
use crate::json;
use crate::output::{self, CHECKPOINT, FileProgress, Outputs};
use crate::read;
use crate::tally::Tally;
use microsim_core::snapshot::Checkpoint;
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Bytes of the checksum at the end.
const CHECKSUM: usize = 32;

/// The part of a checkpoint beside the run itself.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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

/// Writes the checkpoint in place of the one before. The content of all files that it needs must be on the disk.
pub(crate) fn write(outputs: &Outputs, header: &CheckpointHeader, run: &Checkpoint) -> Result<(), Failure> {
    let run = run.to_bytes().map_err(|error| Failure::Message(format!("cannot write a checkpoint: {error}")))?;
    let line = json::line(header)?;
    outputs.sync()?;
    outputs.replace(CHECKPOINT, &sealed(line.trim_end().as_bytes(), &run))?;
    outputs.sync()
}

/// The file of a line and a run.
pub(crate) fn sealed(line: &[u8], run: &[u8]) -> Vec<u8> {
    let mut bytes = [line, b"\n", run].concat();
    bytes.extend(hmac_sha256::Hash::hash(&bytes));
    bytes
}

/// Reads the checkpoint of a folder.
pub(crate) fn read(folder: &Path) -> Result<(CheckpointHeader, Checkpoint), Failure> {
    let path = folder.join(CHECKPOINT);
    let bytes = match read::whole(&path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => {
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
    let (header, run) = split(bytes).ok_or("not a checkpoint, or damaged")?;
    let header: CheckpointHeader =
        serde_json::from_slice(header).map_err(|error| format!("not a checkpoint: {error}"))?;
    let run = Checkpoint::from_bytes(run).map_err(|error| error.to_string())?;
    if header.tally.steps != run.run.world.step_index() {
        return Err("its line and its run are of different steps".to_owned());
    }
    let built = run.origin.scenario().and_then(|scenario| scenario.build());
    if built.is_ok_and(|built| built.named == run.run.named) {
        Ok((header, run))
    } else {
        Err("its organisms have other names than those of its scenario".to_owned())
    }
}

/// The line and the run of a checkpoint whose checksum is right.
fn split(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (content, checksum) = bytes.split_at_checked(bytes.len().checked_sub(CHECKSUM)?)?;
    if !content.starts_with(b"{") || hmac_sha256::Hash::hash(content)[..] != *checksum {
        return None;
    }
    let end = content.iter().position(|byte| *byte == b'\n')?;
    Some((&content[..end], &content[end + 1..]))
}

/// The run behind the line about its files; `None` where there is no sound line.
pub(crate) fn run_of(bytes: &[u8]) -> Option<&[u8]> {
    split(bytes).map(|(_, run)| run)
}

/// Gives up the run that was stopped in a folder, before another one replaces its tables: a checkpoint that a power cut brings
/// back would continue the tables of the other run.
pub(crate) fn give_up(outputs: &Outputs) -> Result<(), Failure> {
    let path = outputs.folder().join(CHECKPOINT);
    match output::remove(&path) {
        Ok(()) => outputs.sync(),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(Failure::file("replace", &path, &error)),
    }
}

/// Removes the files that only an unfinished run needs: the checkpoint first, which cannot be resumed without the `others`.
pub(crate) fn remove(folder: &Path, others: Vec<PathBuf>) {
    // It does no harm where it cannot be removed, as long as the others stay: `run.json` says that the run is finished.
    let removed = output::remove(&folder.join(CHECKPOINT));
    if removed.is_ok() || removed.is_err_and(|error| error.kind() == ErrorKind::NotFound) {
        others.iter().for_each(|path| _ = output::remove(path));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepared::{Prepared, apart, prepare};
    use crate::scenario_args::{Changes, ScenarioArgs};

    fn bytes_at(steps: u64) -> Vec<u8> {
        let args = ScenarioArgs { scenario: "empty".to_owned(), changes: Changes::default() };
        bytes_of(prepare(&args).ok().unwrap(), steps)
    }

    fn bytes_of(prepared: Prepared, steps: u64) -> Vec<u8> {
        let header = CheckpointHeader {
            source: "empty".to_owned(),
            steps: 9,
            progress: FileProgress::default(),
            tally: Tally { steps, ..Tally::default() },
            validates: false,
            broken: None,
            digest_at_start: String::new(),
        };
        let run = Checkpoint { origin: prepared.scenario.origin(), run: prepared.built };
        sealed(&serde_json::to_vec(&header).unwrap(), &run.to_bytes().unwrap())
    }

    #[test]
    fn no_bit_of_a_checkpoint_can_change_unseen() {
        let mut bytes = bytes_at(0);
        assert!(parse(&bytes).is_ok());
        for bit in 0..8 * bytes.len() {
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(parse(&bytes).is_err() && run_of(&bytes).is_none(), "bit {bit}");
            bytes[bit / 8] ^= 1 << (bit % 8);
        }
        assert!((0..bytes.len()).all(|end| parse(&bytes[..end]).is_err()));
    }

    #[test]
    fn organisms_have_the_names_of_the_scenario() {
        let mut prepared = apart("");
        assert!(parse(&bytes_of(apart(""), 0)).is_ok());
        "a,b".clone_into(&mut prepared.built.named[0].0);
        assert!(parse(&bytes_of(prepared, 0)).is_err_and(|why| why.contains("other names")));
    }

    #[test]
    fn what_a_checkpoint_needs_stays_as_long_as_it_does() {
        let folder = std::env::temp_dir().join(format!("microsim-needs-{}", std::process::id()));
        let (checkpoint, rows) = (folder.join(CHECKPOINT), folder.join("rows"));
        // A folder is not removed as a file is.
        std::fs::create_dir_all(&checkpoint).unwrap();
        let left = || {
            std::fs::write(&rows, "").unwrap();
            remove(&folder, vec![rows.clone()]);
            rows.exists()
        };
        let beside_it = left();
        std::fs::remove_dir(&checkpoint).unwrap();
        let alone = left();
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(beside_it && !alone);
    }

    #[test]
    fn line_and_run_are_of_the_same_step() {
        assert!(parse(&bytes_at(3)).is_err());
    }
}
