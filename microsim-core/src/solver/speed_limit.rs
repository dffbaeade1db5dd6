//! Momentum at the speed limit. [`super::integrate`] moves back what the projections moved too far, particle by particle: a cell that
//! becomes round in a hurry would swim by it. So of cells the other particles move on by what these lose.

use super::contact::{moved, shift};
use super::lanes::ratio;
use super::ratio_limit;
use crate::particle::Particles;
use glam::Vec2;

/// Particles that come to the limit by their part pass it on to the others in the next round.
const ROUNDS: usize = 8;
/// Ways end so near to the limit that the rounding of positions does not lift them beyond it.
const WITHIN: f32 = 0.9999;

/// Moves back those of some particles that have moved farther than `longest` since the substep began, and moves the others on, so
/// that the centre of mass stays where it is unless all are at the limit.
pub(crate) fn limit_ways<I: Iterator<Item = u32>>(of: impl Fn() -> I, p: &mut Particles, longest: f32) {
    let within = WITHIN * longest;
    // Nearly always.
    if !of().any(|i| moved(p, i as usize).length_squared() > within * within) {
        return;
    }
    let mut on = Vec2::ZERO;
    for _ in 0..ROUNDS {
        let (mut mass, mut lost) = (0.0, Vec2::ZERO);
        for i in of().map(|i| i as usize) {
            if p.inv_mass[i] == 0.0 {
                continue;
            }
            let (way, own) = (moved(p, i) + on, ratio(1.0, p.inv_mass[i]));
            let back = way * (1.0 - ratio_limit(way.length_squared(), within));
            shift(p, i, on - back);
            mass += own;
            lost += back * own;
        }
        if lost == Vec2::ZERO || !lost.is_finite() {
            return;
        }
        on = lost * ratio(1.0, mass);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{disc, line, momentum};
    use super::*;

    const LONGEST: f32 = 0.05;

    #[test]
    fn what_one_particle_loses_the_others_get() {
        let mut p = line(1.0, [1.0, 0.25]);
        p.insert(&disc(Vec2::new(2.0, 0.0), 0.0));
        let before = momentum(&p);
        // As constraints leave it: they keep momentum.
        (p.x[0], p.x[1]) = (p.x[0] - 0.2, p.x[1] + 0.05);
        limit_ways(|| 0..3, &mut p, LONGEST);
        assert!((momentum(&p) - before).length() < 1e-3, "{}", momentum(&p) - before);
        assert!((0..3).all(|i| moved(&p, i).length() <= LONGEST) && moved(&p, 2) == Vec2::ZERO);
    }

    #[test]
    fn all_at_the_limit_go_no_farther() {
        let mut p = line(1.0, [1.0, 1.0]);
        p.x.iter_mut().for_each(|x| *x += 3.0);
        limit_ways(|| 0..2, &mut p, LONGEST);
        assert!((0..2).all(|i| (moved(&p, i).x - LONGEST).abs() < 1e-3 * LONGEST), "{:?}", p.x);
    }

    #[test]
    fn ways_within_the_limit_are_left_alone() {
        let mut p = line(1.0, [1.0, 0.25]);
        p.x[0] += 0.9 * LONGEST;
        let before = p.clone();
        limit_ways(|| 0..2, &mut p, LONGEST);
        assert_eq!((p.x, p.y), (before.x, before.y));
    }
}
