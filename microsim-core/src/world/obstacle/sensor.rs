//! Sensors: zones without contacts that report what enters and leaves them.

use super::WALLS;
use crate::collision::ObstacleContact;
use crate::event::Event;
use crate::id::{ObstacleId, OrganismId};
use crate::world::World;
use serde::{Deserialize, Serialize};

/// What is in which sensor: an organism, or for fluid without a membrane one of its particles.
type Presence = (ObstacleId, OrganismId, Option<u32>);

/// What is in sensors at the end of the last step, sorted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Presences(Vec<Presence>);

impl World {
    /// What is in a sensor at the end of the last step: organisms, and of fluid without a membrane the particles, see
    /// [`crate::ParticleView::index`].
    pub fn inside_sensor(&self, id: ObstacleId) -> impl Iterator<Item = (OrganismId, Option<u32>)> + '_ {
        let first = self.presences.0.partition_point(|&(sensor, ..)| sensor < id);
        let inside = self.presences.0[first..].iter().take_while(move |&&(sensor, ..)| sensor == id);
        inside.map(|&(_, organism, particle)| (organism, particle))
    }

    /// Compares what is in sensors with what was, and reports the differences. What sleeps stays where it is.
    pub(crate) fn update_sensors(&mut self) {
        let contacts = &self.scratch.broad_phase.sensor_contacts;
        if contacts.is_empty() && self.presences.0.is_empty() {
            return;
        }
        let found = contacts.iter().filter_map(|contact| self.presence(contact));
        let asleep = self.presences.0.iter().filter(|presence| self.stays_asleep(presence)).copied();
        let mut now: Vec<Presence> = found.chain(asleep).collect();
        now.sort_unstable();
        now.dedup();
        let before = std::mem::replace(&mut self.presences.0, now);
        let now = &self.presences.0;
        let left = before.iter().filter(|presence| now.binary_search(presence).is_err());
        let events = left.map(|&(sensor, organism, particle)| Event::SensorLeft { sensor, organism, particle });
        self.events.extend(events);
        let entered = now.iter().filter(|presence| before.binary_search(presence).is_err());
        let events = entered.map(|&(sensor, organism, particle)| Event::SensorEntered { sensor, organism, particle });
        self.events.extend(events);
    }

    /// What a particle near a sensor is inside it as.
    fn presence(&self, &ObstacleContact { particle, obstacle, shift }: &ObstacleContact) -> Option<Presence> {
        let (p, i, sensor) = (&self.particles, particle as usize, &self.obstacles[obstacle as usize]);
        let at = p.position(i) - shift;
        let (surface, is_inside) = sensor.nearest(at);
        let is_present = is_inside || (at - surface).length() < p.radius[i];
        let id = self.obstacle_table.id_at(obstacle - WALLS as u32)?;
        let owner = self.organisms.id_at(p.owner[i]).filter(|_| is_present && p.groups[i].meets(sensor.groups))?;
        let is_free = p.fluid[i] != 0 && self.organisms.get(owner)?.body.membrane().is_none();
        Some((id, owner, is_free.then_some(particle)))
    }

    fn stays_asleep(&self, &(sensor, organism, _): &Presence) -> bool {
        let lane = self.organisms.get(organism).and_then(|organism| organism.body.lane(&self.blocks));
        let is_there = self.obstacle(sensor).is_some_and(|sensor| sensor.is_enabled && sensor.is_sensor);
        is_there && lane.is_some_and(|(block, _)| self.sleep.is_asleep(block))
    }
}
