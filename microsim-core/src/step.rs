//! The step, as a table of contents. Every phase is one function elsewhere; the names are those of [`Phase`].

use crate::behavior::{constrict, cup, draw_in_prey, exchange, sensing, steer_organisms};
use crate::capability::controller::senses;
use crate::collision::broad_phase::Surroundings;
use crate::collision::leeway::Reach;
use crate::collision::ring::Ring;
use crate::inputs::Inputs;
use crate::organism::table::Organisms;
use crate::parallel;
use crate::particle::{BlockRange, outside_of};
use crate::solver::block::Block;
use crate::solver::membrane::Membrane;
use crate::solver::{block, contact, contraction, drive, integrate, obstacle, ring_contact, untangle};
use crate::world::World;
use glam::Vec2;

/// One phase of the step, in their order. Those from `PredictPositions` to `UpdateVelocities` run once per substep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Phase {
    /// Inputs and controllers become the velocities that organisms give to their own particles.
    SteerOrganisms,
    /// Pairs that are expected to touch before the next step are found, who sleeps in this one, and the neighbours of fluid.
    FindPairs,
    /// Velocities are applied and limited, positions of loose particles predicted.
    PredictPositions,
    /// Fluid returns to its density; viscosity.
    ProjectFluids,
    /// Blocks in lanes, their positions predicted and their constraints projected; then constraints of loose bodies.
    ProjectConstraints,
    /// Pairs of bodies that got faster than expected are found; discs and obstacles push each other apart.
    ProjectContacts,
    /// What has moved gets the velocity of its move; restitution.
    UpdateVelocities,
    /// What is on the wrong side of a membrane is taken back; prey is touched, taken in and digested; engulfers grow.
    AdvancePhagocytosis,
    /// Furrows close, cells divide and fuse.
    DivideAndFuse,
    /// Organisms secrete and take up chemicals, which diffuse and decay.
    DiffuseChemicals,
    /// Contacts become events, and what is no longer finite is frozen.
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

pub(crate) fn advance(world: &mut World, inputs: &Inputs, finished: &mut impl FnMut(Phase)) {
    world.events.clear();
    alone(world, |world| steer(world, inputs));
    finished(Phase::SteerOrganisms);
    find_pairs(world);
    find_neighbours(world);
    quieten_sleepers(world);
    finished(Phase::FindPairs);
    let h = world.config.substep();
    for substep in 0..world.config.substeps {
        alone(world, |world| predict_positions(world, h));
        finished(Phase::PredictPositions);
        // Fluid before constraints: the membrane has the last word over its cytoplasm.
        project_fluids(world, h);
        finished(Phase::ProjectFluids);
        project_constraints(world, h, substep > 0);
        finished(Phase::ProjectConstraints);
        // Contacts last, walls after discs: the last projection wins, and nothing may end a substep inside anything.
        alone(world, project_contacts);
        finished(Phase::ProjectContacts);
        update_velocities(world, h);
        finished(Phase::UpdateVelocities);
    }
    catch_strays(world);
    world.advance_phagocytosis();
    finished(Phase::AdvancePhagocytosis);
    world.divide_and_fuse();
    finished(Phase::DivideAndFuse);
    diffuse_chemicals(world);
    finished(Phase::DiffuseChemicals);
    conclude(world);
    finished(Phase::Conclude);
    world.step_index += 1;
}

/// Does what no other thread takes part in.
fn alone(world: &mut World, phase: impl FnOnce(&mut World) + Send) {
    parallel::alone(world.particles.len(), || phase(world));
}

fn steer(world: &mut World, inputs: &Inputs) {
    let World { config, particles, organisms, blocks, sleep, fluids, obstacles, chemicals, events, scratch, .. } =
        world;
    let (size, dt, others) = (config.size, config.dt, &sensing::others(organisms, particles));
    let surroundings = senses::Surroundings { size, dt, chemicals, obstacles, others };
    steer_organisms(organisms, inputs, particles, &surroundings, &mut scratch.drives, events);
    draw_in_prey(organisms, particles, &mut scratch.drives);
    scratch.contractions.clear();
    constrict::draw_furrows(organisms, particles, &mut scratch.drives, &mut scratch.contractions);
    cup::drive_lips(organisms, particles, &mut scratch.drives, &mut scratch.contractions);
    organisms.for_each_with_membrane(|organism| organism.relax_membrane(particles, fluids, config.dt));
    // What wants to move does not sleep, even where it cannot.
    for drive in scratch.drives.iter().filter(|drive| drive.velocity != Vec2::ZERO) {
        let owner = organisms.id_at(particles.owner[drive.particle as usize]);
        let lane = owner.and_then(|owner| organisms.get(owner)?.body.lane(blocks));
        lane.into_iter().for_each(|(block, lane)| sleep.disturb(block, lane));
    }
}

pub(crate) fn find_pairs(world: &mut World) {
    let World { config, particles, blocks, sleep, organisms, obstacles, exemptions, scratch, .. } = world;
    let (size, reach) = (config.size, Reach { step: config.reach(), substep: config.substep_reach(), dt: config.dt });
    let rings: Vec<Ring<'_>> = if config.protects_membranes { organisms.rings().collect() } else { Vec::new() };
    let (rings, homes) = (rings.as_slice(), &organisms.homes());
    let blocks: &[BlockRange] = &blocks.iter().map(Block::range).collect::<Vec<_>>();
    let around = Surroundings { particles, blocks, obstacles, exemptions, rings, homes, size, reach };
    scratch.broad_phase.find_pairs(around, sleep, config.patience());
}

fn find_neighbours(world: &mut World) {
    let World { config, particles, fluids, scratch, .. } = world;
    scratch.fluid.find_neighbours(fluids, particles, config.size);
}

fn quieten_sleepers(world: &mut World) {
    let World { particles, blocks, sleep, .. } = world;
    sleep.quieten(blocks.iter().map(Block::range), particles);
}

fn predict_positions(world: &mut World, h: f32) {
    let World { config, particles, blocks, scratch, dispatch, .. } = world;
    drive::apply(&scratch.drives, particles, h);
    let outside = outside_of(blocks.iter().map(Block::range), particles.len());
    let mut columns = particles.columns();
    dispatch.run(
        #[inline(always)]
        || {
            for loose in outside {
                integrate::predict_positions(&mut columns.part(loose), config.gravity, config.speed_limit(), h);
            }
        },
    );
}

fn project_fluids(world: &mut World, h: f32) {
    let World { particles, fluids, scratch, dispatch, .. } = world;
    scratch.fluid.project(fluids, particles, h, *dispatch);
}

fn project_constraints(world: &mut World, h: f32, has_moved: bool) {
    let World { config, particles, templates, blocks, sleep, organisms, scratch, dispatch, .. } = world;
    let leeways = scratch.broad_phase.leeway.blocks_mut();
    let awake = blocks.iter().zip(leeways).zip(0..).filter(|(_, k)| !sleep.is_asleep(*k)).map(|(block, _)| block);
    let mut awake: Vec<_> = awake.collect();
    parallel::for_each(block::batches(&mut awake, particles), |mut batch| {
        let constraints = templates[batch.template()].constraints();
        dispatch.run(
            #[inline(always)]
            || {
                batch.for_each_block(
                    #[inline(always)]
                    |block, leeway| {
                        if has_moved {
                            block::note_way(block, leeway);
                        }
                        integrate::predict_positions(block, config.gravity, config.speed_limit(), h);
                    },
                );
                batch.project(constraints, h);
            },
        );
    });
    for (membrane, ring) in membranes(organisms) {
        membrane.project(ring, particles, h);
    }
    contraction::project(&scratch.contractions, particles, h);
}

/// All membranes that move, with their rings.
fn membranes(organisms: &Organisms) -> impl Iterator<Item = (&Membrane, &[u32])> {
    let moving = organisms.with_membrane().filter(|(_, organism)| !organism.is_quarantined);
    moving.flat_map(|(_, organism)| organism.membranes())
}

fn project_contacts(world: &mut World) {
    let World { config, particles, obstacles, organisms, exemptions, sleep, guard, scratch, .. } = world;
    let broad_phase = &mut scratch.broad_phase;
    broad_phase.widen(particles, exemptions, sleep, config.substep_reach());
    for contacts in broad_phase.contacts.lists_mut() {
        contact::project(contacts, particles, &mut scratch.impacts);
    }
    guard.wrong_side += u64::from(ring_contact::project(&mut broad_phase.ring_contacts, particles));
    for (membrane, ring) in membranes(organisms).filter(|_| config.protects_membranes) {
        membrane.limit_strain(ring, particles);
    }
    obstacle::project(&broad_phase.obstacle_contacts, obstacles, particles, &mut scratch.impacts);
}

fn update_velocities(world: &mut World, h: f32) {
    let World { config, particles, blocks, sleep, organisms, guard, scratch, dispatch, .. } = world;
    let awake = outside_of(sleep.sleepers(blocks.iter().map(Block::range)), particles.len());
    integrate::in_stretches(
        particles,
        awake,
        *dispatch,
        #[inline(always)]
        |stretch| integrate::update_velocities(stretch, config.damping, config.speed_limit(), h),
    );
    // The medium's drag is on the membrane; a cell at rest comes to rest with all that it holds.
    for (_, cell) in organisms.with_membrane().filter(|(_, organism)| organism.crawls()) {
        integrate::take_back_damping(&cell.fluid_particles, particles, config.damping, h);
    }
    guard.wrong_side += u64::from(ring_contact::keep_sides(&scratch.broad_phase.ring_contacts, particles));
    contact::apply_restitution(&mut scratch.impacts, particles);
}

/// The safety net: lays out what crosses itself, and casts a ray from every disc near a membrane.
fn catch_strays(world: &mut World) {
    let World { config, particles, organisms, guard, scratch, .. } = world;
    for (place, ring) in organisms.rings().enumerate().filter(|_| config.protects_membranes) {
        guard.net_fired += u64::from(untangle::untangle(ring.nodes, particles));
        let caught = ring_contact::catch_strays(ring, place, &scratch.broad_phase.ring_contacts, particles);
        guard.net_fired += u64::from(caught);
    }
}

fn diffuse_chemicals(world: &mut World) {
    let World { config, particles, organisms, chemicals, .. } = world;
    exchange::exchange(organisms, particles, chemicals, config.dt);
    chemicals.iter_mut().for_each(|chemical| chemical.advance(config.dt));
}

fn conclude(world: &mut World) {
    let World { config, particles, blocks, sleep, organisms, touching, events, scratch, .. } = world;
    let lane = |id| organisms.get(id)?.body.lane(blocks);
    let is_asleep = |id| lane(id).is_some_and(|(block, _)| sleep.is_asleep(block));
    touching.update(scratch.broad_phase.touched(), is_asleep, particles, organisms, events);
    if config.sleeps {
        sleep.note(blocks.iter().map(Block::range), particles, config.calm_speed(), config.patience());
    }
    world.quarantine();
    world.rebase();
}
