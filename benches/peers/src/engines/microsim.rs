//! microsim-core, through its public API.

use super::Peer;
use crate::scene::{self, DT, FluidBlock, PlateletField, Pusher};
use microsim_core::glam::Vec2;
use microsim_core::{
    FluidBlockSpec, FluidParams, Inputs, InstructionSet, Intent, Kind, OrganismId, Placement, PlateletSpec, ProbeSpec,
    World, WorldConfig,
};
use rayon::{ThreadPool, ThreadPoolBuilder};

struct Microsim {
    world: World,
    /// Where steps run; without it, on the calling thread.
    threads: Option<ThreadPool>,
    pushers: Vec<OrganismId>,
    inputs: Inputs,
}

/// Substeps of the platelet field.
const SUBSTEPS: u32 = 3;
/// Substeps of the fluid.
const FLUID_SUBSTEPS: u32 = 2;

/// Platelets and probes of the library, on one thread with the instructions that the processor has.
pub(super) fn platelets(field: &PlateletField) -> Box<dyn Peer> {
    Box::new(platelet_field(field))
}

/// The same with the instructions that every processor of the architecture has.
pub(super) fn baseline_platelets(field: &PlateletField) -> Box<dyn Peer> {
    let mut made = platelet_field(field);
    made.world.set_instruction_set(InstructionSet::Baseline);
    Box::new(made)
}

/// The same on two threads.
pub(super) fn two_threads(field: &PlateletField) -> Box<dyn Peer> {
    Box::new(Microsim { threads: Some(two()), ..platelet_field(field) })
}

/// Two threads.
pub(super) fn two() -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(2).build().expect("threads can be started")
}

/// A step on some threads, or on the calling one.
pub(super) fn step(world: &mut World, inputs: &Inputs, threads: Option<&ThreadPool>) {
    match threads {
        Some(threads) => threads.install(|| world.step(inputs)),
        None => world.step(inputs),
    }
}

fn platelet_field(field: &PlateletField) -> Microsim {
    let config = WorldConfig {
        size: field.size,
        dt: DT,
        substeps: SUBSTEPS,
        damping: scene::DAMPING,
        max_speed: 30.0 * scene::Platelet::satellite_radius(),
        sleeps: false,
        ..WorldConfig::default()
    };
    let mut world = World::new(config).expect("the configuration is valid");
    let platelet = PlateletSpec {
        radius: scene::OUTER_RADIUS,
        satellites: scene::SATELLITES as u32,
        core_mass: scene::CORE_MASS,
        spoke_compliance: scene::SPOKE_COMPLIANCE,
        anchor_compliance: scene::ANCHOR_COMPLIANCE,
        rope_length: scene::ROPE_LENGTH,
    };
    let probe = ProbeSpec {
        radius: Pusher::RADIUS,
        mass: Pusher::MASS,
        speed: Pusher::SPEED,
        max_acceleration: Pusher::MAX_ACCELERATION,
    };
    let mut spawn = |spec: &microsim_core::OrganismSpec, at: Vec2| {
        world.spawn(spec, Placement::at(at.x, at.y)).expect("the scene fits the room")
    };
    for &centre in &field.centres {
        spawn(&platelet.clone().into(), centre);
    }
    let pushers = field.sweeps.iter().map(|sweep| spawn(&probe.clone().into(), sweep.start())).collect();
    Microsim { world, threads: None, pushers, inputs: Inputs::new() }
}

/// A fluid block of the library.
pub(super) fn fluid(block: &FluidBlock) -> Box<dyn Peer> {
    let config = WorldConfig {
        size: block.tank,
        dt: DT,
        substeps: FLUID_SUBSTEPS,
        gravity: Vec2::new(0.0, -FluidBlock::GRAVITY),
        damping: 0.0,
        // More than a fall over the tank's height reaches.
        max_speed: 1.1 * (2.0 * FluidBlock::GRAVITY * block.tank.y).sqrt(),
        ..WorldConfig::default()
    };
    let mut world = World::new(config).expect("the configuration is valid");
    let params = FluidParams { spacing: FluidBlock::SPACING, ..FluidParams::default() };
    let spec = FluidBlockSpec { size: block.size, fluid: params };
    let at = block.size * 0.5;
    let fluid = world.spawn(&spec.into(), Placement::at(at.x, at.y)).expect("the block fits the tank");
    let count = world.view().organism(fluid).map_or(0, |fluid| fluid.particles().count());
    assert_eq!(count, block.points.len(), "the library fills the block as the scene does");
    Box::new(Microsim { world, threads: None, pushers: Vec::new(), inputs: Inputs::new() })
}

impl Peer for Microsim {
    fn step(&mut self, goals: &[Vec2]) {
        for (&pusher, &goal) in self.pushers.iter().zip(goals) {
            self.inputs.set(pusher, Intent::toward(goal).expect("goals lie in the room"));
        }
        step(&mut self.world, &self.inputs, self.threads.as_ref());
    }

    fn positions(&self) -> Vec<Vec2> {
        let of_interest = |kind: Kind, node: usize| kind != Kind::Platelet || node != ANCHOR;
        let organisms = self.world.view().organisms();
        let particles = organisms.flat_map(|organism| {
            let kind = organism.kind();
            organism.particles().enumerate().filter(move |&(node, _)| of_interest(kind, node))
        });
        particles.map(|(_, particle)| particle.position).collect()
    }
}

/// Node of a platelet that is its static anchor; the others are in the scene's order.
const ANCHOR: usize = 2;
