//! Waking sleepers up for another reason than motion: a change of the body itself, or of a body that it leans on.

use super::World;
use crate::id::OrganismId;

impl World {
    /// Wakes an organism up that has changed, or on which something acts.
    pub(super) fn wake_up(&mut self, id: OrganismId) {
        let lane = self.organisms.get(id).and_then(|organism| organism.body.lane(&self.blocks));
        lane.into_iter().for_each(|(block, lane)| self.sleep.wake_up(block, lane));
    }

    /// Wakes up all organisms that touch one.
    pub(super) fn wake_up_touching(&mut self, id: OrganismId) {
        let other = |&(a, b): &_| if a == id { Some(b) } else { (b == id).then_some(a) };
        for other in self.touching.pairs().iter().filter_map(other).collect::<Vec<_>>() {
            self.wake_up(other);
        }
    }
}
