//! Brownian motion: what is too small to swim against the water's molecules is kicked about by them (Einstein 1905, Ann. Phys.
//! 322, 549). The displacement after a time `t` is normal with variance `2 D t` along each axis.
//!
//! The velocity of a kick is kept up for a while, so the law holds at the ends of kicks. It is normal too, with the standard
//! deviation `sqrt(2 D / interval)` along each axis: the speed limit of the world must be three times that, which takes 1 % of
//! `D` away at most. A ball of
//! radius `a` has `D = k T / (6 pi eta a)`: 0.46 square micrometres per second for a coccus of 0.47 micrometres in water.

use super::senses::{Senses, Steering};
use crate::capability::Locomotion;
use crate::config::WorldConfig;
use crate::error::{Error, in_range, out_of_range};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Least speed limit, in standard deviations of a kick along an axis: the share exp(-9 / 2) of its variance is beyond.
const SPEED_LIMIT: f32 = 3.0;

/// Parameters of Brownian motion, see [`super::Controller::brownian`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrownianParams {
    /// Diffusion coefficient, square units/s, 0 to 10 000, and at most `max_speed^2 interval / 18`.
    pub diffusion: f32,
    /// Time of a kick, s, 0.005 to 10, in whole steps and at least one.
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

    /// Checks that all of a body can be kicked, and that the speed limit leaves the kicks as they are.
    pub(super) fn check_body(&self, locomotion: &Locomotion, config: &WorldConfig) -> Result<(), Error> {
        if !matches!(locomotion, Locomotion::Tow { .. }) {
            return Err(Error::unsupported("controller", "a coccus, bacillus or probe for Brownian motion"));
        }
        let time = self.time_of_kick(config.dt);
        let deviation = config.max_speed / SPEED_LIMIT;
        let most = 0.5 * deviation * deviation * time;
        let accepted =
            || format!("0 to {most} with kicks of {time} s and a `max_speed` of {} in this world", config.max_speed);
        let is_sound = self.params.diffusion <= most;
        is_sound
            .then_some(())
            .ok_or_else(|| out_of_range("controller.diffusion", self.params.diffusion.into(), accepted()))
    }

    /// Time of a kick: a whole number of steps.
    fn time_of_kick(&self, dt: f32) -> f32 {
        let steps = (self.params.interval / dt).round();
        if steps > 1.0 { steps * dt } else { dt }
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let dt = senses.around.dt;
        if self.remaining < 0.5 * dt {
            self.remaining = self.time_of_kick(dt);
            let speed = (2.0 * self.params.diffusion / self.remaining).sqrt();
            self.velocity = Vec2::new(rng.normal(), rng.normal()) * speed;
        }
        self.remaining -= dt;
        Some(senses.with_velocity(self.velocity / senses.speed))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::mean_squared_displacement;
    use super::*;

    #[test]
    fn kicks_last_whole_steps_and_the_speed_limit_leaves_room_for_them() {
        let walk = |diffusion| Brownian::new(BrownianParams { diffusion, interval: 0.1 });
        assert!((walk(1.0).time_of_kick(1.0 / 60.0) - 0.1).abs() < 1e-6);
        assert_eq!(walk(1.0).time_of_kick(0.25), 0.25, "one step at least");
        let config = WorldConfig { dt: 1.0 / 60.0, max_speed: 60.0, ..WorldConfig::default() };
        let check = |diffusion| walk(diffusion).check_body(&Locomotion::Tow { max_acceleration: 1.0 }, &config);
        // max_speed^2 interval / 18
        assert!(check(19.9).is_ok() && check(20.1).is_err());
    }

    #[test]
    fn it_diffuses_as_fast_as_asked() {
        for interval in [0.005, 0.1, 0.13] {
            let walk = Controller::brownian(BrownianParams { diffusion: 0.46, interval });
            let measured = mean_squared_displacement(&walk, 0.6, 4.0, 4000) / (4.0 * 4.0);
            assert!((measured / 0.46 - 1.0).abs() < 0.05, "kicks of {interval} s: {measured}");
        }
    }
}
