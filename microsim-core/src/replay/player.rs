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
    /// The present record, if there is more of it to come.
    now: Option<Progress>,
}

/// A record, and what was played of it.
#[derive(Clone, Debug)]
struct Progress {
    record: Record,
    steps: u32,
    changes: usize,
    world: usize,
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

impl Progress {
    /// Does what was done before the next step.
    fn change(&mut self, world: &mut World, told: &mut Inputs) {
        let step = self.steps;
        while let Some((_, change)) = self.record.world.get(self.world).filter(|(at, _)| *at == step) {
            // What a world refuses was not done to the recorded one: the next digest differs.
            let _ = change.apply(world);
            self.world += 1;
        }
        while let Some((_, change)) = self.record.changes.get(self.changes).filter(|(at, _)| *at == step) {
            // The decoder has checked it.
            let _ = change.apply(told);
            self.changes += 1;
        }
    }
}

impl Iterator for Player {
    type Item = Result<(), Mismatch>;

    /// Takes one step; an error where its digest is not the recorded one. One can go on after that, but the digests that
    /// follow will not be the recorded ones either.
    fn next(&mut self) -> Option<Self::Item> {
        let begin = |record| Progress { record, steps: 0, changes: 0, world: 0 };
        let mut now = self.now.take().or_else(|| self.records.next().map(begin))?;
        now.change(&mut self.run.world, &mut self.told);
        self.run.step(&self.told);
        now.steps += 1;
        if now.steps < now.record.steps {
            self.now = Some(now);
            return Some(Ok(()));
        }
        let Some(recorded) = now.record.digest else { return Some(Ok(())) };
        let (step, found) = (self.run.world.step_index(), self.run.world.digest());
        Some(if found == recorded { Ok(()) } else { Err(Mismatch { step, recorded, found }) })
    }
}
