//! Marks are explained when they are seen first, and the lunge when it helps first, one at a time.

use super::hint::{Hints, Readiness};
use crate::words::Key;

/// Time for which an explanation is shown, s.
const TIME: f32 = 6.0;
/// The explanation of each mark, and of the lunge.
const LESSONS: [Key; 4] = [Key::LessonReady, Key::LessonTooLarge, Key::LessonNoRoom, Key::LessonLunge];

/// Time for which a newcomer has to crawl until it is clear that they can, s.
const CRAWLED: f32 = 1.0;

/// What a player has to do first, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FirstDeed {
    /// To crawl.
    Crawl,
    /// To take something in.
    Eat,
}

/// What was explained so far, and what is being explained; and what the player has done.
#[derive(Clone, Debug, Default)]
pub struct Lessons {
    is_told: [bool; LESSONS.len()],
    shown: Option<(usize, f32)>,
    /// Time for which the player has crawled, s.
    crawled: f32,
    has_eaten: bool,
    /// What was said that is said once.
    said: Vec<Key>,
}

impl Lessons {
    /// Notes what the player does in a frame of this length, s.
    pub fn note(&mut self, crawls: bool, eats: bool, elapsed: f32) {
        if crawls {
            self.crawled += elapsed;
        }
        self.has_eaten |= eats;
    }

    /// Whether something is to be said that was not said before.
    pub fn is_first(&mut self, word: Key) -> bool {
        let is_first = !self.said.contains(&word);
        self.said.extend(is_first.then_some(word));
        is_first
    }

    /// What the player has not done yet: that is explained until it is done.
    #[must_use]
    pub fn first_deed(&self) -> Option<FirstDeed> {
        match (self.has_eaten, self.crawled < CRAWLED) {
            (true, _) => None,
            (false, true) => Some(FirstDeed::Crawl),
            (false, false) => Some(FirstDeed::Eat),
        }
    }

    /// What to tell now, at a time of the program, s: nothing begins while something else is told in its place. `is_hunted` says
    /// whether somebody is near from whom a lunge takes the player away; `None` where there are no lunges.
    pub fn pass(&mut self, hints: &Hints, is_hunted: Option<bool>, time: f32, is_free: bool) -> Option<Key> {
        self.shown = self.shown.filter(|(_, until)| time < *until);
        if self.shown.is_none() && is_free {
            let places = hints.targets.iter().map(|target| match target.readiness {
                Readiness::Ready => 0,
                Readiness::TooLarge(_) => 1,
                Readiness::NoRoom => 2,
            });
            let is_chase = hints.targets.iter().any(|target| target.readiness == Readiness::Ready);
            let lunge = is_hunted.filter(|is_hunted| *is_hunted || is_chase).map(|_| 3);
            if let Some(new) = places.chain(lunge).filter(|&place| !self.is_told[place]).min() {
                (self.is_told[new], self.shown) = (true, Some((new, time + TIME)));
            }
        }
        self.shown.map(|(place, _)| LESSONS[place])
    }
}

#[cfg(test)]
mod tests {
    use super::super::hint::PreyTarget;
    use super::*;
    use microsim_core::glam::Vec2;
    use microsim_core::{AgarSpec, Placement, World, WorldConfig};

    #[test]
    fn every_mark_is_explained_once_and_one_at_a_time() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let prey = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0)).unwrap();
        let hints = |all: &[Readiness]| {
            let target = |&readiness| PreyTarget { prey, at: Vec2::ZERO, half_extent: 1.0, readiness };
            Hints { targets: all.iter().map(target).collect(), held: Vec::new() }
        };
        let both = hints(&[Readiness::TooLarge(0.7), Readiness::NoRoom]);
        let mut lessons = Lessons::default();
        assert_eq!(lessons.pass(&hints(&[]), None, 0.0, true), None);
        assert_eq!(lessons.pass(&both, None, 1.0, true), Some(LESSONS[1]));
        assert_eq!(lessons.pass(&hints(&[]), None, 6.9, true), Some(LESSONS[1]));
        assert_eq!(lessons.pass(&both, None, 7.1, true), Some(LESSONS[2]));
        assert_eq!(lessons.pass(&both, None, 13.2, true), None);
        assert_eq!(lessons.pass(&hints(&[Readiness::Ready]), None, 14.0, true), Some(LESSONS[0]));
        assert_eq!(lessons.pass(&hints(&[Readiness::Ready]), None, 30.0, true), None);
    }

    #[test]
    fn a_lunge_is_explained_where_there_are_lunges_and_one_helps() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let prey = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0)).unwrap();
        let target = PreyTarget { prey, at: Vec2::ZERO, half_extent: 1.0, readiness: Readiness::Ready };
        let [ready, none] = [vec![target], Vec::new()].map(|targets| Hints { targets, held: Vec::new() });
        let lunge = Some(Key::LessonLunge);
        let mut told = Lessons::default();
        let told = [(0.0, None), (7.0, None), (8.0, Some(false)), (20.0, Some(true))]
            .map(|(time, hunted)| told.pass(&ready, hunted, time, true));
        assert_eq!(told, [Some(Key::LessonReady), None, lunge, None]);
        let mut told = Lessons::default();
        assert_eq!([Some(false), Some(true)].map(|hunted| told.pass(&none, hunted, 0.0, true)), [None, lunge]);
    }

    #[test]
    fn what_is_said_once_is_first_once() {
        let mut lessons = Lessons::default();
        let said = [Key::HudLungePrice, Key::HudLungeEarly, Key::HudLungePrice].map(|word| lessons.is_first(word));
        assert_eq!(said, [true, true, false]);
    }

    #[test]
    fn what_comes_first_is_explained_until_it_is_done() {
        let mut lessons = Lessons::default();
        let mut after = |crawls, eats, elapsed| {
            lessons.note(crawls, eats, elapsed);
            lessons.first_deed()
        };
        assert_eq!(after(false, false, 60.0), Some(FirstDeed::Crawl), "not after a time");
        assert_eq!(after(true, false, 0.5), Some(FirstDeed::Crawl));
        assert_eq!(after(true, false, 0.6), Some(FirstDeed::Eat));
        assert_eq!(after(false, true, 0.1), None);
        assert_eq!(after(true, false, 9.0), None);
    }

    #[test]
    fn a_mark_is_explained_after_the_advice_that_a_round_begins_with() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let prey = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0)).unwrap();
        let target = PreyTarget { prey, at: Vec2::ZERO, half_extent: 1.0, readiness: Readiness::TooLarge(0.7) };
        let hints = Hints { targets: vec![target], held: Vec::new() };
        let mut lessons = Lessons::default();
        assert_eq!([0.0, 3.0, 6.9].map(|time| lessons.pass(&hints, None, time, false)), [None; 3]);
        assert_eq!([7.1, 13.0].map(|time| lessons.pass(&hints, None, time, true)), [Some(LESSONS[1]); 2]);
    }
}
