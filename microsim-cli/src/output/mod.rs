//! The output files of a run: tables, events, pictures, snapshots and `run.json`.

mod description;
mod events;
#[cfg(test)]
pub(crate) mod fault;
mod files;
mod folder;
mod measures;
mod moments;
#[cfg(feature = "parquet")]
mod parquet;
mod pending;
mod run_writer;
mod table;
mod trajectories;

pub(crate) use description::write_description;
pub(crate) use files::{Written, remove};
pub(crate) use folder::{Outputs, hex};
pub(crate) use pending::PendingFile;
pub(crate) use run_writer::{FileProgress, RunWriter, check_formats};

use microsim_core::World;

/// Name of the file that an unfinished run can be resumed from.
pub(crate) const CHECKPOINT: &str = "checkpoint";

/// Which steps are sampled.
#[derive(Clone, Copy, Debug)]
struct Rhythm(u64);

impl Rhythm {
    /// Every `seconds`, to the nearest step; 0 for every step.
    fn every(seconds: f32, world: &World) -> Self {
        Self(((f64::from(seconds) / f64::from(world.config().dt)).round() as u64).max(1))
    }

    fn is_due(self, world: &World) -> bool {
        world.step_index().is_multiple_of(self.0)
    }
}
