//! Arena: values under handles with a generation, so that a stale handle names nothing.

use serde::{Deserialize, Serialize};

/// Index and generation.
pub(crate) type Handle = (u32, u32);

/// Values in the order of their index.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Arena<T> {
    slots: Vec<Slot<T>>,
    /// Indices of empty slots, the last freed last.
    free: Vec<u32>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Slot<T> {
    generation: u32,
    /// In a box: a file cannot ask for much memory with many empty slots.
    value: Option<Box<T>>,
}

impl<T> Default for Arena<T> {
    fn default() -> Self {
        Self { slots: Vec::new(), free: Vec::new() }
    }
}

impl<T> Arena<T> {
    pub(crate) fn insert(&mut self, value: T) -> Handle {
        let index = self.free.pop().unwrap_or_else(|| {
            self.slots.push(Slot { generation: 0, value: None });
            self.slots.len() as u32 - 1
        });
        let slot = &mut self.slots[index as usize];
        slot.value = Some(Box::new(value));
        (index, slot.generation)
    }

    pub(crate) fn remove(&mut self, (index, generation): Handle) -> Option<T> {
        let slot = self.slots.get_mut(index as usize).filter(|slot| slot.generation == generation)?;
        let value = slot.value.take()?;
        slot.generation = generation.wrapping_add(1);
        self.free.push(index);
        Some(*value)
    }

    pub(crate) fn get(&self, (index, generation): Handle) -> Option<&T> {
        self.slots.get(index as usize).filter(|slot| slot.generation == generation)?.value.as_deref()
    }

    pub(crate) fn get_mut(&mut self, (index, generation): Handle) -> Option<&mut T> {
        self.slots.get_mut(index as usize).filter(|slot| slot.generation == generation)?.value.as_deref_mut()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (Handle, &T)> {
        let slots = self.slots.iter().zip(0..);
        slots.filter_map(|(slot, index)| slot.value.as_deref().map(|value| ((index, slot.generation), value)))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.slots.len() == self.free.len()
    }

    /// Whether the free slots are exactly the empty ones.
    pub(crate) fn is_sound(&self) -> bool {
        let mut free = self.free.clone();
        free.sort_unstable();
        (0..).zip(&self.slots).filter(|(_, slot)| slot.value.is_none()).map(|(index, _)| index).eq(free)
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
        let c = arena.insert('c');
        assert_eq!((c.0, arena.get(a), arena.get(c)), (a.0, None, Some(&'c')));
        assert!(arena.iter().eq([(c, &'c'), (b, &'b')]) && arena.is_sound() && !arena.is_empty());
        arena.free.push(b.0);
        assert!(!arena.is_sound());
    }
}
