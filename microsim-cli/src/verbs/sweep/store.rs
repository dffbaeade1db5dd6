//! Where results are kept: one file for each task, named after its key. It is there whole or not at all.

use super::task::{Task, TaskOutcome};
use crate::failure::Failure;
use crate::json;
use crate::output::Outputs;
use crate::read;
use std::io::ErrorKind;
use std::path::Path;

#[derive(Debug)]
pub(crate) struct ResultStore {
    outputs: Outputs,
}

impl ResultStore {
    /// Creates the folder if it is missing.
    pub(crate) fn open(folder: &Path) -> Result<Self, Failure> {
        if folder.exists() && !folder.is_dir() {
            let message =
                format!("--store {}: it is not a directory, accepted: a directory or a new one", folder.display());
            return Err(Failure::Message(message));
        }
        Ok(Self { outputs: Outputs::shared(folder)? })
    }

    /// The result of a task. One that is torn, or of another task, counts as missing, and is replaced when the task is run.
    pub(crate) fn get(&self, task: &Task) -> Result<Option<TaskOutcome>, Failure> {
        let path = self.outputs.folder().join(name(task));
        let bytes = match read::whole(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Failure::file("read", &path, &error)),
        };
        Ok(outcome_of(task, &bytes))
    }

    /// Keeps the result of a task.
    pub(crate) fn put(&self, outcome: &TaskOutcome) -> Result<(), Failure> {
        self.outputs.write(&format!("{}.json", outcome.key), json::line(outcome)?.as_bytes())
    }
}

/// The result of a task, if these bytes are one.
pub(crate) fn outcome_of(task: &Task, bytes: &[u8]) -> Option<TaskOutcome> {
    serde_json::from_slice(bytes).ok().filter(|outcome: &TaskOutcome| outcome.is_of(task))
}

fn name(task: &Task) -> String {
    format!("{}.json", task.key)
}
