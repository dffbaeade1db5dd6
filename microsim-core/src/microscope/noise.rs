//! Noise without state: the same place always has the same value, so that texture neither flickers nor swims.

use glam::{IVec2, Vec2};

/// 32 bits for a place on the lattice (the finaliser of MurmurHash3, applied to each coordinate in turn).
pub(super) fn hash(at: IVec2, seed: u32) -> u32 {
    scramble(scramble(scramble(seed).wrapping_add(at.x as u32)).wrapping_add(at.y as u32))
}

/// 32 bits for a number.
pub(super) fn scramble(mut bits: u32) -> u32 {
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
pub(super) struct Dice(u32);

impl Dice {
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

/// Smooth noise from -1 to 1 with features of size 1.
pub(super) fn value(at: Vec2, seed: u32) -> f32 {
    let cell = at.floor();
    let f = at - cell;
    let t = f * f * f * (f * (f * 6.0 - Vec2::splat(15.0)) + Vec2::splat(10.0));
    let cell = cell.as_ivec2();
    let corner = |x: i32, y: i32| unit(hash(cell.wrapping_add(IVec2::new(x, y)), seed));
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * t.x;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * t.x;
    (low + (high - low) * t.y) * 2.0 - 1.0
}

/// Several octaves of noise, each half as large and half as strong.
pub(super) fn octaves(at: Vec2, count: u32, seed: u32) -> f32 {
    let (mut sum, mut strength, mut at) = (0.0, 1.0, at);
    for octave in 0..count {
        sum += strength * value(at, seed.wrapping_add(octave));
        strength *= 0.5;
        // Turned, so that the lattices of the octaves do not line up.
        at = Vec2::new(1.6 * at.x - 1.2 * at.y, 1.2 * at.x + 1.6 * at.y);
    }
    sum
}

/// Smooth noise along time, from -1 to 1, with features of 1.
pub(super) fn wobble(time: f32, seed: u32) -> f32 {
    value(Vec2::new(time, 0.5), seed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_smooth_bounded_and_different_by_seed() {
        let along = |k: i32, seed| octaves(Vec2::new(k as f32 * 0.01, 3.3), 1, seed);
        assert!((0..2000).all(|k| (along(k, 1) - along(k + 1, 1)).abs() < 0.05 && along(k, 1).abs() <= 1.0));
        assert!((0..100).any(|k| (along(k, 1) - along(k, 2)).abs() > 0.1));
        assert!(value(Vec2::new(f32::NAN, 1e30), 1).is_nan() || value(Vec2::new(f32::NAN, 1e30), 1).abs() <= 1.0);
    }

    #[test]
    fn dice_are_fair() {
        let mut dice = Dice::new(7);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..4000 {
            let x = dice.normal();
            sum += x;
            squares += x * x;
        }
        assert!((sum / 4000.0).abs() < 0.06 && (squares / 4000.0 - 1.0).abs() < 0.1, "{sum} {squares}");
    }
}
