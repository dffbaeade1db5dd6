//! To and fro without rest: every now and then the opposite or a random direction. Hard on membranes.

use super::senses::{Senses, Steering};
use crate::error::{Error, in_range};
use crate::geometry::ring::unit_vector;
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// See [`super::Controller::thrash`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thrash {
    interval: f32,
    reversal: f32,
    /// Present direction, a unit vector; zero before the first decision.
    direction: Vec2,
    /// Time until the next decision, s.
    remaining: f32,
}

impl Thrash {
    pub(super) fn new(interval: f32, reversal: f32) -> Self {
        Self { interval, reversal, direction: Vec2::ZERO, remaining: 0.0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("interval", self.interval, 0.01, 600.0)?;
        in_range("reversal", self.reversal, 0.0, 1.0)
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        self.remaining -= senses.around.dt;
        if self.remaining <= 0.0 {
            self.remaining = self.interval;
            let reverses = self.direction != Vec2::ZERO && rng.unit() < self.reversal;
            self.direction = if reverses { -self.direction } else { unit_vector(rng.range(0.0, TAU)) };
        }
        Some(senses.along(self.direction))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::Bench;
    use super::*;

    #[test]
    fn thrashing_turns_round_or_anywhere() {
        let ways = |reversal: f32| {
            let mut bench = Bench::new(Controller::thrash(0.5, reversal), 0.1);
            (0..500).map(|_| bench.heading().unwrap()).collect::<Vec<Vec2>>()
        };
        let turns = |ways: &[Vec2]| ways.windows(2).filter(|pair| (pair[1] - pair[0]).length() > 1e-3).count();
        let to_and_fro = ways(1.0);
        assert!((80..=100).contains(&turns(&to_and_fro)));
        assert!(to_and_fro.iter().all(|way| way.perp_dot(to_and_fro[0]).abs() < 1e-3));
        let anywhere = ways(0.0);
        assert!(turns(&anywhere) >= 80 && anywhere.iter().sum::<Vec2>().length() < 0.3 * 500.0);
    }
}
