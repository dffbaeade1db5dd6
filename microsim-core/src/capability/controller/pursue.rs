//! Pursuit of prey in sight: it heads for where the prey will be (Reynolds 1999, "Steering Behaviors For Autonomous
//! Characters": pursuit). Where there is none it does something else.

use super::Controller;
use super::senses::{Senses, Steering};
use crate::error::{Error, in_range};
use crate::rng::Rng;
use serde::{Deserialize, Serialize};

/// Farthest that it looks ahead, s.
const FORESIGHT: f32 = 2.0;

/// Parameters of pursuit, see [`super::Controller::pursue`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PursueParams {
    /// Distance within which it sees prey, units, 0 to 10 000.
    pub within: f32,
    /// Largest prey that it goes for, in its own radii, 0 to 100.
    pub largest: f32,
}

impl Default for PursueParams {
    fn default() -> Self {
        Self { within: 40.0, largest: 0.7 }
    }
}

/// Pursuit, and what it does otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pursue {
    params: PursueParams,
    /// Written by [`super::chain`].
    #[serde(skip)]
    pub(super) otherwise: Box<Controller>,
}

impl Pursue {
    pub(super) fn new(params: PursueParams, otherwise: Controller) -> Self {
        Self { params, otherwise: Box::new(otherwise) }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("within", self.params.within, 0.0, 1e4)?;
        in_range("largest", self.params.largest, 0.0, 100.0)?;
        self.otherwise.validate().map_err(|error| error.within("otherwise"))
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let largest = self.params.largest * senses.radius;
        let prey = senses.nearest(|other| other.is_prey && other.radius <= largest);
        let Some(prey) = prey.filter(|prey| prey.at.distance(senses.at) < self.params.within) else {
            return self.otherwise.decide(senses, rng);
        };
        let time = prey.at.distance(senses.at) / senses.speed;
        let ahead = prey.velocity * if time < FORESIGHT { time } else { FORESIGHT };
        Some(Steering::to(prey.at + ahead))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Bench, prey};
    use super::*;
    use glam::Vec2;

    #[test]
    fn it_goes_for_where_the_nearest_prey_of_its_size_will_be() {
        let mut bench = Bench::new(Controller::pursue(PursueParams::default(), Controller::Still), 0.1);
        assert_eq!(bench.decide(), None);
        let large = super::super::senses::Other { radius: 5.0, ..prey(1, Vec2::new(2.0, 0.0)) };
        let moving = super::super::senses::Other { velocity: Vec2::Y, ..prey(2, Vec2::new(10.0, 0.0)) };
        bench.others = vec![large, moving, prey(3, Vec2::new(0.0, 30.0)), prey(4, Vec2::new(90.0, 0.0))];
        assert_eq!(bench.decide().unwrap().goal, Vec2::new(10.0, 2.0));
    }
}
