//! Playing a replay: the run is made again and compared with what was recorded.

use super::{Record, Replay};
use crate::inputs::Inputs;
use crate::scenario::{Built, Diagnostics};
use crate::world::World;
use std::fmt;

/// A run as it is made again from a replay. Each item of the iterator is a step that was taken.
#[derive(Clone, Debug)]
pub struct Player {
    run: Built,
    told: Inputs,
    records: std::vec::IntoIter<Record>,
    /// What is left of the present record: steps already taken, changes to come.
    now: Option<(Record, u32, usize)>,
}

/// A world that is not what it was when it was recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// Number of steps taken.
    pub step: u64,
    /// The digest that was recorded.
    pub recorded: u64,
    /// The world's digest now.
    pub found: u64,
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { step, recorded, found } = self;
        write!(f, "digest {found:016x} after step {step}, recorded: {recorded:016x}")
    }
}

impl std::error::Error for Mismatch {}

impl Player {
    /// Sets up the first step.
    ///
    /// # Errors
    /// When the scenario is none that this version of the library accepts.
    pub fn new(replay: &Replay) -> Result<Self, Diagnostics> {
        let run = replay.origin().scenario()?.build()?;
        Ok(Self { run, told: Inputs::new(), records: replay.records.clone().into_iter(), now: None })
    }

    /// The world as it is now.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.run.world
    }

    /// The run as it is now.
    #[must_use]
    pub fn run(&self) -> &Built {
        &self.run
    }

    /// What organisms were told in the last step, beside what the scenario's script told them.
    #[must_use]
    pub fn told(&self) -> &Inputs {
        &self.told
    }
}

impl Iterator for Player {
    type Item = Result<(), Mismatch>;

    /// Takes one step; an error where its digest is not the recorded one. One can go on after that, but the digests that
    /// follow will not be the recorded ones either.
    fn next(&mut self) -> Option<Self::Item> {
        let (record, step, mut change) = self.now.take().or_else(|| Some((self.records.next()?, 0, 0)))?;
        while let Some(&(_, told)) = record.changes.get(change).filter(|(at, _)| *at == step) {
            // The decoder has checked it.
            let _ = told.apply(&mut self.told);
            change += 1;
        }
        self.run.step(&self.told);
        if step + 1 < record.steps {
            self.now = Some((record, step + 1, change));
            return Some(Ok(()));
        }
        let Some(recorded) = record.digest else { return Some(Ok(())) };
        let (step, found) = (self.run.world.step_index(), self.run.world.digest());
        Some(if found == recorded { Ok(()) } else { Err(Mismatch { step, recorded, found }) })
    }
}
