//! The two ends of a substep: where particles would go, and what velocity their corrected positions amount to.

use super::instruction_set::Dispatch;
use super::ratio_limit;
use crate::parallel;
use crate::particle::{Columns, Particles};
use glam::Vec2;

/// Particles of a stretch, a fixed number whatever the number of threads.
const STRETCH: usize = 8192;

/// Does the same to all particles, a stretch at a time.
pub(crate) fn in_stretches(p: &mut Particles, dispatch: Dispatch, kernel: impl Fn(&mut Columns<'_>) + Send + Sync) {
    parallel::for_each(p.columns().chunks(STRETCH), |mut stretch| {
        dispatch.run(
            #[inline(always)]
            || kernel(&mut stretch),
        );
    });
}

/// `v += h g`, limited to the speed limit; `x += h v`, for everything that can move.
#[inline(always)]
pub(crate) fn predict_positions(particles: &mut Columns<'_>, gravity: Vec2, max_speed: f32, h: f32) {
    let Columns { x, y, prev_x, prev_y, vx, vy, inv_mass, .. } = particles;
    let moving = x.iter_mut().zip(&mut **y).zip(prev_x.iter_mut().zip(&mut **prev_y));
    let columns = moving.zip(vx.iter_mut().zip(&mut **vy)).zip(inv_mass.iter());
    for ((((x, y), (prev_x, prev_y)), (vx, vy)), inv_mass) in columns {
        let moves = if *inv_mass > 0.0 { h } else { 0.0 };
        *vx += moves * gravity.x;
        *vy += moves * gravity.y;
        let limit = ratio_limit(*vx * *vx + *vy * *vy, max_speed);
        *vx *= limit;
        *vy *= limit;
        *prev_x = *x;
        *prev_y = *y;
        *x += moves * *vx;
        *y += moves * *vy;
    }
}

/// `v = (x - x_prev) / h`, damped. A particle that the projections moved farther than the speed limit allows is moved
/// back along its way, so that nothing travels farther in a step than pairs were searched for.
#[inline(always)]
pub(crate) fn update_velocities(particles: &mut Columns<'_>, damping: f32, max_speed: f32, h: f32) {
    let keep = 1.0 / (1.0 + damping * h);
    let (longest, inverse) = (max_speed * h, 1.0 / h);
    let Columns { x, y, prev_x, prev_y, vx, vy, .. } = particles;
    let columns = x.iter_mut().zip(&mut **y).zip(prev_x.iter().zip(&**prev_y)).zip(vx.iter_mut().zip(&mut **vy));
    for (((x, y), (prev_x, prev_y)), (vx, vy)) in columns {
        let (dx, dy) = (*x - *prev_x, *y - *prev_y);
        let limit = ratio_limit(dx * dx + dy * dy, longest);
        *x = *prev_x + dx * limit;
        *y = *prev_y + dy * limit;
        *vx = dx * limit * inverse * keep;
        *vy = dy * limit * inverse * keep;
    }
}

/// Takes back the damping of [`update_velocities`] from some particles.
pub(crate) fn take_back_damping(of: &[u32], particles: &mut Particles, damping: f32, h: f32) {
    let undo = 1.0 + damping * h;
    for &i in of {
        particles.vx[i as usize] *= undo;
        particles.vy[i as usize] *= undo;
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::line;
    use super::*;

    #[test]
    fn free_fall_follows_the_closed_form() {
        let mut p = line(1.0, [1.0, 0.0]);
        for _ in 0..100 {
            predict_positions(&mut p.columns(), Vec2::new(0.0, -10.0), 1e3, 0.01);
            update_velocities(&mut p.columns(), 0.0, 1e3, 0.01);
        }
        assert!((p.vy[0] + 10.0).abs() < 1e-2, "v {}", p.vy[0]);
        assert!((p.y[0] + 5.0).abs() < 0.06, "y {}", p.y[0]);
        assert_eq!((p.y[1], p.vy[1]), (0.0, 0.0), "what has no inverse mass does not fall");
    }

    #[test]
    fn nothing_moves_farther_than_the_speed_limit() {
        let mut p = line(1.0, [1.0, 1.0]);
        p.vx[0] = 1e6;
        predict_positions(&mut p.columns(), Vec2::ZERO, 5.0, 0.01);
        p.x[0] += 100.0;
        update_velocities(&mut p.columns(), 0.0, 5.0, 0.01);
        assert!((p.x[0] - 0.05).abs() < 1e-6, "x {}", p.x[0]);
        assert!((p.vx[0] - 5.0).abs() < 1e-3);
    }

    #[test]
    fn damping_takes_its_share_per_second() {
        let mut p = line(1.0, [1.0, 1.0]);
        p.vx[0] = 1.0;
        for _ in 0..1000 {
            predict_positions(&mut p.columns(), Vec2::ZERO, 10.0, 0.001);
            update_velocities(&mut p.columns(), 0.5, 10.0, 0.001);
        }
        assert!((p.vx[0] - (-0.5f64).exp() as f32).abs() < 3e-3, "v {}", p.vx[0]);
    }

    #[test]
    fn damping_that_is_taken_back_takes_nothing() {
        let mut p = line(1.0, [1.0, 1.0]);
        (p.vx[0], p.vx[1]) = (1.0, 1.0);
        for _ in 0..1000 {
            predict_positions(&mut p.columns(), Vec2::ZERO, 10.0, 0.001);
            update_velocities(&mut p.columns(), 0.5, 10.0, 0.001);
            take_back_damping(&[1], &mut p, 0.5, 0.001);
        }
        assert!(p.vx[0] < 0.7 && (p.vx[1] - 1.0).abs() < 1e-3, "{} {}", p.vx[0], p.vx[1]);
    }
}
