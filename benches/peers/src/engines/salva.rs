//! Salva: incompressible and divergence-free smoothed particles (DFSPH) against walls of particles.

use super::Peer;
use crate::scene::{DT, FluidBlock};
use microsim_core::glam::Vec2;
use salva2d::LiquidWorld;
use salva2d::math::Vector;
use salva2d::object::interaction_groups::InteractionGroups;
use salva2d::object::{Boundary, Fluid, FluidHandle};
use salva2d::solver::DFSPHSolver;

/// Substeps that it needs to keep its particles.
const SUBSTEPS: u32 = 3;
/// A particle's volume is 0.8 of its diameter squared; with this diameter that is its share of the scene's lattice.
const DIAMETER: f32 = 1.0405 * FluidBlock::SPACING;
/// Layers of particles in a wall: the kernel reaches two diameters far.
const WALL_LAYERS: i32 = 2;

struct Salva {
    world: LiquidWorld,
    fluid: FluidHandle,
}

/// The block between walls.
pub(super) fn fluid(block: &FluidBlock) -> Box<dyn Peer> {
    let solver: DFSPHSolver = DFSPHSolver::new();
    let mut world = LiquidWorld::new(solver, 0.5 * DIAMETER, 2.0, 1.0);
    let points = block.points.iter().map(|point| Vector::new(point.x, point.y)).collect();
    let fluid = world.add_fluid(Fluid::new(points, 0.5 * DIAMETER, 1.0, InteractionGroups::default()));
    world.add_boundary(Boundary::new(walls(block.tank), InteractionGroups::default()));
    Box::new(Salva { world, fluid })
}

/// Particles in layers around the tank, the innermost half a diameter behind its wall.
fn walls(tank: Vec2) -> Vec<Vector<f32>> {
    let (columns, rows) = ((tank.x / DIAMETER).ceil() as i32, (tank.y / DIAMETER).ceil() as i32);
    let is_wall = |x: i32, y: i32| x < 0 || y < 0 || x >= columns || y >= rows;
    (-WALL_LAYERS..columns + WALL_LAYERS)
        .flat_map(|x| (-WALL_LAYERS..rows + WALL_LAYERS).map(move |y| (x, y)))
        .filter(|&(x, y)| is_wall(x, y))
        .map(|(x, y)| Vector::new((x as f32 + 0.5) * DIAMETER, (y as f32 + 0.5) * DIAMETER))
        .collect()
}

impl Peer for Salva {
    fn step(&mut self, _: &[Vec2]) {
        for _ in 0..SUBSTEPS {
            self.world.step(DT / SUBSTEPS as f32, &Vector::new(0.0, -FluidBlock::GRAVITY));
        }
    }

    fn positions(&self) -> Vec<Vec2> {
        let fluid = self.world.fluids().get(self.fluid).expect("nothing removes it");
        fluid.positions.iter().map(|position| Vec2::new(position.x, position.y)).collect()
    }
}
