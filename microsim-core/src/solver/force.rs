//! Forces: what accelerates some particles together in every substep.

use crate::particle::Particles;
use crate::particle::mass_properties::{MassProperties, movable};
use glam::Vec2;
use std::ops::Range;

/// What acts on some particles together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Force {
    /// Of each of them, units/s2.
    pub acceleration: Vec2,
    /// About their centre of mass.
    pub torque: f32,
    /// The velocity of their centre of mass, units/s, if it is prescribed.
    pub velocity: Option<Vec2>,
}

/// The forces of a step, each with its particles.
#[derive(Debug, Default)]
pub(crate) struct Forces {
    particles: Vec<u32>,
    list: Vec<(Range<usize>, Force)>,
    /// Particles that are damped together, and the rates of their motion and of their rotation, 1/s.
    damped: Vec<(Vec<u32>, [f32; 2])>,
}

impl Forces {
    pub(crate) fn clear(&mut self) {
        self.particles.clear();
        self.list.clear();
        self.damped.clear();
    }

    /// Damps some particles as a whole: the velocity of their centre of mass, and their rotation about it.
    pub(crate) fn damp(&mut self, on: Vec<u32>, rates: [f32; 2]) {
        self.damped.push((on, rates));
    }

    /// Damps velocities for a substep of `h` seconds, by `1 / (1 + rate h)` as the medium does.
    pub(crate) fn apply_damping(&self, p: &mut Particles, h: f32) {
        for (list, rates) in &self.damped {
            let Some(body) = MassProperties::of(p, list) else { continue };
            let [linear, angular] = rates.map(|rate| rate * h / (1.0 + rate * h));
            let spin = if angular > 0.0 { body.angular_velocity(p, list) } else { 0.0 };
            accelerate(p, list, |arm| arm.perp() * (-spin * angular) - body.velocity * linear, &body, f32::MAX);
        }
    }

    /// Adds a force on some particles.
    pub(crate) fn add(&mut self, on: &[u32], force: Force) {
        let first = self.particles.len();
        self.particles.extend(on);
        self.list.push((first..self.particles.len(), force));
    }

    /// All particles that something acts on.
    pub(crate) fn particles(&self) -> &[u32] {
        &self.particles
    }

    /// Changes velocities for a substep of `h` seconds, each by at most the speed limit; prescribed velocities come last.
    /// Gravity will be added afterwards, so they are less by that.
    pub(crate) fn apply(&self, p: &mut Particles, gravity: Vec2, max_speed: f32, h: f32) {
        let is_prescribed = |(_, force): &&(Range<usize>, Force)| force.velocity.is_some();
        let (free, prescribed) =
            (self.list.iter().filter(|it| !is_prescribed(it)), self.list.iter().filter(is_prescribed));
        for (range, force) in free.chain(prescribed) {
            let list = &self.particles[range.clone()];
            let Some(body) = MassProperties::of(p, list) else { continue };
            let spin = if force.torque == 0.0 { None } else { body.inertia(p, list) };
            let spin = spin.map_or(0.0, |inertia| h * force.torque / inertia);
            let push = match force.velocity {
                Some(velocity) => velocity - body.velocity - gravity * h,
                None => force.acceleration * h,
            };
            accelerate(p, list, |arm| push + arm.perp() * spin, &body, max_speed);
        }
    }
}

/// Adds velocities that depend on the place relative to the centre of mass.
fn accelerate(p: &mut Particles, list: &[u32], change: impl Fn(Vec2) -> Vec2, body: &MassProperties, max_speed: f32) {
    for &i in list {
        let i = i as usize;
        if p.inv_mass[i] > 0.0 {
            let change = change(body.arm(p, i));
            let change = change * super::ratio_limit(change.length_squared(), max_speed);
            p.vx[i] += change.x;
            p.vy[i] += change.y;
        }
    }
}

/// Adds to the velocities of some particles what an impulse on all of them together gives.
pub(crate) fn push(p: &mut Particles, list: &[u32], impulse: Vec2) {
    let mass: f32 = movable(p, list).map(|(_, mass)| mass).sum();
    for &i in list {
        if p.inv_mass[i as usize] > 0.0 {
            p.vx[i as usize] += impulse.x / mass;
            p.vy[i as usize] += impulse.y / mass;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{line, ring};
    use super::*;

    /// Sum of mass times velocity.
    fn momentum(p: &Particles, list: &[u32]) -> Vec2 {
        movable(p, list).map(|(i, mass)| p.velocity(i) * mass).sum()
    }

    #[test]
    fn a_torque_turns_about_the_centre_of_mass_and_adds_no_momentum() {
        let mut p = line(3.0, [1.0, 0.5]);
        let mut forces = Forces::default();
        forces.add(&[0, 1], Force { torque: 6.0, ..Force::default() });
        forces.apply(&mut p, Vec2::ZERO, 100.0, 0.01);
        // Masses 1 and 2 at arms of 2 and 1: an inertia of 6.
        let body = MassProperties::of(&p, &[0, 1]).unwrap();
        assert!((body.angular_velocity(&p, &[0, 1]) - 0.01).abs() < 1e-6);
        assert!(momentum(&p, &[0, 1]).length() < 1e-6);
    }

    #[test]
    fn damping_of_the_motion_leaves_the_rotation_and_the_other_way_round() {
        for (rates, velocity, spin) in [([25.0, 0.0], 4.0, 2.0), ([0.0, 25.0], 5.0, 1.6)] {
            let mut p = line(3.0, [1.0, 0.5]);
            // Arms of 2 and 1 turn with 2 radians/s while all of it moves with 5 units/s.
            (p.vx, p.vy) = (vec![5.0; 2], vec![-4.0, 2.0]);
            let mut forces = Forces::default();
            forces.damp(vec![0, 1], rates);
            forces.apply_damping(&mut p, 0.01);
            let body = MassProperties::of(&p, &[0, 1]).unwrap();
            assert!((body.velocity - Vec2::new(velocity, 0.0)).length() < 1e-5, "{}", body.velocity);
            assert!((body.angular_velocity(&p, &[0, 1]) - spin).abs() < 1e-5);
        }
    }

    #[test]
    fn a_force_and_an_impulse_leave_what_cannot_move() {
        let mut p = line(3.0, [0.0, 0.5]);
        push(&mut p, &[0, 1], Vec2::new(4.0, 0.0));
        assert_eq!((p.velocity(0), p.velocity(1)), (Vec2::ZERO, Vec2::new(2.0, 0.0)));
        push(&mut p, &[0], Vec2::X);
        let mut forces = Forces::default();
        forces.add(&[0], Force { acceleration: Vec2::X, ..Force::default() });
        forces.apply(&mut p, Vec2::ZERO, 100.0, 0.01);
        assert_eq!(p.velocity(0), Vec2::ZERO);
    }

    #[test]
    fn the_strongest_torque_on_the_smallest_body_stays_finite() {
        let mut p = ring(3, 1e-5);
        let mut forces = Forces::default();
        forces.add(&[0, 1, 2], Force { torque: 1e9, acceleration: Vec2::splat(1e15), velocity: None });
        forces.apply(&mut p, Vec2::ZERO, 20.0, 0.01);
        assert!((0..3).all(|i| p.velocity(i).length() <= 20.001), "{:?}", p.vx);
    }
}
