//! Controllers: what an organism wants when nobody commands it. They are part of the world's state.

use crate::error::{Error, in_range};
use crate::rng::Rng;
use glam::Vec2;

/// What steers an organism when no input does.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Controller {
    /// Nothing: it rests.
    #[default]
    Still,
    /// The seed's trivial random movement (3.3.1): now and then a new goal anywhere in the room, or a rest.
    Wander {
        /// Shortest and longest time until the next decision, s, 0.05 to 600.
        interval: [f32; 2],
        /// Probability that a decision is to rest, 0 to 1.
        rest: f32,
        /// Present goal.
        goal: Option<Vec2>,
        /// Time until the next decision, s.
        remaining: f32,
    },
    /// From one point to the next.
    Patrol {
        /// The points, 1 to 1000.
        through: Vec<Vec2>,
        /// Whether it starts again after the last point; else it stays there.
        repeats: bool,
        /// Index of the point that it moves to.
        next: u32,
    },
}

/// What a controller may know of the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surroundings {
    /// Upper right corner of the room.
    pub size: Vec2,
    /// Time of a step, s.
    pub dt: f32,
}

/// A patrol's point is reached at this distance.
const ARRIVED: f32 = 0.25;

impl Controller {
    /// Random movement that decides anew after a time drawn from `interval`, s.
    #[must_use]
    pub fn wander(interval: [f32; 2], rest: f32) -> Self {
        Self::Wander { interval, rest, goal: None, remaining: 0.0 }
    }

    /// Movement through these points, once or for ever.
    #[must_use]
    pub fn patrol(through: Vec<Vec2>, repeats: bool) -> Self {
        Self::Patrol { through, repeats, next: 0 }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        match self {
            Self::Still => Ok(()),
            Self::Wander { interval, rest, goal, remaining } => {
                in_range("interval[0]", interval[0], 0.05, 600.0)?;
                in_range("interval[1]", interval[1], interval[0], 600.0)?;
                in_range("rest", *rest, 0.0, 1.0)?;
                in_range("remaining", *remaining, 0.0, 600.0)?;
                goal.map_or(Ok(()), |goal| check_point("goal", goal))
            }
            Self::Patrol { through, next, .. } => {
                if through.is_empty() || through.len() > 1000 || *next as usize >= through.len() {
                    return Err(Error::reference("through", "1 to 1000 points, `next` one of them"));
                }
                through.iter().enumerate().try_for_each(|(k, &p)| check_point(&format!("through[{k}]"), p))
            }
        }
    }

    /// Decides for one step; `at` is where the organism is. Returns its goal, if it has one.
    pub(crate) fn advance(&mut self, at: Vec2, rng: &mut Rng, around: &Surroundings) -> Option<Vec2> {
        match self {
            Self::Still => None,
            Self::Wander { interval, rest, goal, remaining } => {
                *remaining -= around.dt;
                if *remaining <= 0.0 {
                    *remaining = rng.range(interval[0], interval[1]);
                    let point = Vec2::new(rng.range(0.0, around.size.x), rng.range(0.0, around.size.y));
                    *goal = (rng.unit() >= *rest).then_some(point);
                }
                *goal
            }
            Self::Patrol { through, repeats, next } => {
                let goal = through[*next as usize];
                let has_arrived = (goal - at).length_squared() < ARRIVED * ARRIVED;
                let is_last = *next as usize + 1 == through.len();
                if has_arrived && is_last && !*repeats {
                    return None;
                }
                if has_arrived {
                    *next = if is_last { 0 } else { *next + 1 };
                }
                Some(through[*next as usize])
            }
        }
    }
}

fn check_point(field: &str, point: Vec2) -> Result<(), Error> {
    in_range(&format!("{field}.x"), point.x, -1e6, 1e6)?;
    in_range(&format!("{field}.y"), point.y, -1e6, 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Surroundings = Surroundings { size: Vec2::new(30.0, 20.0), dt: 0.1 };

    #[test]
    fn wandering_changes_its_goal_within_its_interval_and_stays_in_the_room() {
        let mut controller = Controller::wander([0.5, 1.0], 0.3);
        let mut rng = Rng::new(1, 1);
        let goals: Vec<_> = (0..1000).map(|_| controller.advance(Vec2::ZERO, &mut rng, &ROOM)).collect();
        let changes = goals.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let rests = goals.iter().filter(|goal| goal.is_none()).count();
        assert!((80..200).contains(&changes), "{changes} changes in 100 s");
        assert!((100..600).contains(&rests), "{rests} rests");
        assert!(goals.iter().flatten().all(|g| g.cmpge(Vec2::ZERO).all() && g.cmple(ROOM.size).all()));
    }

    #[test]
    fn patrol_visits_its_points_in_order_and_ends_or_repeats() {
        let points = vec![Vec2::new(1.0, 0.0), Vec2::new(2.0, 0.0)];
        let mut rng = Rng::new(1, 1);
        let mut once = Controller::patrol(points.clone(), false);
        assert_eq!(once.advance(Vec2::ZERO, &mut rng, &ROOM), Some(points[0]));
        assert_eq!(once.advance(points[0], &mut rng, &ROOM), Some(points[1]));
        assert_eq!(once.advance(points[1], &mut rng, &ROOM), None);
        let mut forever = Controller::patrol(points.clone(), true);
        forever.advance(points[0], &mut rng, &ROOM);
        assert_eq!(forever.advance(points[1], &mut rng, &ROOM), Some(points[0]));
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let field = |controller: Controller| controller.validate().unwrap_err().field().to_owned();
        assert_eq!(field(Controller::wander([1.0, 0.5], 0.0)), "interval[1]");
        assert_eq!(field(Controller::wander([1.0, 2.0], f32::NAN)), "rest");
        assert_eq!(field(Controller::patrol(vec![], true)), "through");
        assert_eq!(field(Controller::patrol(vec![Vec2::ZERO, Vec2::NAN], true)), "through[1].x");
    }
}
