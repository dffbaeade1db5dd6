//! The two files that grow with the run.

use super::rounded;
use crate::failure::Failure;
use crate::output::{Outputs, PendingFile};
use microsim_core::{Event, Measure, World};
use serde::Serialize;
use std::io::Write;

/// `measures.csv`: one row per step, one column per measure.
#[derive(Debug)]
pub(crate) struct MeasureFile {
    writer: csv::Writer<PendingFile>,
}

impl MeasureFile {
    pub(crate) fn create(outputs: &Outputs) -> Result<Self, Failure> {
        let mut writer = csv::Writer::from_writer(outputs.file("measures.csv")?);
        let names = Measure::ALL.iter().map(|measure| measure.name());
        writer.write_record(["step", "time", "events"].into_iter().chain(names)).map_err(|e| unwritable(&e))?;
        Ok(Self { writer })
    }

    pub(crate) fn add(&mut self, world: &World) -> Result<(), Failure> {
        let start =
            [world.step_index().to_string(), rounded(world.time()).to_string(), world.events().len().to_string()];
        // Most measures are single precision: their shortest digits.
        let measures = Measure::ALL.iter().map(|measure| (measure.of(world) as f32).to_string());
        self.writer.write_record(start.into_iter().chain(measures)).map_err(|e| unwritable(&e))
    }

    pub(crate) fn finish(self) -> Result<(), Failure> {
        self.writer.into_inner().map_err(|e| unwritable(&e))?.finish()
    }
}

fn unwritable(error: &dyn std::error::Error) -> Failure {
    Failure::Message(format!("cannot write measures.csv: {error}"))
}

/// `events.jsonl`: one object per event.
#[derive(Debug)]
pub(crate) struct EventFile {
    pending: PendingFile,
}

#[derive(Serialize)]
struct EventLine {
    step: u64,
    time: f64,
    kind: &'static str,
    organisms: Vec<String>,
}

impl EventFile {
    pub(crate) fn create(outputs: &Outputs) -> Result<Self, Failure> {
        let pending = outputs.file("events.jsonl")?;
        Ok(Self { pending })
    }

    pub(crate) fn add(&mut self, world: &World) -> Result<(), Failure> {
        for event in world.events() {
            let line = EventLine {
                step: world.step_index(),
                time: rounded(world.time()),
                kind: event.name(),
                organisms: organisms(event),
            };
            let written = serde_json::to_writer(&mut self.pending, &line)
                .map_err(std::io::Error::from)
                .and_then(|()| self.pending.write_all(b"\n"));
            written.map_err(|error| Failure::file("write", self.pending.path(), &error))?;
        }
        Ok(())
    }

    pub(crate) fn finish(self) -> Result<(), Failure> {
        self.pending.finish()
    }
}

/// Handles as `index:generation`.
fn organisms(event: &Event) -> Vec<String> {
    let ids = event.organisms().into_iter().flatten();
    ids.map(|id| format!("{}:{}", id.index(), id.generation())).collect()
}
