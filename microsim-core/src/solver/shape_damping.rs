//! Damping of a soft body's shape: what its particles move relative to its motion as a whole.
//!
//! With `V` and `Omega` the velocity and the angular velocity of a rigid body of the same momentum and angular momentum,
//! `v_i -= (c h / (1 + c h)) (v_i - V - Omega perp(r_i))`: both momenta stay (Mueller et al. 2007, "Position Based Dynamics", 3.5).

use super::lanes::ratio;
use crate::particle::Particles;
use glam::Vec2;

/// Damps the shape of some particles at this rate, 1/s, for a substep of `h` seconds. What nothing moves stays and does not count.
pub(crate) fn damp_shape(of: impl Iterator<Item = u32>, p: &mut Particles, rate: f32, h: f32) {
    let list: Vec<usize> = of.map(|i| i as usize).filter(|&i| p.inv_mass[i] > 0.0).collect();
    let Some(&first) = list.first() else { return };
    let motion = Motion::of(&list, first, p);
    let share = rate * h / (1.0 + rate * h);
    for i in list {
        let change = (motion.at(p.between(first, i)) - p.velocity(i)) * share;
        p.vx[i] += change.x;
        p.vy[i] += change.y;
    }
}

/// How particles move as a whole.
struct Motion {
    /// Centre of mass, from the first particle.
    centre: Vec2,
    velocity: Vec2,
    /// Angular velocity, 1/s.
    spin: f32,
}

impl Motion {
    fn of(list: &[usize], first: usize, p: &Particles) -> Self {
        let (mut mass, mut moment, mut momentum) = (0.0, Vec2::ZERO, Vec2::ZERO);
        for &i in list {
            let m = ratio(1.0, p.inv_mass[i]);
            mass += m;
            moment += p.between(first, i) * m;
            momentum += p.velocity(i) * m;
        }
        let (centre, velocity) = (moment / mass, momentum / mass);
        let (mut angular_momentum, mut inertia) = (0.0, 0.0);
        for &i in list {
            let (m, arm) = (ratio(1.0, p.inv_mass[i]), p.between(first, i) - centre);
            angular_momentum += m * arm.perp_dot(p.velocity(i) - velocity);
            inertia += m * arm.length_squared();
        }
        Self { centre, velocity, spin: ratio(angular_momentum, inertia) }
    }

    /// Velocity at a place, given from the first particle.
    fn at(&self, place: Vec2) -> Vec2 {
        self.velocity + (place - self.centre).perp() * self.spin
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::ring;
    use super::*;

    const ALL: std::ops::Range<u32> = 0..12;

    /// Momentum and angular momentum about the origin.
    fn momenta(p: &Particles) -> (Vec2, f32) {
        let momentum = |i: usize| p.velocity(i) / p.inv_mass[i];
        let all = || ALL.map(|i| i as usize);
        (all().map(momentum).sum(), all().map(|i| p.position(i).perp_dot(momentum(i))).sum())
    }

    #[test]
    fn a_shape_that_changes_stops_and_keeps_its_momenta() {
        let mut p = ring(12, 3.0);
        for i in 0..12 {
            p.inv_mass[i] = 1.0 / (1.0 + i as f32);
            (p.vx[i], p.vy[i]) = (0.3 - p.x[i] + 0.1 * p.y[i], 0.7 + p.y[i]);
        }
        let before = momenta(&p);
        (0..200).for_each(|_| damp_shape(ALL, &mut p, 10.0, 0.01));
        let after = momenta(&p);
        assert!((after.0 - before.0).length() < 1e-3 && (after.1 - before.1).abs() < 1e-2, "{before:?} {after:?}");
        let [a, b] = [p.between(0, 6), p.velocity(6) - p.velocity(0)];
        assert!(a.dot(b).abs() < 1e-3, "opposite particles no longer approach: {b}");
    }

    #[test]
    fn what_moves_and_turns_as_a_whole_goes_on_and_what_is_fixed_stays() {
        let mut p = ring(12, 3.0);
        for i in 0..12 {
            (p.vx[i], p.vy[i]) = (1.0 - 0.5 * p.y[i], 2.0 + 0.5 * p.x[i]);
        }
        let before = (p.vx.clone(), p.vy.clone());
        damp_shape(ALL, &mut p, 1e3, 0.01);
        let change = |now: &[f32], before: &[f32]| now.iter().zip(before).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(change(&p.vx, &before.0) && change(&p.vy, &before.1));
        p.inv_mass.fill(0.0);
        damp_shape(ALL, &mut p, 10.0, 0.01);
        damp_shape(0..0, &mut p, 10.0, 0.01);
        assert!(p.vx.iter().all(|v| v.is_finite()));
    }
}
