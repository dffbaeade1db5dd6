//! Speculative margins: how far the bodies in blocks are expected to move in a step.
//!
//! Nearly all move much less than the speed limit lets them, and most pairs that a search with the largest displacement finds
//! never touch. So a body in a block is searched for with a smaller margin, and once more with the largest displacement before
//! the contacts of the substep in which it may exceed that margin: no pair is missed.

use crate::particle::{BlockRange, LANES, Particles};

/// A body is expected to get at most so many times as fast as it is ...
const FASTER: f32 = 2.0;
/// ... and besides to move by this share of the largest displacement.
const START: f32 = 1.0 / 32.0;

/// How far particles can move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DisplacementLimits {
    /// Largest displacement of a particle in a step, units.
    pub step: f32,
    /// Largest displacement in a substep, units.
    pub substep: f32,
    /// Time of a step, s.
    pub dt: f32,
}

impl DisplacementLimits {
    /// Margin of a body of this speed, units: at least a substep at the limit, so that there is time for the second search.
    /// Infinite if it is no less than the largest displacement.
    fn margin(self, speed: f32) -> f32 {
        let margin = self.substep + FASTER * speed * self.dt + START * self.step;
        if margin < self.step { margin } else { f32::INFINITY }
    }

    /// How much smaller a margin is than the largest displacement, units.
    pub(super) fn slack(self, margin: f32) -> f32 {
        if margin < self.step { self.step - margin } else { 0.0 }
    }
}

/// What remains of the margins of the bodies in blocks, by block and lane, units.
#[derive(Clone, Debug, Default)]
pub(crate) struct SpeculativeMargins(Vec<[f32; LANES]>);

impl SpeculativeMargins {
    /// Those of all blocks, to be set.
    pub(super) fn reset(&mut self, blocks: usize) -> &mut [[f32; LANES]] {
        self.0.clear();
        self.0.resize(blocks, [0.0; LANES]);
        &mut self.0
    }

    /// Block by block.
    pub(crate) fn blocks_mut(&mut self) -> impl Iterator<Item = &mut [f32; LANES]> {
        self.0.iter_mut()
    }

    /// Whether a body may exceed its margin with another displacement of `next`.
    pub(crate) fn any_below(&self, next: f32) -> bool {
        self.0.iter().flatten().fold(false, |any, &remaining| any | (remaining < next))
    }

    /// Of one body; infinite after a search with the largest displacement.
    pub(super) fn remaining(&self, block: u32, lane: usize) -> f32 {
        self.0[block as usize][lane]
    }

    /// Notes that a body has been searched for with the largest displacement.
    pub(super) fn lift(&mut self, block: u32, lane: usize) {
        self.0[block as usize][lane] = f32::INFINITY;
    }
}

/// Margins of the bodies in a block, by the fastest particle of each.
#[inline(always)]
pub(super) fn margins_of(block: &BlockRange, p: &Particles, limits: DisplacementLimits) -> [f32; LANES] {
    let mut fastest = [0.0; LANES];
    let own = block.base..block.end();
    for (vx, vy) in p.vx[own.clone()].chunks_exact(LANES).zip(p.vy[own].chunks_exact(LANES)) {
        let speeds = vx.iter().zip(vy).map(|(vx, vy)| vx * vx + vy * vy);
        for (fastest, squared) in fastest.iter_mut().zip(speeds) {
            *fastest = if squared > *fastest { squared } else { *fastest };
        }
    }
    fastest.map(|squared: f32| limits.margin(squared.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: DisplacementLimits = DisplacementLimits { step: 0.8, substep: 0.1, dt: 0.02 };

    #[test]
    fn a_margin_grows_with_the_speed_up_to_the_largest_displacement() {
        for (speed, margin) in [(0.0, 0.125), (1.0, 0.165), (10.0, 0.525)] {
            assert!((LIMITS.margin(speed) - margin).abs() < 1e-6, "{speed}: {}", LIMITS.margin(speed));
            assert!((LIMITS.slack(LIMITS.margin(speed)) + margin - 0.8).abs() < 1e-6);
        }
        let one_substep = DisplacementLimits { substep: 0.8, ..LIMITS };
        let just_as_large = DisplacementLimits { step: 1.0, substep: 1.0 - START, ..LIMITS };
        assert_eq!(just_as_large.margin(0.0), f32::INFINITY);
        for unlimited in
            [LIMITS.margin(40.0), LIMITS.margin(f32::INFINITY), LIMITS.margin(f32::NAN), one_substep.margin(0.0)]
        {
            assert_eq!((unlimited, LIMITS.slack(unlimited)), (f32::INFINITY, 0.0));
        }
    }

    #[test]
    fn the_fastest_particle_of_a_body_counts() {
        let mut p = Particles::default();
        let block = BlockRange { base: p.extend(3 * LANES) as usize, slots: 3 };
        (p.vx[block.entry(1, 2)], p.vy[block.entry(2, 2)], p.vy[block.entry(0, 5)]) = (1.0, -10.0, 40.0);
        (p.vx[block.entry(0, 6)], p.vy[block.entry(0, 6)]) = (-6.0, -8.0);
        let (still, fast, unlimited) = (LIMITS.margin(0.0), LIMITS.margin(10.0), f32::INFINITY);
        assert_eq!(margins_of(&block, &p, LIMITS), [still, still, fast, still, still, unlimited, fast, still]);
    }
}
