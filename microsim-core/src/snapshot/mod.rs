//! Worlds as bytes: everything that the future of a world depends on, exact to the bit.
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
//! The content is that of the types themselves, in the order in which they declare their fields, as `postcard` writes it.
//! So a version of the format goes with the types: another version is refused, never guessed at.

#[cfg(feature = "scenario")]
mod checkpoint;
mod envelope;

#[cfg(feature = "scenario")]
pub use checkpoint::Checkpoint;

use crate::collision::obstacle::Obstacle;
use crate::collision::shape::ObstacleRecord;
use crate::world::World;
use crate::world::restore::State;
use envelope::Format;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt;

/// Changes with every change of a type that is part of a world, except for a new kind of constraint at the end of the list.
const WORLD: Format = Format { magic: *b"MSIMWRLD", version: 4 };

/// What a snapshot of a world holds.
type Content = (Vec<ObstacleRecord>, State);

/// Why bytes are no snapshot, or why there cannot be one.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The first bytes are not those of such a file.
    Foreign,
    /// Another version of the format.
    Version {
        /// The version of the bytes.
        found: u32,
        /// The only one that is read.
        accepted: u32,
    },
    /// The end is missing.
    Truncated {
        /// How many bytes there should be.
        expected: u64,
        /// How many there are.
        found: u64,
    },
    /// Something follows the end.
    Trailing {
        /// How many bytes too many.
        count: u64,
    },
    /// Something in it was changed: the checksum is wrong.
    Corrupt,
    /// The checksum is right, but the content is no state of a world.
    Invalid {
        /// What cannot be.
        flaw: String,
    },
    /// The world cannot be written: the shape of an obstacle is of a kind that the format does not know. It knows balls,
    /// cuboids, capsules, segments, triangles, convex polygons, polylines, and compounds of all but the last.
    UnknownShape {
        /// Which of [`World::obstacles`].
        obstacle: usize,
    },
}

impl fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign => write!(f, "not a snapshot: the first bytes are wrong"),
            Self::Version { found, accepted } => {
                write!(f, "version {found} of the format, accepted: version {accepted}")
            }
            Self::Truncated { expected, found } => write!(f, "the end is missing: {found} of {expected} bytes"),
            Self::Trailing { count } => write!(f, "{count} bytes follow the end"),
            Self::Corrupt => write!(f, "damaged: the checksum is wrong"),
            Self::Invalid { flaw } => write!(f, "no state of a world: {flaw}"),
            Self::UnknownShape { obstacle } => {
                write!(f, "the shape of obstacle {obstacle} cannot be written")
            }
        }
    }
}

impl std::error::Error for SnapshotError {}

impl World {
    /// Everything that the world's future depends on, as bytes.
    ///
    /// # Errors
    /// [`SnapshotError::UnknownShape`].
    pub fn to_snapshot(&self) -> Result<Vec<u8>, SnapshotError> {
        let record = |(obstacle, known)| ObstacleRecord::of(known).ok_or(SnapshotError::UnknownShape { obstacle });
        let obstacles = self.obstacles().enumerate().map(record).collect::<Result<Vec<_>, _>>()?;
        Ok(WORLD.seal(&encode(&(obstacles, self))?))
    }

    /// The world that was written: it has the same digest, and the same future.
    ///
    /// # Errors
    /// When the bytes are not what [`World::to_snapshot`] wrote, see [`SnapshotError`]. Nothing in them is trusted: what is
    /// returned can be stepped.
    pub fn from_snapshot(bytes: &[u8]) -> Result<Self, SnapshotError> {
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
mod layout;
#[cfg(test)]
mod tests;

fn invalid(flaw: String) -> SnapshotError {
    SnapshotError::Invalid { flaw }
}
