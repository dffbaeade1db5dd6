//! Movement of a body that is towed as a whole: its centre takes on the wanted velocity, whichever way it points, and its first
//! particle turns ahead.

use super::heading;
use crate::capability::controller::senses::Steering;
use crate::organism::{Organism, Storage};
use crate::solver::drive::Tow;
use glam::Vec2;

/// Share of the wanted velocity from which on a body follows its steering.
const FOLLOWING: f32 = 0.3;

/// The tow of this step, after one in which the body at this place wanted to move with the velocity `before`.
pub(crate) fn tow(
    organism: &Organism,
    at: Vec2,
    steering: Option<Steering>,
    before: Vec2,
    max_acceleration: f32,
) -> Option<Tow> {
    let Storage::Lane { first, .. } = organism.body else { return None };
    let velocity = wanted_velocity(organism, at);
    let is_at_once = steering.is_some_and(|steering| steering.is_at_once);
    Some(Tow {
        first,
        slots: organism.slots,
        velocity,
        heading: organism.goal.map_or(Vec2::ZERO, |goal| heading(goal - at)),
        max_acceleration,
        own_damping: organism.linear_damping,
        at_once: if is_at_once { (velocity - before).length() } else { 0.0 },
    })
}

/// Velocity with which a towed body at this place wants to move towards its goal.
pub(crate) fn wanted_velocity(organism: &Organism, at: Vec2) -> Vec2 {
    organism.goal.map_or(Vec2::ZERO, |goal| heading(goal - at) * organism.present_speed())
}

/// Whether a body that moves with one velocity is on the way to what it wants.
pub(crate) fn follows(velocity: Vec2, wanted: Vec2) -> bool {
    velocity.dot(wanted) > FOLLOWING * wanted.length_squared()
}
