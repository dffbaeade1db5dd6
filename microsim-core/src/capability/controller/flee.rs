//! Flight from what takes others in (Reynolds 1999, "Steering Behaviors For Autonomous Characters": flee, with the weights of
//! several threats falling off with their distance). Where there is none it does something else.

use super::Controller;
use super::senses::{Senses, Steering, larger};
use crate::error::{Error, in_range};
use crate::geometry::ring::direction_or;
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Parameters of flight, see [`super::Controller::flee`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FleeParams {
    /// Gap to a threat from which on it flees, units, 0 to 10 000.
    pub within: f32,
    /// Time for which it goes on when the threat is farther away again, s, 0 to 600.
    pub alarm: f32,
}

impl Default for FleeParams {
    fn default() -> Self {
        Self { within: 10.0, alarm: 0.5 }
    }
}

/// Flight, and what it does otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flee {
    params: FleeParams,
    /// Written by [`super::chain`].
    #[serde(skip)]
    pub(super) otherwise: Box<Controller>,
    /// Away from the threats: a unit vector.
    heading: Vec2,
    /// Time for which it still flees, s.
    remaining: f32,
}

impl Flee {
    pub(super) fn new(params: FleeParams, otherwise: Controller) -> Self {
        Self { params, otherwise: Box::new(otherwise), heading: Vec2::ZERO, remaining: 0.0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("within", self.params.within, 0.0, 1e4)?;
        in_range("alarm", self.params.alarm, 0.0, 600.0)?;
        self.otherwise.validate().map_err(|error| error.within("otherwise"))
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let mut away = Vec2::ZERO;
        for threat in senses.others(|other| other.is_engulfer) {
            let offset = senses.at - threat.at;
            let gap = larger(offset.length() - threat.radius - senses.radius, 0.1 * senses.radius);
            if gap < self.params.within {
                away += direction_or(offset, Vec2::X) / gap;
            }
        }
        self.remaining -= senses.around.dt;
        if away != Vec2::ZERO {
            (self.heading, self.remaining) = (direction_or(away, Vec2::X), self.params.alarm);
        } else if self.remaining <= 0.0 {
            return self.otherwise.decide(senses, rng);
        }
        self.heading = senses.along_walls(self.heading);
        Some(senses.along(self.heading))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Bench, engulfer};
    use super::*;

    #[test]
    fn it_flees_from_what_is_near_and_does_something_else_otherwise() {
        let elsewhere = Controller::patrol(vec![Vec2::new(1.0, 10.0)], true);
        let mut bench = Bench::new(Controller::flee(FleeParams { within: 5.0, alarm: 1.0 }, elsewhere), 0.1);
        bench.at = Vec2::new(15.0, 10.0);
        assert!(bench.heading().unwrap().x < -0.99, "otherwise");
        bench.others = vec![engulfer(1, Vec2::new(10.0, 10.0)), engulfer(2, Vec2::new(27.0, 10.0))];
        assert!(bench.heading().unwrap().x > 0.99, "away from the one that is near");
        bench.others.clear();
        let longer = (0..20).take_while(|_| bench.heading().unwrap().x > 0.99).count();
        assert_eq!(longer, 9, "for the rest of a second");
    }
}
