//! `events.jsonl`: one object per event.

use super::pending::PendingFile;
use crate::failure::Failure;
use crate::json;
use crate::summary::{handle, rounded};
use microsim_core::World;
use serde::Serialize;
use std::io::Write;

#[derive(Debug)]
pub(super) struct Events(pub PendingFile);

#[derive(Serialize)]
struct Line {
    step: u64,
    time: f64,
    kind: &'static str,
    organisms: Vec<String>,
}

impl Events {
    pub(super) const FILE: &'static str = "events.jsonl";

    pub(super) fn look_at(&mut self, world: &World) -> Result<(), Failure> {
        for event in world.events() {
            let (step, time, kind) = (world.step_index(), rounded(world.time()), event.name());
            let organisms = event.organisms().into_iter().flatten().map(handle).collect();
            let line = Line { step, time, kind, organisms };
            let written = json::line(&line).and_then(|line| self.0.write_all(line.as_bytes()));
            written.map_err(|error| Failure::file("write", &self.0.path, &error))?;
        }
        Ok(())
    }
}
