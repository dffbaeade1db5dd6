//! Which particles may touch during a step: broad phase and filters. Knows no constraints.

mod bodies;
pub(crate) mod broad_phase;
mod crowd;
pub(crate) mod filter;
pub(crate) mod grid;
pub(crate) mod obstacle;
pub(crate) mod ring;
pub(crate) mod shape;

use crate::particle::Material;

/// Two discs near enough that they may touch during the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    pub i: u32,
    pub j: u32,
    pub friction: f32,
    pub restitution: f32,
    /// Touched in any substep since the pair was found.
    pub touched: bool,
}

/// A disc and an obstacle that may touch during the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObstacleContact {
    pub particle: u32,
    pub obstacle: u32,
}

/// Friction and restitution of two surfaces on each other.
pub(crate) fn combine(a: Material, b: Material) -> (f32, f32) {
    let restitution = if a.restitution > b.restitution { a.restitution } else { b.restitution };
    ((a.friction * b.friction).sqrt(), restitution)
}
