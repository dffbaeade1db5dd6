//! A world from state that was read: derived parts are rebuilt, and everything that stepping relies on is checked
//! ([`super::validate::structure`], [`super::validate::numbers`]).

use super::validate;
use crate::arena::Arena;
use crate::chemical;
use crate::collision::exemptions::Exemptions;
use crate::collision::obstacle::Obstacle;
use crate::config::WorldConfig;
use crate::event::Event;
use crate::force_field::ForceField;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::particle::sleep::Sleep;
use crate::shared::Shared;
use crate::solver::block::Block;
use crate::solver::fluid::Fluid;
use crate::supply::Drain;
use crate::template::Template;
use crate::template::projection::Projection;
use crate::world::contact_report::ContactReports;
use crate::world::contacts::Touching;
use crate::world::joint::JointRecord;
use crate::world::obstacle::sensor::Presences;
use crate::world::obstacle::table::ObstacleTable;
use crate::world::supply::EmitterRecord;
use crate::world::{Guard, World};
use serde::Deserialize;

/// The serialised fields of a [`World`].
#[derive(Debug, Deserialize)]
pub(crate) struct WorldState {
    step_index: u64,
    config: WorldConfig,
    particles: Particles,
    organisms: Organisms,
    templates: Vec<Template>,
    blocks: Vec<Block>,
    sleep: Sleep,
    fluids: Vec<Fluid>,
    chemicals: Vec<chemical::ChemicalRecord>,
    exemptions: Exemptions,
    touching: Touching,
    events: Vec<Event>,
    guard: Guard,
    joints: Arena<Box<JointRecord>>,
    fields: Arena<Box<ForceField>>,
    obstacle_table: ObstacleTable,
    presences: Presences,
    contact_reports: ContactReports,
    emitters: Arena<Box<EmitterRecord>>,
    drains: Arena<Box<Drain>>,
}

impl World {
    /// The world of this state with these obstacles.
    ///
    /// # Errors
    /// Says which part of the state cannot be one of a world.
    pub(crate) fn restore(state: WorldState, obstacles: Vec<Obstacle>) -> Result<Self, String> {
        let mut world = Self::new(state.config).map_err(|error| error.within("config").to_string())?;
        world.restore_obstacles(state.obstacle_table, obstacles)?;
        world.presences = state.presences;
        world.restore_contact_reports(state.contact_reports)?;
        for (k, record) in state.chemicals.into_iter().enumerate() {
            let added = world.add_chemical(record.spec).map_err(|error| error.to_string()).map(drop);
            let filled = added.and_then(|()| world.chemicals[k].restore(record, &world.config));
            filled.map_err(|flaw| format!("chemicals[{k}]: {flaw}"))?;
        }
        world.step_index = state.step_index;
        world.particles = state.particles;
        world.organisms = state.organisms;
        world.templates = Shared::new(state.templates);
        world.blocks = Shared::new(state.blocks);
        world.sleep = state.sleep;
        world.fluids = state.fluids;
        world.exemptions = state.exemptions;
        world.touching = state.touching;
        world.events = state.events;
        world.guard = state.guard;
        world.joints = state.joints;
        world.fields = state.fields;
        world.emitters = state.emitters;
        world.drains = state.drains;
        world.particles.restore_skipped()?;
        world.organisms.complete();
        validate::structure::check(&world)
            .and_then(|()| validate::numbers::check(&world))
            .map_err(|violation| violation.to_string())?;
        let h = world.config.substep();
        world.projections = Shared::new(world.templates.iter().map(|template| Projection::new(template, h)).collect());
        // Measures need the pairs of the last step, which are not part of the state.
        if world.step_index > 0 {
            world.find_pairs();
        }
        Ok(world)
    }
}
