//! A run in the midst of it: the world, and what its scenario does and checks.

use super::envelope::Format;
use super::{SnapshotError, decode, encode};
use crate::scenario::{Built, Origin};
use crate::world::World;

/// Changes with every change of a type that is part of a run, but not with one of a world.
const RUN: Format = Format { magic: *b"MSIMRUN\0", version: 1 };

/// A run of a scenario that can be resumed: it goes on as if it had not been interrupted.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// What the scenario was read from.
    pub origin: Origin,
    /// The run.
    pub run: Built,
}

impl Checkpoint {
    /// The run as bytes.
    ///
    /// # Errors
    /// As for [`World::to_snapshot`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, SnapshotError> {
        let Built { world, player, named, script, checks, chemicals } = &self.run;
        Ok(RUN.seal(&encode(&(&self.origin, player, named, script, checks, chemicals, world.to_snapshot()?))?))
    }

    /// The run that was written.
    ///
    /// # Errors
    /// As for [`World::from_snapshot`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let (origin, player, named, script, checks, chemicals, world): (_, _, _, _, _, _, Vec<u8>) =
            decode(RUN.open(bytes)?)?;
        let world = World::from_snapshot(&world)?;
        Ok(Self { origin, run: Built { world, player, named, script, checks, chemicals } })
    }
}
