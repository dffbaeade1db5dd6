//! An attempt at a slide: which goals are reached, when all are, and the stars for it.

use crate::words::{self, Key};
use microsim_core::Kind;
use microsim_core::glam::Vec2;
use microsim_core::scenario::{Game, Goal, Points, Slide};

/// How an attempt at a slide stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempt {
    slide: Slide,
    /// What is done for each goal.
    done: Vec<u32>,
    /// When all goals were reached, s.
    time: Option<f32>,
    /// Whether the last cell that could reach them was taken in and digested.
    is_lost: bool,
}

impl Attempt {
    /// A new attempt.
    #[must_use]
    pub fn new(slide: Slide) -> Self {
        let done = vec![0; slide.goals.len()];
        Self { slide, done, time: None, is_lost: false }
    }

    /// What a referee counts and how long: one point for each prey that a goal asks for.
    #[must_use]
    pub fn game(slide: &Slide) -> Game {
        let each = Points { each: 1.0, per_area: 0.0 };
        let kinds = slide.goals.iter().filter_map(|goal| match goal {
            Goal::Digest { kind, .. } => Some((*kind, each)),
            Goal::Reach { .. } | Goal::Together { .. } => None,
        });
        Game { time: slide.time, points: kinds.collect() }
    }

    /// Looks after a step, at a time, at where the players are and how much of a kind they have digested together.
    pub fn after_step(&mut self, time: f32, players: &[Vec2], digested: impl Fn(Kind) -> u32) {
        for (goal, done) in self.slide.goals.iter().zip(&mut self.done) {
            let all = wanted(goal);
            if *done < all {
                *done = match *goal {
                    Goal::Digest { kind, .. } => digested(kind).min(all),
                    _ => places(goal).filter(|place| is_held(*place, players)).count() as u32,
                };
            }
        }
        if self.time.is_none() && self.goals().all(|(goal, done)| done == wanted(goal)) {
            self.time = Some(time);
        }
    }

    /// All goals, and how much is done of each, at most [`wanted`].
    pub fn goals(&self) -> impl Iterator<Item = (&Goal, u32)> {
        self.slide.goals.iter().zip(self.done.iter().copied())
    }

    /// When all goals were reached, s; `None` before.
    #[must_use]
    pub fn time(&self) -> Option<f32> {
        self.time
    }

    /// Ends it: a larger amoeba has digested whoever could reach the goals.
    pub fn lose(&mut self) {
        self.is_lost = self.time.is_none();
    }

    /// Whether a larger amoeba has ended it.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        self.is_lost
    }

    /// Stars, 0 before all goals are reached.
    #[must_use]
    pub fn stars(&self) -> u32 {
        self.time.map_or(0, |time| stars_for(&self.slide, time))
    }

    /// The slide.
    #[must_use]
    pub fn slide(&self) -> &Slide {
        &self.slide
    }

    /// What is done and what is wanted, for the status line.
    #[must_use]
    pub fn summary(&self) -> String {
        let is_prey = |goal: &Goal| matches!(goal, Goal::Digest { .. });
        let count = |done, all| format!("{done}/{all}");
        let places = self.goals().filter(|(goal, _)| !is_prey(goal));
        let [done, all] = places.fold([0, 0], |[done, all], (goal, more)| [done + more, all + wanted(goal)]);
        // Each kind for itself, in the order of the task.
        let prey = self.goals().filter(|(goal, _)| is_prey(goal)).map(|(goal, done)| count(done, wanted(goal)));
        let parts = [
            (Key::HudPlaces, if all > 0 { count(done, all) } else { String::new() }),
            (Key::HudDigested, prey.collect::<Vec<_>>().join(", ")),
        ];
        let told = parts.iter().filter(|(_, counts)| !counts.is_empty());
        told.map(|(what, counts)| words::text_with(*what, &[("counts", counts.into())])).collect::<Vec<_>>().join("  ")
    }
}

/// How much a goal asks for: a count of prey, or of places.
#[must_use]
pub fn wanted(goal: &Goal) -> u32 {
    match goal {
        Goal::Digest { count, .. } => *count,
        _ => places(goal).count() as u32,
    }
}

/// The places of a goal: lower left and upper right corner of each.
pub fn places(goal: &Goal) -> impl Iterator<Item = [Vec2; 2]> + use<> {
    let places = match *goal {
        Goal::Reach { low, high } => [Some([low, high]), None],
        Goal::Together { places } => places.map(Some),
        Goal::Digest { .. } => [None; 2],
    };
    places.into_iter().flatten()
}

/// Whether one of these points is in a place.
#[must_use]
pub fn is_held([low, high]: [Vec2; 2], points: &[Vec2]) -> bool {
    points.iter().any(|&at| low.cmple(at).all() && at.cmple(high).all())
}

/// Stars for reaching all goals of a slide after so many seconds: 1 to 3.
#[must_use]
pub fn stars_for(slide: &Slide, time: f32) -> u32 {
    1 + slide.stars.iter().filter(|longest| time <= **longest).count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sooner_the_more_stars() {
        let text = String::new;
        let (title, task, fact, source) = (text(), text(), text(), text());
        let slide = Slide { title, task, fact, source, time: 60.0, stars: [20.0, 40.0], goals: Vec::new() };
        assert_eq!([19.0, 20.0, 20.1, 40.0, 41.0].map(|time| stars_for(&slide, time)), [3, 3, 2, 2, 1]);
    }

    #[test]
    fn what_is_digested_is_counted_by_kind_and_places_together() {
        let slide = |name| crate::slides::find(name).unwrap().read().unwrap();
        let mut attempt = Attempt::new(slide("little-animals"));
        attempt.after_step(1.0, &[Vec2::new(80.0, 46.0)], |kind| u32::from(kind != Kind::RigidCell));
        assert_eq!(attempt.summary(), "Places 0/1  Digested 1/4, 1/2, 0/1");
        assert_eq!(Attempt::new(slide("first-steps")).summary(), "Places 0/3");
    }
}
