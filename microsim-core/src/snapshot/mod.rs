//! Snapshots: worlds as bytes, with everything that their future depends on, exact to the bit.
//!
//! ```
//! use microsim_core::{AgarSpec, Inputs, Placement, World, WorldConfig};
//!
//! let mut world = World::new(WorldConfig::default())?;
//! world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
//! let bytes = world.to_snapshot()?;
//! let mut restored = World::from_snapshot(&bytes)?;
//! world.step(&Inputs::new());
//! restored.step(&Inputs::new());
//! assert_eq!(world.digest(), restored.digest());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The content is the serialised state in the order in which its types declare their fields, written by `postcard`. A change
//! of these types is a new version of the format, and only the present version is read.

#[cfg(feature = "scenario")]
mod checkpoint;
mod envelope;
mod error;

#[cfg(feature = "scenario")]
pub use checkpoint::Checkpoint;
pub use error::SnapshotError;

use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_record::ObstacleRecord;
use crate::float_environment::with_default_float_environment;
use crate::world::World;
use crate::world::state::restore::WorldState;
use envelope::Format;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Changes with every change of a type that is part of a world, except for a new kind of constraint at the end of the list.
const WORLD: Format = Format { magic: *b"MSIMWRLD", version: 12 };

/// Content of a snapshot of a world.
type Content = (Vec<ObstacleRecord>, WorldState);

impl World {
    /// Everything that the world's future depends on, as bytes.
    ///
    /// # Errors
    /// [`SnapshotError::UnknownShape`].
    pub fn to_snapshot(&self) -> Result<Vec<u8>, SnapshotError> {
        let record = |(obstacle, known)| ObstacleRecord::of(known).ok_or(SnapshotError::UnknownShape { obstacle });
        let obstacles = self
            .obstacles()
            .filter_map(|id| self.obstacle(id))
            .enumerate()
            .map(record)
            .collect::<Result<Vec<_>, _>>()?;
        Ok(WORLD.seal(&encode(&(obstacles, self))?))
    }

    /// Restores a world: it has the same digest and the same future as the one that was written.
    ///
    /// # Errors
    /// When the bytes are not what [`World::to_snapshot`] wrote, see [`SnapshotError`]. All of them are checked: the
    /// returned world can be stepped.
    pub fn from_snapshot(bytes: &[u8]) -> Result<Self, SnapshotError> {
        with_default_float_environment(|| Self::read(bytes))
    }

    fn read(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let (records, state): Content = decode(WORLD.open(bytes)?)?;
        let obstacle = |(k, record): (usize, ObstacleRecord)| {
            record.restore().ok_or_else(|| invalid(format!("obstacles[{k}]: no shape")))
        };
        let obstacles = records.into_iter().enumerate().map(obstacle).collect::<Result<Vec<Obstacle>, _>>()?;
        Self::restore(state, obstacles).map_err(invalid)
    }
}

fn encode(value: &impl Serialize) -> Result<Vec<u8>, SnapshotError> {
    postcard::to_stdvec(value).map_err(|error| invalid(error.to_string()))
}

fn decode<T: DeserializeOwned>(content: &[u8]) -> Result<T, SnapshotError> {
    match postcard::take_from_bytes(content) {
        Ok((value, [])) => Ok(value),
        Ok((_, rest)) => Err(invalid(format!("{} bytes of the content are left over", rest.len()))),
        Err(error) => Err(invalid(error.to_string())),
    }
}

#[cfg(test)]
mod busy;
#[cfg(test)]
mod known_layout;
#[cfg(test)]
mod layout;
#[cfg(test)]
mod tests;

fn invalid(flaw: String) -> SnapshotError {
    SnapshotError::Invalid { flaw }
}
