//! Inputs as changes from step to step; goals as differences of the bits of floating-point numbers from the last goal of
//! the same organism, which are small for a hand that moves.

use super::Record;
use crate::id::OrganismId;
use crate::inputs::{Inputs, Intent};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What an organism is told from now on; `None`: nothing.
pub(super) type Change = (OrganismId, Option<Intent>);

/// The content of a chunk of steps.
#[derive(Serialize, Deserialize)]
struct Steps {
    count: u32,
    changes: Vec<Delta>,
    digest: Option<[u8; 8]>,
}

/// A change as it is written.
#[derive(Clone, Copy, Serialize, Deserialize)]
enum Delta {
    /// As the change before, but for the goal.
    Goal([i32; 2]),
    /// Steps since the change before, or since the end of the chunk before; the organism; what it is told.
    Other(u32, OrganismId, Told),
}

/// What an organism is told; to go somewhere: the difference from its last goal.
#[derive(Clone, Copy, Serialize, Deserialize)]
enum Told {
    Nothing,
    Rest { digests: bool },
    Go { digests: bool, by: [i32; 2] },
}

/// The last that an organism was told, and its last goal as bits.
#[derive(Clone, Copy, Debug, Default)]
struct Last {
    intent: Option<Intent>,
    goal: [u32; 2],
}

/// What encoder and decoder know: steps, organism and digestion of the last change, if it had a goal, and what every
/// organism was told last.
#[derive(Clone, Debug, Default)]
struct History {
    change: Option<(u32, OrganismId, bool)>,
    organisms: BTreeMap<OrganismId, Last>,
}

impl History {
    fn encode(&mut self, gap: u32, (organism, intent): Change) -> Delta {
        let told = match intent.map(|intent| (intent.digests(), intent.goal())) {
            None => Told::Nothing,
            Some((digests, None)) => Told::Rest { digests },
            Some((digests, Some(goal))) => {
                let goal = goal.to_array().map(f32::to_bits);
                let last = std::mem::replace(&mut self.organisms.entry(organism).or_default().goal, goal);
                Told::Go { digests, by: [0, 1].map(|k| goal[k].wrapping_sub(last[k]).cast_signed()) }
            }
        };
        let head = if let Told::Go { digests, .. } = told { Some((gap, organism, digests)) } else { None };
        let before = std::mem::replace(&mut self.change, head);
        match told {
            Told::Go { by, .. } if before == head => Delta::Goal(by),
            _ => Delta::Other(gap, organism, told),
        }
    }

    /// `None` if nothing changes, or the goal is not finite.
    fn decode(&mut self, delta: Delta) -> Option<(u32, Change)> {
        let (gap, organism, told) = match delta {
            Delta::Goal(by) => {
                let (gap, organism, digests) = self.change?;
                (gap, organism, Told::Go { digests, by })
            }
            Delta::Other(gap, organism, told) => (gap, organism, told),
        };
        let last = self.organisms.entry(organism).or_default();
        self.change = None;
        let intent = match told {
            Told::Nothing => None,
            Told::Rest { digests } => Some(Intent::REST.digesting(digests)),
            Told::Go { digests, by } => {
                self.change = Some((gap, organism, digests));
                last.goal = [0, 1].map(|k| last.goal[k].wrapping_add(by[k].cast_unsigned()));
                Some(Intent::toward(Vec2::from(last.goal.map(f32::from_bits))).ok()?.digesting(digests))
            }
        };
        let is_change = std::mem::replace(&mut last.intent, intent) != intent;
        is_change.then_some((gap, (organism, intent)))
    }
}

/// Notes what changes from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Encoder {
    history: History,
    told: Inputs,
    pending: Vec<(u32, Change)>,
    steps: u32,
}

impl Encoder {
    /// Notes what organisms were told in one more step. Returns how many steps wait to be written.
    pub(super) fn note(&mut self, told: &Inputs) -> u32 {
        let gone = self.told.iter().filter(|&(organism, _)| told.get(organism).is_none());
        let changed = told.iter().filter(|&(organism, intent)| self.told.get(organism) != Some(intent));
        let changes = gone.map(|(organism, _)| (organism, None));
        let changes = changes.chain(changed.map(|(organism, intent)| (organism, Some(intent))));
        let before = self.pending.len();
        self.pending.extend(changes.map(|change| (self.steps, change)));
        if self.pending.len() > before {
            self.pending[before..].sort_unstable_by_key(|&(_, (organism, _))| organism);
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

    /// The steps that wait, as the content of a chunk.
    pub(super) fn write(&mut self, digest: Option<u64>) -> Vec<u8> {
        let (mut changes, mut done) = (Vec::new(), 0);
        for (step, change) in self.pending.drain(..) {
            changes.push(self.history.encode(step + 1 - done, change));
            done = step + 1;
        }
        let count = std::mem::take(&mut self.steps);
        // Into memory this cannot fail.
        postcard::to_stdvec(&Steps { count, changes, digest: digest.map(u64::to_le_bytes) }).unwrap_or_default()
    }
}

/// Reads what an [`Encoder`] wrote.
#[derive(Clone, Debug, Default)]
pub(super) struct Decoder {
    history: History,
}

impl Decoder {
    /// The record that a chunk holds; `None` if no encoder writes such a chunk.
    pub(super) fn record(&mut self, content: &[u8]) -> Option<Record> {
        let (Steps { count: steps, changes: deltas, digest }, rest) = postcard::take_from_bytes(content).ok()?;
        let (mut changes, mut done) = (Vec::new(), 0u32);
        for delta in deltas {
            let (gap, change) = self.history.decode(delta)?;
            let step = done.checked_add(gap)?.checked_sub(1).filter(|&step| step < steps)?;
            let is_next = |&(at, (organism, _)): &(u32, Change)| (at, organism) < (step, change.0);
            changes.last().is_none_or(is_next).then(|| changes.push((step, change)))?;
            done = step + 1;
        }
        let is_whole = steps > 0 && rest.is_empty();
        is_whole.then(|| Record { steps, changes, digest: digest.map(u64::from_le_bytes) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The record that the only chunk of some changes holds, each of a gap, the index of an organism and what it is told.
    fn read(count: u32, changes: &[(u32, u32, Told)]) -> Option<Record> {
        let delta = |&(gap, index, told): &_| Delta::Other(gap, OrganismId { index, generation: 0 }, told);
        let steps = Steps { count, changes: changes.iter().map(delta).collect(), digest: None };
        Decoder::default().record(&postcard::to_stdvec(&steps).unwrap())
    }

    #[test]
    fn what_no_encoder_writes_is_refused() {
        let rest = Told::Rest { digests: false };
        assert_eq!(read(3, &[(1, 4, rest), (0, 5, rest), (2, 4, Told::Nothing)]).unwrap().changes.len(), 3);
        assert_eq!(read(3, &[(0, 4, rest)]), None, "before the first step");
        assert_eq!(read(3, &[(4, 4, rest)]), None, "after the last one");
        assert_eq!(read(3, &[(1, 4, rest), (0, 4, Told::Nothing)]), None, "twice in a step");
        assert_eq!(read(3, &[(1, 4, rest), (0, 3, rest)]), None, "out of order");
        assert_eq!(read(3, &[(1, 4, Told::Nothing)]), None, "no change");
        assert_eq!(read(3, &[(1, 4, Told::Go { digests: true, by: [-1, 0] })]), None, "no number");
        assert_eq!(read(0, &[]), None, "no steps");
        let steps = |changes, rest: &[u8]| {
            let content = postcard::to_stdvec(&Steps { count: 1, changes, digest: None }).unwrap();
            Decoder::default().record(&[&content, rest].concat())
        };
        assert!(steps(vec![], &[]).is_some());
        assert_eq!(steps(vec![], &[0]), None, "more than its content");
        assert_eq!(steps(vec![Delta::Goal([1, 1])], &[]), None, "the same as nothing");
    }
}
