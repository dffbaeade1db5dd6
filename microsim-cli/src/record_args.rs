//! `run --record` and `--save`: a replay, written during the run, and a checkpoint of its end.

use crate::failure::Failure;
use crate::output::{Outputs, Written};
use crate::value_parser::positive;
use microsim_core::replay::Recorder;
use microsim_core::scenario::{Built, Origin};
use microsim_core::snapshot::Checkpoint;
use microsim_core::{Inputs, World};
use std::io::Write;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};

/// Options of `run` that keep it for `replay`, `diff` and `inspect`.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct RecordArgs {
    /// Record the run into this file, for `replay` and `diff`; it can be played even if the run is killed
    #[arg(long, value_name = "FILE", conflicts_with = "checkpoint_every")]
    pub record: Option<PathBuf>,
    /// Steps from one digest of a record to the next
    #[arg(long, value_name = "N", default_value = "60", value_parser = positive, requires = "record")]
    pub digest_every: NonZeroU32,
    /// Save a checkpoint of the end of the run into this file
    #[arg(long, value_name = "FILE")]
    pub save: Option<PathBuf>,
}

/// Writes a replay during the run.
#[derive(Debug)]
pub(crate) struct ReplayWriter {
    recorder: Recorder,
    file: Written,
    path: PathBuf,
}

impl RecordArgs {
    /// Refuses files that would take each other's place, or that of something in the folder of the results, and all of them for a
    /// run that may be stopped and resumed, which would leave them out.
    pub(crate) fn check(&self, out: Option<&Path>, is_resumable: bool) -> Result<(), Failure> {
        if is_resumable && (self.record.is_some() || self.save.is_some()) {
            let told = "--record and --save do not go with output.checkpoint_every, accepted: 0";
            return Err(Failure::Message(told.to_owned()));
        }
        let whole = |path: &Path| std::path::absolute(path).map_err(|error| Failure::file("write", path, &error));
        let (record, save) =
            (self.record.as_deref().map(whole).transpose()?, self.save.as_deref().map(whole).transpose()?);
        if let Some(path) = record.as_ref().filter(|record| Some(*record) == save.as_ref()) {
            return Err(Failure::Message(format!("--record and --save are both {}", path.display())));
        }
        let out = out.map(whole).transpose()?;
        let is_inside = |path: &&PathBuf| out.as_ref().is_some_and(|out| path.starts_with(out));
        if let Some(path) = [&record, &save].into_iter().flatten().find(is_inside) {
            return Err(Failure::Message(format!("{} is in the folder of --out", path.display())));
        }
        // A path that cannot be written is refused before the run, and before anything else is replaced.
        for path in [&self.record, &self.save].into_iter().flatten() {
            let (outputs, name) = Outputs::beside(path)?;
            outputs.file(&name)?;
        }
        Ok(())
    }

    /// Begins the record, if one is asked for.
    pub(crate) fn start(&self, origin: Origin) -> Result<Option<ReplayWriter>, Failure> {
        self.record.as_deref().map(|path| ReplayWriter::start(path, origin, self.digest_every)).transpose()
    }

    /// Saves the end of a run, if that is asked for.
    pub(crate) fn save(&self, origin: Origin, run: &Built) -> Result<(), Failure> {
        let Some(path) = &self.save else { return Ok(()) };
        let bytes = Checkpoint { origin, run: run.clone() }.to_bytes();
        let bytes = bytes.map_err(|error| Failure::Message(format!("--save {}: {error}", path.display())))?;
        let (outputs, name) = Outputs::beside(path)?;
        outputs.write(&name, &bytes)
    }
}

impl ReplayWriter {
    /// The file appears with its header, so that it can be read at any time.
    fn start(path: &Path, origin: Origin, interval: NonZeroU32) -> Result<Self, Failure> {
        let (recorder, header) = Recorder::new(origin, interval);
        let (outputs, name) = Outputs::beside(path)?;
        outputs.write(&name, &header)?;
        let file = Written::append(path).map_err(|error| Failure::file("write", path, &error))?;
        Ok(Self { recorder, file, path: path.to_owned() })
    }

    /// Adds a step; its inputs follow from the scenario.
    pub(crate) fn add(&mut self, world: &World) -> Result<(), Failure> {
        let bytes = self.recorder.step(&Inputs::new(), world);
        self.append(&bytes)
    }

    pub(crate) fn finish(mut self, world: &World) -> Result<(), Failure> {
        let bytes = self.recorder.clone().finish(world);
        self.append(&bytes)
    }

    fn append(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.file.write_all(bytes).map_err(|error| Failure::file("write", &self.path, &error))
    }
}
