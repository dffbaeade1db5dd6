//! Persistent random walk of a cell that senses nothing: its heading diffuses, so that after a time `t` it is correlated with
//! what it was by `exp(-t / P)`. The mean squared displacement is that of Fuerth 1920 (Z. Phys. 2, 244),
//! `2 S^2 P (t - P (1 - exp(-t / P)))`; for crawling cells see Gail and Boone 1970 (Biophys. J. 10, 980) and Li,
//! Norrelykke and Cox 2008 (PLoS ONE 3, e2093).

use super::check_time;
use super::senses::{Senses, Steering};
use crate::capability::Locomotion;
use crate::error::{Error, in_range, out_of_range};
use crate::geometry::ring::{direction_or, rotate, unit_vector};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// Shortest persistence that an amoeboid cell follows, s: with 0.2 s its mean squared displacement is three times that of the law.
const LEAST_OF_A_CELL: f32 = 1.0;

/// Parameters of the persistent random walk, see [`super::Controller::persistent_walk`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PersistentWalkParams {
    /// Time over which it keeps its direction, s, 0.05 to 10 000; at least three steps, and 1 s in an amoeboid cell.
    pub persistence: f32,
}

impl Default for PersistentWalkParams {
    fn default() -> Self {
        Self { persistence: 10.0 }
    }
}

/// A heading that diffuses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PersistentWalk {
    params: PersistentWalkParams,
    /// A unit vector; zero before the first step.
    pub(super) heading: Vec2,
}

impl PersistentWalk {
    pub(super) fn new(params: PersistentWalkParams) -> Self {
        Self { params, heading: Vec2::ZERO }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("persistence", self.params.persistence, 0.05, 1e4)
    }

    /// Checks that the steps and the body follow it.
    pub(super) fn check_body(&self, locomotion: &Locomotion, dt: f32) -> Result<(), Error> {
        let Self { params: PersistentWalkParams { persistence }, .. } = *self;
        check_time("persistence", persistence, dt)?;
        let crawls = matches!(locomotion, Locomotion::Crawl { .. } | Locomotion::Protrude(_));
        if crawls && persistence < LEAST_OF_A_CELL {
            let accepted = format!("{LEAST_OF_A_CELL} or more for an amoeboid cell, whose front takes time to form");
            return Err(out_of_range("controller.persistence", persistence.into(), accepted));
        }
        Ok(())
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let before = self.heading;
        self.turn(senses.around.dt, rng);
        self.heading = senses.along_walls(self.heading);
        // It turns during the step: nearer to the law than where it heads before or after.
        let mean = if before == Vec2::ZERO { self.heading } else { 0.5 * (before + self.heading) };
        Some(senses.with_velocity(mean))
    }

    /// Lets the heading diffuse for a step.
    pub(super) fn turn(&mut self, dt: f32, rng: &mut Rng) {
        if self.heading == Vec2::ZERO {
            self.heading = unit_vector(rng.range(0.0, TAU));
        }
        let angle = rng.normal() * (2.0 * dt / self.params.persistence).sqrt();
        self.heading = direction_or(rotate(self.heading, unit_vector(angle)), Vec2::X);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::mean_squared_displacement;
    use super::*;

    #[test]
    fn the_mean_squared_displacement_is_fuerths() {
        let (persistence, speed) = (2.0, 3.0);
        let walk = Controller::persistent_walk(PersistentWalkParams { persistence });
        for periods in [0.5, 1.0, 3.0, 10.0] {
            let time = periods * persistence;
            let measured = mean_squared_displacement(&walk, speed, time, 5000);
            let p = f64::from(persistence);
            let expected =
                2.0 * f64::from(speed).powi(2) * p * (f64::from(time) - p * (1.0 - (-f64::from(periods)).exp()));
            println!("t = {periods} P: {measured:.2}, Fuerth {expected:.2}");
            assert!((measured / expected - 1.0).abs() < 0.05, "after {periods} P: {measured} instead of {expected}");
        }
    }
}
