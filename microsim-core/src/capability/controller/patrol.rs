//! From one point to the next.

use super::check_point;
use super::senses::{Senses, Steering};
use crate::error::Error;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// See [`super::Controller::patrol`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Patrol {
    through: Vec<Vec2>,
    repeats: bool,
    /// Index of the point that it moves to.
    next: u32,
}

impl Patrol {
    pub(super) fn new(through: Vec<Vec2>, repeats: bool) -> Self {
        Self { through, repeats, next: 0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        if self.through.is_empty() || self.through.len() > 1000 {
            return Err(Error::reference("through", "1 to 1000 points"));
        }
        if self.next as usize >= self.through.len() {
            return Err(Error::reference("next", "the index of a point"));
        }
        self.through.iter().enumerate().try_for_each(|(k, &p)| check_point(&format!("through[{k}]"), p))
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>) -> Option<Steering> {
        let has_arrived = self.through[self.next as usize].distance(senses.at) < senses.arrival;
        let is_last = self.next as usize + 1 == self.through.len();
        if has_arrived && is_last && !self.repeats {
            return None;
        }
        if has_arrived {
            self.next = if is_last { 0 } else { self.next + 1 };
        }
        Some(Steering::to(self.through[self.next as usize]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::Bench;
    use super::*;

    #[test]
    fn patrol_visits_its_points_in_order_and_ends_or_repeats() {
        let points = vec![Vec2::new(1.0, 0.0), Vec2::new(2.0, 0.0)];
        let mut once = Bench::new(Controller::patrol(points.clone(), false), 0.1);
        let goal = |bench: &mut Bench, at| {
            bench.at = at;
            bench.decide().map(|steering| steering.goal)
        };
        assert_eq!(goal(&mut once, Vec2::ZERO), Some(points[0]));
        assert_eq!(goal(&mut once, points[0]), Some(points[1]));
        assert_eq!(goal(&mut once, points[1]), None);
        let mut forever = Bench::new(Controller::patrol(points.clone(), true), 0.1);
        goal(&mut forever, points[0]);
        assert_eq!(goal(&mut forever, points[1]), Some(points[0]));
    }

    #[test]
    fn one_that_moves_to_no_point_is_refused() {
        let through = vec![Vec2::ZERO; 2];
        let at = |next| Patrol { through: through.clone(), repeats: true, next }.validate();
        assert!(at(1).is_ok() && at(2).is_err() && at(u32::MAX).is_err());
    }

    #[test]
    fn a_crawling_cell_gets_round() {
        use crate::{AmoeboidCellSpec, Inputs, Placement, World, WorldConfig};
        let mut world = World::new(WorldConfig::default()).unwrap();
        let way = vec![Vec2::new(70.0, 40.0), Vec2::new(90.0, 50.0)];
        let placement = Placement::at(80.0, 45.0).steered_by(Controller::patrol(way.clone(), true));
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), placement).unwrap();
        let mut visits = Vec::new();
        for _ in 0..1500 {
            world.step(&Inputs::new());
            let near = way.iter().position(|&point| world.centroid(cell).unwrap().distance(point) < 5.5);
            visits.extend(near.filter(|near| visits.last() != Some(near)));
        }
        assert!(visits.len() >= 4, "{visits:?}");
    }
}
