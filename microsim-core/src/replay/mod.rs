//! Replays: a scenario, what its organisms were told, step by step, and what else was changed, with digests to check against.
//!
//! A file is a header and then one chunk for every few steps, each with its length and checksum, so that it can be written
//! as the run goes on, and what there is of it can be played wherever it was cut off.
//!
//! All that a program does to the world by the functions of [`World`](crate::World) is recorded with the step before which it was
//! done: spawning, obstacles, joints, fields, settings. Two things are not: a world that is put in the place of another one,
//! which is noticed when the replay is played; and an obstacle of a shape that cannot be written, see
//! [`World::to_snapshot`](crate::World::to_snapshot), before which the replay ends with [`Ending::Unrecordable`].
//!
//! ```
//! use microsim_core::replay::{Recorder, Replay, Player};
//! use std::num::NonZeroU32;
//! use microsim_core::{Inputs, Intent, glam::Vec2, scenario::{Scenario, builtin}};
//!
//! let scenario = Scenario::parse(builtin("demo").unwrap().text, &[])?;
//! let mut run = scenario.build()?;
//! let player = run.player.unwrap();
//! let (mut recorder, mut file) = Recorder::new(scenario.origin(), NonZeroU32::MIN);
//! let mut inputs = Inputs::new();
//! for step in 0..20 {
//!     inputs.set(player, Intent::toward(Vec2::new(step as f32, 10.0))?);
//!     if step == 10 {
//!         run.world.set_gravity(Vec2::new(0.0, -10.0))?;
//!     }
//!     run.step(&inputs);
//!     file.extend(recorder.step(&inputs, &run.world));
//! }
//! file.extend(recorder.finish(&run.world));
//!
//! let replay = Replay::read(&file)?;
//! assert_eq!(replay.steps(), 20);
//! let mut again = Player::new(&replay)?;
//! assert!(again.by_ref().all(|step| step.is_ok()));
//! assert_eq!(again.world().digest(), run.world.digest());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chunk;
mod encoding;
mod player;
mod recorder;

use crate::scenario::Origin;
use crate::world::change::WorldChange;
use chunk::{ChunkError, ChunkReader};
use encoding::{Change, Decoder};
pub use player::{Mismatch, Player};
pub use recorder::Recorder;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::num::NonZeroU32;

const MAGIC: [u8; 8] = *b"MSIMPLAY";
/// Changes with every change of the chunks, and of what they hold.
const VERSION: u32 = 4;

/// Kinds of chunks.
const HEADER: u8 = 0;
const STEPS: u8 = 1;
const END: u8 = 2;
/// What was done to the world in the steps of the next chunk.
const WORLD: u8 = 3;
/// Something was done that cannot be recorded.
const UNRECORDABLE: u8 = 4;

/// What was recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    header: Header,
    records: Vec<Record>,
    ending: Ending,
}

/// What the first chunk says.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Header {
    /// Version of the library that recorded it.
    made_by: String,
    /// Steps from one digest to the next.
    interval: NonZeroU32,
    origin: Origin,
}

/// Some steps.
#[derive(Clone, Debug, PartialEq)]
struct Record {
    steps: u32,
    /// What changed before a step, counted from the first one of the record; ascending.
    changes: Vec<(u32, Change)>,
    /// What was done to the world before a step, in this order.
    world: Vec<(u32, WorldChange)>,
    /// Of the world after the last step.
    digest: Option<u64>,
}

/// How a replay ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// As its recorder finished it.
    Complete,
    /// Before a step in which the world was changed by something that cannot be recorded.
    Unrecordable,
    /// Within a chunk, or without the last one: it was cut off, or its recorder did not get to finish it.
    CutOff,
    /// With something that no recorder writes.
    Damaged {
        /// Where, bytes from the beginning of the file.
        at: u64,
    },
}

/// Why bytes are not a replay.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReplayError {
    /// The first bytes are not those of a replay.
    Foreign,
    /// Another version of the format.
    Version {
        /// The version of the bytes.
        found: u32,
        /// The only one that is read.
        accepted: u32,
    },
    /// Not even the header is whole.
    NoHeader,
}

impl fmt::Display for ReplayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign => write!(f, "not a replay: the first bytes are wrong"),
            Self::Version { found, accepted } => {
                write!(f, "version {found} of the replay format, accepted: version {accepted}")
            }
            Self::NoHeader => write!(f, "the header of the replay is cut off or damaged"),
        }
    }
}

impl std::error::Error for ReplayError {}

impl Replay {
    /// Reads as much of a replay as is whole.
    ///
    /// # Errors
    /// When not even the header is.
    pub fn read(bytes: &[u8]) -> Result<Self, ReplayError> {
        let mut chunks = ChunkReader::open(bytes)?;
        let header = match chunks.next() {
            Some(Ok((HEADER, content))) => postcard::from_bytes(content).map_err(|_| ReplayError::NoHeader)?,
            _ => return Err(ReplayError::NoHeader),
        };
        let (mut records, mut decoder, mut world) = (Vec::new(), Decoder::default(), Vec::new());
        let ending = loop {
            let at = chunks.place();
            match chunks.next() {
                None => break Ending::CutOff,
                Some(Err(ChunkError::CutOff)) => break Ending::CutOff,
                Some(Ok((WORLD, content))) if world.is_empty() => match encoding::world_changes(content) {
                    Some(read) => world = read,
                    None => break Ending::Damaged { at },
                },
                Some(Ok((STEPS, content))) => match decoder.record(content, std::mem::take(&mut world)) {
                    Some(record) => records.push(record),
                    None => break Ending::Damaged { at },
                },
                Some(Ok((END, []))) if chunks.is_at_end() => break Ending::Complete,
                Some(Ok((UNRECORDABLE, []))) if chunks.is_at_end() => break Ending::Unrecordable,
                Some(Ok(_) | Err(ChunkError::Damaged)) => break Ending::Damaged { at },
            }
        };
        Ok(Self { header, records, ending })
    }

    /// What its scenario was read from.
    #[must_use]
    pub fn origin(&self) -> &Origin {
        &self.header.origin
    }

    /// Version of the library that recorded it. Another one may play it differently.
    #[must_use]
    pub fn made_by(&self) -> &str {
        &self.header.made_by
    }

    /// Number of steps.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.records.iter().map(|record| u64::from(record.steps)).sum()
    }

    /// Steps from one digest to the next; the last step has one too.
    #[must_use]
    pub fn interval(&self) -> NonZeroU32 {
        self.header.interval
    }

    /// Whether all of it is there.
    #[must_use]
    pub fn ending(&self) -> Ending {
        self.ending
    }
}

#[cfg(test)]
mod meddle;
#[cfg(test)]
mod tests;
