//! Writing a replay while a run goes on.

use super::changes::Encoder;
use super::chunk::ChunkWriter;
use super::{END, HEADER, Header, STEPS};
use crate::inputs::Inputs;
use crate::scenario::Origin;
use crate::world::World;
use std::num::NonZeroU32;

/// Steps with changes that wait at most: what is lost when the recorder ends without [`Recorder::finish`].
const LONGEST: u32 = 16;

/// Turns a run into the bytes of a replay, to be appended to a file as they come.
#[derive(Clone, Debug)]
pub struct Recorder {
    chunks: ChunkWriter,
    encoder: Encoder,
    interval: NonZeroU32,
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
        (Self { chunks, encoder: Encoder::default(), interval }, bytes)
    }

    /// Notes a step: what organisms were told beside what the scenario's script tells them (see
    /// [`Built::step`](crate::scenario::Built::step)), and the world after it. Returns bytes to append, often none.
    #[must_use]
    pub fn step(&mut self, told: &Inputs, after: &World) -> Vec<u8> {
        let waiting = self.encoder.note(told);
        let is_due = after.step_index().is_multiple_of(u64::from(self.interval.get()));
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
        let mut bytes = if self.encoder.is_empty() { Vec::new() } else { self.flush(Some(last.digest())) };
        bytes.extend(self.chunks.write(END, &[]));
        bytes
    }

    fn flush(&mut self, digest: Option<u64>) -> Vec<u8> {
        let content = self.encoder.write(digest);
        self.chunks.write(STEPS, &content)
    }
}
