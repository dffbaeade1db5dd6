//! Waking organisms when something other than motion changes: the body itself, or one that it touches.

use super::World;
use crate::id::OrganismId;

impl World {
    /// Wakes an organism.
    pub(super) fn wake_up(&mut self, id: OrganismId) {
        let lane = self.organisms.get(id).and_then(|organism| organism.body.lane(&self.blocks));
        if let Some((block, lane)) = lane {
            self.sleep.wake_up(block, lane);
        }
    }

    /// Wakes all organisms that touch one.
    pub(super) fn wake_up_touching(&mut self, id: OrganismId) {
        let other = |&(a, b): &_| if a == id { Some(b) } else { (b == id).then_some(a) };
        for other in self.touching.pairs().iter().filter_map(other).collect::<Vec<_>>() {
            self.wake_up(other);
        }
    }
}
