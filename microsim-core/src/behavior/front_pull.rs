//! Movement of a rigid cell (seed, 3.1.1): the front body is given a velocity towards the goal and pulls the cell after
//! it, which also turns it. If the goal is nearer to the opposite body, that one becomes the front.

use super::heading;
use crate::organism::Organism;
use crate::particle::Particles;
use crate::solver::drive::Drive;
use glam::Vec2;

/// Drives the front body and returns which body of the outline is the front now.
pub(crate) fn drive(
    organism: &Organism,
    front: u32,
    goal: Vec2,
    particles: &Particles,
    drives: &mut Vec<Drive>,
) -> u32 {
    let count = organism.outline.len() as u32;
    let particle = |k: u32| organism.body.particle(organism.outline[(k % count) as usize]);
    let way = |k: u32| goal - particles.position(particle(k) as usize);
    let opposite = (front + count / 2) % count;
    let front = if way(opposite).length_squared() < way(front).length_squared() { opposite } else { front };
    let velocity = heading(way(front)) * organism.speed;
    drives.push(Drive { particle: particle(front), velocity, max_acceleration: f32::INFINITY });
    front
}
