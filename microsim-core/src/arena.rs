//! Arena: values under handles with a generation, so that a stale handle names nothing.

use serde::{Deserialize, Serialize};

/// Index and generation.
pub(crate) type Handle = (u32, u32);

/// Values in the order of their index. They are pointers (`Box`, `Shared`): a file cannot ask for much memory with many
/// empty slots.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Arena<P> {
    slots: Vec<Slot<P>>,
    /// Indices of empty slots, the last freed last.
    free: Vec<u32>,
}

#[derive(Debug, Serialize, Deserialize)]
struct Slot<P> {
    generation: u32,
    value: Option<P>,
}

impl<P> Default for Arena<P> {
    fn default() -> Self {
        Self { slots: Vec::new(), free: Vec::new() }
    }
}

impl<P: Clone> Clone for Arena<P> {
    fn clone(&self) -> Self {
        Self { slots: self.slots.clone(), free: self.free.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        self.slots.clone_from(&source.slots);
        self.free.clone_from(&source.free);
    }
}

impl<P: Clone> Clone for Slot<P> {
    fn clone(&self) -> Self {
        Self { generation: self.generation, value: self.value.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        self.generation = source.generation;
        self.value.clone_from(&source.value);
    }
}

impl<P> Arena<P> {
    /// The handle that the next value gets.
    pub(crate) fn next_handle(&self) -> Handle {
        let index = self.free.last().copied().unwrap_or(self.slots.len() as u32);
        (index, self.generation(index).unwrap_or(0))
    }

    /// Puts a value under [`Arena::next_handle`].
    pub(crate) fn insert(&mut self, value: P) -> Handle {
        let (index, generation) = self.next_handle();
        if self.free.pop().is_none() {
            self.slots.push(Slot { generation, value: None });
        }
        self.slots[index as usize].value = Some(value);
        (index, generation)
    }

    /// Takes a value out; its handle is stale from now on.
    pub(crate) fn remove(&mut self, (index, generation): Handle) -> Option<P> {
        let slot = self.slots.get_mut(index as usize).filter(|slot| slot.generation == generation)?;
        let value = slot.value.take()?;
        slot.generation = generation.saturating_add(1);
        // A slot whose generations are used up stays empty.
        if slot.generation < u32::MAX {
            self.free.push(index);
        }
        Some(value)
    }

    pub(crate) fn get(&self, (index, generation): Handle) -> Option<&P> {
        self.slots.get(index as usize).filter(|slot| slot.generation == generation)?.value.as_ref()
    }

    pub(crate) fn get_mut(&mut self, (index, generation): Handle) -> Option<&mut P> {
        self.slots.get_mut(index as usize).filter(|slot| slot.generation == generation)?.value.as_mut()
    }

    /// The value at an index.
    pub(crate) fn at(&self, index: u32) -> Option<&P> {
        self.slots.get(index as usize)?.value.as_ref()
    }

    pub(crate) fn at_mut(&mut self, index: u32) -> Option<&mut P> {
        self.slots.get_mut(index as usize)?.value.as_mut()
    }

    /// The handle of the value at an index.
    pub(crate) fn handle_at(&self, index: u32) -> Option<Handle> {
        let slot = self.slots.get(index as usize)?;
        slot.value.as_ref().map(|_| (index, slot.generation))
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (Handle, &P)> {
        let slots = self.slots.iter().zip(0..);
        slots.filter_map(|(slot, index)| slot.value.as_ref().map(|value| ((index, slot.generation), value)))
    }

    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = (Handle, &mut P)> {
        let slots = self.slots.iter_mut().zip(0..);
        slots.filter_map(|(slot, index)| slot.value.as_mut().map(|value| ((index, slot.generation), value)))
    }

    /// Number of slots, empty ones included.
    pub(crate) fn slot_count(&self) -> usize {
        self.slots.len()
    }

    /// Generation of a slot: of the value there, or of the next.
    pub(crate) fn generation(&self, index: u32) -> Option<u32> {
        self.slots.get(index as usize).map(|slot| slot.generation)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.slots.iter().all(|slot| slot.value.is_none())
    }

    /// Whether the free slots are exactly the empty ones that can be used again.
    pub(crate) fn is_sound(&self) -> bool {
        let mut free = self.free.clone();
        free.sort_unstable();
        let is_free = |slot: &Slot<P>| slot.value.is_none() && slot.generation < u32::MAX;
        (0..).zip(&self.slots).filter(|(_, slot)| is_free(slot)).map(|(index, _)| index).eq(free)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stale_handle_names_nothing_and_indices_are_used_again() {
        let mut arena = Arena::default();
        let [a, b] = ['a', 'b'].map(|value| arena.insert(value));
        assert_eq!((arena.remove(a), arena.remove(a), arena.get(a)), (Some('a'), None, None));
        assert_eq!((arena.next_handle(), arena.at(a.0), arena.handle_at(b.0)), ((a.0, 1), None, Some(b)));
        let c = arena.insert('c');
        assert_eq!((c.0, arena.get(a), arena.get(c)), (a.0, None, Some(&'c')));
        assert!(arena.iter().eq([(c, &'c'), (b, &'b')]) && arena.is_sound() && !arena.is_empty());
        arena.free.push(b.0);
        assert!(!arena.is_sound());
    }

    #[test]
    fn a_slot_whose_generations_are_used_up_stays_empty() {
        let mut arena = Arena::default();
        let (index, _) = arena.insert('a');
        arena.slots[0].generation = u32::MAX - 1;
        assert_eq!(arena.remove((index, u32::MAX - 1)), Some('a'));
        assert!(arena.is_sound() && arena.is_empty());
        assert_eq!(arena.insert('b'), (1, 0));
    }
}
