//! The step, as a table of contents: the order of its phases, and what each hands to which function elsewhere. The names are
//! those of [`Phase`].

use crate::behavior::{actuation, exchange, furrow_pull, phagocytosis, sensing, steer_organisms};
use crate::capability::controller::senses;
use crate::float_environment::with_default_float_environment;
use crate::inputs::Inputs;
use crate::organism::table::Organisms;
use crate::parallel;
use crate::particle::outside_of;
use crate::solver::block::Block;
use crate::solver::disc_contacts::LinkedBlocks;
use crate::solver::membrane::{self, Membrane};
use crate::solver::{
    block, contact, contraction, drive, integrate, obstacle, repair, ring_contact, speed_limit, stretch_damping,
};
use crate::world::contacts::bound_driven_discs;
use crate::world::{Scratch, World, count};
use glam::Vec2;

/// One phase of the step, in their order. Those from `PredictPositions` to `UpdateVelocities` run once per substep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Phase {
    /// Inputs and controllers become the velocities that organisms give to their own particles.
    SteerOrganisms,
    /// Pairs that may touch in this step are found, blocks that sleep in it, and the neighbours of fluid particles.
    FindPairs,
    /// Velocities are applied and limited, positions of loose particles predicted.
    PredictPositions,
    /// Fluid returns to its density; viscosity.
    ProjectFluids,
    /// Blocks in lanes, their positions predicted and their constraints projected; then constraints of loose bodies.
    ProjectConstraints,
    /// Pairs of bodies that got faster than expected are found; discs and obstacles push each other apart.
    ProjectContacts,
    /// Velocities follow from the changes of position; restitution; links flow and tear.
    UpdateVelocities,
    /// Discs on the wrong side of a membrane are returned; prey is touched, taken in and digested; engulfers grow.
    AdvancePhagocytosis,
    /// Furrows close, cells divide and fuse.
    DivideAndFuse,
    /// Organisms secrete and take up chemicals, which diffuse and decay.
    DiffuseChemicals,
    /// Contacts become events, bodies are cut, organisms that are no longer finite are frozen, origins are moved.
    Conclude,
}

impl Phase {
    /// All phases, in their order.
    pub const ALL: [Self; 11] = [
        Self::SteerOrganisms,
        Self::FindPairs,
        Self::PredictPositions,
        Self::ProjectFluids,
        Self::ProjectConstraints,
        Self::ProjectContacts,
        Self::UpdateVelocities,
        Self::AdvancePhagocytosis,
        Self::DivideAndFuse,
        Self::DiffuseChemicals,
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
            Self::DivideAndFuse => "divide_and_fuse",
            Self::DiffuseChemicals => "diffuse_chemicals",
            Self::Conclude => "conclude",
        }
    }
}

impl World {
    /// Advances the world by [`crate::WorldConfig::dt`]. Cannot fail and does not panic.
    pub fn step(&mut self, inputs: &Inputs) {
        self.step_observed(inputs, |_| {});
    }

    /// The same as [`World::step`]; calls `finished` after each phase, once per substep for those inside the loop. For
    /// measuring times: the core itself reads no clock. It is called in the default floating-point environment.
    pub fn step_observed(&mut self, inputs: &Inputs, mut finished: impl FnMut(Phase) + Send) {
        with_default_float_environment(|| {
            parallel::in_pool(self.particles.len(), || advance(self, inputs, &mut finished));
        });
    }
}

fn advance(world: &mut World, inputs: &Inputs, finished: &mut impl FnMut(Phase)) {
    world.events.clear();
    world.changes.begin_step();
    world.scratch.occupancy.clear();
    world.scratch.query_index.clear();
    world.begin_contact_reports();
    serial(world, |world| steer(world, inputs));
    world.contract_muscles(inputs);
    world.wake_up_joints();
    world.wake_up_in_fields();
    finished(Phase::SteerOrganisms);
    world.plan_obstacle_paths();
    world.find_pairs();
    find_neighbours(world);
    stop_sleepers(world);
    world.find_grips();
    world.gather_joints();
    world.scale_gravity();
    world.damp_organisms();
    world.kick_bodies();
    finished(Phase::FindPairs);
    let h = world.config.substep();
    for substep in 0..world.config.substeps {
        world.apply_fields(h);
        predict_positions(world, h);
        finished(Phase::PredictPositions);
        // Fluid before constraints: the membrane has the last word over its cytoplasm.
        project_fluids(world, h);
        finished(Phase::ProjectFluids);
        world.advance_obstacles();
        project_constraints(world, h, substep);
        finished(Phase::ProjectConstraints);
        // Contacts last, walls after discs: the last projection wins, and nothing may end a substep inside anything.
        project_contacts(world);
        finished(Phase::ProjectContacts);
        update_velocities(world, h);
        world.yield_links(substep, h);
        finished(Phase::UpdateVelocities);
    }
    damp_stretching(world);
    repair_membranes(world);
    world.advance_phagocytosis();
    finished(Phase::AdvancePhagocytosis);
    world.divide_and_fuse();
    finished(Phase::DivideAndFuse);
    diffuse_chemicals(world);
    finished(Phase::DiffuseChemicals);
    conclude(world);
    finished(Phase::Conclude);
    world.changes.end_step();
    count(&mut world.step_index, 1);
}

/// Runs a phase on one thread.
fn serial(world: &mut World, phase: impl FnOnce(&mut World) + Send) {
    parallel::serial(world.particles.len(), || phase(world));
}

fn steer(world: &mut World, inputs: &Inputs) {
    let period = world.period();
    let World { config, particles, organisms, blocks, sleep, fluids, obstacles, chemicals, events, scratch, .. } =
        world;
    let (size, dt, others) = (config.size, config.dt, &sensing::others(organisms, particles));
    let environment = senses::Environment { size, period, dt, chemicals, obstacles, others };
    steer_organisms(organisms, inputs, particles, &environment, &mut scratch.drives, &mut scratch.tows, events);
    let own = scratch.drives.len();
    drive::begin_tows(&scratch.tows, particles);
    phagocytosis::draw_in_prey(organisms, particles, &mut scratch.drives);
    scratch.contractions.clear();
    furrow_pull::draw_furrows(organisms, particles, &mut scratch.drives, &mut scratch.contractions);
    phagocytosis::lips::drive_lips(organisms, particles, &mut scratch.drives, &mut scratch.contractions);
    organisms.for_each_with_membrane(|organism| organism.relax_membrane(particles, fluids, config.dt));
    scratch.forces.clear();
    actuation::actuate(organisms, inputs, particles, &mut scratch.forces, dt, period);
    // An organism with a drive or a force stays awake, even if it is blocked.
    let driven = scratch.drives.iter().map(|drive| (drive.particle, drive.velocity));
    let towed = scratch.tows.iter().map(|tow| (tow.first, tow.velocity));
    let driven = driven.chain(towed).filter(|(_, velocity)| *velocity != Vec2::ZERO).map(|(particle, _)| particle);
    for particle in driven.chain(scratch.forces.particles().iter().copied()) {
        let owner = organisms.id_at(particles.owner[particle as usize]);
        let lane = owner.and_then(|owner| organisms.get(owner)?.body.lane(blocks));
        if let Some((block, lane)) = lane {
            sleep.wake_up(block, lane);
        }
    }
    world.part_with_crawls(own);
}

fn find_neighbours(world: &mut World) {
    let period = world.period();
    let World { config, particles, fluids, organisms, scratch, .. } = world;
    scratch.fluid.scale(fluids.len(), organisms.fluid_scales());
    scratch.fluid.find_neighbours(fluids, particles, config.walls(), period);
}

fn stop_sleepers(world: &mut World) {
    let World { particles, blocks, sleep, .. } = world;
    sleep.stop_sleepers(blocks.iter().map(Block::range), particles);
}

fn predict_positions(world: &mut World, h: f32) {
    let World { config, particles, blocks, scratch, dispatch, .. } = world;
    scratch.forces.apply_damping(particles, h);
    drive::apply_tows(&scratch.tows, particles, config, h);
    drive::apply(&scratch.drives, particles, h);
    drive::pull(&scratch.tractions, particles, h);
    scratch.forces.apply(particles, config.gravity, config.speed_limit(), h);
    let outside = outside_of(blocks.iter().map(Block::range), particles.len());
    integrate::for_each_chunk(
        particles,
        outside,
        *dispatch,
        #[inline(always)]
        |chunk| integrate::predict_positions(chunk, config.gravity, config.speed_limit(), h),
    );
}

fn project_fluids(world: &mut World, h: f32) {
    let World { particles, fluids, scratch, dispatch, .. } = world;
    scratch.fluid.project(fluids, particles, h, *dispatch);
}

fn project_constraints(world: &mut World, h: f32, substep: u32) {
    let World { config, particles, projections, blocks, sleep, organisms, obstacles, scratch, dispatch, .. } = world;
    let share = (substep + 1) as f32 / config.substeps as f32;
    let margins = scratch.broad_phase.margins.blocks_mut();
    let awake = blocks.iter().zip(margins).zip(0..).filter(|(_, k)| !sleep.is_asleep(*k)).map(|(block, _)| block);
    let mut awake: Vec<_> = awake.collect();
    parallel::for_each(block::batches(&mut awake, particles), |mut batch| {
        let projection = &projections[batch.template()];
        dispatch.run(
            #[inline(always)]
            || {
                batch.for_each_block(
                    #[inline(always)]
                    |block, margins| {
                        if substep > 0 {
                            block::subtract_displacement(block, margins);
                        }
                        integrate::predict_positions(block, config.gravity, config.speed_limit(), h);
                    },
                );
            },
        );
        batch.project(&projection.constraints, &projection.scaled, share, h, *dispatch);
    });
    membrane::project(membranes(organisms), particles, h, *dispatch);
    contraction::project(&scratch.contractions, particles, h);
    scratch.joints.follow(obstacles, &mut scratch.obstacle_paths);
    scratch.joints.project(particles, h);
}

/// All membranes that move, with their rings.
fn membranes(organisms: &Organisms) -> impl Iterator<Item = (&Membrane, &[u32])> {
    let moving = organisms.with_membrane().filter(|(_, organism)| !organism.is_quarantined);
    moving.flat_map(|(_, organism)| organism.membranes())
}

fn project_contacts(world: &mut World) {
    let found = &world.scratch.broad_phase;
    if parallel::are_many(found.contacts.len() + found.ring_contacts.in_disc_contacts()) {
        project_all_contacts(world);
    } else {
        serial(world, project_all_contacts);
    }
}

fn project_all_contacts(world: &mut World) {
    project_discs(world);
    let World { config, particles, obstacles, organisms, guard, scratch, dispatch, .. } = world;
    let broad_phase = &mut scratch.broad_phase;
    let (rings, recorder) = (&mut broad_phase.ring_contacts, &mut scratch.contact_records);
    count(&mut guard.wrong_side, ring_contact::project(rings, particles, recorder, *dispatch));
    for (membrane, ring) in membranes(organisms).filter(|_| config.protects_membranes) {
        membrane.limit_strain(ring, particles);
    }
    let (paths, h) = (&mut scratch.obstacle_paths, config.substep());
    let (impacts, recorder) = (&mut scratch.impacts, &mut scratch.contact_records);
    obstacle::project(&broad_phase.obstacle_contacts, obstacles, paths, particles, impacts, recorder, h);
}

/// Discs push each other apart; in long substeps, and where they press hard, bodies get their links back.
fn project_discs(world: &mut World) {
    let World { config, particles, projections, blocks, organisms, exemptions, sleep, scratch, dispatch, .. } = world;
    let Scratch { broad_phase, impacts, contact_records, disc_contacts, .. } = scratch;
    let late = broad_phase.find_late_pairs(particles, exemptions, sleep, config.max_substep_displacement());
    bound_driven_discs(late.iter_mut(), particles, organisms);
    let links = |template: usize| &*projections[template].rigid_links;
    let (contacts, bodies) = (&mut *broad_phase.contacts, LinkedBlocks { blocks, links });
    disc_contacts.project(contacts, particles, bodies, (impacts, contact_records), config.substep(), *dispatch);
}

fn update_velocities(world: &mut World, h: f32) {
    limit_ways_of_cells(world, h);
    let World { config, particles, blocks, sleep, organisms, guard, scratch, dispatch, .. } = world;
    let awake = outside_of(sleep.sleepers(blocks.iter().map(Block::range)), particles.len());
    integrate::for_each_chunk(
        particles,
        awake,
        *dispatch,
        #[inline(always)]
        |chunk| integrate::update_velocities(chunk, config.damping, config.speed_limit(), h),
    );
    // Drag acts on the membrane only: the cytoplasm of a crawling cell is not damped.
    for (_, cell) in organisms.with_membrane().filter(|(_, organism)| organism.crawls()) {
        integrate::undo_damping(&cell.fluid_particles, particles, config.damping, h);
    }
    let rings = &mut *scratch.broad_phase.ring_contacts;
    count(&mut guard.wrong_side, ring_contact::keep_sides(rings, particles, *dispatch));
    contact::apply_restitution(&mut scratch.impacts, particles);
}

/// Cells keep their momentum at the speed limit; seldom anything comes to it.
fn limit_ways_of_cells(world: &mut World, h: f32) {
    let World { config, particles, blocks, organisms, dispatch, .. } = world;
    let outside = outside_of(blocks.iter().map(Block::range), particles.len());
    if integrate::exceed_speed_limit(particles, outside, *dispatch, config.speed_limit(), h) {
        for (_, cell) in organisms.with_membrane() {
            speed_limit::limit_ways(|| cell.particles(), particles, config.speed_limit() * h);
        }
    }
}

/// Cells at rest do not overshoot when they become round. Once per step is enough, and costs less than in each substep.
fn damp_stretching(world: &mut World) {
    let World { config, particles, organisms, .. } = world;
    for (_, cell) in organisms.with_membrane() {
        if let Some(rate) = cell.stretch_damping() {
            stretch_damping::damp_stretching(|| cell.particles(), particles, rate, config.speed_limit(), config.dt);
        }
    }
}

fn repair_membranes(world: &mut World) {
    let World { config, particles, organisms, guard, scratch, .. } = world;
    if config.protects_membranes {
        let rings: Vec<_> = organisms.rings().collect();
        count(&mut guard.net_fired, repair::repair_rings(&rings, &scratch.broad_phase.ring_contacts, particles));
    }
}

fn diffuse_chemicals(world: &mut World) {
    let World { config, particles, organisms, chemicals, dispatch, .. } = world;
    exchange::exchange(organisms, particles, chemicals, config.dt);
    chemicals.iter_mut().for_each(|chemical| chemical.advance(config.dt, *dispatch));
}

fn conclude(world: &mut World) {
    let World { particles, blocks, sleep, organisms, touching, events, scratch, .. } = world;
    let lane = |id| organisms.get(id)?.body.lane(blocks);
    let is_asleep = |id| lane(id).is_some_and(|(block, _)| sleep.is_asleep(block));
    touching.update(scratch.broad_phase.touched(), is_asleep, particles, organisms, events);
    world.conclude_obstacle_paths();
    world.update_sensors();
    world.report_contacts();
    // What touched has been reported of the whole bodies.
    world.divide_bodies();
    let World { config, particles, blocks, sleep, .. } = world;
    if config.sleeps {
        sleep.update_sleep_times(
            blocks.iter().map(Block::range),
            particles,
            config.sleep_speed(),
            config.steps_to_sleep(),
        );
    }
    world.quarantine();
    world.conclude_joints();
    let World { particles, blocks, sleep, dispatch, .. } = world;
    // Sleepers have not moved.
    let awake = outside_of(sleep.sleepers(blocks.iter().map(Block::range)), particles.len());
    integrate::for_each_chunk(particles, awake, *dispatch, integrate::move_origins);
    world.return_to_room();
    world.supply();
}
