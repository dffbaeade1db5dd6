//! `measures`: one row per sample, one column per measure.

use super::Rhythm;
use super::table::{Cell, DataTable};
use crate::failure::Failure;
use crate::summary::rounded;
use microsim_core::{Measure, World};

#[derive(Debug)]
pub(super) struct Measures {
    pub table: DataTable,
    of: Vec<Measure>,
    rhythm: Rhythm,
    /// Events since the last row.
    events: u64,
}

impl Measures {
    pub(super) fn columns(of: &[Measure]) -> Vec<&'static str> {
        ["step", "time", "events"].into_iter().chain(of.iter().map(|measure| measure.name())).collect()
    }

    pub(super) fn new(table: DataTable, of: &[Measure], rhythm: Rhythm) -> Self {
        Self { table, of: of.to_vec(), rhythm, events: 0 }
    }

    pub(super) fn look_at(&mut self, world: &World) -> Result<(), Failure> {
        self.events += world.events().len() as u64;
        if !self.rhythm.is_due(world) {
            return Ok(());
        }
        let events = std::mem::take(&mut self.events);
        let start = [Cell::Whole(world.step_index()), Cell::Double(rounded(world.time())), Cell::Whole(events)];
        // Most measures are single precision.
        let measures = self.of.iter().map(|measure| Cell::Single(measure.of(world) as f32));
        self.table.add(&start.into_iter().chain(measures).collect::<Vec<_>>())
    }

    /// Events that no row counts yet.
    pub(super) fn pending_events(&mut self) -> &mut u64 {
        &mut self.events
    }
}
