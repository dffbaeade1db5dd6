//! Sleep: a block of which all bodies have been slow for long enough is left out of the step until something that moves is near.
//!
//! The state is the sleep time of each body. The blocks that sleep follow from it and from what is near, in each step: a
//! sleeper is awake before anything can touch it. Slow neighbours that are not asleep themselves, because their sleep time is
//! too short or a body of their block moves, collide with a sleeper as if it had infinite mass.

use super::{BlockRange, LANES, Particles};
use serde::{Deserialize, Serialize};

/// Block index of a body that is in no block.
pub(crate) const NO_BLOCK: u32 = u32::MAX;

/// Sleep times of the bodies in blocks, and the blocks that sleep.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Sleep {
    /// Steps in a row below the sleep speed, by block and lane, empty lanes included; at most as many as it takes to fall asleep.
    sleep_time: Vec<[u16; LANES]>,
    /// By block, for the present step.
    #[serde(skip)]
    asleep: Vec<bool>,
}

impl Sleep {
    /// Number of blocks that it knows.
    pub(crate) fn len(&self) -> usize {
        self.sleep_time.len()
    }

    /// Resets the sleep time of a body that has changed, or on which something acts. A new block is added so.
    pub(crate) fn wake_up(&mut self, block: u32, lane: usize) {
        let block = block as usize;
        if block >= self.sleep_time.len() {
            self.sleep_time.resize(block + 1, [0; LANES]);
        }
        self.sleep_time[block][lane] = 0;
    }

    /// Resets all sleep times.
    pub(crate) fn wake_all(&mut self) {
        self.sleep_time.fill([0; LANES]);
    }

    /// Whether a body was above the sleep speed in the last step.
    pub(crate) fn is_moving(&self, block: usize, lane: usize) -> bool {
        self.sleep_time.get(block).is_none_or(|lanes| lanes[lane] == 0)
    }

    /// Whether all bodies of a block have a sleep time of so many steps.
    pub(crate) fn is_at_rest(&self, block: u32, steps: u16) -> bool {
        self.sleep_time.get(block as usize).is_some_and(|lanes| lanes.iter().all(|&time| time >= steps))
    }

    /// Puts to sleep each block whose bodies have all been slow for at least `steps` steps; returns whether there are any.
    pub(crate) fn fall_asleep(&mut self, steps: u16) -> bool {
        let Self { sleep_time, asleep } = self;
        asleep.clear();
        asleep.extend(sleep_time.iter().map(|lanes| lanes.iter().all(|&time| time >= steps)));
        asleep.contains(&true)
    }

    /// Keeps a block awake in the present step.
    pub(crate) fn keep_awake(&mut self, block: u32) {
        self.asleep[block as usize] = false;
    }

    pub(crate) fn is_asleep(&self, block: u32) -> bool {
        self.asleep.get(block as usize) == Some(&true)
    }

    /// The sleepers among all blocks.
    pub(crate) fn sleepers<T>(&self, blocks: impl Iterator<Item = T> + Clone) -> impl Iterator<Item = T> + Clone {
        blocks.zip(&self.asleep).filter(|(_, asleep)| **asleep).map(|(block, _)| block)
    }

    /// Sets the velocities of sleepers to zero.
    pub(crate) fn stop_sleepers(&self, blocks: impl Iterator<Item = BlockRange> + Clone, particles: &mut Particles) {
        for block in self.sleepers(blocks) {
            let range = block.base..block.end();
            let Particles { x, y, prev_x, prev_y, vx, vy, .. } = particles;
            prev_x[range.clone()].copy_from_slice(&x[range.clone()]);
            prev_y[range.clone()].copy_from_slice(&y[range.clone()]);
            // NaN stays NaN, and is found.
            [vx, vy].into_iter().flat_map(|v| &mut v[range.clone()]).for_each(|v| *v *= 0.0);
        }
    }

    /// Adds a step to the sleep time of each body of which no particle is faster than `speed`, and resets it for the others.
    pub(crate) fn update_sleep_times(
        &mut self,
        blocks: impl Iterator<Item = BlockRange>,
        particles: &Particles,
        speed: f32,
        steps: u16,
    ) {
        let Self { sleep_time, asleep } = self;
        for ((block, lanes), _) in blocks.zip(sleep_time).zip(asleep).filter(|(_, asleep)| !**asleep) {
            let moves = moving_lanes(block, particles, speed * speed);
            for (time, moves) in lanes.iter_mut().zip(moves) {
                *time = if moves { 0 } else { steps.min(time.saturating_add(1)) };
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

    /// A block of two slots, of which lane 3 moves a little, and its sleep times of 0.
    fn block() -> (BlockRange, Particles, Sleep) {
        let mut particles = Particles::default();
        let block = BlockRange { base: particles.extend(2 * LANES) as usize, slots: 2 };
        particles.vx[block.entry(1, 3)] = 0.1;
        let mut sleep = Sleep::default();
        sleep.wake_up(0, 0);
        (block, particles, sleep)
    }

    #[test]
    fn a_block_falls_asleep_when_its_last_body_has_been_slow_for_long_enough() {
        let (block, mut particles, mut sleep) = block();
        for step in 0..9 {
            assert_eq!(sleep.fall_asleep(4), step == 8, "step {step}");
            assert_eq!(sleep.is_moving(0, 3), step < 5);
            if step == 4 {
                particles.vx[block.entry(1, 3)] = 0.04;
            }
            sleep.update_sleep_times([block].into_iter(), &particles, 0.05, 4);
        }
        assert!(sleep.is_asleep(0) && !sleep.is_asleep(1) && !sleep.is_asleep(NO_BLOCK));
    }

    #[test]
    fn waking_up_resets_the_sleep_time() {
        let (block, particles, mut sleep) = block();
        sleep.fall_asleep(3);
        (0..3).for_each(|_| sleep.update_sleep_times([block].into_iter(), &particles, 0.5, 3));
        assert!(sleep.fall_asleep(3) && sleep.is_at_rest(0, 3));
        sleep.wake_up(0, 7);
        assert!(!sleep.fall_asleep(3) && sleep.is_moving(0, 7) && !sleep.is_moving(0, 0));
    }

    #[test]
    fn a_sleeper_has_no_velocity() {
        let (block, mut particles, mut sleep) = block();
        sleep.fall_asleep(0);
        particles.x[3] = 2.0;
        sleep.stop_sleepers([block].into_iter(), &mut particles);
        assert!(particles.vx.iter().all(|&v| v == 0.0) && particles.prev_x[3] == 2.0);
    }

    #[test]
    fn sleep_times_read_from_a_file_do_not_overflow() {
        let (block, particles, _) = block();
        let mut sleep = Sleep { sleep_time: vec![[u16::MAX; LANES]], asleep: vec![false] };
        sleep.update_sleep_times([block].into_iter(), &particles, 0.5, 30);
        assert!(sleep.is_at_rest(0, 30) && !sleep.is_at_rest(0, 31));
    }
}
