//! Digest: 64 bits that stand for the whole state.
//!
//! FNV-1a over all state, in the order in which [`World`] and the types in it declare their fields; what is left out is
//! marked `#[serde(skip)]` there. Each value has a fixed width, little-endian: integers of up to 32 bits, booleans,
//! variants and the number of a list's elements one word, 64-bit integers and numbers two, text its bytes a word each after
//! their number. Zeros are made positive and every NaN the same, so that equal states have equal digests.

use crate::float_environment::with_default_float_environment;
use crate::fnv::Fnv1a;
use crate::value_walk::{Leaf, Visitor, walk};
use crate::world::World;
use serde::Serialize;

/// Hash of a value.
pub(in crate::world) struct Digest(Fnv1a);

impl Digest {
    pub(in crate::world) fn of(value: &(impl Serialize + ?Sized)) -> u64 {
        let mut digest = Self(Fnv1a::new());
        walk(value, &mut digest);
        digest.0.finish()
    }

    fn word(&mut self, word: u32) {
        self.0.bytes(&word.to_le_bytes());
    }

    fn long(&mut self, long: u64) {
        self.0.bytes(&long.to_le_bytes());
    }

    fn float(&mut self, value: f32) {
        let canonical = if value == 0.0 { 0.0 } else { value };
        self.word(if value.is_nan() { f32::NAN.to_bits() & 0x7fff_ffff } else { canonical.to_bits() });
    }

    fn double(&mut self, value: f64) {
        let canonical = if value == 0.0 { 0.0 } else { value };
        self.long(if value.is_nan() { f64::NAN.to_bits() & (u64::MAX >> 1) } else { canonical.to_bits() });
    }
}

impl Visitor for Digest {
    fn leaf(&mut self, leaf: Leaf<'_>) {
        match leaf {
            Leaf::Word(value) => self.word(value),
            Leaf::Long(value) => self.long(value),
            Leaf::Single(value) => self.float(value),
            Leaf::Double(value) => self.double(value),
            Leaf::Text(text) => {
                self.word(text.len() as u32);
                text.bytes().for_each(|byte| self.word(u32::from(byte)));
            }
            Leaf::Variant(place, _) => self.word(place),
            Leaf::Count(count) => self.word(count as u32),
        }
    }
}

impl World {
    /// 64 bits that stand for the whole state: equal worlds have equal digests on every platform, and worlds that differ
    /// anywhere in what the next step depends on differ in it (up to chance, 2^-64).
    #[must_use]
    pub fn digest(&self) -> u64 {
        with_default_float_environment(|| Digest::of(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_and_nans_are_canonical_and_order_matters() {
        assert_eq!(Digest::of(&[0.0f32]), Digest::of(&[-0.0f32]));
        assert_eq!(Digest::of(&[f32::NAN]), Digest::of(&[-f32::NAN]));
        assert_eq!(Digest::of(&[0.0, f64::NAN]), Digest::of(&[-0.0, -f64::NAN]));
        assert_ne!(Digest::of(&[1.0, 2.0]), Digest::of(&[2.0, 1.0]));
    }

    #[test]
    fn digests_depend_on_where_a_list_ends() {
        assert_ne!(Digest::of(&[vec![1, 2], vec![3]]), Digest::of(&[vec![1], vec![2, 3]]));
        assert_ne!(Digest::of(&["ab", "c"]), Digest::of(&["a", "bc"]));
        assert_ne!(Digest::of(&(None::<u32>, 1u32)), Digest::of(&(Some(1u32), 0u32)));
    }
}
