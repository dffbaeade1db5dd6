//! Joints between organisms, obstacles and places of the world: they are made and removed at run time, wake who they join, and end when
//! one of them goes.

use super::World;
use super::change::WorldChange;
use super::obstacle::WALLS;
use crate::error::Error;
use crate::event::Event;
use crate::float_environment::with_default_float_environment;
use crate::id::{JointId, ObstacleId, OrganismId};
use crate::joint::{JointEnd, JointKind, JointSpec};
use crate::organism::Organism;
use crate::particle::mass_properties::{MassProperties, movable};
use crate::solver::joint::{End, Held, Joint, Law};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// A joint, and what was found when it was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct JointRecord {
    pub spec: JointSpec,
    /// The particle of each end that is a node; none if one of them is gone, so that the joint ends in the next step.
    pub particles: [Option<u32>; 2],
    /// Distance of the ends then, units.
    pub length: f32,
    /// Largest force in a substep of the last step in which it was not asleep.
    pub force: f32,
}

/// A joint, for reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointView {
    /// Its handle.
    pub id: JointId,
    /// What it was made from.
    pub spec: JointSpec,
    /// Where its ends are, units.
    pub ends: [Vec2; 2],
    /// Largest force that it exerted in a substep of the last step in which it was not asleep.
    pub force: f32,
}

/// Speed of a body above which a soft joint keeps it awake, units/s: slower ones are about to turn round, or at rest.
const LEAST_DRIVEN_SPEED: f32 = 0.001;

impl World {
    /// Joins two things. Bodies that are joined still collide ([`World::set_exempt`]), and wake each other.
    ///
    /// The joint ends with [`Event::JointEnded`] when an organism that it holds goes or is frozen, a node of a cell goes to
    /// another cell, or an obstacle that it holds is removed or disabled, and with [`Event::JointBroken`] when its force is exceeded.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Inputs, JointEnd, JointKind, JointSpec, Placement, World, WorldConfig, glam::Vec2};
    /// # let gravity = Vec2::new(0.0, -10.0);
    /// # let mut world = World::new(WorldConfig { gravity, ..WorldConfig::default() })?;
    /// let bob = world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 40.0))?;
    /// let nail = JointEnd::Point(Vec2::new(50.0, 60.0));
    /// let rope = JointKind::Rope { max_length: 21.0 };
    /// let joint = world.add_joint(JointSpec::new(nail, JointEnd::Centre(bob), rope))?;
    /// (0..300).for_each(|_| world.step(&Inputs::new()));
    /// let [top, bottom] = world.joint(joint).unwrap().ends;
    /// assert!((top.distance(bottom) - 21.0).abs() < 0.01);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Names the number that is out of its range, the handle that is stale, the node that does not exist, the end that cannot
    /// be joined, or in a room with periodic sides a length of half of it or more. Nothing is changed then.
    pub fn add_joint(&mut self, spec: JointSpec) -> Result<JointId, Error> {
        let record = with_default_float_environment(|| self.joint_record(spec))?;
        self.wake_up_joined(&spec);
        let id = JointId::of(self.joints.insert(Box::new(record)));
        self.changed(|| WorldChange::AddJoint(spec));
        Ok(id)
    }

    /// Replaces a joint by another one, under the same handle: to move the place that it leads to, or to set a motor.
    ///
    /// # Errors
    /// As for [`World::add_joint`], and when the handle is stale.
    pub fn set_joint(&mut self, id: JointId, spec: JointSpec) -> Result<(), Error> {
        let before = self.joints.get(id.handle()).map(|record| record.spec).ok_or_else(|| Error::stale("joint"))?;
        let record = with_default_float_environment(|| self.joint_record(spec))?;
        self.wake_up_joined(&before);
        self.wake_up_joined(&spec);
        if let Some(joint) = self.joints.get_mut(id.handle()) {
            **joint = record;
        }
        self.changed(|| WorldChange::SetJoint(id, spec));
        Ok(())
    }

    /// Removes a joint, without an event.
    ///
    /// # Errors
    /// When the handle is stale.
    pub fn remove_joint(&mut self, id: JointId) -> Result<(), Error> {
        let record = self.joints.remove(id.handle()).ok_or_else(|| Error::stale("joint"))?;
        self.wake_up_joined(&record.spec);
        self.changed(|| WorldChange::RemoveJoint(id));
        Ok(())
    }

    /// A joint; `None` for a stale handle, and when something that it holds is gone.
    #[must_use]
    pub fn joint(&self, id: JointId) -> Option<JointView> {
        self.joint_view(id, self.joints.get(id.handle())?)
    }

    /// All joints, in a stable order.
    pub fn joints(&self) -> impl Iterator<Item = JointView> + '_ {
        self.joints.iter().filter_map(|(handle, record)| self.joint_view(JointId::of(handle), record))
    }

    fn joint_view(&self, id: JointId, record: &JointRecord) -> Option<JointView> {
        let [a, b] = [self.end_position(record, 0)?, self.end_position(record, 1)?];
        let ends = [a, b - self.joint_shift(record)];
        Some(JointView { id, spec: record.spec, ends, force: record.force })
    }

    /// Checks a joint and finds what it holds.
    fn joint_record(&self, spec: JointSpec) -> Result<JointRecord, Error> {
        spec.check(&self.config)?;
        let a = self.joined_particle(spec.a).map_err(|error| error.within("a"))?;
        let b = self.joined_particle(spec.b).map_err(|error| error.within("b"))?;
        let mut record = JointRecord { spec, particles: [a, b], length: 0.0, force: 0.0 };
        let ends = [spec.a, spec.b].map(JointEnd::organism);
        let is_same = a == b && ends[0] == ends[1];
        if is_same || !(0..2).any(|k| self.end_particles(&record, k).is_some_and(|list| self.can_move(&list))) {
            return Err(Error::unsupported("b", "another end than a; one of the two must be able to move"));
        }
        if let (Some(a), Some(b)) = (self.end_position(&record, 0), self.end_position(&record, 1)) {
            record.length = a.distance(b - self.joint_shift(&record));
        }
        self.check_joint_period(&spec, record.length)?;
        Ok(record)
    }

    /// The particle of an end that is a node.
    fn joined_particle(&self, end: JointEnd) -> Result<Option<u32>, Error> {
        if let Some((id, _)) = end.obstacle() {
            return self.check_joined_obstacle(id).map(|()| None);
        }
        let Some(id) = end.organism() else { return Ok(None) };
        self.organism_or_stale(id, "organism")?;
        let Some(organism) = self.organisms.get(id).filter(|organism| !organism.is_quarantined) else {
            return Err(Error::unsupported("organism", "an organism that is not frozen"));
        };
        if organism.is_free_fluid() && matches!(end, JointEnd::Centre(_)) && !self.period().is_none() {
            return Err(Error::unsupported("organism", "a body in a room with periodic sides"));
        }
        let JointEnd::Node { node, .. } = end else { return Ok(None) };
        let accepted = || format!("a node below {}", organism.particles().count());
        organism.particle_of(node).map(Some).ok_or_else(|| Error::reference("node", accepted()))
    }

    fn check_joined_obstacle(&self, id: ObstacleId) -> Result<(), Error> {
        let obstacle = self.obstacle(id).ok_or_else(|| Error::stale("obstacle"))?;
        let refused = || Error::unsupported("obstacle", "an obstacle that is enabled");
        obstacle.is_enabled.then_some(()).ok_or_else(refused)
    }

    fn can_move(&self, list: &[u32]) -> bool {
        movable(&self.particles, list).next().is_some()
    }

    /// The particles of an end, none for a place; `None` if what it held is gone.
    fn end_particles(&self, record: &JointRecord, k: usize) -> Option<Vec<u32>> {
        if let Some((id, _)) = record.end(k).obstacle() {
            return self.check_joined_obstacle(id).ok().map(|()| Vec::new());
        }
        let Some(id) = record.end(k).organism() else { return Some(Vec::new()) };
        let organism = self.organisms.get(id).filter(|organism| !organism.is_quarantined)?;
        if let JointEnd::Centre(_) = record.end(k) {
            return Some(organism.particles().collect());
        }
        let particle = record.particles[k]?;
        (self.particles.owner[particle as usize] == id.index).then(|| vec![particle])
    }

    fn end_position(&self, record: &JointRecord, k: usize) -> Option<Vec2> {
        match record.end(k) {
            JointEnd::Point(at) => return Some(at),
            JointEnd::Obstacle { obstacle, at } => return Some(self.obstacle(obstacle)?.pose.transform_point(at)),
            JointEnd::Node { .. } | JointEnd::Centre(_) => {}
        }
        let list = self.end_particles(record, k)?;
        let centre = MassProperties::of(&self.particles, &list).map(|body| body.position(&self.particles));
        centre.or_else(|| list.first().map(|&i| self.particles.position(i as usize)))
    }

    /// How far the second end is from the image of it that is nearest to the first one.
    fn joint_shift(&self, record: &JointRecord) -> Vec2 {
        let period = self.period();
        if period.is_none() {
            return Vec2::ZERO;
        }
        let ends = [0, 1].map(|k| self.end_position(record, k));
        let [Some(a), Some(b)] = ends else { return Vec2::ZERO };
        period.whole(b - a)
    }

    fn wake_up_joined(&mut self, spec: &JointSpec) {
        for id in [spec.a, spec.b].into_iter().filter_map(JointEnd::organism) {
            self.wake_up(id);
        }
    }

    /// Wakes who is joined to an obstacle.
    pub(in crate::world) fn wake_up_joined_to(&mut self, obstacle: ObstacleId) {
        let specs: Vec<JointSpec> = self.joints.iter().map(|(_, record)| record.spec).collect();
        let holds = |end: JointEnd| end.obstacle().is_some_and(|(id, _)| id == obstacle);
        for spec in specs.into_iter().filter(|spec| holds(spec.a) || holds(spec.b)) {
            self.wake_up_joined(&spec);
        }
    }

    /// Wakes who is joined to something that moves, and who a joint drives too slowly to stay awake.
    pub(crate) fn wake_up_joints(&mut self) {
        let is_moving = |organism: &Organism, world: &Self| {
            let lane = organism.body.lane(&world.blocks);
            lane.is_none_or(|(block, lane)| world.sleep.is_moving(block as usize, lane))
        };
        let wakes = |spec: &JointSpec, world: &Self| {
            let organisms = [spec.a, spec.b].into_iter().filter_map(JointEnd::organism);
            let mut obstacles = [spec.a, spec.b].into_iter().filter_map(JointEnd::obstacle);
            let is_carried = obstacles.any(|(id, _)| world.obstacle_target(id).is_some());
            let mut organisms = organisms.filter_map(|id| world.organisms.get(id));
            is_carried || organisms.any(|organism| is_moving(organism, world) || world.is_driven(organism, spec.kind))
        };
        let mut specs: Vec<JointSpec> = self.joints.iter().map(|(_, record)| record.spec).collect();
        // Until nothing else is woken: a chain of joints wakes from any end, whatever their order.
        loop {
            let (waking, others): (Vec<_>, Vec<_>) = specs.into_iter().partition(|spec| wakes(spec, self));
            waking.iter().for_each(|spec| self.wake_up_joined(spec));
            specs = others;
            if waking.is_empty() || specs.is_empty() {
                break;
            }
        }
    }

    /// Whether a joint moves a body that need not be faster than the sleep speed for that.
    fn is_driven(&self, organism: &Organism, kind: JointKind) -> bool {
        match kind {
            JointKind::SpeedMotor { speed, .. } => speed != 0.0,
            JointKind::Spring { .. } | JointKind::Mouse { .. } | JointKind::LengthMotor { .. } => {
                let list: Vec<u32> = organism.particles().collect();
                let speed = MassProperties::of(&self.particles, &list).map_or(0.0, |body| body.velocity.length());
                speed > LEAST_DRIVEN_SPEED
            }
            _ => false,
        }
    }

    /// Hands the joints to the solver for a step: those of which an end is awake.
    pub(crate) fn gather_joints(&mut self) {
        let mut gathered = std::mem::take(&mut self.scratch.joints);
        gathered.clear();
        self.scratch.joined.clear();
        for (handle, record) in self.joints.iter() {
            let (Some(a), Some(b)) =
                (self.end(record, 0, &mut gathered.particles), self.end(record, 1, &mut gathered.particles))
            else {
                continue;
            };
            let moves = |end: &End| matches!(end, End::Particles { is_static: false, .. });
            if moves(&a) || moves(&b) {
                self.scratch.joined.push(handle);
                let held = [record.spec.a, record.spec.b].map(JointEnd::obstacle).into_iter().enumerate();
                let held = held.filter_map(|(end, held)| Some((end, held?)));
                gathered.held.extend(held.map(|(end, (id, at))| Held {
                    joint: gathered.list.len(),
                    end,
                    obstacle: id.index + WALLS as u32,
                    at,
                }));
                gathered.list.push(Joint {
                    ends: [a, b],
                    shift: self.joint_shift(record),
                    law: record.law(),
                    force: 0.0,
                    lambda: 0.0,
                    is_broken: false,
                });
            }
        }
        self.scratch.joints = gathered;
    }

    /// An end as the solver sees it. Its particles are added to a list.
    fn end(&self, record: &JointRecord, k: usize, list: &mut Vec<u32>) -> Option<End> {
        if record.end(k).organism().is_none() {
            return self.end_position(record, k).map(|at| End::place(at, Vec2::ZERO));
        }
        let particles = self.end_particles(record, k).filter(|particles| !particles.is_empty())?;
        let first = list.len();
        let organism = self.organisms.get(record.end(k).organism()?)?;
        let is_asleep = organism.body.lane(&self.blocks).is_some_and(|(block, _)| self.sleep.is_asleep(block));
        let is_static = is_asleep || !self.can_move(&particles);
        list.extend(particles);
        Some(End::Particles { range: first..list.len(), is_static })
    }

    /// Notes that some particles are gone, as their indices may be handed out again: joints to them end in the next step.
    pub(in crate::world) fn lose_joints(&mut self, gone: impl Fn(u32) -> bool) {
        let holds = |record: &JointRecord| record.particles.iter().flatten().any(|&particle| gone(particle));
        let lost: Vec<_> = self.joints.iter().filter(|(_, it)| holds(it)).map(|(handle, _)| handle).collect();
        for handle in lost {
            if let Some(record) = self.joints.get_mut(handle) {
                record.particles = [None; 2];
            }
        }
    }

    /// Notes the forces of a step; removes what broke and what has lost somebody.
    pub(crate) fn conclude_joints(&mut self) {
        for (handle, solved) in self.scratch.joined.iter().zip(&self.scratch.joints.list) {
            if let Some(record) = self.joints.get_mut(*handle) {
                record.force = if solved.force < f32::MAX { solved.force } else { f32::MAX };
            }
            if solved.is_broken
                && let Some(record) = self.joints.remove(*handle)
            {
                self.events.push(Event::JointBroken { joint: JointId::of(*handle), between: record.organisms() });
            }
        }
        let is_gone = |particle: u32| self.particles.is_new(particle as usize);
        let has_gone = |record: &JointRecord| record.particles.into_iter().flatten().any(is_gone);
        let is_lost =
            |record: &JointRecord| has_gone(record) || (0..2).any(|k| self.end_particles(record, k).is_none());
        let lost: Vec<_> = self.joints.iter().filter(|(_, it)| is_lost(it)).map(|(handle, _)| handle).collect();
        for handle in lost {
            let Some(record) = self.joints.remove(handle) else { continue };
            self.wake_up_joined(&record.spec);
            self.events.push(Event::JointEnded { joint: JointId::of(handle), between: record.organisms() });
        }
    }
}

impl JointRecord {
    fn end(&self, k: usize) -> JointEnd {
        [self.spec.a, self.spec.b][k]
    }

    fn organisms(&self) -> [Option<OrganismId>; 2] {
        [self.spec.a, self.spec.b].map(JointEnd::organism)
    }

    fn law(&self) -> Law {
        let law = match self.spec.kind {
            JointKind::Pin => Law::rigid(0.0),
            JointKind::Distance { length } => Law::rigid(length),
            JointKind::Weld => Law::rigid(self.length),
            JointKind::Rope { max_length } => Law { only_pulls: true, ..Law::rigid(max_length) },
            JointKind::Spring { length, frequency, damping_ratio } => {
                Law { spring: Some([frequency, damping_ratio]), ..Law::rigid(length) }
            }
            JointKind::Mouse { frequency, damping_ratio, max_force } => {
                Law { spring: Some([frequency, damping_ratio]), max_force, ..Law::rigid(0.0) }
            }
            JointKind::LengthMotor { length, max_force } => Law { max_force, ..Law::rigid(length) },
            JointKind::SpeedMotor { speed, max_force } => Law { speed: Some(speed), max_force, ..Law::rigid(0.0) },
        };
        Law { break_force: self.spec.break_force, ..law }
    }
}
