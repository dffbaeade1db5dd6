//! Fluid at rest in a room, for what is spawned: found by projecting its constraints alone, without time.

use super::{Fluid, FluidMode, FluidParams, Workspace};
use crate::geometry::period::Period;
use crate::instruction_set::Dispatch;
use crate::particle::{CollisionGroups, Material, Particle, Particles};
use glam::Vec2;
use std::slice;

/// Number of iterations, each of the density and then of the least spacing.
const ITERATIONS: usize = 60;
/// Substep of an iteration, s: long, so that viscosity evens out what the constraints do.
const SUBSTEP: f32 = 0.01;
/// This viscosity, 1/s, whatever that of the fluid is.
const VISCOSITY: f32 = 20.0;
/// Share of its last displacement that a particle makes once more: without it the fluid jams before it is at rest.
const INERTIA: f32 = 0.9;
/// Least spacing at the end, relative to the rest spacing: a little more than what is enforced later.
const LEAST_SPACING: f32 = 0.88;

/// Moves points until a fluid of particles there is at rest, in the room that `confine` moves points into.
pub(crate) fn settle(points: &mut [Vec2], params: FluidParams, confine: impl Fn(Vec2) -> Vec2) {
    // Far from the walls at 0.
    let far = points.iter().fold(Vec2::ZERO, |far, point| far.max(point.abs())) + Vec2::splat(4.0 * params.spacing);
    let mut particles = Particles::default();
    let params = FluidParams { viscosity: VISCOSITY, ..params };
    let spacing = LEAST_SPACING * params.spacing;
    let grains = FluidParams { spacing, mode: FluidMode::Granular, friction: 0.0, ..params };
    let mut fluids = [Fluid::new(params, true), Fluid::new(grains, true)];
    for &point in &*points {
        let index = particles.insert(&disc(far + point));
        fluids.iter_mut().for_each(|fluid| fluid.particles.push(index));
    }
    // One after the other, because they move the same particles.
    let mut workspaces = [(); 2].map(|()| Workspace::default());
    for _ in 0..ITERATIONS {
        for i in 0..points.len() {
            let (at, before) = (particles.offset(i), Vec2::new(particles.prev_x[i], particles.prev_y[i]));
            (particles.prev_x[i], particles.prev_y[i]) = at.into();
            (particles.x[i], particles.y[i]) = (at + INERTIA * (at - before)).into();
        }
        let pairs = || fluids.iter().map(slice::from_ref);
        for (workspace, fluid) in workspaces.iter_mut().zip(pairs()) {
            workspace.find_neighbours(fluid, &particles, [Vec2::ZERO, Vec2::INFINITY], Period::NONE);
        }
        for (workspace, fluid) in workspaces.iter_mut().zip(pairs()) {
            workspace.project(fluid, &mut particles, SUBSTEP, Dispatch::default());
        }
        for i in 0..points.len() {
            (particles.x[i], particles.y[i]) = (far + confine(particles.offset(i) - far)).into();
        }
    }
    points.iter_mut().enumerate().for_each(|(i, point)| *point = particles.position(i) - far);
}

fn disc(offset: Vec2) -> Particle {
    Particle {
        origin: Vec2::ZERO,
        offset,
        velocity: Vec2::ZERO,
        inv_mass: 1.0,
        radius: 0.0,
        groups: CollisionGroups::NONE,
        material: Material::default(),
        role: 0,
        owner: 0,
        fluid: 0,
    }
}
