//! Counts and times over the steps of a run or a benchmark.

use microsim_core::World;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Duration;

/// Counts and times over some steps.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Tally {
    /// Number of steps taken.
    pub steps: u64,
    /// Time of each step, ms; of a run that was resumed, only of those since.
    #[serde(skip)]
    pub step_ms: Vec<f64>,
    /// Most leaks seen at the end of a step.
    pub leaks: usize,
    /// Most improper absorptions seen at the end of a step.
    pub improper_absorptions: usize,
    /// Events by the name of their kind.
    pub events: BTreeMap<String, u64>,
    /// Time of everything, measures included.
    #[serde(skip)]
    pub wall: Duration,
    /// Whether the user stopped it.
    pub is_interrupted: bool,
}

impl Tally {
    /// Counts a step that took so long.
    pub(crate) fn add(&mut self, world: &World, took: Duration) {
        let census = world.census();
        self.steps += 1;
        self.step_ms.push(took.as_secs_f64() * 1e3);
        self.leaks = self.leaks.max(census.leaks);
        self.improper_absorptions = self.improper_absorptions.max(census.improper_absorptions);
        for event in world.events() {
            let count = self.events.entry(event.name().to_owned()).or_default();
            *count = count.saturating_add(1);
        }
    }
}
