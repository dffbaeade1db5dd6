//! Contraction: two nodes approach each other at a given speed, whatever holds them back, as the ends of a muscle fibre.
//!
//! `C = |x_b - x_a| - (|x_b - x_a|_prev - h v) <= 0`, projected rigidly like a rope ([`Rope`]) that is reeled in.

use super::constraint::Rope;
use super::contact::moved;
use super::lanes::Span;
use crate::particle::Particles;

/// Two nodes of one organism that are drawn together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Contraction {
    pub a: u32,
    pub b: u32,
    /// Speed of their approach, units/s.
    pub speed: f32,
}

/// Draws each pair together for a substep of `h` seconds.
pub(crate) fn project(contractions: &[Contraction], p: &mut Particles, h: f32) {
    for &Contraction { a, b, speed } in contractions {
        let (i, j) = (a as usize, b as usize);
        let before = p.between(i, j) - (moved(p, j) - moved(p, i));
        let length = before.length() - h * speed;
        let max_length = if length > 0.0 { length } else { 0.0 };
        Rope { a, b, max_length }.shorten(&[Span::LOOSE], &mut p.columns());
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{line, momentum};
    use super::*;

    #[test]
    fn the_ends_approach_at_the_given_speed_against_any_pull_and_keep_their_momentum() {
        let mut p = line(3.0, [1.0, 0.25]);
        for _ in 0..100 {
            p.prev_x.clone_from(&p.x);
            p.x[1] += 0.5;
            let before = momentum(&p);
            project(&[Contraction { a: 0, b: 1, speed: 2.0 }], &mut p, 0.01);
            assert!((momentum(&p) - before).length() < 1e-4);
        }
        assert!((p.x[1] - p.x[0] - 1.0).abs() < 1e-3, "{} apart", p.x[1] - p.x[0]);
    }
}
