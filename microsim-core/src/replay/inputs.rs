//! Inputs as what changed since the step before; goals as the steps between floating-point numbers from the last goal of
//! the same organism, which are few for a hand that moves. A hand that moves in every step says so with one bit.

use super::Record;
use super::bits::{BitReader, BitWriter, width};
use crate::id::OrganismId;
use crate::inputs::{Inputs, Intent};
use glam::Vec2;
use std::collections::BTreeMap;

/// What an organism is told from now on; `None`: nothing.
pub(super) type Change = (OrganismId, Option<Intent>);

/// Kinds of what an organism is told, added up; 0 if it is told nothing.
const TOLD: u32 = 1;
const TO_DIGEST: u32 = 2;
const TO_GO: u32 = 4;
const KIND_BITS: u32 = 3;

/// What of a change is often the same as of the one before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Head {
    /// Steps since the change before it; since the end of the frame before it, for the first one of a frame.
    gap: u32,
    organism: OrganismId,
    kind: u32,
}

/// The last that an organism was told, and its last goal as bits.
#[derive(Clone, Copy, Debug, Default)]
struct Last {
    intent: Option<Intent>,
    goal: [u32; 2],
}

/// What both ends know: of the last change, and of every organism that has been told something.
#[derive(Clone, Debug, Default)]
struct Code {
    head: Option<Head>,
    last: BTreeMap<OrganismId, Last>,
}

/// Notes what changes from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Writer {
    code: Code,
    told: Inputs,
    pending: Vec<(u32, Change)>,
    steps: u32,
}

/// Reads what a [`Writer`] wrote.
#[derive(Clone, Debug, Default)]
pub(super) struct Reader {
    code: Code,
}

impl Code {
    fn write(&mut self, gap: u32, (organism, intent): Change, bits: &mut BitWriter) {
        let head = Head { gap, organism, kind: kind_of(intent) };
        let is_same = self.head.replace(head) == Some(head);
        bits.put(u64::from(is_same), 1);
        if !is_same {
            [gap, organism.index, organism.generation].into_iter().for_each(|number| bits.number(number));
            bits.put(u64::from(head.kind), KIND_BITS);
        }
        let Some(goal) = intent.and_then(|intent| intent.goal()) else { return };
        let (goal, last) = (goal.to_array().map(f32::to_bits), self.last.entry(organism).or_default());
        let by = [0, 1].map(|k| fold(goal[k].wrapping_sub(last.goal[k])));
        last.goal = goal;
        // One width for both: they are of a size.
        let width = width(by[0] | by[1]);
        bits.width(width);
        by.into_iter().for_each(|by| bits.put(u64::from(by), width));
    }

    /// Fails where there is no change, or one to what cannot be told.
    fn read(&mut self, bits: &mut BitReader<'_>) -> Option<(u32, Change)> {
        let is_same = bits.flag()?;
        let Head { gap, organism, kind } = if is_same { self.head? } else { read_head(bits)? };
        self.head = Some(Head { gap, organism, kind });
        let last = self.last.entry(organism).or_default();
        let goal = if kind & TO_GO != 0 {
            let width = bits.width()?;
            let by = [bits.get(width)? as u32, bits.get(width)? as u32];
            last.goal = [0, 1].map(|k| last.goal[k].wrapping_add(unfold(by[k])));
            Intent::toward(Vec2::from(last.goal.map(f32::from_bits))).ok()?
        } else {
            Intent::REST
        };
        let intent = (kind & TOLD != 0).then_some(goal.digesting(kind & TO_DIGEST != 0));
        let is_change = std::mem::replace(&mut last.intent, intent) != intent && kind_of(intent) == kind;
        is_change.then_some((gap, (organism, intent)))
    }
}

fn read_head(bits: &mut BitReader<'_>) -> Option<Head> {
    let (gap, index, generation) = (bits.number()?, bits.number()?, bits.number()?);
    Some(Head { gap, organism: OrganismId { index, generation }, kind: bits.get(KIND_BITS)? as u32 })
}

fn kind_of(intent: Option<Intent>) -> u32 {
    intent.map_or(0, |intent| {
        let (digests, goes) = (u32::from(intent.digests()), u32::from(intent.goal().is_some()));
        TOLD + TO_DIGEST * digests + TO_GO * goes
    })
}

/// A difference as a number that is small when the difference is, whatever its sign.
fn fold(by: u32) -> u32 {
    (by << 1) ^ ((by as i32) >> 31) as u32
}

fn unfold(folded: u32) -> u32 {
    (folded >> 1) ^ (folded & 1).wrapping_neg()
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

    /// The steps that wait, as the content of a frame.
    pub(super) fn write(&mut self, digest: Option<u64>) -> Vec<u8> {
        let (mut bits, mut done) = (BitWriter::default(), 0);
        bits.number(std::mem::take(&mut self.steps));
        bits.number(self.pending.len() as u32);
        for (step, change) in self.pending.drain(..) {
            self.code.write(step + 1 - done, change, &mut bits);
            done = step + 1;
        }
        bits.put(u64::from(digest.is_some()), 1);
        bits.put(digest.unwrap_or_default(), if digest.is_some() { u64::BITS } else { 0 });
        bits.finish()
    }
}

impl Reader {
    /// The record that a frame holds, unless it is none that a writer writes.
    pub(super) fn record(&mut self, content: &[u8]) -> Option<Record> {
        let mut bits = BitReader::new(content);
        let (steps, count) = (bits.number().filter(|&steps| steps > 0)?, bits.number()?);
        let (mut changes, mut done) = (Vec::new(), 0u32);
        for _ in 0..count {
            let (gap, change) = self.code.read(&mut bits)?;
            let step = done.checked_add(gap)?.checked_sub(1).filter(|&step| step < steps)?;
            let is_next = |&(at, (organism, _)): &(u32, Change)| (at, organism) < (step, change.0);
            changes.last().is_none_or(is_next).then(|| changes.push((step, change)))?;
            done = step + 1;
        }
        let digest = if bits.flag()? { Some(bits.get(u64::BITS)?) } else { None };
        bits.is_at_end().then_some(Record { steps, changes, digest })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folding_takes_small_differences_to_small_numbers_and_back() {
        for (by, folded) in [(0i32, 0u32), (-1, 1), (1, 2), (-2, 3), (i32::MAX, u32::MAX - 1), (i32::MIN, u32::MAX)] {
            assert_eq!((fold(by as u32), unfold(folded)), (folded, by as u32));
        }
    }

    /// The record that the only frame of some bits holds.
    fn read(write: impl Fn(&mut BitWriter)) -> Option<Record> {
        let mut bits = BitWriter::default();
        write(&mut bits);
        Reader::default().record(&bits.finish())
    }

    #[test]
    fn what_no_writer_writes_is_refused() {
        let head = |bits: &mut BitWriter, gap: u32, index: u32, kind: u32| {
            bits.put(0, 1);
            [gap, index, 0].into_iter().for_each(|number| bits.number(number));
            bits.put(u64::from(kind), KIND_BITS);
        };
        let frame = |changes: &[(u32, u32, u32)]| {
            read(|bits| {
                bits.number(3);
                bits.number(changes.len() as u32);
                changes.iter().for_each(|&(gap, index, kind)| head(bits, gap, index, kind));
                bits.put(0, 1);
            })
        };
        assert_eq!(frame(&[(1, 4, TOLD), (0, 5, TOLD), (2, 4, 0)]).unwrap().changes.len(), 3);
        assert_eq!(frame(&[(0, 4, TOLD)]), None, "before the first step");
        assert_eq!(frame(&[(4, 4, TOLD)]), None, "after the last one");
        assert_eq!(frame(&[(1, 4, TOLD), (0, 4, 0)]), None, "twice in a step");
        assert_eq!(frame(&[(1, 4, TOLD), (0, 3, TOLD)]), None, "out of order");
        assert_eq!(frame(&[(1, 4, 0)]), None, "no change");
        assert_eq!(frame(&[(1, 4, TO_DIGEST)]), None, "no kind");
        assert_eq!(read(|bits| bits.put(0, 13)), None, "no steps");
        assert_eq!(read(|bits| (bits.number(1), bits.number(1), bits.put(1, 1)).2), None, "the same as nothing");
    }
}
