//! microsim-core's amoeboid cells, through its public API, each told in every step where to go.

use super::Peer;
use super::microsim::{step, two};
use crate::scene::DAMPING;
use crate::scene::DT;
use crate::scene::crowd::{Crowd, MAX_SPEED, cell_spec};
use microsim_core::glam::Vec2;
use microsim_core::{Inputs, Intent, OrganismId, Placement, Role, World, WorldConfig};
use rayon::ThreadPool;

/// Fewest that amoeboid cells accept at this time step: a substep is at most 6 ms.
const SUBSTEPS: u32 = 3;
/// Distance of the goal that stands for a direction, units.
const FAR: f32 = 1000.0;

struct Microsim {
    world: World,
    cells: Vec<OrganismId>,
    inputs: Inputs,
    /// Where steps run; without it, on the calling thread.
    threads: Option<ThreadPool>,
}

/// Amoeboid cells of the library.
pub(super) fn crowd(crowd: &Crowd) -> Box<dyn Peer> {
    Box::new(made(crowd, None))
}

/// The same on two threads.
pub(super) fn two_threads(crowd: &Crowd) -> Box<dyn Peer> {
    Box::new(made(crowd, Some(two())))
}

fn made(crowd: &Crowd, threads: Option<ThreadPool>) -> Microsim {
    let config = WorldConfig {
        size: crowd.size,
        dt: DT,
        substeps: SUBSTEPS,
        damping: DAMPING,
        max_speed: MAX_SPEED,
        sleeps: false,
        ..WorldConfig::default()
    };
    let mut world = World::new(config).expect("the configuration is valid");
    let spec = cell_spec().into();
    let spawn = |at: &Vec2| world.spawn(&spec, Placement::at(at.x, at.y)).expect("the crowd fits the room");
    let cells: Vec<OrganismId> = crowd.centres.iter().map(spawn).collect();
    Microsim { world, cells, inputs: Inputs::new(), threads }
}

impl Peer for Microsim {
    fn step(&mut self, directions: &[Vec2]) {
        for (&cell, &direction) in self.cells.iter().zip(directions) {
            let at = self.world.centroid(cell).expect("nothing removes it");
            let goal = Intent::toward(at + direction * FAR).expect("goals are not far beyond the room");
            self.inputs.set(cell, goal);
        }
        step(&mut self.world, &self.inputs, self.threads.as_ref());
    }

    fn positions(&self) -> Vec<Vec2> {
        let view = self.world.view();
        let positions = self.cells.iter().filter_map(|&cell| view.organism(cell)).flat_map(|cell| {
            // A frozen cell would neither leak nor cost anything.
            assert!(!cell.is_quarantined(), "every cell moves");
            let cytoplasm = cell.particles().filter(|particle| particle.role == Role::Cytoplasm);
            cell.outline().chain(cytoplasm.map(|particle| particle.position))
        });
        positions.collect()
    }
}
