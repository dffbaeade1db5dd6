//! The engines: one file each, one line each in the table. Another configuration of an engine is another line.

mod microsim;
mod microsim_crowd;
mod native;
mod native_crowd;
mod rapier_crowd;
mod rapier_joints;
mod rapier_soft;
mod salva;

use crate::scene::crowd::Crowd;
use crate::scene::{FluidBlock, PlateletField};
use microsim_core::glam::Vec2;

/// A scene in an engine.
pub(crate) trait Peer {
    /// One step; pushers head for these places, or cells in these directions.
    fn step(&mut self, goals: &[Vec2]);

    /// Where everything is, in the scene's order: of a platelet nucleus, interlayer and satellites, then the pushers; or
    /// the fluid; or of each cell the ring and the cytoplasm.
    fn positions(&self) -> Vec<Vec2>;
}

/// What the time of a step is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Clock {
    /// Processor time of the calling thread: what other processes do counts least.
    Thread,
    /// Time on the wall: for engines with threads of their own.
    Wall,
}

/// Makes an engine's world of a scene.
type Build<Setup> = fn(&Setup) -> Box<dyn Peer>;

/// One row of the comparison.
pub(crate) struct Engine {
    pub name: &'static str,
    /// Version and settings, for the report.
    pub settings: &'static str,
    pub platelets: Option<Build<PlateletField>>,
    pub fluid: Option<Build<FluidBlock>>,
    pub crowd: Option<Build<Crowd>>,
    /// Largest fluid that it is asked to run, particles.
    pub most_fluid: usize,
    pub clock: Clock,
}

impl Engine {
    const NONE: Self = Self {
        name: "",
        settings: "",
        platelets: None,
        fluid: None,
        crowd: None,
        most_fluid: usize::MAX,
        clock: Clock::Thread,
    };

    /// Whether this is a configuration of ours.
    pub(crate) fn is_microsim(&self) -> bool {
        self.name.starts_with("microsim")
    }
}

/// All rows, ours first.
pub(crate) const ENGINES: &[Engine] = &[
    Engine {
        name: "microsim",
        settings: "3 substeps; fluid 2 substeps",
        platelets: Some(microsim::platelets),
        fluid: Some(microsim::fluid),
        crowd: Some(microsim_crowd::crowd),
        ..Engine::NONE
    },
    Engine {
        name: "microsim-baseline",
        settings: "the same without run-time choice of instructions",
        platelets: Some(microsim::baseline_platelets),
        ..Engine::NONE
    },
    Engine {
        name: "microsim-2-threads",
        settings: "the same on two threads, time on the wall",
        platelets: Some(microsim::two_threads),
        crowd: Some(microsim_crowd::two_threads),
        clock: Clock::Wall,
        ..Engine::NONE
    },
    Engine {
        name: "box2d-3",
        settings: "3.2, 4 substeps, AVX2 where there is",
        platelets: Some(native::box2d),
        ..Engine::NONE
    },
    Engine {
        name: "liquidfun",
        settings: "1.1 (Box2D 2.3), 8 velocity and 3 position iterations; fluid and cytoplasm 2 particle iterations",
        platelets: Some(native::liquidfun),
        fluid: Some(native::liquidfun_fluid),
        crowd: Some(native_crowd::liquidfun),
        ..Engine::NONE
    },
    #[cfg(has_chipmunk)]
    Engine { name: "chipmunk", settings: "7, 10 iterations", platelets: Some(native::chipmunk), ..Engine::NONE },
    Engine {
        name: "rapier-joints",
        settings: "0.36, 4 solver iterations, stiff spring joints for links",
        platelets: Some(rapier_joints::platelets),
        ..Engine::NONE
    },
    Engine {
        name: "rapier-soft",
        settings: "0.36, soft-body disks, 4 solver iterations, no core discs; crowd: soft rings around rigid balls",
        platelets: Some(rapier_soft::platelets),
        crowd: Some(rapier_crowd::crowd),
        ..Engine::NONE
    },
    Engine {
        name: "salva2d",
        settings: "0.11, DFSPH, 3 substeps",
        fluid: Some(salva::fluid),
        most_fluid: 10_000,
        ..Engine::NONE
    },
];
