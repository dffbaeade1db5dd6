//! Leeway: how far bodies are expected to move in a step.
//!
//! Nearly all move much less far than the speed limit lets them, and pairs that only the limit could bring together are most
//! of what a search finds. So a body in a block is searched for as if it moved by no more than its leeway, and again, as far as
//! it can get at all, before the contacts of the substep in which it may use that up: nothing is missed.

use crate::particle::{BlockRange, LANES, Particles};

/// A body is expected to get at most so many times as fast as it is ...
const FASTER: f32 = 2.0;
/// ... and besides to move by this share of what the speed limit allows.
const START: f32 = 1.0 / 32.0;

/// How far particles move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Farthest that the search expects of one in a step, units.
    pub step: f32,
    /// Farthest that one moves in a substep, units.
    pub substep: f32,
    /// Time of a step, s.
    pub dt: f32,
}

impl Reach {
    /// How far something of this speed is expected to move in a step: at least a substep at the limit, so that there is time to
    /// look again. Infinite if that is no less than it can.
    fn leeway(self, speed: f32) -> f32 {
        let way = self.substep + FASTER * speed * self.dt + START * self.step;
        if way < self.step { way } else { f32::INFINITY }
    }

    /// How much farther something with this leeway can get than it is expected to.
    pub(super) fn slack(self, leeway: f32) -> f32 {
        if leeway < self.step { self.step - leeway } else { 0.0 }
    }
}

/// How far the bodies in blocks may still move before they have to be looked for again, by block and lane, units.
#[derive(Clone, Debug, Default)]
pub(crate) struct Leeway(Vec<[f32; LANES]>);

impl Leeway {
    /// Of all blocks, to be granted anew.
    pub(super) fn renew(&mut self, blocks: usize) -> &mut [[f32; LANES]] {
        self.0.clear();
        self.0.resize(blocks, [0.0; LANES]);
        &mut self.0
    }

    /// Block by block.
    pub(crate) fn blocks_mut(&mut self) -> impl Iterator<Item = &mut [f32; LANES]> {
        self.0.iter_mut()
    }

    /// Whether something may have moved farther than expected when it has moved by `next` more than was noted.
    pub(crate) fn ends_within(&self, next: f32) -> bool {
        self.0.iter().flatten().fold(false, |ends, &left| ends | (left < next))
    }

    /// Of one body; infinite if it may move as far as it can.
    pub(super) fn left(&self, block: u32, lane: usize) -> f32 {
        self.0[block as usize][lane]
    }

    /// Lets a body move as far as it can.
    pub(super) fn lift(&mut self, block: u32, lane: usize) {
        self.0[block as usize][lane] = f32::INFINITY;
    }
}

/// What the bodies in a block are granted, by the fastest particle of each.
pub(super) fn grant(block: &BlockRange, p: &Particles, reach: Reach) -> [f32; LANES] {
    let mut fastest = [0.0; LANES];
    for slot in 0..block.slots {
        let lanes = block.entry(slot, 0)..block.entry(slot + 1, 0);
        let speeds = p.vx[lanes.clone()].iter().zip(&p.vy[lanes]).map(|(vx, vy)| vx * vx + vy * vy);
        for (fastest, squared) in fastest.iter_mut().zip(speeds) {
            *fastest = if squared > *fastest { squared } else { *fastest };
        }
    }
    fastest.map(|squared: f32| reach.leeway(squared.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const REACH: Reach = Reach { step: 0.8, substep: 0.1, dt: 0.02 };

    #[test]
    fn a_body_is_expected_to_move_a_little_and_is_not_held_to_what_it_can() {
        for (speed, way) in [(0.0, 0.125), (1.0, 0.165), (10.0, 0.525)] {
            assert!((REACH.leeway(speed) - way).abs() < 1e-6, "{speed}: {}", REACH.leeway(speed));
            assert!((REACH.slack(REACH.leeway(speed)) + way - 0.8).abs() < 1e-6);
        }
        let one_substep = Reach { substep: 0.8, ..REACH };
        for endless in
            [REACH.leeway(40.0), REACH.leeway(f32::INFINITY), REACH.leeway(f32::NAN), one_substep.leeway(0.0)]
        {
            assert_eq!((endless, REACH.slack(endless)), (f32::INFINITY, 0.0));
        }
    }

    #[test]
    fn the_fastest_particle_of_a_body_counts() {
        let mut p = Particles::default();
        let block = BlockRange { base: p.extend(3 * LANES) as usize, slots: 3 };
        (p.vx[block.entry(1, 2)], p.vy[block.entry(2, 2)], p.vy[block.entry(0, 5)]) = (1.0, -10.0, 40.0);
        let (still, fast, endless) = (REACH.leeway(0.0), REACH.leeway(10.0), f32::INFINITY);
        assert_eq!(grant(&block, &p, REACH), [still, still, fast, still, still, endless, still, still]);
    }
}
