//! Inputs as changes from step to step; forces and activations as they are, goals as differences of the bits of floating-point numbers from the last goal of
//! the same organism, which are small for a hand that moves.

use super::Record;
use crate::actuation::Actuation;
use crate::id::OrganismId;
use crate::inputs::{Inputs, Intent};
use crate::world::change::WorldChange;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What holds from now on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// What an organism is told; `None`: nothing.
    Intent(OrganismId, Option<Intent>),
    /// What acts on an organism, or on one of its nodes.
    Actuation(OrganismId, Option<u32>, Actuation),
    /// The activation of one of its channels.
    Activation(OrganismId, u32, f32),
}

impl Change {
    /// What it is a change of; changes of a step are in this order.
    fn subject(&self) -> (u8, OrganismId, Option<u32>) {
        match *self {
            Self::Intent(organism, _) => (0, organism, None),
            Self::Actuation(organism, node, _) => (1, organism, node),
            Self::Activation(organism, channel, _) => (2, organism, Some(channel)),
        }
    }

    /// Whether it is so already.
    fn is_in(&self, told: &Inputs) -> bool {
        match *self {
            Self::Intent(organism, intent) => told.get(organism) == intent,
            Self::Actuation(organism, node, actuation) => told.actuation(organism, node) == actuation,
            Self::Activation(organism, channel, activation) => told.activation(organism, channel) == activation,
        }
    }

    /// Makes the change; `None` if a number is out of its range.
    pub(super) fn apply(self, told: &mut Inputs) -> Option<()> {
        match self {
            Self::Intent(organism, Some(intent)) => told.set(organism, intent),
            Self::Intent(organism, None) => told.remove(organism),
            Self::Actuation(organism, node, actuation) => told.act_on(organism, node, actuation).ok()?,
            Self::Activation(organism, channel, activation) => told.activate(organism, channel, activation).ok()?,
        }
        Some(())
    }

    /// What leads from one to another, by subject.
    fn between(from: &Inputs, to: &Inputs) -> Vec<Self> {
        let list = |inputs: &Inputs, or: Option<&Inputs>| {
            let of = or.unwrap_or(inputs);
            let intents = inputs.iter().map(|(id, _)| Self::Intent(id, of.get(id)));
            let actuations = inputs.actuations().map(|(id, node, _)| Self::Actuation(id, node, of.actuation(id, node)));
            let activations = inputs.activations().map(|(id, k, _)| Self::Activation(id, k, of.activation(id, k)));
            intents.chain(actuations).chain(activations).filter(|change| !change.is_in(from)).collect::<Vec<_>>()
        };
        let mut changes = list(to, None);
        changes.extend(list(from, Some(to)));
        changes.sort_unstable_by_key(Self::subject);
        changes.dedup_by_key(|change| change.subject());
        changes
    }
}

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
    /// Steps as above; the organism, the node; what acts on it.
    Actuation(u32, OrganismId, Option<u32>, Actuation),
    /// Steps as above; the organism, the channel; its activation.
    Activation(u32, OrganismId, u32, f32),
}

/// What an organism is told; to go somewhere: the difference from its last goal.
#[derive(Clone, Copy, Serialize, Deserialize)]
enum Told {
    Nothing,
    Rest { digests: bool },
    Go { digests: bool, by: [i32; 2] },
}

/// What encoder and decoder know: steps, organism and digestion of the last change, if it had a goal, and the last goal of
/// every organism, as bits.
#[derive(Clone, Debug, Default)]
struct History {
    change: Option<(u32, OrganismId, bool)>,
    goals: BTreeMap<OrganismId, [u32; 2]>,
}

impl History {
    fn encode(&mut self, gap: u32, change: Change) -> Delta {
        let (organism, intent) = match change {
            Change::Intent(organism, intent) => (organism, intent),
            Change::Actuation(organism, node, actuation) => {
                self.change = None;
                return Delta::Actuation(gap, organism, node, actuation);
            }
            Change::Activation(organism, channel, activation) => {
                self.change = None;
                return Delta::Activation(gap, organism, channel, activation);
            }
        };
        let told = match intent.map(|intent| (intent.digests(), intent.goal())) {
            None => Told::Nothing,
            Some((digests, None)) => Told::Rest { digests },
            Some((digests, Some(goal))) => {
                let goal = goal.to_array().map(f32::to_bits);
                let last = self.goals.insert(organism, goal).unwrap_or_default();
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

    /// `None` if the goal is not finite, or the same as that of no change.
    fn decode(&mut self, delta: Delta) -> Option<(u32, Change)> {
        let before = self.change.take();
        let (gap, organism, told) = match delta {
            Delta::Goal(by) => {
                let (gap, organism, digests) = before?;
                (gap, organism, Told::Go { digests, by })
            }
            Delta::Other(gap, organism, told) => (gap, organism, told),
            Delta::Actuation(gap, organism, node, it) => return Some((gap, Change::Actuation(organism, node, it))),
            Delta::Activation(gap, organism, k, it) => return Some((gap, Change::Activation(organism, k, it))),
        };
        let intent = match told {
            Told::Nothing => None,
            Told::Rest { digests } => Some(Intent::REST.digesting(digests)),
            Told::Go { digests, by } => {
                self.change = Some((gap, organism, digests));
                let goal = self.goals.entry(organism).or_default();
                *goal = [0, 1].map(|k| goal[k].wrapping_add(by[k].cast_unsigned()));
                Some(Intent::toward(Vec2::from(goal.map(f32::from_bits))).ok()?.digesting(digests))
            }
        };
        Some((gap, Change::Intent(organism, intent)))
    }
}

/// Notes what changes from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Encoder {
    history: History,
    told: Inputs,
    pending: Vec<(u32, Change)>,
    world: Vec<(u32, WorldChange)>,
    steps: u32,
}

impl Encoder {
    /// Notes what was done to the world before one more step, and what organisms were told in it. Returns how many steps wait to be written.
    pub(super) fn note(&mut self, world: &[WorldChange], told: &Inputs) -> u32 {
        self.world.extend(world.iter().map(|change| (self.steps, change.clone())));
        let before = self.pending.len();
        self.pending.extend(Change::between(&self.told, told).into_iter().map(|change| (self.steps, change)));
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
        !(self.pending.is_empty() && self.world.is_empty())
    }

    /// What was done to the world in the steps that wait, as the content of a chunk, if anything was.
    pub(super) fn write_world(&mut self) -> Option<Vec<u8>> {
        let world = std::mem::take(&mut self.world);
        // Into memory this cannot fail.
        (!world.is_empty()).then(|| postcard::to_stdvec(&world).unwrap_or_default())
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
    told: Inputs,
}

impl Decoder {
    /// The record that a chunk holds; `None` if no encoder writes such a chunk.
    pub(super) fn record(&mut self, content: &[u8], world: Vec<(u32, WorldChange)>) -> Option<Record> {
        let (Steps { count: steps, changes: deltas, digest }, rest) = postcard::take_from_bytes(content).ok()?;
        let (mut changes, mut done) = (Vec::new(), 0u32);
        for delta in deltas {
            let (gap, change) = self.history.decode(delta)?;
            let step = done.checked_add(gap)?.checked_sub(1).filter(|&step| step < steps)?;
            let is_next = |(at, last): &(u32, Change)| (*at, last.subject()) < (step, change.subject());
            (changes.last().is_none_or(is_next) && !change.is_in(&self.told)).then_some(())?;
            change.apply(&mut self.told)?;
            changes.push((step, change));
            done = step + 1;
        }
        let is_whole = steps > 0 && rest.is_empty() && world.last().is_none_or(|(step, _)| *step < steps);
        is_whole.then(|| Record { steps, changes, world, digest: digest.map(u64::from_le_bytes) })
    }
}

/// What was done to the world in the steps of a chunk; `None` if no encoder writes such a content.
pub(super) fn world_changes(content: &[u8]) -> Option<Vec<(u32, WorldChange)>> {
    let (changes, rest): (Vec<(u32, WorldChange)>, _) = postcard::take_from_bytes(content).ok()?;
    let is_sound = rest.is_empty() && !changes.is_empty() && changes.is_sorted_by_key(|(step, _)| *step);
    is_sound.then_some(changes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The record that the only chunk of some changes holds, each of a gap, the index of an organism and what it is told.
    fn read(count: u32, changes: &[(u32, u32, Told)]) -> Option<Record> {
        let delta = |&(gap, index, told): &_| Delta::Other(gap, OrganismId { index, generation: 0 }, told);
        let steps = Steps { count, changes: changes.iter().map(delta).collect(), digest: None };
        Decoder::default().record(&postcard::to_stdvec(&steps).unwrap(), Vec::new())
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
        let acts = |actuation| Delta::Actuation(1, OrganismId { index: 4, generation: 0 }, Some(2), actuation);
        let beats = |activation| Delta::Activation(1, OrganismId { index: 4, generation: 0 }, 0, activation);
        let steps = |changes, rest: &[u8]| {
            let content = postcard::to_stdvec(&Steps { count: 1, changes, digest: None }).unwrap();
            Decoder::default().record(&[&content, rest].concat(), Vec::new())
        };
        assert!(steps(vec![], &[]).is_some());
        assert_eq!(steps(vec![], &[0]), None, "more than its content");
        assert_eq!(steps(vec![Delta::Goal([1, 1])], &[]), None, "the same as nothing");
        assert!(steps(vec![acts(Actuation::force(Vec2::X))], &[]).is_some() && steps(vec![beats(0.5)], &[]).is_some());
        assert_eq!(steps(vec![acts(Actuation::force(Vec2::NAN))], &[]), None, "no force");
        assert_eq!(steps(vec![acts(Actuation::torque(1.0))], &[]), None, "a torque on a node");
        assert_eq!(steps(vec![acts(Actuation::default())], &[]), None, "no change");
        assert_eq!(steps(vec![beats(2.0)], &[]), None, "no activation");
    }

    #[test]
    fn changes_of_the_world_are_read_as_they_were_written() {
        let (mut encoder, change) = (Encoder::default(), WorldChange::SetDamping(0.5));
        encoder.note(&[], &Inputs::new());
        assert!(!encoder.has_changes() && encoder.write_world().is_none());
        encoder.note(std::slice::from_ref(&change), &Inputs::new());
        assert!(encoder.has_changes());
        let content = encoder.write_world().unwrap();
        assert_eq!(world_changes(&content), Some(vec![(1, change.clone())]));
        assert_eq!(world_changes(&[content.as_slice(), &[0]].concat()), None, "more than its content");
        let others = |steps: &[u32]| {
            let changes: Vec<_> = steps.iter().map(|&step| (step, change.clone())).collect();
            world_changes(&postcard::to_stdvec(&changes).unwrap()).is_some()
        };
        assert!(others(&[1, 1, 2]) && !others(&[2, 1]) && !others(&[]));
        let steps = encoder.write(None);
        let in_step = |step| Decoder::default().record(&steps, vec![(step, change.clone())]).is_some();
        assert_eq!([0, 1, 2, 3].map(in_step), [true, true, false, false], "two steps");
    }
}
