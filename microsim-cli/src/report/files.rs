//! The two files that grow with the run.

use super::rounded;
use crate::failure::Failure;
use crate::output::{Outputs, PendingFile};
use microsim_core::{Census, Event, World};
use serde::Serialize;
use std::io::Write;

/// `measures.csv`: one row per step.
#[derive(Debug)]
pub(crate) struct MeasureFile {
    writer: csv::Writer<PendingFile>,
}

/// One row; the field names are the column names.
#[derive(Serialize)]
struct MeasureRow {
    step: u64,
    time: f64,
    organisms: usize,
    leaks: usize,
    improper_absorptions: usize,
    events: usize,
    ring_error_mean: f32,
    ring_error_max: f32,
    penetration_max: f32,
    edge_stretch_max: f32,
    anchor_offset_max: f32,
    fluid_compression_mean: f32,
}

impl MeasureFile {
    pub(crate) fn create(outputs: &Outputs) -> Result<Self, Failure> {
        let writer = csv::Writer::from_writer(outputs.file("measures.csv")?);
        Ok(Self { writer })
    }

    pub(crate) fn add(&mut self, world: &World, census: &Census) -> Result<(), Failure> {
        let quality = world.quality();
        let row = MeasureRow {
            step: world.step_index(),
            time: rounded(world.time()),
            organisms: census.organisms,
            leaks: census.leaks,
            improper_absorptions: census.improper_absorptions,
            events: world.events().len(),
            ring_error_mean: quality.ring_error_mean,
            ring_error_max: quality.ring_error_max,
            penetration_max: quality.penetration_max,
            edge_stretch_max: quality.edge_stretch_max,
            anchor_offset_max: quality.anchor_offset_max,
            fluid_compression_mean: quality.fluid_compression_mean,
        };
        self.writer.serialize(row).map_err(|error| Failure::Message(format!("cannot write measures.csv: {error}")))
    }

    pub(crate) fn finish(self) -> Result<(), Failure> {
        let pending = self
            .writer
            .into_inner()
            .map_err(|error| Failure::Message(format!("cannot write measures.csv: {error}")))?;
        pending.finish()
    }
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
