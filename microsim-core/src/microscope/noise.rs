//! Noise without state: the same place always has the same value, so that texture neither flickers nor swims.
//!
//! What pixels are asked for comes from one table of random bytes, which repeats itself: a graphics card, which may know no
//! integers, holds it as a texture. A seed is a shift of the table.

use super::glsl::Glsl;
use crate::bare_text::bare_text;
use glam::{IVec2, Vec2};

pub(super) const GLSL: Glsl = Glsl {
    source: bare_text!("noise.glsl", "//"),
    constants: &[("TABLE", &[SIDE as f32]), ("NEXT_OCTAVE", &[NEXT_OCTAVE.x as f32, NEXT_OCTAVE.y as f32])],
};

/// Entries along each side of the table.
pub(super) const SIDE: i32 = 256;
/// From an octave's part of the table to the next one's.
const NEXT_OCTAVE: IVec2 = IVec2::new(37, 101);

/// The bytes of an entry.
pub(super) fn entry(at: IVec2) -> [u8; 4] {
    hash(at & (SIDE - 1), 0).to_le_bytes()
}

/// Where a seed's noise begins in the table.
pub(super) const fn shift(seed: u32) -> IVec2 {
    let bits = scramble(seed) as i32;
    IVec2::new(bits & (SIDE - 1), bits >> 16 & (SIDE - 1))
}

/// The same for a graphics card.
pub(super) const fn shift_of(seed: u32) -> [f32; 2] {
    let shift = shift(seed);
    [shift.x as f32, shift.y as f32]
}

/// The texture that programs take noise from: its side in texels, and four bytes for each. Beyond its edges it repeats
/// itself, and between texels it is interpolated.
#[must_use]
pub fn noise_table() -> (u16, Vec<u8>) {
    let side = SIDE;
    let texels = (0..side * side).flat_map(|k| entry(IVec2::new(k % side, k / side)));
    (side as u16, texels.collect())
}

/// 32 bits for a place on the lattice (the finaliser of MurmurHash3, applied to each coordinate in turn).
pub(super) fn hash(at: IVec2, seed: u32) -> u32 {
    scramble(scramble(scramble(seed).wrapping_add(at.x as u32)).wrapping_add(at.y as u32))
}

/// 32 bits for a number.
pub(super) const fn scramble(mut bits: u32) -> u32 {
    bits = bits.wrapping_add(0x9e37_79b9);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ (bits >> 13)).wrapping_mul(0xc2b2_ae35);
    bits ^ (bits >> 16)
}

/// A number from 0 to 1 from 32 bits.
pub(super) fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / 16_777_216.0
}

/// The numbers of one thing that looks a little different from its neighbours.
#[derive(Clone, Debug)]
pub(super) struct HashRng(u32);

impl HashRng {
    pub(super) fn new(seed: u32) -> Self {
        Self(scramble(seed))
    }

    pub(super) fn bits(&mut self) -> u32 {
        self.0 = scramble(self.0);
        self.0
    }

    /// Uniform from 0 to 1.
    pub(super) fn unit(&mut self) -> f32 {
        unit(self.bits())
    }

    /// Uniform within a range.
    pub(super) fn range(&mut self, range: [f32; 2]) -> f32 {
        range[0] + (range[1] - range[0]) * self.unit()
    }

    /// Nearly normal, mean 0 and standard deviation 1: a sum of uniform numbers.
    pub(super) fn normal(&mut self) -> f32 {
        (self.unit() + self.unit() + self.unit() - 1.5) * 2.0
    }

    /// A uniform direction.
    pub(super) fn direction(&mut self) -> Vec2 {
        crate::geometry::unit_vector(self.unit() * std::f32::consts::TAU)
    }
}

/// Smooth noise from -1 to 1 with features of size 1; `shift` as for a seed.
fn value(at: Vec2, shift: IVec2) -> f32 {
    let cell = at.floor();
    let f = at - cell;
    let t = f * f * f * (f * (f * 6.0 - Vec2::splat(15.0)) + Vec2::splat(10.0));
    let cell = cell.as_ivec2().wrapping_add(shift);
    let corner = |x: i32, y: i32| f32::from(entry(cell.wrapping_add(IVec2::new(x, y)))[0]) / 255.0;
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * t.x;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * t.x;
    (low + (high - low) * t.y) * 2.0 - 1.0
}

/// Several octaves of noise, each half as large and half as strong.
pub(super) fn octaves(at: Vec2, count: u32, seed: u32) -> f32 {
    let (mut sum, mut strength, mut at, mut shift) = (0.0, 1.0, at, shift(seed));
    for _ in 0..count {
        sum += strength * value(at, shift);
        strength *= 0.5;
        // Turned, so that the lattices of the octaves do not line up.
        at = Vec2::new(1.6 * at.x - 1.2 * at.y, 1.2 * at.x + 1.6 * at.y);
        shift += NEXT_OCTAVE;
    }
    sum
}

/// Nearly normal, mean 0 and standard deviation 1, for a place of the table.
pub(super) fn grain(at: IVec2) -> f32 {
    normal(entry(at))
}

/// Nearly normal, mean 0 and standard deviation 1, from four random bytes.
pub(super) fn normal(bytes: [u8; 4]) -> f32 {
    let [a, b, c, d] = bytes.map(f32::from);
    ((a + b + c + d) / 255.0 - 2.0) * 1.732
}

/// Three uncorrelated numbers of mean 0 and of standard deviation 1 at entries, interpolated between them.
pub(super) fn three_grains(at: Vec2, shift: IVec2) -> [f32; 3] {
    let cell = at.floor();
    let share = at - cell;
    let cell = cell.as_ivec2().wrapping_add(shift);
    let corner = |x: i32, y: i32| entry(cell.wrapping_add(IVec2::new(x, y))).map(f32::from);
    let blend =
        |a: [f32; 4], b: [f32; 4], share: f32| -> [f32; 4] { std::array::from_fn(|k| a[k] + (b[k] - a[k]) * share) };
    let low = blend(corner(0, 0), corner(1, 0), share.x);
    let [a, b, c, d] = blend(low, blend(corner(0, 1), corner(1, 1), share.x), share.y);
    [a + b - c - d, a - b + c - d, a - b - c + d].map(|sum| sum / 255.0 * 1.732)
}

/// Smooth noise along time, from -1 to 1, with features of 1.
pub(super) fn wobble(time: f32, seed: u32) -> f32 {
    value(Vec2::new(time, 0.5), shift(seed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_smooth_bounded_and_different_by_seed() {
        let along = |k: i32, seed| octaves(Vec2::new(k as f32 * 0.01, 3.3), 1, seed);
        assert!((0..2000).all(|k| (along(k, 1) - along(k + 1, 1)).abs() < 0.05 && along(k, 1).abs() <= 1.0));
        assert!((0..100).any(|k| (along(k, 1) - along(k, 2)).abs() > 0.1));
        let nowhere = octaves(Vec2::new(f32::NAN, 1e30), 1, 1);
        assert!(nowhere.is_nan() || nowhere.abs() <= 1.0);
    }

    #[test]
    fn dice_are_fair() {
        let mut rng = HashRng::new(7);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..4000 {
            let x = rng.normal();
            sum += x;
            squares += x * x;
        }
        assert!((sum / 4000.0).abs() < 0.06 && (squares / 4000.0 - 1.0).abs() < 0.1, "{sum} {squares}");
    }
}
