//! What wakes sleepers besides motion: a change of the body itself, or of what it leans on.

use super::World;
use crate::id::OrganismId;

impl World {
    /// Notes that an organism has changed, or what acts on it.
    pub(super) fn disturb(&mut self, id: OrganismId) {
        let lane = self.organisms.get(id).and_then(|organism| organism.body.lane(&self.blocks));
        lane.into_iter().for_each(|(block, lane)| self.sleep.disturb(block, lane));
    }

    /// The same of all that touch it.
    pub(super) fn disturb_what_touches(&mut self, id: OrganismId) {
        let other = |&(a, b): &_| if a == id { Some(b) } else { (b == id).then_some(a) };
        for other in self.touching.pairs().iter().filter_map(other).collect::<Vec<_>>() {
            self.disturb(other);
        }
    }
}
