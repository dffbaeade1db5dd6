//! Writing a replay while a run goes on.

use super::chunk::ChunkWriter;
use super::encoding::Encoder;
use super::{END, HEADER, Header, STEPS, UNRECORDABLE, WORLD};
use crate::inputs::Inputs;
use crate::scenario::Origin;
use crate::world::World;
use crate::world::change::WorldChange;
use std::num::NonZeroU32;

/// Steps with changes that wait at most: what is lost when the recorder ends without [`Recorder::finish`].
const LONGEST: u32 = 16;

/// Turns a run into the bytes of a replay, to be appended to a file as they come.
#[derive(Clone, Debug)]
pub struct Recorder {
    chunks: ChunkWriter,
    encoder: Encoder,
    interval: NonZeroU32,
    /// Whether the record ended before the run.
    is_over: bool,
}

impl Recorder {
    /// Begins the record of a scenario from its first step on, with a digest every `interval` steps. Returns also the
    /// first bytes.
    #[must_use]
    pub fn new(origin: Origin, interval: NonZeroU32) -> (Self, Vec<u8>) {
        let (mut chunks, mut bytes) = ChunkWriter::new();
        let header = Header { made_by: env!("CARGO_PKG_VERSION").to_owned(), interval, origin };
        // Into memory this cannot fail.
        bytes.extend(chunks.write(HEADER, &postcard::to_stdvec(&header).unwrap_or_default()));
        (Self { chunks, encoder: Encoder::default(), interval, is_over: false }, bytes)
    }

    /// Notes a step: what organisms were told beside what the scenario's script tells them (see
    /// [`Built::step`](crate::scenario::Built::step)), and the world after it, which knows how it was changed before. Returns
    /// bytes to append, often none, and none at all after a change that cannot be recorded, see
    /// [`Ending::Unrecordable`](super::Ending::Unrecordable).
    #[must_use]
    pub fn step(&mut self, told: &Inputs, after: &World) -> Vec<u8> {
        if self.is_over {
            return Vec::new();
        }
        let changes = after.changes.before_last_step();
        if changes.contains(&WorldChange::Unrecordable) {
            return self.give_up();
        }
        let waiting = self.encoder.note(changes, told);
        let is_as_stepped = !after.changes.is_pending();
        let is_due = after.step_index().is_multiple_of(u64::from(self.interval.get())) && is_as_stepped;
        if is_due {
            self.flush(Some(after.digest()))
        } else if waiting == u32::MAX || (waiting >= LONGEST && self.encoder.has_changes()) {
            self.flush(None)
        } else {
            Vec::new()
        }
    }

    /// Ends the record; the last bytes.
    #[must_use]
    pub fn finish(mut self, last: &World) -> Vec<u8> {
        if self.is_over {
            return Vec::new();
        }
        let digest = (!last.changes.is_pending()).then(|| last.digest());
        let mut bytes = self.flush(digest);
        bytes.extend(self.chunks.write(END, &[]));
        bytes
    }

    /// Ends the record before a step that cannot be recorded.
    fn give_up(&mut self) -> Vec<u8> {
        self.is_over = true;
        let mut bytes = self.flush(None);
        bytes.extend(self.chunks.write(UNRECORDABLE, &[]));
        bytes
    }

    /// Writes the steps that wait, if there are any.
    fn flush(&mut self, digest: Option<u64>) -> Vec<u8> {
        if self.encoder.is_empty() {
            return Vec::new();
        }
        let world = self.encoder.write_world();
        let mut bytes = world.map_or_else(Vec::new, |content| self.chunks.write(WORLD, &content));
        bytes.extend(self.chunks.write(STEPS, &self.encoder.write(digest)));
        bytes
    }
}
