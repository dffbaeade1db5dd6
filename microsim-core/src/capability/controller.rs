//! Controllers: what an organism wants when nobody commands it. They are part of the world's state.

use crate::error::{Error, in_range};
use crate::geometry::ring::unit_vector;
use crate::id::OrganismId;
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// What steers an organism when no input does.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    /// To and fro without rest: every now and then the opposite or a random direction. Hard on membranes.
    Thrash {
        /// Time until the next decision, s, 0.01 to 600.
        interval: f32,
        /// Probability that a decision is for the opposite direction rather than a random one, 0 to 1.
        reversal: f32,
        /// Present direction, a unit vector; zero before the first decision.
        direction: Vec2,
        /// Time until the next decision, s.
        remaining: f32,
    },
    /// Charges at the nearest engulfer, again and again from another side.
    Ram {
        /// Time of a charge, s, 0.01 to 600.
        charge: f32,
        /// Time in which it goes to where the next charge begins, s, 0.01 to 600.
        retreat: f32,
        /// Distance of that place from the engulfer's centre, units, 0 to 10 000.
        distance: f32,
        /// That place as seen from the engulfer's centre; `None` while it charges.
        aside: Option<Vec2>,
        /// Time until the charge or the retreat ends, s.
        remaining: f32,
    },
}

/// What a controller may know of the world.
#[derive(Clone, Debug)]
pub(crate) struct Surroundings {
    /// Upper right corner of the room.
    pub size: Vec2,
    /// Time of a step, s.
    pub dt: f32,
    /// Organisms that take others in, and where they are.
    pub engulfers: Vec<(OrganismId, Vec2)>,
}

impl Surroundings {
    /// Where the nearest engulfer is, other than the asking one.
    fn nearest_engulfer(&self, asking: OrganismId, at: Vec2) -> Option<Vec2> {
        let others = self.engulfers.iter().filter(|(id, _)| *id != asking).map(|&(_, place)| place);
        others.reduce(|a, b| if (b - at).length_squared() < (a - at).length_squared() { b } else { a })
    }
}

/// A patrol's point is reached at this distance.
const ARRIVED: f32 = 0.25;
/// Distance of a goal that stands for a direction, units.
const FAR: f32 = 1000.0;

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

    /// Movement to and fro that decides anew every `interval` s, with probability `reversal` for the opposite direction.
    #[must_use]
    pub fn thrash(interval: f32, reversal: f32) -> Self {
        Self::Thrash { interval, reversal, direction: Vec2::ZERO, remaining: 0.0 }
    }

    /// Charges of `charge` s at the nearest engulfer, each from a random place `distance` units away from its centre, for
    /// which there are `retreat` s.
    #[must_use]
    pub fn ram(charge: f32, retreat: f32, distance: f32) -> Self {
        Self::Ram { charge, retreat, distance, aside: None, remaining: 0.0 }
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
            Self::Thrash { interval, reversal, direction, remaining } => {
                in_range("interval", *interval, 0.01, 600.0)?;
                in_range("reversal", *reversal, 0.0, 1.0)?;
                in_range("remaining", *remaining, 0.0, 600.0)?;
                check_point("direction", *direction)
            }
            Self::Ram { charge, retreat, distance, aside, remaining } => {
                in_range("charge", *charge, 0.01, 600.0)?;
                in_range("retreat", *retreat, 0.01, 600.0)?;
                in_range("distance", *distance, 0.0, 1e4)?;
                in_range("remaining", *remaining, 0.0, 600.0)?;
                aside.map_or(Ok(()), |aside| check_point("aside", aside))
            }
        }
    }

    /// Decides for one step of organism `me`, which is at `at`. Returns its goal, if it has one.
    pub(crate) fn advance(&mut self, me: OrganismId, at: Vec2, rng: &mut Rng, around: &Surroundings) -> Option<Vec2> {
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
            Self::Thrash { interval, reversal, direction, remaining } => {
                *remaining -= around.dt;
                if *remaining <= 0.0 {
                    *remaining = *interval;
                    let reverses = *direction != Vec2::ZERO && rng.unit() < *reversal;
                    *direction = if reverses { -*direction } else { unit_vector(rng.range(0.0, TAU)) };
                }
                Some(at + *direction * FAR)
            }
            Self::Ram { charge, retreat, distance, aside, remaining } => {
                let target = around.nearest_engulfer(me, at)?;
                *remaining -= around.dt;
                if *remaining <= 0.0 {
                    let goes_aside = aside.is_none();
                    *remaining = if goes_aside { *retreat } else { *charge };
                    *aside = goes_aside.then(|| unit_vector(rng.range(0.0, TAU)) * *distance);
                }
                Some(target + aside.unwrap_or(Vec2::ZERO))
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

    const ROOM: Surroundings = Surroundings { size: Vec2::new(30.0, 20.0), dt: 0.1, engulfers: Vec::new() };
    const ME: OrganismId = OrganismId { index: 7, generation: 0 };

    #[test]
    fn wandering_changes_its_goal_within_its_interval_and_stays_in_the_room() {
        let mut controller = Controller::wander([0.5, 1.0], 0.3);
        let mut rng = Rng::new(1, 1);
        let goals: Vec<_> = (0..1000).map(|_| controller.advance(ME, Vec2::ZERO, &mut rng, &ROOM)).collect();
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
        assert_eq!(once.advance(ME, Vec2::ZERO, &mut rng, &ROOM), Some(points[0]));
        assert_eq!(once.advance(ME, points[0], &mut rng, &ROOM), Some(points[1]));
        assert_eq!(once.advance(ME, points[1], &mut rng, &ROOM), None);
        let mut forever = Controller::patrol(points.clone(), true);
        forever.advance(ME, points[0], &mut rng, &ROOM);
        assert_eq!(forever.advance(ME, points[1], &mut rng, &ROOM), Some(points[0]));
    }

    #[test]
    fn thrashing_turns_round_or_anywhere() {
        let ways = |reversal: f32| {
            let (mut controller, mut rng) = (Controller::thrash(0.5, reversal), Rng::new(1, 1));
            let goals = (0..500).filter_map(|_| controller.advance(ME, Vec2::ONE, &mut rng, &ROOM));
            goals.map(|goal| (goal - Vec2::ONE) / FAR).collect::<Vec<Vec2>>()
        };
        let turns = |ways: &[Vec2]| ways.windows(2).filter(|pair| (pair[1] - pair[0]).length() > 1e-3).count();
        let to_and_fro = ways(1.0);
        assert!((80..=100).contains(&turns(&to_and_fro)));
        assert!(to_and_fro.iter().all(|way| way.perp_dot(to_and_fro[0]).abs() < 1e-3));
        let anywhere = ways(0.0);
        assert!(turns(&anywhere) >= 80 && anywhere.iter().sum::<Vec2>().length() < 0.3 * 500.0);
    }

    #[test]
    fn rams_charge_at_the_nearest_engulfer_from_all_sides() {
        let id = |index| OrganismId { index, generation: 0 };
        let (near, far) = (Vec2::new(5.0, 5.0), Vec2::new(25.0, 5.0));
        let around = Surroundings { engulfers: vec![(ME, Vec2::ZERO), (id(1), far), (id(2), near)], ..ROOM };
        let (mut controller, mut rng) = (Controller::ram(1.0, 0.5, 8.0), Rng::new(1, 1));
        let goals: Vec<Vec2> =
            (0..3000).filter_map(|_| controller.advance(ME, Vec2::ZERO, &mut rng, &around)).collect();
        let aside: Vec<Vec2> = goals.iter().map(|&goal| goal - near).filter(|&way| way != Vec2::ZERO).collect();
        assert_eq!(goals.len(), 3000);
        assert!((950..1150).contains(&aside.len()), "a third of the time, not {}", aside.len());
        assert!(aside.iter().all(|way| (way.length() - 8.0).abs() < 1e-3));
        let quadrant = |x: f32, y: f32| aside.iter().any(|way| way.x * x > 0.0 && way.y * y > 0.0);
        assert!(quadrant(1.0, 1.0) && quadrant(1.0, -1.0) && quadrant(-1.0, 1.0) && quadrant(-1.0, -1.0));
        assert_eq!(controller.advance(ME, Vec2::ZERO, &mut rng, &ROOM), None);
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let field = |controller: Controller| controller.validate().unwrap_err().field().to_owned();
        assert_eq!(field(Controller::wander([1.0, 0.5], 0.0)), "interval[1]");
        assert_eq!(field(Controller::wander([1.0, 2.0], f32::NAN)), "rest");
        assert_eq!(field(Controller::thrash(0.0, 1.0)), "interval");
        assert_eq!(field(Controller::thrash(1.0, 1.5)), "reversal");
        assert_eq!(field(Controller::ram(1.0, 0.0, 1.0)), "retreat");
        assert_eq!(field(Controller::patrol(vec![], true)), "through");
        assert_eq!(field(Controller::patrol(vec![Vec2::ZERO, Vec2::NAN], true)), "through[1].x");
    }
}
