//! Rapier2D, every cell a soft body around balls: the ring is a soft body without bending edges and without preserved area,
//! its surface a shell that holds in what is inside, and each cytoplasm particle a rigid ball.

use super::Peer;
use super::rapier_joints::add_walls;
use crate::scene::crowd::{Crowd, DISC_RADIUS, FRICTION, SPACING, drive};
use crate::scene::{DAMPING, DT};
use microsim_core::glam::Vec2;
use rapier2d::dynamics::{SoftBodyBuilder, SoftBodyHandle, SpringCoefficients};
use rapier2d::prelude::*;

/// Radius of a ball over half the cytoplasm's spacing: balls that touched all their neighbours would be jammed, and the
/// cell with them.
const BALL_SHARE: f32 = 0.9;

struct RapierCrowd {
    world: PhysicsWorld,
    cells: Vec<Cell>,
}

struct Cell {
    ring: SoftBodyHandle,
    balls: Vec<RigidBodyHandle>,
}

/// Soft rings with balls inside.
pub(super) fn crowd(crowd: &Crowd) -> Box<dyn Peer> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.dt = DT;
    world.integration_parameters.max_ccd_substeps = 0;
    add_walls(&mut world, crowd.size);
    let mut add = |&centre: &Vec2| {
        let ring = crowd.cell.ring.iter().map(|offset| centre + *offset).collect();
        let ring = world.insert_soft_body(shell(ring));
        let balls = crowd.cell.cytoplasm.iter().map(|offset| add_ball(&mut world, centre + *offset)).collect();
        Cell { ring, balls }
    };
    let cells = crowd.centres.iter().map(&mut add).collect();
    Box::new(RapierCrowd { world, cells })
}

/// A closed chain of particles of mass 1 and the discs' thickness, with edges as rigid as joints.
fn shell(ring: Vec<Vec2>) -> SoftBodyBuilder {
    let count = ring.len() as u32;
    let links: Vec<[u32; 2]> = (0..count).map(|k| [k, (k + 1) % count]).collect();
    let mut shell = SoftBodyBuilder::new(ring)
        .edges(links.clone())
        .surface(links)
        .oriented(false)
        .particle_mass(1.0)
        .particle_radius(DISC_RADIUS)
        .surface_collider(ColliderBuilder::ball(1.0).friction(FRICTION))
        .linear_damping(DAMPING)
        .can_sleep(false);
    shell.material.edge_softness = SpringCoefficients::joint_defaults();
    shell
}

/// A particle of the cytoplasm: a ball of mass 1 without friction.
fn add_ball(world: &mut PhysicsWorld, at: Vec2) -> RigidBodyHandle {
    let body = RigidBodyBuilder::dynamic()
        .translation(at)
        .linear_damping(DAMPING)
        .lock_rotations()
        .can_sleep(false)
        .additional_mass(1.0);
    let body = world.insert_body(body);
    let ball = ColliderBuilder::ball(BALL_SHARE * 0.5 * SPACING).density(0.0).friction(0.0);
    world.insert_collider(ball, Some(body));
    body
}

impl Peer for RapierCrowd {
    fn step(&mut self, directions: &[Vec2]) {
        for (cell, &direction) in self.cells.iter().zip(directions) {
            let body = self.world.soft_bodies.get_mut(cell.ring).expect("nothing removes it");
            let ring: Vec<Vec2> = body.particle_positions().collect();
            drive(&ring, direction).for_each(|(k, velocity)| body.set_particle_velocity(k, velocity));
        }
        self.world.step();
    }

    fn positions(&self) -> Vec<Vec2> {
        let of_cell = |cell: &Cell| {
            let ring = self.world.soft_bodies.get(cell.ring).expect("nothing removes it");
            let balls = cell.balls.iter().map(|&ball| self.world.bodies[ball].translation());
            ring.particle_positions().chain(balls).collect::<Vec<_>>()
        };
        self.cells.iter().flat_map(of_cell).collect()
    }
}
