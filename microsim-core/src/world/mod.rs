//! The world owns all state. What it can do is in files of their own: spawning, obstacles, queries, eating
//! ([`phagocytosis`]), division, fusion and growth ([`membrane`]), [`measure`]s, the [`view`], digest and validation
//! ([`state`]).

pub(crate) mod change;
mod chemical;
pub(crate) mod contact_report;
pub(crate) mod contacts;
mod controller;
mod cut;
mod force_field;
mod grip;
mod guard;
mod inputs;
pub(crate) mod joint;
mod mass;
pub(crate) mod measure;
mod membrane;
mod muscle;
pub(crate) mod obstacle;
mod occupancy;
mod own_medium;
mod periodic;
mod phagocytosis;
mod push;
mod quarantine;
pub(crate) mod query;
mod replace;
mod scale;
mod settings;
mod size;
mod spawn;
pub(crate) mod state;
pub(crate) mod supply;
mod template;
mod thermal;
mod vacancies;
pub(crate) mod view;
mod wake;
mod yielding;

use crate::arena::{Arena, Handle};
use crate::chemical::Chemical;
use crate::collision::broad_phase::BroadPhase;
use crate::collision::exemptions::Exemptions;
use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_path::ObstaclePath;
use crate::config::WorldConfig;
use crate::error::{Error, ErrorKind};
use crate::event::Event;
use crate::float_environment::with_default_float_environment;
use crate::force_field::ForceField;
use crate::id::OrganismId;
use crate::instruction_set::{Dispatch, InstructionSet};
use crate::kind::Kind;
use crate::organism::Organism;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::particle::sleep::Sleep;
use crate::shared::Shared;
use crate::solver::block::Block;
use crate::solver::contact::Impact;
use crate::solver::contact_record::ContactRecorder;
use crate::solver::contraction::Contraction;
use crate::solver::disc_contacts::DiscContacts;
use crate::solver::drive::{Drive, Tow, Traction};
use crate::solver::fluid::{self, Fluid};
use crate::solver::force::Forces;
use crate::solver::joint::Joints;
use crate::supply::Drain;
use crate::template::Template;
use crate::template::projection::Projection;
use change::{Changes, WorldChange};
use contact_report::ContactReports;
use contacts::Touching;
use glam::Vec2;
pub(crate) use guard::{Guard, MOST_COUNTED, count};
use joint::JointRecord;
use obstacle::sensor::Presences;
use obstacle::table::ObstacleTable;
use occupancy::Occupancy;
use query::QueryIndex;
use serde::Serialize;
use supply::EmitterRecord;
use vacancies::Vacancies;

/// A room with organisms in it. Cloning it is a snapshot: the clone has the same future and answers every question alike.
///
/// A clone shares with its original what neither has changed since; positions and velocities are copied. To save often
/// and go back now and then, as rollback does, keep a ring of worlds and use `clone_from` both ways: it copies into the
/// memory that is there.
///
/// ```
/// # use microsim_core::{AgarSpec, Inputs, Placement, World, WorldConfig};
/// # let mut world = World::new(WorldConfig::default())?;
/// # world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
/// let mut ring = vec![world.clone(); 8];
/// for step in 0..20 {
///     ring[step % 8].clone_from(&world);
///     world.step(&Inputs::new());
/// }
/// world.clone_from(&ring[15 % 8]);
/// assert_eq!(world.step_index(), 15);
/// # Ok::<(), microsim_core::Error>(())
/// ```
///
/// A serialised world has a digest in place of each obstacle's shape; feature `snapshot` writes the shapes too.
#[derive(Debug, Serialize)]
pub struct World {
    pub(crate) step_index: u64,
    pub(crate) config: WorldConfig,
    pub(crate) particles: Particles,
    pub(crate) organisms: Organisms,
    pub(crate) templates: Shared<Vec<Template>>,
    pub(crate) blocks: Shared<Vec<Block>>,
    pub(crate) sleep: Sleep,
    pub(crate) fluids: Vec<Fluid>,
    pub(crate) chemicals: Vec<Chemical>,
    pub(crate) exemptions: Exemptions,
    pub(crate) touching: Touching,
    pub(crate) events: Vec<Event>,
    pub(crate) guard: Guard,
    pub(crate) joints: Arena<Box<JointRecord>>,
    pub(crate) fields: Arena<Box<ForceField>>,
    pub(crate) obstacle_table: ObstacleTable,
    presences: Presences,
    pub(crate) contact_reports: ContactReports,
    pub(crate) emitters: Arena<Box<EmitterRecord>>,
    pub(crate) drains: Arena<Box<Drain>>,
    /// Of each template.
    #[serde(skip)]
    pub(crate) projections: Shared<Vec<Projection>>,
    /// The walls, then those of the table.
    #[serde(skip)]
    pub(crate) obstacles: Shared<Vec<Obstacle>>,
    #[serde(skip)]
    pub(crate) changes: Changes,
    #[serde(skip)]
    pub(crate) scratch: Scratch,
    #[serde(skip)]
    pub(crate) dispatch: Dispatch,
}

/// Buffers of a step, which the next one does not need, and what spares spawning a search. Of them, a clone has the pairs that
/// were found.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub broad_phase: BroadPhase,
    /// Of the obstacles that move in this step, in their order.
    pub obstacle_paths: Vec<ObstaclePath>,
    pub fluid: fluid::Workspace,
    pub drives: Vec<Drive>,
    /// Of crawling cells where the slide gives no grip.
    pub tractions: Vec<Traction>,
    pub tows: Vec<Tow>,
    pub contractions: Vec<Contraction>,
    pub forces: Forces,
    pub joints: Joints,
    /// The handle of each of these joints.
    pub joined: Vec<Handle>,
    pub impacts: Vec<Impact>,
    pub disc_contacts: DiscContacts,
    pub contact_records: ContactRecorder,
    pub occupancy: Occupancy,
    pub vacancies: Vacancies,
    pub query_index: QueryIndex,
}

impl Scratch {
    /// Takes over the pairs that another world's search found, and forgets the rest.
    fn share_pairs_of(&mut self, other: &Self) {
        self.broad_phase.share_pairs_of(&other.broad_phase);
        self.occupancy.clear();
        self.vacancies.clear();
        self.query_index.clear();
        self.query_index.clear_obstacles();
    }
}

impl Clone for World {
    fn clone(&self) -> Self {
        let mut clone = Self::of(self.config.clone(), self.obstacles.clone());
        clone.clone_from(self);
        clone
    }

    fn clone_from(&mut self, source: &Self) {
        let Self {
            step_index,
            config,
            particles,
            organisms,
            templates,
            blocks,
            sleep,
            fluids,
            chemicals,
            exemptions,
            touching,
            events,
            guard,
            joints,
            fields,
            obstacle_table,
            presences,
            contact_reports,
            emitters,
            drains,
            projections,
            obstacles,
            changes,
            scratch,
            dispatch,
        } = source;
        self.step_index = *step_index;
        self.config.clone_from(config);
        self.particles.clone_from(particles);
        self.organisms.clone_from(organisms);
        self.templates.clone_from(templates);
        self.blocks.clone_from(blocks);
        self.sleep.clone_from(sleep);
        self.fluids.clone_from(fluids);
        self.chemicals.clone_from(chemicals);
        self.exemptions.clone_from(exemptions);
        self.touching.clone_from(touching);
        self.events.clone_from(events);
        self.guard = *guard;
        self.joints.clone_from(joints);
        self.fields.clone_from(fields);
        self.obstacle_table.clone_from(obstacle_table);
        self.presences.clone_from(presences);
        self.contact_reports.clone_from(contact_reports);
        self.emitters.clone_from(emitters);
        self.drains.clone_from(drains);
        self.projections.clone_from(projections);
        self.obstacles.clone_from(obstacles);
        self.changes.clone_from(changes);
        self.scratch.share_pairs_of(scratch);
        self.dispatch = *dispatch;
    }
}

impl World {
    /// An empty room.
    ///
    /// # Errors
    /// Names the field of `config` that is out of range.
    pub fn new(config: WorldConfig) -> Result<Self, Error> {
        let walls = with_default_float_environment(|| config.validate().map(|()| obstacle::walls(&config)))?;
        Ok(Self::of(config, Shared::new(walls)))
    }

    /// A room with these obstacles.
    fn of(config: WorldConfig, obstacles: Shared<Vec<Obstacle>>) -> Self {
        Self {
            obstacles,
            config,
            particles: Particles::default(),
            templates: Shared::default(),
            projections: Shared::default(),
            obstacle_table: ObstacleTable::default(),
            presences: Presences::default(),
            contact_reports: ContactReports::default(),
            emitters: Arena::default(),
            drains: Arena::default(),
            blocks: Shared::default(),
            sleep: Sleep::default(),
            fluids: Vec::new(),
            chemicals: Vec::new(),
            exemptions: Exemptions::default(),
            organisms: Organisms::default(),
            touching: Touching::default(),
            events: Vec::new(),
            step_index: 0,
            guard: Guard::default(),
            joints: Arena::default(),
            fields: Arena::default(),
            changes: Changes::default(),
            // It holds a density, the fluid's at rest.
            scratch: with_default_float_environment(Scratch::default),
            dispatch: Dispatch::default(),
        }
    }

    /// Restricts the processor instructions that steps use, for measuring times; results do not depend on it.
    pub fn set_instruction_set(&mut self, set: InstructionSet) {
        self.dispatch = Dispatch::new(set);
    }

    /// What happened in the last step.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Settings that the world was made with.
    #[must_use]
    pub fn config(&self) -> &WorldConfig {
        &self.config
    }

    /// Number of steps taken.
    #[must_use]
    pub fn step_index(&self) -> u64 {
        self.step_index
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.step_index as f64 * f64::from(self.config.dt)
    }

    /// Lets two organisms pass through each other, or collide again.
    ///
    /// # Errors
    /// When a handle is stale, both name the same organism, or one has taken the other in, which would fall out.
    pub fn set_exempt(&mut self, a: OrganismId, b: OrganismId, is_exempt: bool) -> Result<(), Error> {
        self.organism_or_stale(a, "a")?;
        self.organism_or_stale(b, "b")?;
        if a == b {
            return Err(Error::unsupported("b", "another organism: a membrane holds its own cytoplasm"));
        }
        if is_exempt && (self.holder_of(a) == Some(b) || self.holder_of(b) == Some(a)) {
            return Err(Error::unsupported(
                "b",
                "neither prey inside `a` nor the cell that holds it: it would fall out",
            ));
        }
        self.exemptions.set(a.index, b.index, is_exempt);
        self.wake_up(a);
        self.wake_up(b);
        self.changed(|| WorldChange::SetExempt([a, b], is_exempt));
        Ok(())
    }

    /// Handles of all organisms, in a stable order.
    pub fn organisms(&self) -> impl Iterator<Item = OrganismId> + '_ {
        self.organisms.iter().map(|(id, _)| id)
    }

    /// What an organism is; `None` for a stale handle.
    #[must_use]
    pub fn kind(&self, id: OrganismId) -> Option<Kind> {
        self.organisms.get(id).map(|organism| organism.kind)
    }

    /// Centre of an organism: the area centroid of its outline, or its particles' mean. `None` for a stale handle.
    #[must_use]
    pub fn centroid(&self, id: OrganismId) -> Option<Vec2> {
        Some(self.view().organism(id)?.centroid())
    }

    /// The discs of an organism that can move.
    pub(in crate::world) fn discs_of(&self, id: OrganismId) -> impl Iterator<Item = usize> + '_ {
        let particles = self.organisms.get(id).into_iter().flat_map(Organism::particles).map(|i| i as usize);
        particles.filter(|&i| self.particles.inv_mass[i] > 0.0)
    }

    fn holder_of(&self, id: OrganismId) -> Option<OrganismId> {
        self.organisms.get(id)?.prey?.held_by
    }

    pub(crate) fn organism_or_stale(&self, id: OrganismId, field: &str) -> Result<(), Error> {
        self.organisms.get(id).map(drop).ok_or_else(|| Error::new(ErrorKind::Stale, field))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Controller, Inputs, Placement, PlateletSpec, ProbeSpec};

    #[test]
    fn a_step_leaves_shared_with_clones_what_it_does_not_change() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let platelet = world.spawn(&PlateletSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        let to = Controller::patrol(vec![Vec2::new(60.0, 40.0)], false);
        let probe = world.spawn(&ProbeSpec::default().into(), Placement::at(30.0, 40.0).steered_by(to)).unwrap();
        let clone = world.clone();
        (0..10).for_each(|_| world.step(&Inputs::new()));
        let (p, q) = (&world.particles, &clone.particles);
        let is_shared = |a: &Shared<Vec<f32>>, b: &Shared<Vec<f32>>| std::ptr::eq(&**a, &**b);
        assert!(is_shared(&p.inv_mass, &q.inv_mass));
        assert!(is_shared(&p.radius, &q.radius) && std::ptr::eq(&*p.groups, &*q.groups));
        assert!(std::ptr::eq(&*p.owner, &*q.owner) && std::ptr::eq(&*p.next_in_ring, &*q.next_in_ring));
        assert!(std::ptr::eq(&*world.blocks, &*clone.blocks) && std::ptr::eq(&*world.templates, &*clone.templates));
        let organism = |world: &World, id| std::ptr::from_ref(world.organisms.get(id).unwrap());
        assert_eq!(organism(&world, platelet), organism(&clone, platelet));
        assert_ne!(organism(&world, probe), organism(&clone, probe), "it has chosen a goal");
    }
}
