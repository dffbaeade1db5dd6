//! Progress of an organism that wants to move, and its escape when it is stuck: faster than it usually moves, as ciliates
//! do (Hamel et al. 2011, PNAS 108, 7290).

use super::controller::senses::{Senses, Steering};
use crate::geometry::ring::{direction_or, unit_vector};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// Distance from its mark at which it has made progress, in its radii.
const PROGRESS_DISTANCE: f32 = 1.0 / 3.0;
/// Time without progress after which it is stuck: so many times the time for that distance at its speed, and some more, s.
const STUCK_AFTER: [f32; 2] = [1.2, 0.3];
/// Share of its speed with which it must move away from its mark not to be stuck.
const MOVING_SPEED: f32 = 0.3;
/// Time of an escape in one direction, composed likewise.
const ESCAPE_TIME: [f32; 2] = [1.3, 0.5];
/// Time after which an escape on which it does not move is given up, s.
const GIVE_UP_AFTER: f32 = 0.6;
/// Speed of an escape, in units of its own: at first, and more with each second without progress.
const ESCAPE_SPEED: [f32; 2] = [1.5, 0.75];
/// Time after which it pushes no harder, s: it must not crush what holds it.
const MAX_EFFORT_AFTER: f32 = 4.0;
/// Directions of escape that it compares, all around.
const DIRECTIONS: u32 = 12;
/// Weight of the direction back, against directions that failed.
const WEIGHT_BACK: f32 = 0.5;
/// Weight of its long axis: a long organism has to turn before it moves in another direction.
const WEIGHT_AXIS: f32 = 0.5;
/// Factor on the directions that failed with each further one.
const MEMORY: f32 = 0.5;

/// Where an organism last got to, and its way out when it is stuck.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Progress {
    /// Where it last got somewhere, and where it was before.
    mark: Vec2,
    before: Vec2,
    /// Time since then for which it wanted to move, s.
    pub stalled: f32,
    /// Way out that it is on.
    escape: Option<Escape>,
    /// Sum of the directions that failed, the last ones weighing most.
    failed: Vec2,
}

/// A way out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Escape {
    direction: Vec2,
    /// Time for which it has been on it, s.
    age: f32,
}

impl Progress {
    /// Takes note of a step.
    pub(crate) fn note(&mut self, wants_to_move: bool, senses: &Senses<'_>) {
        let distance = PROGRESS_DISTANCE * senses.radius;
        if (senses.at - self.mark).length_squared() > distance * distance {
            *self = Self { mark: senses.at, before: self.mark, stalled: 0.0, failed: Vec2::ZERO, ..*self };
        } else if wants_to_move {
            self.stalled += senses.around.dt;
        }
    }

    /// How it tries to get away, if it is stuck: rather away from what it has tried, back the way that it came and with
    /// an end first.
    pub(crate) fn way_out(&mut self, steering: Steering, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let needed = PROGRESS_DISTANCE * senses.radius / senses.speed;
        let [due, length] = [STUCK_AFTER, ESCAPE_TIME].map(|[times, more]| times * needed + more);
        let goes = |direction: Vec2| senses.velocity.dot(direction) > MOVING_SPEED * senses.speed;
        let escape = match self.escape {
            Some(Escape { direction, age }) if age > GIVE_UP_AFTER && !goes(direction) && self.stalled > 0.0 => {
                self.next_escape(direction, senses, rng)
            }
            Some(Escape { direction, age }) if age < length => Escape { direction, age: age + senses.around.dt },
            _ if self.stalled > due && !goes(direction_or(senses.at - self.mark, Vec2::ZERO)) => self.next_escape(
                direction_or((steering.goal - senses.at) * steering.relative_speed, Vec2::ZERO),
                senses,
                rng,
            ),
            _ => {
                self.escape = None;
                return None;
            }
        };
        self.escape = Some(escape);
        let effort = if self.stalled < MAX_EFFORT_AFTER { self.stalled } else { MAX_EFFORT_AFTER };
        Some(Steering { relative_speed: ESCAPE_SPEED[0] + ESCAPE_SPEED[1] * effort, ..senses.along(escape.direction) })
    }

    /// The most promising of some directions all around, after one that failed.
    fn next_escape(&mut self, failed: Vec2, senses: &Senses<'_>, rng: &mut Rng) -> Escape {
        self.failed = self.failed * MEMORY + failed;
        Escape { direction: self.best_direction(senses, rng), age: 0.0 }
    }

    fn best_direction(&self, senses: &Senses<'_>, rng: &mut Rng) -> Vec2 {
        let towards = direction_or(self.before - senses.at, Vec2::ZERO) * WEIGHT_BACK - self.failed;
        let axis = senses.axis() * WEIGHT_AXIS;
        let merit = |direction: Vec2| direction.dot(towards) + direction.dot(axis).abs();
        let first = rng.range(0.0, TAU);
        let directions =
            (0..DIRECTIONS).map(|k| senses.along_walls(unit_vector(first + TAU * k as f32 / DIRECTIONS as f32)));
        directions.reduce(|a, b| if merit(b) > merit(a) { b } else { a }).unwrap_or(Vec2::X)
    }
}

#[cfg(test)]
mod tests {
    use super::super::controller::senses::Environment;
    use super::*;
    use crate::geometry::period::Period;
    use crate::geometry::ring::ellipse;
    use crate::id::OrganismId;

    /// Directions and speeds of escapes, one for each tenth of a second, of what wants to go to the right at 1 unit/s and moves so.
    fn escapes(velocity: Vec2, seconds: f32) -> Vec<Option<(Vec2, f32)>> {
        const DT: f32 = 0.1;
        let around = Environment {
            size: Vec2::splat(100.0),
            period: Period::NONE,
            dt: DT,
            chemicals: &[],
            obstacles: &[],
            others: &[],
        };
        let (mut progress, mut rng) = (Progress::default(), Rng::new(1, 1));
        let way_out = |step: u32| {
            let at = Vec2::new(30.0, 30.0) + velocity * (step as f32 * DT);
            let outline: Vec<Vec2> = ellipse(Vec2::new(2.0, 1.0), 16).into_iter().map(|arm| at + arm).collect();
            let me = OrganismId { index: 0, generation: 0 };
            let (speed, radius, arrival) = (1.0, 1.5, 0.25);
            let senses = Senses { me, at, velocity, speed, radius, arrival, outline: &outline, around: &around };
            progress.note(true, &senses);
            let steering = progress.way_out(senses.along(Vec2::X), &senses, &mut rng);
            steering.map(|steering| (direction_or(steering.goal - at, Vec2::ZERO), steering.relative_speed))
        };
        (0..(seconds / DT) as u32).map(way_out).collect()
    }

    #[test]
    fn what_is_stuck_tries_one_way_after_the_other_and_none_that_just_failed() {
        let escapes = escapes(Vec2::ZERO, 4.0);
        let waits = escapes.iter().take_while(|escape| escape.is_none()).count();
        assert!((9..=11).contains(&waits), "{waits} tenths of a second");
        assert!(escapes[waits..].iter().all(Option::is_some));
        let ways: Vec<Vec2> = escapes.into_iter().flatten().map(|(direction, _)| direction).collect();
        let kept: Vec<usize> = ways.chunk_by(|a, b| a == b).map(<[Vec2]>::len).collect();
        assert!(kept[..kept.len() - 1].iter().all(|tenths| (6..=9).contains(tenths)), "each for a while: {kept:?}");
        let mut tried = ways;
        tried.dedup();
        assert!(tried.len() >= 4, "{tried:?}");
        assert!(tried[0].x < 0.0, "{}", tried[0]);
        assert!(tried.windows(2).all(|pair| pair[0].dot(pair[1]) < 0.5), "{tried:?}");
    }

    #[test]
    fn it_pushes_harder_the_longer_it_gets_nowhere_up_to_a_limit() {
        let speeds: Vec<f32> = escapes(Vec2::ZERO, 8.0).into_iter().flatten().map(|(_, speed)| speed).collect();
        assert!(speeds.is_sorted() && (2.1..2.4).contains(&speeds[0]), "{speeds:?}");
        assert_eq!(speeds.last(), Some(&4.5));
    }

    #[test]
    fn what_gets_somewhere_is_let_alone() {
        assert_eq!(escapes(Vec2::X * 0.5, 4.0), [None; 40]);
        assert_eq!(escapes(Vec2::Y * 0.35, 4.0), [None; 40], "pushed aside, but away");
    }
}
