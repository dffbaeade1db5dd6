//! The summary of a run, as JSON and as text.

mod statistics;
mod table;

pub(crate) use statistics::{Spread, mean, median};
pub(crate) use table::Table;

use crate::prepared::Prepared;
use crate::tally::Tally;
use microsim_core::{OrganismId, World};
use serde::Serialize;
use std::collections::BTreeMap;

/// The report of a run.
#[derive(Debug, Serialize)]
pub(crate) struct RunReport {
    pub version: &'static str,
    pub scenario: String,
    pub seed: u64,
    pub steps: u64,
    pub simulated_seconds: f64,
    pub organisms: usize,
    pub bodies: usize,
    pub particles: usize,
    pub constraints: usize,
    pub quarantined: usize,
    pub digest: String,
    pub leaks: usize,
    pub improper_absorptions: usize,
    pub events: BTreeMap<String, u64>,
    pub step_ms: Spread,
    /// Medians of even stretches of the run.
    pub step_ms_over_time: Vec<f64>,
    pub wall_seconds: f64,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub interrupted: bool,
    /// The first invariant or expectation that broke, and commands that were refused.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<String>,
}

impl RunReport {
    /// The report of a world after the steps of the tally.
    pub(crate) fn new(prepared: &Prepared, world: &World, tally: Tally) -> Self {
        let census = world.census();
        Self {
            version: env!("CARGO_PKG_VERSION"),
            scenario: prepared.scenario.name().to_owned(),
            seed: prepared.scenario.seed(),
            steps: tally.steps,
            simulated_seconds: rounded(tally.steps as f64 * f64::from(world.config().dt)),
            organisms: census.organisms,
            bodies: census.bodies,
            particles: census.particles,
            constraints: census.constraints,
            quarantined: census.quarantined,
            digest: format!("{:016x}", world.digest()),
            leaks: tally.leaks,
            improper_absorptions: tally.improper_absorptions,
            step_ms: Spread::of(&tally.step_ms),
            step_ms_over_time: stretches(&tally.step_ms),
            wall_seconds: tally.wall.as_secs_f64(),
            interrupted: tally.is_interrupted,
            events: tally.events,
            failures: Vec::new(),
        }
    }

    /// The rows that a person reads.
    pub(crate) fn table(&self) -> Table {
        let mut table = Table::default();
        table.row("scenario", &self.scenario);
        table.row("seed", self.seed);
        table.row("steps", format!("{} ({:.2} s)", self.steps, self.simulated_seconds));
        table.row("organisms", self.organisms);
        table.row("bodies", self.bodies);
        table.row("particles", self.particles);
        table.row("constraints", self.constraints);
        table.row("digest", &self.digest);
        table.row("leaks", self.leaks);
        table.row("improper absorptions", self.improper_absorptions);
        if self.quarantined > 0 {
            table.row("quarantined", self.quarantined);
        }
        for (name, count) in &self.events {
            table.row(&name.replace('_', " "), count);
        }
        let Spread { median, p90, p99 } = self.step_ms;
        table.row("step", format!("{median:.3} ms median, {p90:.3} p90, {p99:.3} p99"));
        table.row("wall time", format!("{:.2} s", self.wall_seconds));
        table
    }
}

/// Medians of up to 200 even stretches.
fn stretches(step_ms: &[f64]) -> Vec<f64> {
    let length = step_ms.len().div_ceil(200).max(1);
    step_ms.chunks(length).map(|part| (median(part) * 1e4).round() / 1e4).collect()
}

/// A time without the noise of its 32-bit step: to the microsecond.
pub(crate) fn rounded(seconds: f64) -> f64 {
    (seconds * 1e6).round() / 1e6
}

/// A handle as `index:generation`.
pub(crate) fn handle(id: OrganismId) -> String {
    format!("{}:{}", id.index(), id.generation())
}
