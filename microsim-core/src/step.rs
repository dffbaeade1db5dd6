//! The step, as a table of contents. Every phase is one function elsewhere; the names are those of [`Phase`].

use crate::behavior::{draw_in_prey, steer_organisms};
use crate::capability::controller;
use crate::collision::broad_phase::Surroundings;
use crate::inputs::Inputs;
use crate::organism::table::Organisms;
use crate::solver::membrane::Membrane;
use crate::solver::{block, contact, drive, integrate, obstacle};
use crate::world::World;

/// One phase of the step, in their order. Those from `PredictPositions` to `UpdateVelocities` run once per substep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Phase {
    /// Inputs and controllers become the velocities that organisms give to their own particles.
    SteerOrganisms,
    /// Pairs that may touch before the next step are found.
    FindPairs,
    /// Velocities are applied and limited, positions predicted.
    PredictPositions,
    /// Fluid returns to its density; viscosity.
    ProjectFluids,
    /// Constraints: blocks in lanes, then loose bodies.
    ProjectConstraints,
    /// Discs and obstacles push each other apart.
    ProjectContacts,
    /// What has moved gets the velocity of its move; restitution.
    UpdateVelocities,
    /// Prey is touched, taken in and digested; engulfers grow.
    AdvancePhagocytosis,
    /// Contacts become events, and what is no longer finite is frozen.
    Conclude,
}

impl Phase {
    /// All phases, in their order.
    pub const ALL: [Self; 9] = [
        Self::SteerOrganisms,
        Self::FindPairs,
        Self::PredictPositions,
        Self::ProjectFluids,
        Self::ProjectConstraints,
        Self::ProjectContacts,
        Self::UpdateVelocities,
        Self::AdvancePhagocytosis,
        Self::Conclude,
    ];

    /// Name in benchmarks and output.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SteerOrganisms => "steer_organisms",
            Self::FindPairs => "find_pairs",
            Self::PredictPositions => "predict_positions",
            Self::ProjectFluids => "project_fluids",
            Self::ProjectConstraints => "project_constraints",
            Self::ProjectContacts => "project_contacts",
            Self::UpdateVelocities => "update_velocities",
            Self::AdvancePhagocytosis => "advance_phagocytosis",
            Self::Conclude => "conclude",
        }
    }
}

pub(crate) fn advance(world: &mut World, inputs: &Inputs, finished: &mut impl FnMut(Phase)) {
    world.events.clear();
    steer(world, inputs);
    finished(Phase::SteerOrganisms);
    find_pairs(world);
    finished(Phase::FindPairs);
    let h = world.config.substep();
    for _ in 0..world.config.substeps {
        predict_positions(world, h);
        finished(Phase::PredictPositions);
        // Fluid before constraints: the membrane has the last word over its cytoplasm.
        project_fluids(world, h);
        finished(Phase::ProjectFluids);
        project_constraints(world, h);
        finished(Phase::ProjectConstraints);
        // Contacts last, walls after discs: the last projection wins, and nothing may end a substep inside anything.
        project_contacts(world);
        finished(Phase::ProjectContacts);
        update_velocities(world, h);
        finished(Phase::UpdateVelocities);
    }
    world.advance_phagocytosis();
    finished(Phase::AdvancePhagocytosis);
    conclude(world);
    finished(Phase::Conclude);
    world.step_index += 1;
}

fn steer(world: &mut World, inputs: &Inputs) {
    let World { config, particles, organisms, fluids, events, scratch, .. } = world;
    let surroundings = controller::Surroundings { size: config.size, dt: config.dt };
    steer_organisms(organisms, inputs, particles, &surroundings, &mut scratch.drives, events);
    draw_in_prey(organisms, particles, &mut scratch.drives);
    for (_, organism) in organisms.iter_mut() {
        organism.relax_membrane(particles, fluids, config.dt);
    }
}

fn find_pairs(world: &mut World) {
    let World { config, particles, obstacles, exemptions, scratch, .. } = world;
    let (size, reach) = (config.size, config.reach());
    scratch.broad_phase.find_pairs(Surroundings { particles, obstacles, exemptions, size, reach });
}

fn predict_positions(world: &mut World, h: f32) {
    let World { config, particles, scratch, dispatch, .. } = world;
    drive::apply(&scratch.drives, particles, h);
    integrate::in_stretches(
        particles,
        *dispatch,
        #[inline(always)]
        |stretch| integrate::predict_positions(stretch, config.gravity, config.max_speed, h),
    );
}

fn project_fluids(world: &mut World, h: f32) {
    for fluid in world.fluids.iter_mut().filter(|fluid| !fluid.particles.is_empty()) {
        fluid.project(&mut world.particles, world.config.size, h, world.dispatch);
    }
}

fn project_constraints(world: &mut World, h: f32) {
    let World { particles, templates, blocks, organisms, dispatch, .. } = world;
    let constraints = |template: u32| templates[template as usize].constraints();
    block::project(blocks, constraints, particles, h, *dispatch);
    for (membrane, ring) in membranes(organisms) {
        membrane.project(ring, particles, h);
    }
}

/// All membranes with their rings.
fn membranes(organisms: &Organisms) -> impl Iterator<Item = (&Membrane, &[u32])> {
    organisms.iter().filter_map(|(_, organism)| Some((organism.body.membrane()?, organism.outline.as_slice())))
}

fn project_contacts(world: &mut World) {
    let World { particles, obstacles, organisms, scratch, .. } = world;
    let broad_phase = &mut scratch.broad_phase;
    contact::project(&mut broad_phase.contacts, particles, &mut scratch.impacts);
    for (membrane, ring) in membranes(organisms) {
        membrane.limit_strain(ring, particles);
    }
    obstacle::project(&broad_phase.obstacle_contacts, obstacles, particles, &mut scratch.impacts);
}

fn update_velocities(world: &mut World, h: f32) {
    let World { config, particles, scratch, dispatch, .. } = world;
    integrate::in_stretches(
        particles,
        *dispatch,
        #[inline(always)]
        |stretch| integrate::update_velocities(stretch, config.damping, config.max_speed, h),
    );
    contact::apply_restitution(&mut scratch.impacts, particles);
}

fn conclude(world: &mut World) {
    let World { particles, organisms, touching, events, scratch, .. } = world;
    touching.update(&scratch.broad_phase.contacts, particles, organisms, events);
    world.quarantine();
    world.rebase();
}
