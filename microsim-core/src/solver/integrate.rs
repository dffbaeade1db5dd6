//! The two ends of a substep: where particles would go, and what velocity their corrected positions amount to.

use super::lanes::{LANES, load, store};
use super::ratio_limit;
use crate::instruction_set::{Dispatch, each};
use crate::parallel::{self, CHUNK};
use crate::particle::{Columns, GRID, Particles};
use glam::Vec2;
use std::ops::Range;

/// Added and taken away, it rounds to whole numbers what is smaller than it: beyond 2^23 `f32` has no fractions.
const ROUNDS: f32 = 12_582_912.0;

/// Does the same to all particles of some ranges, a chunk at a time.
pub(crate) fn for_each_chunk(
    p: &mut Particles,
    ranges: impl Iterator<Item = Range<usize>>,
    dispatch: Dispatch,
    kernel: impl Fn(&mut Columns<'_>) + Send + Sync,
) {
    parallel::for_each(p.columns().chunks(ranges, CHUNK), |mut chunk| {
        dispatch.run(
            #[inline(always)]
            || kernel(&mut chunk),
        );
    });
}

/// `v += h g`, limited to the speed limit; `x += h v`, for everything that can move.
#[inline(always)]
pub(crate) fn predict_positions(particles: &mut Columns<'_>, gravity: Vec2, max_speed: f32, h: f32) {
    let particles = &mut particles.even();
    let (whole, end) = in_lanes(particles);
    for at in (0..whole).step_by(LANES) {
        predict::<LANES>(particles, at, gravity, max_speed, h);
    }
    for at in whole..end {
        predict::<1>(particles, at, gravity, max_speed, h);
    }
}

#[inline(always)]
fn predict<const L: usize>(p: &mut Columns<'_>, at: usize, gravity: Vec2, max_speed: f32, h: f32) {
    let inv_mass = load::<L>(p.inv_mass, at);
    let moves = each::<L>(|l| if inv_mass[l] > 0.0 { 1.0 } else { 0.0 });
    let (x, y, vx, vy) = (load::<L>(p.x, at), load::<L>(p.y, at), load::<L>(p.vx, at), load::<L>(p.vy, at));
    let (vx, vy) =
        (each::<L>(|l| moves[l] * (vx[l] + h * gravity.x)), each::<L>(|l| moves[l] * (vy[l] + h * gravity.y)));
    let (vx, vy) = match limits(&vx, &vy, max_speed) {
        Some(limit) => (each::<L>(|l| vx[l] * limit[l]), each::<L>(|l| vy[l] * limit[l])),
        None => (vx, vy),
    };
    store(p.vx, at, vx);
    store(p.vy, at, vy);
    store(p.prev_x, at, x);
    store(p.prev_y, at, y);
    store(p.x, at, each::<L>(|l| x[l] + h * vx[l]));
    store(p.y, at, each::<L>(|l| y[l] + h * vy[l]));
}

/// `v += (x - x_predicted) / h`, damped: the same as `(x - x_prev) / h`, but what no constraint has corrected keeps its
/// velocity to the bit, whatever the substep and the rounding of positions. A particle that the projections moved farther than the speed limit allows is moved
/// back along its way, so that nothing travels farther in a step than pairs were searched for.
#[inline(always)]
pub(crate) fn update_velocities(particles: &mut Columns<'_>, damping: f32, max_speed: f32, h: f32) {
    let keep = 1.0 / (1.0 + damping * h);
    let particles = &mut particles.even();
    let (whole, end) = in_lanes(particles);
    for at in (0..whole).step_by(LANES) {
        update::<LANES>(particles, at, max_speed, keep, h);
    }
    for at in whole..end {
        update::<1>(particles, at, max_speed, keep, h);
    }
}

#[inline(always)]
fn update<const L: usize>(p: &mut Columns<'_>, at: usize, max_speed: f32, keep: f32, h: f32) {
    let inverse = 1.0 / h;
    let (x, y, from_x, from_y) =
        (load::<L>(p.x, at), load::<L>(p.y, at), load::<L>(p.prev_x, at), load::<L>(p.prev_y, at));
    let (vx, vy) = (load::<L>(p.vx, at), load::<L>(p.vy, at));
    let corrected = |x: f32, from: f32, v: f32| v + (x - (from + h * v)) * inverse;
    let (mut vx, mut vy) =
        (each::<L>(|l| corrected(x[l], from_x[l], vx[l])), each::<L>(|l| corrected(y[l], from_y[l], vy[l])));
    let (dx, dy) = (each::<L>(|l| x[l] - from_x[l]), each::<L>(|l| y[l] - from_y[l]));
    if let Some(limit) = limits(&dx, &dy, max_speed * h) {
        (vx, vy) = (each::<L>(|l| vx[l] * limit[l]), each::<L>(|l| vy[l] * limit[l]));
        store(p.x, at, each::<L>(|l| if limit[l] < 1.0 { from_x[l] + dx[l] * limit[l] } else { x[l] }));
        store(p.y, at, each::<L>(|l| if limit[l] < 1.0 { from_y[l] + dy[l] * limit[l] } else { y[l] }));
    }
    store(p.vx, at, each::<L>(|l| vx[l] * keep));
    store(p.vy, at, each::<L>(|l| vy[l] * keep));
}

/// Whether [`update_velocities`] is going to move anything in these ranges back.
pub(crate) fn exceed_speed_limit(
    p: &mut Particles,
    ranges: impl Iterator<Item = Range<usize>>,
    dispatch: Dispatch,
    max_speed: f32,
    h: f32,
) -> bool {
    let exceeds = |mut chunk: Columns<'_>| {
        dispatch.run(
            #[inline(always)]
            || {
                let (chunk, longest) = (&mut chunk.even(), max_speed * h);
                let (whole, end) = in_lanes(chunk);
                (0..whole).step_by(LANES).any(|at| exceeds::<LANES>(chunk, at, longest))
                    || (whole..end).any(|at| exceeds::<1>(chunk, at, longest))
            },
        )
    };
    parallel::map(p.columns().chunks(ranges, CHUNK), exceeds).contains(&true)
}

#[inline(always)]
fn exceeds<const L: usize>(p: &Columns<'_>, at: usize, longest: f32) -> bool {
    let (x, y, from_x, from_y) =
        (load::<L>(p.x, at), load::<L>(p.y, at), load::<L>(p.prev_x, at), load::<L>(p.prev_y, at));
    limits(&each::<L>(|l| x[l] - from_x[l]), &each::<L>(|l| y[l] - from_y[l]), longest).is_some()
}

/// Moves origins to the places on their grid that are nearest to the particles, which stay where they are: all differences are
/// exact.
#[inline(always)]
pub(crate) fn move_origins(particles: &mut Columns<'_>) {
    move_origins_along(particles.origin_x, particles.x, particles.prev_x);
    move_origins_along(particles.origin_y, particles.y, particles.prev_y);
}

#[inline(always)]
fn move_origins_along(origin: &mut [f32], offset: &mut [f32], previous: &mut [f32]) {
    for ((origin, offset), previous) in origin.iter_mut().zip(offset).zip(previous) {
        let by = (*offset * (1.0 / GRID) + ROUNDS - ROUNDS) * GRID;
        *origin += by;
        *offset -= by;
        *previous -= by;
    }
}

/// Factors that bring vectors down to `longest`, if one of them is longer: few are, and a root and a division are most of the
/// work here.
#[inline(always)]
fn limits<const L: usize>(x: &[f32; L], y: &[f32; L], longest: f32) -> Option<[f32; L]> {
    let squared = each::<L>(|l| x[l] * x[l] + y[l] * y[l]);
    let some = squared.iter().fold(false, |some, &squared| some | (squared > longest * longest));
    if some { Some(each::<L>(|l| ratio_limit(squared[l], longest))) } else { None }
}

/// How many entries can be worked on in lanes, and how many there are.
#[inline(always)]
fn in_lanes(particles: &Columns<'_>) -> (usize, usize) {
    let count = particles.x.len();
    (count - count % LANES, count)
}

/// Takes back the damping of [`update_velocities`] from some particles.
pub(crate) fn undo_damping(of: &[u32], particles: &mut Particles, damping: f32, h: f32) {
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

    fn substep(p: &mut Particles, gravity: Vec2, damping: f32, h: f32) {
        predict_positions(&mut p.columns(), gravity, 1e3, h);
        update_velocities(&mut p.columns(), damping, 1e3, h);
    }

    #[test]
    fn free_fall_follows_the_closed_form() {
        let mut p = line(1.0, [1.0, 0.0]);
        (0..100).for_each(|_| substep(&mut p, Vec2::new(0.0, -10.0), 0.0, 0.01));
        assert!((p.vy[0] + 10.0).abs() < 1e-2, "v {}", p.vy[0]);
        assert!((p.y[0] + 5.0).abs() < 0.06, "y {}", p.y[0]);
        assert_eq!((p.y[1], p.vy[1]), (0.0, 0.0), "what has no inverse mass does not fall");
    }

    #[test]
    fn one_of_many_that_exceeds_the_speed_limit_is_found() {
        let exceeds = |p: &mut Particles, ranges: [Range<usize>; 2]| {
            exceed_speed_limit(p, ranges.into_iter(), Dispatch::default(), 5.0, 0.01)
        };
        for fast in [0, CHUNK - 1, CHUNK + 9, 3 * CHUNK + 4] {
            let mut p = Particles::default();
            p.extend(3 * CHUNK + 5);
            let whole = |p: &Particles| [0..CHUNK + 7, CHUNK + 7..p.len()];
            let without = |p: &Particles| [0..fast, fast + 1..p.len()];
            let (whole, without) = (whole(&p), without(&p));
            assert!(!exceeds(&mut p, whole.clone()), "nothing moves");
            p.y[fast] = 0.051;
            assert!(exceeds(&mut p, whole), "{fast}");
            assert!(!exceeds(&mut p, without), "without {fast}");
        }
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
        (0..1000).for_each(|_| substep(&mut p, Vec2::ZERO, 0.5, 0.001));
        assert!((p.vx[0] - (-0.5f64).exp() as f32).abs() < 3e-3, "v {}", p.vx[0]);
    }

    #[test]
    fn damping_that_is_taken_back_takes_nothing() {
        let mut p = line(1.0, [1.0, 1.0]);
        (p.vx[0], p.vx[1]) = (1.0, 1.0);
        for _ in 0..1000 {
            substep(&mut p, Vec2::ZERO, 0.5, 0.001);
            undo_damping(&[1], &mut p, 0.5, 0.001);
        }
        assert!(p.vx[0] < 0.7 && (p.vx[1] - 1.0).abs() < 1e-3, "{} {}", p.vx[0], p.vx[1]);
    }

    #[test]
    fn vectors_are_brought_down_however_many_are_long() {
        for long in 1..=4 {
            let x: [f32; 4] = std::array::from_fn(|l| if l < long { 8.0 } else { 1.0 });
            let factors = limits(&x, &[0.0; 4], 2.0).unwrap();
            let brought: [f32; 4] = std::array::from_fn(|l| x[l] * factors[l]);
            assert_eq!(brought, std::array::from_fn(|l| if l < long { 2.0 } else { 1.0 }));
        }
        assert_eq!(limits(&[2.0, 0.0], &[0.0, -2.0], 2.0), None);
    }

    #[test]
    fn moving_origins_moves_nothing() {
        let mut p = line(1.0, [1.0, 1.0]);
        (p.x[0], p.prev_x[0], p.y[1], p.prev_y[1]) = (0.3, 0.25, -0.7, -0.65);
        let places = |p: &Particles| [0, 1].map(|i| (p.position(i), p.last_position(i)));
        let before = places(&p);
        move_origins(&mut p.columns());
        assert_eq!(places(&p), before);
        assert!(p.x.iter().chain(&p.y).all(|offset| offset.abs() <= 0.5 * GRID), "{:?} {:?}", p.x, p.y);
    }
}
