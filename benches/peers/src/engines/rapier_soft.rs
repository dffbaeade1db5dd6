//! Rapier2D, every platelet one of its soft-body disks: a ring of particles with rigid edges, bending edges and area
//! preservation in place of spokes and core; the platelet's whole mass lies in the ring. The anchor's spring is a force.

use super::Peer;
use super::rapier_joints::{add_pusher, add_walls, push};
use crate::scene::{self, DT, Platelet, PlateletField, SATELLITES};
use microsim_core::glam::Vec2;
use rapier2d::dynamics::{SoftBodyBuilder, SoftBodyHandle, SpringCoefficients};
use rapier2d::prelude::*;

struct RapierSoft {
    world: PhysicsWorld,
    /// With their anchors.
    disks: Vec<(SoftBodyHandle, Vec2)>,
    pushers: Vec<RigidBodyHandle>,
}

/// Soft-body disks.
pub(super) fn platelets(field: &PlateletField) -> Box<dyn Peer> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.dt = DT;
    world.integration_parameters.max_ccd_substeps = 0;
    add_walls(&mut world, field.size);
    let disks = field.centres.iter().map(|&centre| (world.insert_soft_body(disk(centre)), centre)).collect();
    let pushers = field.sweeps.iter().map(|sweep| add_pusher(&mut world, sweep.start())).collect();
    Box::new(RapierSoft { world, disks, pushers })
}

fn disk(centre: Vec2) -> SoftBodyBuilder {
    let mut disk = SoftBodyBuilder::disk(centre, Platelet::ring_radius(), SATELLITES)
        .mass(SATELLITES as f32 + 2.0 * scene::CORE_MASS)
        .particle_radius(Platelet::satellite_radius())
        .surface_collider(ColliderBuilder::ball(1.0).friction(scene::FRICTION))
        .linear_damping(scene::DAMPING)
        .can_sleep(false);
    disk.material.edge_softness = SpringCoefficients::joint_defaults();
    disk
}

impl Peer for RapierSoft {
    fn step(&mut self, goals: &[Vec2]) {
        for &(disk, anchor) in &self.disks {
            let disk = self.world.soft_bodies.get_mut(disk).expect("nothing removes it");
            let pull = (anchor - disk.center_of_mass()) / (scene::ANCHOR_COMPLIANCE * SATELLITES as f32);
            disk.reset_forces(false);
            disk.add_force(pull, false);
        }
        for (&pusher, &goal) in self.pushers.iter().zip(goals) {
            push(&mut self.world, pusher, goal);
        }
        self.world.step();
    }

    fn positions(&self) -> Vec<Vec2> {
        let disks = self.disks.iter().flat_map(|&(disk, _)| {
            let disk = self.world.soft_bodies.get(disk).expect("nothing removes it");
            // There is no core; its centre stands for both of its discs.
            [disk.center_of_mass(); 2].into_iter().chain(disk.particle_positions())
        });
        let pushers = self.pushers.iter().map(|&pusher| self.world.bodies[pusher].translation());
        disks.chain(pushers).collect()
    }
}
