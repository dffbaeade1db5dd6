//! Rapier2D, every disc a rigid body, joints between them.
//!
//! Rapier has no rigid distance joint (a rope joint knows a longest length only), so links of the ring are stiff springs.

use super::Peer;
use crate::scene::{self, DISCS, DT, Platelet, PlateletField, Pusher, SATELLITES};
use microsim_core::glam::Vec2;
use rapier2d::prelude::*;

/// Natural frequency of a link between two satellites, Hz: half that of the solver's substeps.
const LINK_HERTZ: f32 = 120.0;

struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    pushers: usize,
}

/// Platelets as in the other engines.
pub(super) fn platelets(field: &PlateletField) -> Box<dyn Peer> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.dt = DT;
    world.integration_parameters.max_ccd_substeps = 0;
    let ground = add_walls(&mut world, field.size);
    let mut bodies = Vec::new();
    for &centre in &field.centres {
        add_platelet(&mut world, &mut bodies, ground, centre);
    }
    bodies.extend(field.sweeps.iter().map(|sweep| add_pusher(&mut world, sweep.start())));
    Box::new(Rapier { world, bodies, pushers: field.sweeps.len() })
}

/// Fixed body with a segment for each wall.
pub(super) fn add_walls(world: &mut PhysicsWorld, size: Vec2) -> RigidBodyHandle {
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    let corners = [Vec2::ZERO, size.with_y(0.0), size, size.with_x(0.0)];
    for (k, &corner) in corners.iter().enumerate() {
        let wall = ColliderBuilder::segment(corner, corners[(k + 1) % 4]).friction(scene::FRICTION);
        world.insert_collider(wall, Some(ground));
    }
    ground
}

/// The disc that stirs.
pub(super) fn add_pusher(world: &mut PhysicsWorld, at: Vec2) -> RigidBodyHandle {
    add_disc(world, at, Pusher::MASS, Some(Pusher::RADIUS))
}

/// Drives a pusher for one step.
pub(super) fn push(world: &mut PhysicsWorld, pusher: RigidBodyHandle, goal: Vec2) {
    let body = &mut world.bodies[pusher];
    let force = Pusher::force(body.translation(), body.linvel(), goal);
    body.reset_forces(true);
    body.add_force(force, true);
}

/// A disc; without radius it collides with nothing.
fn add_disc(world: &mut PhysicsWorld, at: Vec2, mass: f32, radius: Option<f32>) -> RigidBodyHandle {
    let body = RigidBodyBuilder::dynamic()
        .translation(at)
        .linear_damping(scene::DAMPING)
        .lock_rotations()
        .can_sleep(false)
        .additional_mass(mass);
    let body = world.insert_body(body);
    if let Some(radius) = radius {
        let collider = ColliderBuilder::ball(radius).density(0.0).friction(scene::FRICTION);
        world.insert_collider(collider, Some(body));
    }
    body
}

fn add_platelet(world: &mut PhysicsWorld, bodies: &mut Vec<RigidBodyHandle>, ground: RigidBodyHandle, centre: Vec2) {
    let first = bodies.len();
    let nucleus = add_disc(world, centre, scene::CORE_MASS, None);
    let interlayer = add_disc(world, centre, scene::CORE_MASS, Some(Platelet::interlayer_radius()));
    bodies.extend([nucleus, interlayer]);
    let radius = Some(Platelet::satellite_radius());
    bodies.extend(Platelet::ring().map(|offset| add_disc(world, centre + offset, 1.0, radius)));
    world.insert_impulse_joint(nucleus, interlayer, RevoluteJointBuilder::new());
    let anchor = SpringJointBuilder::new(0.0, 1.0 / scene::ANCHOR_COMPLIANCE, 0.0).local_anchor1(centre);
    world.insert_impulse_joint(ground, nucleus, anchor);
    let rope = RopeJointBuilder::new(scene::ROPE_LENGTH * scene::OUTER_RADIUS).local_anchor1(centre);
    world.insert_impulse_joint(ground, nucleus, rope);
    let stiffness = 1.0 / scene::SPOKE_COMPLIANCE;
    let damping = 2.0 * scene::SPOKE_DAMPING_RATIO * (stiffness / (1.0 + 1.0 / scene::CORE_MASS)).sqrt();
    let spoke = SpringJointBuilder::new(Platelet::ring_radius(), stiffness, damping).build();
    let omega = std::f32::consts::TAU * LINK_HERTZ;
    let link = SpringJointBuilder::new(2.0 * Platelet::satellite_radius(), 0.5 * omega * omega, omega);
    let link = link.contacts_enabled(false).build();
    let ring = &bodies[first + 2..first + DISCS];
    for (k, &satellite) in ring.iter().enumerate() {
        world.insert_impulse_joint(satellite, ring[(k + 1) % SATELLITES], link);
        world.insert_impulse_joint(satellite, nucleus, spoke);
    }
}

impl Peer for Rapier {
    fn step(&mut self, goals: &[Vec2]) {
        for (&pusher, &goal) in self.bodies[self.bodies.len() - self.pushers..].iter().zip(goals) {
            push(&mut self.world, pusher, goal);
        }
        self.world.step();
    }

    fn positions(&self) -> Vec<Vec2> {
        self.bodies.iter().map(|&body| self.world.bodies[body].translation()).collect()
    }
}
