//! Where the intents of a round come from: from those who play, or from what was recorded.

use microsim_core::replay::{Mismatch, Player, Recorder};
use microsim_core::scenario::Built;

/// Where the intents of a round come from.
#[derive(Debug)]
pub(super) enum Course {
    /// Intents as they come, and what is recorded of them.
    Live { run: Box<Built>, recorder: Recorder, record: Vec<u8> },
    /// What was recorded, and where the replay first differed from it.
    Replay { run: Box<Player>, is_over: bool, mismatch: Option<Mismatch> },
}

impl Clone for Course {
    fn clone(&self) -> Self {
        match self {
            Self::Live { run, recorder, record } => {
                Self::Live { run: run.clone(), recorder: recorder.clone(), record: record.clone() }
            }
            Self::Replay { run, is_over, mismatch } => {
                Self::Replay { run: run.clone(), is_over: *is_over, mismatch: *mismatch }
            }
        }
    }

    fn clone_from(&mut self, source: &Self) {
        match (self, source) {
            (Self::Live { run, recorder, record }, Self::Live { run: other, recorder: notes, record: written }) => {
                run.clone_from(other);
                recorder.clone_from(notes);
                record.clone_from(written);
            }
            (course, _) => *course = source.clone(),
        }
    }
}

impl Course {
    /// The world, and what it was built from.
    pub(super) fn run(&self) -> &Built {
        match self {
            Self::Live { run, .. } => run,
            Self::Replay { run, .. } => run.run(),
        }
    }
}
