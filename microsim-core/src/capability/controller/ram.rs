//! Charges at the nearest engulfer, again and again from another side. Hard on membranes.

use super::senses::{Senses, Steering};
use crate::error::{Error, in_range};
use crate::geometry::ring::unit_vector;
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// See [`super::Controller::ram`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ram {
    charge: f32,
    retreat: f32,
    distance: f32,
    /// Where the next charge begins, as seen from the engulfer's centre; `None` while it charges.
    aside: Option<Vec2>,
    /// Time until the charge or the retreat ends, s.
    remaining: f32,
}

impl Ram {
    pub(super) fn new(charge: f32, retreat: f32, distance: f32) -> Self {
        Self { charge, retreat, distance, aside: None, remaining: 0.0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("charge", self.charge, 0.01, 600.0)?;
        in_range("retreat", self.retreat, 0.01, 600.0)?;
        in_range("distance", self.distance, 0.0, 1e4)
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let target = senses.nearest(|other| other.is_engulfer)?.at;
        self.remaining -= senses.around.dt;
        if self.remaining <= 0.0 {
            let goes_aside = self.aside.is_none();
            self.remaining = if goes_aside { self.retreat } else { self.charge };
            self.aside = goes_aside.then(|| unit_vector(rng.range(0.0, TAU)) * self.distance);
        }
        Some(Steering::to(target + self.aside.unwrap_or(Vec2::ZERO)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::{Bench, engulfer};
    use super::*;

    #[test]
    fn rams_charge_at_the_nearest_engulfer_from_all_sides() {
        let near = Vec2::new(5.0, 5.0);
        let mut bench = Bench::new(Controller::ram(1.0, 0.5, 8.0), 0.1);
        assert_eq!(bench.decide(), None);
        bench.others =
            vec![engulfer(Bench::ME.index, Vec2::ZERO), engulfer(1, Vec2::new(25.0, 5.0)), engulfer(2, near)];
        let goals: Vec<Vec2> = (0..3000).filter_map(|_| bench.decide()).map(|steering| steering.goal).collect();
        let aside: Vec<Vec2> = goals.iter().map(|&goal| goal - near).filter(|&offset| offset != Vec2::ZERO).collect();
        assert_eq!(goals.len(), 3000);
        assert!((950..1150).contains(&aside.len()), "a third of the time, not {}", aside.len());
        assert!(aside.iter().all(|offset| (offset.length() - 8.0).abs() < 1e-3));
        let quadrant = |x: f32, y: f32| aside.iter().any(|offset| offset.x * x > 0.0 && offset.y * y > 0.0);
        assert!(quadrant(1.0, 1.0) && quadrant(1.0, -1.0) && quadrant(-1.0, 1.0) && quadrant(-1.0, -1.0));
    }
}
