//! Brownian motion: what is too small to swim against the water's molecules is kicked about by them (Einstein 1905, Ann. Phys.
//! 322, 549). The displacement after a time `t` is normal with variance `2 D t` along each axis.
//!
//! A kick is kept up for a while, and what is kicked has to be able to follow: its speed is `sqrt(2 D / interval)`. A ball of
//! radius `a` has `D = k T / (6 pi eta a)`: 0.46 square micrometres per second for a coccus of 0.47 micrometres in water.

use super::senses::{Senses, Steering};
use crate::error::{Error, in_range};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Parameters of Brownian motion, see [`super::Controller::brownian`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrownianParams {
    /// Diffusion coefficient, square units/s, 0 to 10 000.
    pub diffusion: f32,
    /// Time of a kick, s, 0.005 to 10; at least a step.
    pub interval: f32,
}

impl Default for BrownianParams {
    fn default() -> Self {
        Self { diffusion: 0.46, interval: 0.1 }
    }
}

/// Kicks in random directions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Brownian {
    params: BrownianParams,
    /// Of the present kick, units/s.
    velocity: Vec2,
    /// Time until the next kick, s.
    remaining: f32,
}

impl Brownian {
    pub(super) fn new(params: BrownianParams) -> Self {
        Self { params, velocity: Vec2::ZERO, remaining: 0.0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("diffusion", self.params.diffusion, 0.0, 1e4)?;
        in_range("interval", self.params.interval, 0.005, 10.0)
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let dt = senses.around.dt;
        if self.remaining < 0.5 * dt {
            // A kick lasts a whole number of steps.
            let steps = (self.params.interval / dt).round();
            self.remaining = if steps > 1.0 { steps * dt } else { dt };
            let speed = (2.0 * self.params.diffusion / self.remaining).sqrt();
            self.velocity = Vec2::new(rng.normal(), rng.normal()) * speed;
        }
        self.remaining -= dt;
        let relative_speed = self.velocity.length() / senses.speed;
        relative_speed
            .is_normal()
            .then(|| Steering { relative_speed, ..senses.along(self.velocity / (relative_speed * senses.speed)) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::mean_squared_displacement;
    use super::*;

    #[test]
    fn it_diffuses_as_fast_as_asked() {
        for interval in [0.005, 0.1, 0.13] {
            let walk = Controller::brownian(BrownianParams { diffusion: 0.46, interval });
            let measured = mean_squared_displacement(&walk, 0.6, 4.0, 4000) / (4.0 * 4.0);
            assert!((measured / 0.46 - 1.0).abs() < 0.05, "kicks of {interval} s: {measured}");
        }
    }
}
