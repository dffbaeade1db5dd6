//! The thesis' trivial random movement (3.3.1): now and then a new goal anywhere in the room, or a rest.

use super::senses::{Senses, Steering};
use crate::error::{Error, in_range};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// See [`super::Controller::wander`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wander {
    /// Shortest and longest time until the next decision, s.
    interval: [f32; 2],
    /// Probability that a decision is to rest.
    rest: f32,
    goal: Option<Vec2>,
    /// Time until the next decision, s.
    remaining: f32,
}

impl Wander {
    pub(super) fn new(interval: [f32; 2], rest: f32) -> Self {
        Self { interval, rest, goal: None, remaining: 0.0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("interval[0]", self.interval[0], 0.05, 600.0)?;
        in_range("interval[1]", self.interval[1], self.interval[0], 600.0)?;
        in_range("rest", self.rest, 0.0, 1.0)
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        self.remaining -= senses.around.dt;
        if self.remaining <= 0.0 {
            self.remaining = rng.range(self.interval[0], self.interval[1]);
            let size = senses.around.size;
            let point = Vec2::new(rng.range(0.0, size.x), rng.range(0.0, size.y));
            self.goal = (rng.unit() >= self.rest).then_some(point);
        }
        // A goal nearer to a wall than its own radius is one at that distance: it has no business in the wall.
        let room = |side: f32| if side > 2.0 * senses.radius { senses.radius } else { 0.5 * side };
        let margin = Vec2::new(room(senses.around.size.x), room(senses.around.size.y));
        let goal = self.goal?.clamp(margin, senses.around.size - margin);
        (goal.distance(senses.at) > senses.arrival).then(|| Steering::to(goal))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::{Bench, ROOM};
    use super::*;

    #[test]
    fn wandering_changes_its_goal_within_its_interval_and_stays_in_the_room() {
        let mut bench = Bench::new(Controller::wander([0.5, 1.0], 0.3), 0.1);
        let goals: Vec<Option<Steering>> = (0..1000).map(|_| bench.decide()).collect();
        let changes = goals.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let rests = goals.iter().filter(|goal| goal.is_none()).count();
        assert!((80..200).contains(&changes), "{changes} changes in 100 s");
        assert!((100..600).contains(&rests), "{rests} rests");
        let is_inside =
            |steering: &Steering| steering.goal.cmpge(Vec2::ONE).all() && steering.goal.cmple(ROOM - 1.0).all();
        assert!(goals.iter().flatten().all(is_inside), "no nearer to a wall than its radius");
    }

    #[test]
    fn a_reached_goal_is_a_rest() {
        let mut bench = Bench::new(Controller::wander([600.0, 600.0], 0.0), 0.1);
        bench.at = bench.decide().unwrap().goal;
        assert_eq!(bench.decide(), None);
    }
}
