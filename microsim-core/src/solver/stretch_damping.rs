//! Damping of how a soft body stretches: of the one way of moving in which it becomes longer and thinner as a whole.
//!
//! With arms `r` from the centre of mass, the fields `(x, -y)` and `(y, x)` stretch a body and keep its area. Each is freed of its
//! angular momentum by the rotation `perp(r)`; the share `c h / (1 + c h)` of the velocities' projection on both, weighted by mass, is
//! taken away. Momentum and angular momentum stay, energy can only fall (after Müller et al. 2007, "Position Based Dynamics", 3.5, which
//! damps all but the rigid motion).

use super::lanes::ratio;
use super::ratio_limit;
use crate::particle::Particles;
use glam::{Mat2, Vec2};

/// Damps the stretching of some particles at this rate, 1/s, for a step of `h` seconds. What nothing moves stays and does not count.
/// Nothing gets faster than the speed limit by it.
pub(crate) fn damp_stretching<I: Iterator<Item = u32>>(
    of: impl Fn() -> I,
    p: &mut Particles,
    rate: f32,
    max_speed: f32,
    h: f32,
) {
    let particles = || of().map(|i| i as usize);
    let Some(first) = particles().next() else { return };
    let Some(stretch) = Stretch::of(particles(), first, p) else { return };
    let share = rate * h / (1.0 + rate * h);
    for i in particles() {
        if p.inv_mass[i] > 0.0 {
            let change = stretch.at(p.between(first, i)) * share;
            let velocity = p.velocity(i) - change;
            let limit = ratio_limit(velocity.length_squared(), max_speed);
            (p.vx[i], p.vy[i]) = (velocity * limit).into();
        }
    }
}

/// How particles stretch: `a (x, -y) + b (y, x) + spin perp(r)`.
struct Stretch {
    /// Centre of mass, from the first particle.
    centre: Vec2,
    a: f32,
    b: f32,
    spin: f32,
}

impl Stretch {
    /// That of some particles, given from the first of them; `None` if nothing can move them.
    fn of(particles: impl Iterator<Item = usize>, first: usize, p: &Particles) -> Option<Self> {
        let (mut mass, mut moment, mut momentum) = (0.0, Vec2::ZERO, Vec2::ZERO);
        // Sums of mass times arm times arm, and of mass times arm times velocity: a column for each component of the arm.
        let (mut arms, mut velocities) = (Mat2::ZERO, Mat2::ZERO);
        for i in particles {
            let m = ratio(1.0, p.inv_mass[i]);
            let (arm, velocity) = (p.between(first, i), p.velocity(i) * m);
            mass += m;
            moment += arm * m;
            momentum += velocity;
            arms += outer(arm * m, arm);
            velocities += outer(velocity, arm);
        }
        let centre = moment * ratio(1.0, mass);
        let (arms, velocities) = (arms - outer(moment, centre), velocities - outer(momentum, centre));
        (mass > 0.0).then(|| Self { centre, ..Self::fit(arms, velocities) })
    }

    /// The field nearest to velocities, from sums about the centre of mass.
    fn fit(arms: Mat2, velocities: Mat2) -> Self {
        let inertia = arms.x_axis.x + arms.y_axis.y;
        // The rotations that take the angular momentum out of each field.
        let spin_a = ratio(2.0 * arms.x_axis.y, inertia);
        let spin_b = ratio(arms.y_axis.y - arms.x_axis.x, inertia);
        let turning = velocities.x_axis.y - velocities.y_axis.x;
        let on_a = velocities.x_axis.x - velocities.y_axis.y + spin_a * turning;
        let on_b = velocities.y_axis.x + velocities.x_axis.y + spin_b * turning;
        let (aa, bb) = (inertia * (1.0 - spin_a * spin_a), inertia * (1.0 - spin_b * spin_b));
        let ab = -spin_a * spin_b * inertia;
        let determinant = aa * bb - ab * ab;
        let (a, b) = (ratio(on_a * bb - on_b * ab, determinant), ratio(on_b * aa - on_a * ab, determinant));
        Self { centre: Vec2::ZERO, a, b, spin: a * spin_a + b * spin_b }
    }

    /// Velocity at a place, given from the first particle.
    fn at(&self, place: Vec2) -> Vec2 {
        let arm = place - self.centre;
        Vec2::new(self.a * arm.x + self.b * arm.y, self.b * arm.x - self.a * arm.y) + arm.perp() * self.spin
    }
}

fn outer(column: Vec2, row: Vec2) -> Mat2 {
    Mat2::from_cols(column * row.x, column * row.y)
}

#[cfg(test)]
mod tests {
    use super::super::testing::ring;
    use super::*;

    /// Momentum, angular momentum about the origin, and energy.
    fn motion(p: &Particles) -> (Vec2, f32, f32) {
        let momentum = |i: usize| p.velocity(i) / p.inv_mass[i];
        let energy = |i: usize| 0.5 * momentum(i).dot(p.velocity(i));
        let turning = |i: usize| p.position(i).perp_dot(momentum(i));
        (p.live().map(momentum).sum(), p.live().map(turning).sum(), p.live().map(energy).sum())
    }

    /// A long body of unequal particles.
    fn body(velocity: impl Fn(Vec2) -> Vec2) -> Particles {
        let mut p = ring(12, 3.0);
        for i in 0..12 {
            p.inv_mass[i] = 1.0 / (1.0 + i as f32);
            (p.x[i], p.y[i]) = (1.7 * p.x[i] + 0.3 * p.y[i], 0.8 * p.y[i]);
            let v = velocity(p.position(i));
            (p.vx[i], p.vy[i]) = (v.x, v.y);
        }
        p
    }

    #[test]
    fn stretching_stops_and_momenta_stay() {
        let mut p = body(|at| Vec2::new(0.3 - at.x + 0.1 * at.y + 0.02 * at.y * at.y, 0.7 + at.y));
        let mut before = motion(&p);
        for _ in 0..200 {
            damp_stretching(|| 0..12, &mut p, 10.0, 1e3, 0.01);
            let after = motion(&p);
            assert!((after.0 - before.0).length() < 1e-2 && (after.1 - before.1).abs() < 1e-2, "{before:?} {after:?}");
            assert!(after.2 < before.2 + 1e-3, "{before:?} {after:?}");
            before = after;
        }
        let left = Stretch::of(0..12, 0, &p).unwrap();
        assert!(left.a.abs() < 1e-3 && left.b.abs() < 1e-3, "{} {}", left.a, left.b);
        assert!(p.velocity(3) != p.velocity(4), "other motion goes on");
    }

    #[test]
    fn a_share_of_stretching_is_lost_per_second_whatever_the_substep() {
        for steps in [10u16, 100] {
            let mut p = ring(12, 3.0);
            for i in 0..12 {
                (p.vx[i], p.vy[i]) = (p.x[i], -p.y[i]);
            }
            let h = 0.1 / f32::from(steps);
            (0..steps).for_each(|_| damp_stretching(|| 0..12, &mut p, 2.0, 1e3, h));
            let kept = p.vx[0] / p.x[0];
            assert!((kept - 0.8187).abs() < 4e-3, "{steps} steps: {kept}");
        }
    }

    #[test]
    fn what_moves_turns_and_grows_as_a_whole_goes_on_and_what_is_fixed_stays() {
        let mut p = body(|at| Vec2::new(1.0, 2.0) + at.perp() * 0.5);
        let before = (p.vx.clone(), p.vy.clone());
        damp_stretching(|| 0..12, &mut p, 1e3, 1e3, 0.01);
        let is_same = |now: &[f32], before: &[f32]| now.iter().zip(before).all(|(a, b)| (a - b).abs() < 1e-4);
        assert!(is_same(&p.vx, &before.0) && is_same(&p.vy, &before.1));
        p.inv_mass.fill(0.0);
        damp_stretching(|| 0..12, &mut p, 10.0, 1e3, 0.01);
        damp_stretching(|| 0..0, &mut p, 10.0, 1e3, 0.01);
        damp_stretching(|| 0..1, &mut p, 10.0, 1e3, 0.01);
        assert!(p.vx.iter().all(|v| v.is_finite()));
    }
}
