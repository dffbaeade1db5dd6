//! Sleep: a block of which all bodies have been calm for a while is left out of the step until something that moves is near.
//!
//! The state is for how many steps each body has been calm. Who sleeps follows from it and from what is near, anew in each
//! step: a sleeper is awake before anything can reach it. Calm neighbours that are not asleep themselves, for want of
//! patience or because something stirs in their block, meet a sleeper as if nothing could move it.

use super::{BlockRange, LANES, Particles};
use serde::{Deserialize, Serialize};

/// Stands for the block of what is in none.
pub(crate) const NO_BLOCK: u32 = u32::MAX;

/// How long the bodies in blocks have been calm, and who sleeps.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Sleep {
    /// Steps in a row, by block and lane; empty lanes are calm. No more are counted than it takes to fall asleep.
    calm: Vec<[u16; LANES]>,
    /// By block, for the present step.
    #[serde(skip)]
    asleep: Vec<bool>,
}

impl Sleep {
    /// Number of blocks that it knows.
    pub(crate) fn len(&self) -> usize {
        self.calm.len()
    }

    /// Notes that a body has changed, or what acts on it. A new block is noted so for the first time.
    pub(crate) fn disturb(&mut self, block: u32, lane: usize) {
        let block = block as usize;
        if block >= self.calm.len() {
            self.calm.resize(block + 1, [0; LANES]);
        }
        self.calm[block][lane] = 0;
    }

    /// Whether a body has moved in the last step.
    pub(crate) fn is_restless(&self, block: usize, lane: usize) -> bool {
        self.calm.get(block).is_none_or(|calm| calm[lane] == 0)
    }

    /// Whether all bodies of a block have been calm for so many steps.
    pub(crate) fn is_calm(&self, block: u32, steps: u16) -> bool {
        self.calm.get(block as usize).is_some_and(|calm| calm.iter().all(|&calm| calm >= steps))
    }

    /// Puts all blocks to sleep that have been calm for so many steps; returns whether there are any.
    pub(crate) fn fall_asleep(&mut self, steps: u16) -> bool {
        let Self { calm, asleep } = self;
        asleep.clear();
        asleep.extend(calm.iter().map(|lanes| lanes.iter().all(|&calm| calm >= steps)));
        asleep.contains(&true)
    }

    /// Wakes a block for the present step.
    pub(crate) fn wake(&mut self, block: u32) {
        self.asleep[block as usize] = false;
    }

    pub(crate) fn is_asleep(&self, block: u32) -> bool {
        self.asleep.get(block as usize) == Some(&true)
    }

    /// Those that sleep of all blocks.
    pub(crate) fn sleepers<T>(&self, blocks: impl Iterator<Item = T> + Clone) -> impl Iterator<Item = T> + Clone {
        blocks.zip(&self.asleep).filter(|(_, asleep)| **asleep).map(|(block, _)| block)
    }

    /// Takes what motion they have left from sleepers.
    pub(crate) fn quieten(&self, blocks: impl Iterator<Item = BlockRange> + Clone, particles: &mut Particles) {
        for block in self.sleepers(blocks) {
            let range = block.base..block.end();
            let Particles { x, y, prev_x, prev_y, vx, vy, .. } = particles;
            prev_x[range.clone()].copy_from_slice(&x[range.clone()]);
            prev_y[range.clone()].copy_from_slice(&y[range.clone()]);
            // What is not a number stays so, and is found.
            [vx, vy].into_iter().flat_map(|v| &mut v[range.clone()]).for_each(|v| *v *= 0.0);
        }
    }

    /// Counts a step of calm for each body of which no particle is faster than `speed`.
    pub(crate) fn note(
        &mut self,
        blocks: impl Iterator<Item = BlockRange>,
        particles: &Particles,
        speed: f32,
        steps: u16,
    ) {
        let Self { calm, asleep } = self;
        for ((block, calm), _) in blocks.zip(calm).zip(asleep).filter(|(_, asleep)| !**asleep) {
            let moves = moving_lanes(block, particles, speed * speed);
            for (calm, moves) in calm.iter_mut().zip(moves) {
                *calm = if moves { 0 } else { steps.min(calm.saturating_add(1)) };
            }
        }
    }
}

/// In which lanes of a block a particle is faster than the root of `squared`.
fn moving_lanes(block: BlockRange, p: &Particles, squared: f32) -> [bool; LANES] {
    let mut moves = [false; LANES];
    for slot in 0..block.slots {
        let first = block.entry(slot, 0);
        for (lane, moves) in moves.iter_mut().enumerate() {
            let (vx, vy) = (p.vx[first + lane], p.vy[first + lane]);
            *moves |= vx * vx + vy * vy > squared;
        }
        if moves == [true; LANES] {
            break;
        }
    }
    moves
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of two slots, of which lane 3 moves a little.
    fn block() -> (BlockRange, Particles) {
        let mut particles = Particles::default();
        let block = BlockRange { base: particles.extend(2 * LANES) as usize, slots: 2 };
        particles.vx[block.entry(1, 3)] = 0.1;
        (block, particles)
    }

    #[test]
    fn a_block_falls_asleep_when_its_last_body_has_been_calm_for_long_enough() {
        let (block, mut particles) = block();
        let mut sleep = Sleep::default();
        sleep.disturb(0, 3);
        for step in 0..9 {
            assert_eq!(sleep.fall_asleep(4), step == 8, "step {step}");
            assert_eq!(sleep.is_restless(0, 3), step < 5);
            if step == 4 {
                particles.vx[block.entry(1, 3)] = 0.04;
            }
            sleep.note([block].into_iter(), &particles, 0.05, 4);
        }
        assert!(sleep.is_asleep(0) && !sleep.is_asleep(1) && !sleep.is_asleep(NO_BLOCK));
    }

    #[test]
    fn what_is_disturbed_has_to_be_calm_anew() {
        let (block, particles) = block();
        let mut sleep = Sleep::default();
        sleep.disturb(0, 0);
        sleep.fall_asleep(3);
        (0..3).for_each(|_| sleep.note([block].into_iter(), &particles, 0.5, 3));
        assert!(sleep.fall_asleep(3) && sleep.is_calm(0, 3));
        sleep.disturb(0, 7);
        assert!(!sleep.fall_asleep(3) && sleep.is_restless(0, 7) && !sleep.is_restless(0, 0));
    }

    #[test]
    fn a_sleeper_is_left_without_motion() {
        let (block, mut particles) = block();
        let mut sleep = Sleep::default();
        sleep.disturb(0, 0);
        sleep.fall_asleep(0);
        particles.x[3] = 2.0;
        sleep.quieten([block].into_iter(), &mut particles);
        assert!(particles.vx.iter().all(|&v| v == 0.0) && particles.prev_x[3] == 2.0);
    }

    #[test]
    fn no_count_that_a_file_may_have_overflows() {
        let (block, particles) = block();
        let mut sleep = Sleep { calm: vec![[u16::MAX; LANES]], asleep: vec![false] };
        sleep.note([block].into_iter(), &particles, 0.5, 30);
        assert!(sleep.is_calm(0, 30) && !sleep.is_calm(0, 31));
    }
}
