//! Waking organisms when something other than motion changes: the body itself, or one that it touches.

use super::World;
use crate::collision::obstacle::Obstacle;
use crate::id::OrganismId;
use parry2d::bounding_volume::BoundingVolume;

impl World {
    /// Wakes an organism.
    pub(super) fn wake_up(&mut self, id: OrganismId) {
        let lane = self.organisms.get(id).and_then(|organism| organism.body.lane(&self.blocks));
        if let Some((block, lane)) = lane {
            self.sleep.wake_up(block, lane);
        }
    }

    /// Wakes all organisms in and around the box of an obstacle.
    pub(super) fn wake_up_near(&mut self, obstacle: &Obstacle) {
        let near = obstacle.aabb().loosened(self.config.max_displacement());
        let (p, period) = (&self.particles, self.period());
        let is_near = |&i: &u32| {
            let (at, near) = (p.position(i as usize), near.loosened(p.radius[i as usize]));
            period.shifts([at; 2], [near.mins, near.maxs]).any(|shift| near.contains_local_point(at + shift))
        };
        let organisms = self.organisms.iter().filter(|(_, organism)| organism.particles().any(|i| is_near(&i)));
        for id in organisms.map(|(id, _)| id).collect::<Vec<_>>() {
            self.wake_up(id);
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
