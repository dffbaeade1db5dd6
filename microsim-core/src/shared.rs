//! Copy on write: values that clones share until one of them changes.

use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// A value that the first change after a clone copies. For values that seldom change, so that a snapshot need not copy them.
/// A mutable borrow counts as a change and checks each time whether the value is shared.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Shared<T>(Arc<T>);

impl<T> Shared<T> {
    pub(crate) fn new(value: T) -> Self {
        Self(Arc::new(value))
    }
}

impl<T: Clone> Shared<T> {
    /// The value, to be filled; a shared one is replaced by a `blank` one made from it.
    pub(crate) fn get_mut_or(&mut self, blank: impl FnOnce(&T) -> T) -> &mut T {
        if Arc::get_mut(&mut self.0).is_none() {
            *self = Self::new(blank(self));
        }
        self
    }

    pub(crate) fn into_inner(self) -> T {
        Arc::unwrap_or_clone(self.0)
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }

    /// Leaves the counter alone if both share already, as most do from one snapshot to the next.
    fn clone_from(&mut self, source: &Self) {
        if !Arc::ptr_eq(&self.0, &source.0) {
            self.0 = Arc::clone(&source.0);
        }
    }
}

impl<T> Deref for Shared<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Clone> DerefMut for Shared<T> {
    fn deref_mut(&mut self) -> &mut T {
        Arc::make_mut(&mut self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_share_until_one_is_changed() {
        let mut one = Shared::new(vec![1, 2]);
        let mut other = one.clone();
        assert!(std::ptr::eq(&*one, &*other));
        one[0] = 5;
        assert_eq!((&*one, &*other), (&vec![5, 2], &vec![1, 2]));
        other.clone_from(&one);
        assert!(std::ptr::eq(&*one, &*other));
    }

    #[test]
    fn memory_is_kept_unless_it_is_shared() {
        let mut one = Shared::new(Vec::with_capacity(100));
        one.get_mut_or(|_| Vec::new()).push(1);
        assert_eq!(one.capacity(), 100);
        let other = one.clone();
        one.get_mut_or(|_| Vec::new()).push(2);
        assert_eq!((&*one, &*other), (&vec![2], &vec![1]));
    }
}
