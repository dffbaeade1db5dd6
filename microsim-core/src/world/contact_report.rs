//! Reports of contacts: where organisms touched what in the last step and how hard; begin and end of contacts with obstacles and
//! walls; hits.

use super::World;
use super::change::WorldChange;
use super::obstacle::WALLS;
use crate::collider::{Collider, ContactPoint, ContactReporting, Wall};
use crate::error::{Error, in_range};
use crate::event::Event;
use crate::id::OrganismId;
use crate::solver::contact_record::{ContactRecord, Touched};
use serde::{Deserialize, Serialize};

/// What was reported in the last step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct ContactReports {
    reporting: Option<ContactReporting>,
    /// By organism, partner and nodes.
    pub(crate) points: Vec<ContactPoint>,
    /// Organisms and the obstacles and walls that they touched, sorted.
    pub(crate) surfaces: Vec<(OrganismId, Collider)>,
    /// Organisms and what they hit, sorted.
    pub(crate) hits: Vec<(OrganismId, Collider)>,
}

impl World {
    /// Turns reports of contacts on or off: [`World::contacts`], [`Event::TouchBegan`], [`Event::TouchEnded`] and
    /// [`Event::Hit`]. They are off at first, and cost nothing then.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, ContactReporting, Event, Inputs, Placement, World, WorldConfig, glam::Vec2};
    /// let mut world = World::new(WorldConfig { gravity: Vec2::new(0.0, -10.0), ..WorldConfig::default() })?;
    /// world.set_contact_reporting(Some(ContactReporting { hit_speed: Some(5.0) }))?;
    /// let ball = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 5.0))?;
    /// let hit = (0..120).find_map(|_| {
    ///     world.step(&Inputs::new());
    ///     world.events().iter().find_map(|event| if let Event::Hit { contact } = event { Some(*contact) } else { None })
    /// });
    /// let hit = hit.expect("it falls on the floor");
    /// assert!(hit.organism == ball && hit.speed > 5.0 && hit.normal.y > 0.99);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// When `hit_speed` is out of its range.
    pub fn set_contact_reporting(&mut self, reporting: Option<ContactReporting>) -> Result<(), Error> {
        if let Some(speed) = reporting.and_then(|reporting| reporting.hit_speed) {
            in_range("hit_speed", speed, 0.0, 1e6)?;
        }
        let reports = &mut self.contact_reports;
        if reporting.is_none() {
            *reports = ContactReports::default();
        }
        reports.reporting = reporting;
        self.changed(|| WorldChange::SetContactReporting(reporting));
        Ok(())
    }

    /// What is reported of contacts, if anything is.
    #[must_use]
    pub fn contact_reporting(&self) -> Option<ContactReporting> {
        self.contact_reports.reporting
    }

    /// Where organisms touched others, obstacles and walls in the last step, if contacts are reported: each pair of discs, or disc
    /// and obstacle, once. What sleeps is left out.
    #[must_use]
    pub fn contacts(&self) -> &[ContactPoint] {
        &self.contact_reports.points
    }

    /// Those of them in which an organism took part, as it felt them.
    pub fn contacts_of(&self, id: OrganismId) -> impl Iterator<Item = ContactPoint> + '_ {
        let felt = move |contact: &ContactPoint| {
            if contact.organism == id {
                Some(*contact)
            } else {
                let flipped = contact.flipped().filter(|flipped| flipped.organism == id);
                flipped.map(|flipped| self.beside_own_node(flipped))
            }
        };
        self.contacts().iter().filter_map(felt)
    }

    /// Takes over what was read.
    ///
    /// # Errors
    /// Says what is wrong with it.
    #[cfg(feature = "snapshot")]
    pub(in crate::world) fn restore_contact_reports(&mut self, reports: ContactReports) -> Result<(), String> {
        self.set_contact_reporting(reports.reporting).map_err(|error| error.to_string())?;
        self.contact_reports = reports;
        Ok(())
    }

    /// Forgets the last step's contacts and gets ready for the next one's.
    pub(crate) fn begin_contact_reports(&mut self) {
        self.contact_reports.points.clear();
        self.scratch.contact_records.begin(self.contact_reports.reporting.is_some(), self.config.substep());
    }

    /// Makes reports of what was recorded.
    pub(crate) fn report_contacts(&mut self) {
        let Some(reporting) = self.contact_reports.reporting else { return };
        let mut recorder = std::mem::take(&mut self.scratch.contact_records);
        let mut points = std::mem::take(&mut self.contact_reports.points);
        let same = |a: &ContactRecord, b: &ContactRecord| (a.particle, a.touched) == (b.particle, b.touched);
        points.extend(recorder.sorted().chunk_by(same).filter_map(|records| self.contact_point(records)));
        points.sort_by_key(|contact| (contact.organism, contact.partner, contact.node, contact.partner_node));
        self.scratch.contact_records = recorder;
        self.contact_reports.points = points;
        self.report_touches();
        self.report_hits(reporting);
    }

    /// A contact of all substeps in which two surfaces touched.
    fn contact_point(&self, records: &[ContactRecord]) -> Option<ContactPoint> {
        let owner = |i: u32| self.organisms.id_at(self.particles.owner[i as usize]);
        let fastest = records.iter().reduce(|a, b| if b.speed > a.speed { b } else { a })?;
        let &ContactRecord { particle: node, touched, point, normal, speed, .. } = fastest;
        let (partner, partner_node) = match touched {
            Touched::Disc(j) => (Collider::Organism(owner(j)?), Some(j)),
            Touched::Obstacle(k) => (self.collider_at(k)?, None),
        };
        let impulse = records.iter().map(|record| record.impulse).sum();
        let speed = if speed > 0.0 { speed } else { 0.0 };
        let contact =
            ContactPoint { organism: owner(node)?, partner, node, partner_node, point, normal, speed, impulse };
        let is_own = partner == Collider::Organism(contact.organism);
        let flipped = contact.flipped().filter(|flipped| flipped.organism < contact.organism);
        (!is_own).then(|| flipped.unwrap_or(contact))
    }

    /// Puts the points of the step's contacts where their organisms have come to in a periodic room.
    pub(super) fn return_contact_points(&mut self) {
        let mut points = std::mem::take(&mut self.contact_reports.points);
        points.iter_mut().for_each(|contact| *contact = self.beside_own_node(*contact));
        self.contact_reports.points = points;
        let mut events = std::mem::take(&mut self.events);
        for event in &mut events {
            if let Event::Hit { contact } = event {
                *contact = self.beside_own_node(*contact);
            }
        }
        self.events = events;
    }

    /// A contact with its point on the side of a periodic room where its organism is.
    fn beside_own_node(&self, contact: ContactPoint) -> ContactPoint {
        let period = self.period();
        if period.is_none() {
            return contact;
        }
        let node = self.particles.position(contact.node as usize);
        ContactPoint { point: node + period.nearest(contact.point - node), ..contact }
    }

    /// An obstacle or wall by its index among all of them.
    pub(crate) fn collider_at(&self, obstacle: u32) -> Option<Collider> {
        let added = || Some(Collider::Obstacle(self.obstacle_table.id_at(obstacle - WALLS as u32)?));
        Wall::ALL.get(obstacle as usize).map(|&wall| Collider::Wall(wall)).or_else(added)
    }

    /// Compares which obstacles and walls are touched with those of the last step. What sleeps keeps touching.
    fn report_touches(&mut self) {
        let points = self.contact_reports.points.iter().filter(|contact| contact.partner_node.is_none());
        let touched = points.map(|contact| (contact.organism, contact.partner));
        let before = &self.contact_reports.surfaces;
        let mut now: Vec<_> = touched.chain(before.iter().copied().filter(|pair| self.keeps_touching(*pair))).collect();
        now.sort_unstable();
        now.dedup();
        let ended = before.iter().filter(|pair| now.binary_search(pair).is_err());
        let ended = ended.map(|&(organism, collider)| Event::TouchEnded { organism, collider });
        let began = now.iter().filter(|pair| before.binary_search(pair).is_err());
        let began = began.map(|&(organism, collider)| Event::TouchBegan { organism, collider });
        self.events.extend(ended.chain(began));
        self.contact_reports.surfaces = now;
    }

    fn keeps_touching(&self, (organism, collider): (OrganismId, Collider)) -> bool {
        let lane = self.organisms.get(organism).and_then(|organism| organism.body.lane(&self.blocks));
        let is_there = |id| self.obstacle(id).is_some_and(|obstacle| obstacle.is_solid());
        lane.is_some_and(|(block, _)| self.sleep.is_asleep(block)) && collider.obstacle().is_none_or(is_there)
    }

    /// Reports of each two that touched their fastest contact, with the impulse of all, if it was fast enough. An impact may go
    /// on into a second step, where it is not reported again.
    fn report_hits(&mut self, ContactReporting { hit_speed }: ContactReporting) {
        let Some(hit_speed) = hit_speed else { return };
        let same = |a: &ContactPoint, b: &ContactPoint| (a.organism, a.partner) == (b.organism, b.partner);
        let before = std::mem::take(&mut self.contact_reports.hits);
        let mut hits = Vec::new();
        for contacts in self.contact_reports.points.chunk_by(same) {
            let fastest = contacts.iter().reduce(|a, b| if b.speed > a.speed { b } else { a });
            let impulse = contacts.iter().map(|contact| contact.impulse).sum();
            let Some(&hit) = fastest.filter(|contact| contact.speed >= hit_speed && contact.speed > 0.0) else {
                continue;
            };
            let pair = (hit.organism, hit.partner);
            if before.binary_search(&pair).is_err() {
                self.events.push(Event::Hit { contact: ContactPoint { impulse, ..hit } });
            }
            hits.push(pair);
        }
        self.contact_reports.hits = hits;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AgarSpec, Placement, Side, Sides, WorldConfig};
    use glam::Vec2;

    #[test]
    fn a_point_is_told_on_the_side_of_the_room_where_its_organism_is() {
        let sides = Sides { left: Side::Periodic, right: Side::Periodic, ..Sides::default() };
        let mut world =
            World::new(WorldConfig { size: Vec2::new(80.0, 60.0), sides, ..WorldConfig::default() }).unwrap();
        let id = world.spawn(&AgarSpec::default().into(), Placement::at(0.5, 30.0)).unwrap();
        let node = world.organisms.get(id).unwrap().particles().next().unwrap();
        let partner = Collider::Wall(Wall::Top);
        let contact = |x: f32| ContactPoint {
            organism: id,
            partner,
            node,
            partner_node: None,
            point: Vec2::new(x, 30.0),
            normal: Vec2::X,
            speed: 0.0,
            impulse: 0.0,
        };
        for (x, told) in [(79.5, -0.5), (1.5, 1.5), (81.5, 1.5)] {
            let point = world.beside_own_node(contact(x)).point;
            assert!((point - Vec2::new(told, 30.0)).length() < 1e-4, "{x}: {point}");
        }
    }
}
