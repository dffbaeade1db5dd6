//! Where results are kept: one file for each task, named after its key. It is there whole or not at all.

use super::task::{Task, TaskOutcome};
use crate::failure::Failure;
use crate::output::Outputs;
use std::fs;
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

    /// The result of a task, if there is one.
    pub(crate) fn get(&self, task: &Task) -> Result<Option<TaskOutcome>, Failure> {
        let path = self.outputs.folder().join(name(task));
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Failure::file("read", &path, &error)),
        };
        let refuse =
            |why: String| Failure::Message(format!("{}: {why}; remove it and run the task again", path.display()));
        let outcome: TaskOutcome =
            serde_json::from_str(&text).map_err(|error| refuse(format!("not a result: {error}")))?;
        if outcome.key == task.key { Ok(Some(outcome)) } else { Err(refuse("the result of another task".to_owned())) }
    }

    /// Keeps the result of a task.
    pub(crate) fn put(&self, outcome: &TaskOutcome) -> Result<(), Failure> {
        let text = serde_json::to_string(outcome).map_err(std::io::Error::from)?;
        self.outputs.write(&format!("{}.json", outcome.key), format!("{text}\n").as_bytes())
    }
}

fn name(task: &Task) -> String {
    format!("{}.json", task.key)
}
