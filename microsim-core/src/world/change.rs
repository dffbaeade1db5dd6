//! Changes from outside, as data: what a program does to a world between two steps, so that a replay can repeat it.

use super::World;
use crate::capability::controller::Controller;
use crate::capability::division::Order;
use crate::capability::exchange::Exchange;
use crate::capability::phagocytosis::PhagocytosisParams;
use crate::chemical::ChemicalSpec;
use crate::collider::ContactReporting;
use crate::collision::obstacle_record::{ObstacleRecord, PoseRecord};
use crate::force_field::ForceField;
use crate::id::{DrainId, EmitterId, FieldId, JointId, ObstacleId, OrganismId};
use crate::joint::JointSpec;
use crate::organism::{OrganismSpec, Placement};
use crate::particle::CollisionGroups;
use crate::supply::{Drain, Emitter, Recipe};
use crate::template::Template;
#[cfg(all(feature = "scenario", feature = "snapshot"))]
use crate::{collision::obstacle_record::pose_of, id::TemplateId};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// One change that succeeded, named as the function that made it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum WorldChange {
    AddTemplate(Box<Template>),
    Spawn(Box<(OrganismSpec, Placement)>),
    SpawnTemplate(u32, Box<Placement>),
    Remove(OrganismId),
    SetExempt([OrganismId; 2], bool),
    SetController(OrganismId, Box<Controller>),
    SetGravityScale(OrganismId, f32),
    SetUserData(OrganismId, [u64; 2]),
    SetCollisionGroups(OrganismId, CollisionGroups),
    Push(OrganismId, Vec2),
    Grow(OrganismId, u32, u32),
    /// To divide or to fuse.
    Order(OrganismId, Order),
    AddChemical(ChemicalSpec),
    SetExchange(OrganismId, Exchange),
    AddObstacle(Box<ObstacleRecord>),
    /// The whole obstacle, with its new pose, shape or presence.
    SetObstacle(ObstacleId, Box<ObstacleRecord>),
    MoveObstacle(ObstacleId, PoseRecord),
    RemoveObstacle(ObstacleId),
    AddJoint(JointSpec),
    SetJoint(JointId, JointSpec),
    RemoveJoint(JointId),
    AddField(ForceField),
    SetField(FieldId, ForceField),
    RemoveField(FieldId),
    SetGravity(Vec2),
    SetDamping(f32),
    SetMaxSpeed(f32),
    SetContactReporting(Option<ContactReporting>),
    AddEmitter(Box<Emitter>),
    SetEmitter(EmitterId, Box<Emitter>),
    RemoveEmitter(EmitterId),
    AddDrain(Drain),
    SetDrain(DrainId, Drain),
    RemoveDrain(DrainId),
    SetScale(OrganismId, f32),
    Replace(OrganismId, Box<(Recipe, Placement)>),
    /// One that has no record: an obstacle of a shape that cannot be written.
    Unrecordable,
    Shrink(OrganismId, u32),
    SetSpeed(OrganismId, f32),
    SetPhagocytosis(OrganismId, Box<PhagocytosisParams>),
    SetLinearDamping(OrganismId, f32),
    SetAngularDamping(OrganismId, f32),
    SetSize(Vec2),
    SetMass(OrganismId, f32),
}

/// The changes since the last step, and those before it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Changes {
    is_recording: bool,
    pending: Vec<WorldChange>,
    before_last_step: Vec<WorldChange>,
}

impl Changes {
    /// Those between the last step and the one before it.
    #[cfg_attr(not(all(feature = "scenario", feature = "snapshot")), allow(dead_code, reason = "for replays"))]
    pub(crate) fn before_last_step(&self) -> &[WorldChange] {
        &self.before_last_step
    }

    /// Whether something was changed since the last step.
    #[cfg_attr(not(all(feature = "scenario", feature = "snapshot")), allow(dead_code, reason = "for replays"))]
    pub(crate) fn is_pending(&self) -> bool {
        !self.pending.is_empty()
    }

    /// Begins a step. What is changed within is not from outside.
    pub(crate) fn begin_step(&mut self) {
        self.before_last_step = std::mem::take(&mut self.pending);
    }

    /// Ends a step.
    pub(crate) fn end_step(&mut self) {
        self.pending.clear();
    }
}

impl World {
    /// Starts or stops noting what is changed by other calls than steps, so that a replay repeats it. The world of a built
    /// scenario notes changes, but for those that its script makes. Returns whether they were noted before.
    pub fn record_changes(&mut self, is_recording: bool) -> bool {
        std::mem::replace(&mut self.changes.is_recording, is_recording)
    }

    /// To be called after every change from outside: what was made for queries is out of date.
    pub(in crate::world) fn changed(&mut self, change: impl FnOnce() -> WorldChange) {
        self.scratch.query_index.clear();
        if self.changes.is_recording {
            self.changes.pending.push(change());
        }
    }
}

#[cfg(all(feature = "scenario", feature = "snapshot"))]
impl WorldChange {
    /// Makes the change again; `None` if the world refuses it.
    pub(crate) fn apply(&self, world: &mut World) -> Option<()> {
        match self.clone() {
            Self::AddTemplate(template) => drop(world.add_template(*template)),
            Self::Spawn(spawned) => drop(world.spawn(&spawned.0, spawned.1).ok()?),
            Self::SpawnTemplate(template, at) => drop(world.spawn_template(TemplateId(template), *at).ok()?),
            Self::Remove(id) => world.remove(id).ok()?,
            Self::SetExempt([a, b], is_exempt) => world.set_exempt(a, b, is_exempt).ok()?,
            Self::SetController(id, controller) => world.set_controller(id, *controller).ok()?,
            Self::SetGravityScale(id, scale) => world.set_gravity_scale(id, scale).ok()?,
            Self::SetUserData(id, [low, high]) => {
                world.set_user_data(id, u128::from(low) | (u128::from(high) << 64)).ok()?;
            }
            Self::SetCollisionGroups(id, groups) => world.set_collision_groups(id, groups).ok()?,
            Self::SetScale(id, scale) => world.set_scale(id, scale).ok()?,
            Self::Replace(id, new) => drop(world.replace(id, &new.0, new.1).ok()?),
            Self::Push(id, velocity) => world.push(id, velocity).ok()?,
            Self::Grow(id, nodes, particles) => world.grow(id, nodes, particles).ok()?,
            // The direction of a furrow was normalised when it was given.
            Self::Order(_, Order::Divide { axis: Some(axis) }) if !axis.is_normalized() => return None,
            Self::Order(id, order) => world.give_order(id, order).ok()?,
            Self::AddChemical(spec) => drop(world.add_chemical(spec).ok()?),
            Self::SetExchange(id, exchange) => world.set_exchange(id, exchange).ok()?,
            Self::AddObstacle(record) => drop(world.add_obstacle(record.restore()?).ok()?),
            Self::SetObstacle(id, record) => {
                let obstacle = record.restore()?;
                world.change_obstacle(id, |place| *place = obstacle).ok()?;
            }
            Self::MoveObstacle(id, target) => world.move_obstacle(id, pose_of(target)?).ok()?,
            Self::RemoveObstacle(id) => world.remove_obstacle(id).ok()?,
            Self::AddJoint(spec) => drop(world.add_joint(spec).ok()?),
            Self::SetJoint(id, spec) => world.set_joint(id, spec).ok()?,
            Self::RemoveJoint(id) => world.remove_joint(id).ok()?,
            Self::AddField(field) => drop(world.add_field(field).ok()?),
            Self::SetField(id, field) => world.set_field(id, field).ok()?,
            Self::RemoveField(id) => world.remove_field(id).ok()?,
            Self::AddEmitter(emitter) => drop(world.add_emitter(*emitter).ok()?),
            Self::SetEmitter(id, emitter) => world.set_emitter(id, *emitter).ok()?,
            Self::RemoveEmitter(id) => world.remove_emitter(id).ok()?,
            Self::AddDrain(drain) => drop(world.add_drain(drain).ok()?),
            Self::SetDrain(id, drain) => world.set_drain(id, drain).ok()?,
            Self::RemoveDrain(id) => world.remove_drain(id).ok()?,
            Self::SetGravity(gravity) => world.set_gravity(gravity).ok()?,
            Self::SetDamping(damping) => world.set_damping(damping).ok()?,
            Self::SetMaxSpeed(speed) => world.set_max_speed(speed).ok()?,
            Self::SetContactReporting(reporting) => world.set_contact_reporting(reporting).ok()?,
            Self::Unrecordable => return None,
            Self::Shrink(id, particles) => world.shrink(id, particles).ok()?,
            Self::SetSpeed(id, speed) => world.set_speed(id, speed).ok()?,
            Self::SetPhagocytosis(id, params) => world.set_phagocytosis(id, *params).ok()?,
            Self::SetLinearDamping(id, damping) => world.set_linear_damping(id, damping).ok()?,
            Self::SetAngularDamping(id, damping) => world.set_angular_damping(id, damping).ok()?,
            Self::SetSize(size) => world.set_size(size).ok()?,
            Self::SetMass(id, mass) => world.set_mass(id, mass).ok()?,
        }
        Some(())
    }
}
