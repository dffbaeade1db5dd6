//! Inputs as what changed since the step before; goals as the steps between floating-point numbers from the last goal of
//! the same organism, which are few for a hand that moves.

use super::Record;
use crate::id::OrganismId;
use crate::inputs::{Inputs, Intent};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What an organism is told from now on; `None`: nothing.
pub(super) type Change = (OrganismId, Option<Intent>);

/// A record as it is written.
#[derive(Debug, Serialize, Deserialize)]
struct Written {
    steps: u32,
    /// Steps since the change before it, who, and what.
    changes: Vec<(u32, OrganismId, Told)>,
    digest: Option<u64>,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Told {
    Nothing,
    Rest,
    RestAndDigest,
    Go([i32; 2]),
    GoAndDigest([i32; 2]),
}

/// The last goal of every organism that has had one, as bits.
#[derive(Clone, Debug, Default)]
struct Goals(BTreeMap<OrganismId, [u32; 2]>);

/// Notes what changes from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Writer {
    goals: Goals,
    told: Inputs,
    pending: Vec<(u32, Change)>,
    steps: u32,
}

/// Reads what a [`Writer`] wrote.
#[derive(Clone, Debug, Default)]
pub(super) struct Reader {
    goals: Goals,
}

impl Goals {
    fn write(&mut self, organism: OrganismId, intent: Option<Intent>) -> Told {
        let Some(intent) = intent else { return Told::Nothing };
        let Some(goal) = intent.goal() else { return if intent.digests() { Told::RestAndDigest } else { Told::Rest } };
        let bits = goal.to_array().map(f32::to_bits);
        let last = self.0.insert(organism, bits).unwrap_or_default();
        let by = [0, 1].map(|k| bits[k].wrapping_sub(last[k]) as i32);
        if intent.digests() { Told::GoAndDigest(by) } else { Told::Go(by) }
    }

    /// Fails where the goal is none that could be given.
    fn read(&mut self, organism: OrganismId, told: Told) -> Option<Option<Intent>> {
        let (by, digests) = match told {
            Told::Nothing => return Some(None),
            Told::Rest => return Some(Some(Intent::REST)),
            Told::RestAndDigest => return Some(Some(Intent::REST.digesting(true))),
            Told::Go(by) => (by, false),
            Told::GoAndDigest(by) => (by, true),
        };
        let last = self.0.get(&organism).copied().unwrap_or_default();
        let bits = [0, 1].map(|k| last[k].wrapping_add(by[k] as u32));
        self.0.insert(organism, bits);
        let goal = Intent::toward(Vec2::from(bits.map(f32::from_bits))).ok()?;
        Some(Some(goal.digesting(digests)))
    }
}

impl Writer {
    /// Notes what organisms were told in one more step. Returns how many steps wait to be written.
    pub(super) fn note(&mut self, told: &Inputs) -> u32 {
        let gone = self.told.iter().filter(|&(organism, _)| told.get(organism).is_none());
        let changed = told.iter().filter(|&(organism, intent)| self.told.get(organism) != Some(intent));
        let changes = gone.map(|(organism, _)| (organism, None));
        let changes = changes.chain(changed.map(|(organism, intent)| (organism, Some(intent))));
        let before = self.pending.len();
        self.pending.extend(changes.map(|change| (self.steps, change)));
        if self.pending.len() > before {
            self.told.clone_from(told);
        }
        self.steps += 1;
        self.steps
    }

    pub(super) fn is_empty(&self) -> bool {
        self.steps == 0
    }

    /// Whether something has changed in the steps that wait.
    pub(super) fn has_changes(&self) -> bool {
        !self.pending.is_empty()
    }

    /// The steps that wait, as the content of a frame.
    pub(super) fn write(&mut self, digest: Option<u64>) -> Vec<u8> {
        let mut last = 0;
        let mut written = Vec::with_capacity(self.pending.len());
        for (step, (organism, intent)) in self.pending.drain(..) {
            written.push((step - last, organism, self.goals.write(organism, intent)));
            last = step;
        }
        let record = Written { steps: std::mem::take(&mut self.steps), changes: written, digest };
        // Into memory this cannot fail.
        postcard::to_stdvec(&record).unwrap_or_default()
    }
}

impl Reader {
    /// The record that a frame holds, unless it makes no sense.
    pub(super) fn record(&mut self, content: &[u8]) -> Option<Record> {
        let (Written { steps, changes, digest }, rest) = postcard::take_from_bytes(content).ok()?;
        let (mut step, mut read) = (0u32, Vec::new());
        for (gap, organism, told) in changes {
            step = step.checked_add(gap).filter(|&step| step < steps)?;
            read.push((step, (organism, self.goals.read(organism, told)?)));
        }
        (steps > 0 && rest.is_empty()).then_some(Record { steps, changes: read, digest })
    }
}
