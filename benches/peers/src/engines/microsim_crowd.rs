//! microsim-core's amoeboid cells, through its public API, each told in every step where to go.

use super::Peer;
use crate::scene::DAMPING;
use crate::scene::DT;
use crate::scene::crowd::{Crowd, MAX_SPEED, cell_spec};
use microsim_core::glam::Vec2;
use microsim_core::{Inputs, Intent, OrganismId, Placement, Role, World, WorldConfig};

/// Fewest that amoeboid cells accept at this time step: a substep is at most 6 ms.
const SUBSTEPS: u32 = 3;
/// Distance of the goal that stands for a direction, units.
const FAR: f32 = 1000.0;

struct Microsim {
    world: World,
    cells: Vec<OrganismId>,
    inputs: Inputs,
}

/// Amoeboid cells of the library.
pub(super) fn crowd(crowd: &Crowd) -> Box<dyn Peer> {
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
    Box::new(Microsim { world, cells, inputs: Inputs::new() })
}

impl Peer for Microsim {
    fn step(&mut self, directions: &[Vec2]) {
        for (&cell, &direction) in self.cells.iter().zip(directions) {
            let at = self.world.centroid(cell).expect("nothing removes it");
            let goal = Intent::toward(at + direction * FAR).expect("goals are not far beyond the room");
            self.inputs.set(cell, goal);
        }
        self.world.step(&self.inputs);
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
