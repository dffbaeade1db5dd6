//! The player's best time for each slide. Stars follow from it.

use super::files::PlayerFolder;
use crate::rules::attempt::stars_for;
use microsim_core::scenario::Slide;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;

/// File that they are kept in.
const FILE: &str = "slides.toml";

/// Best times by the name of the slide, s.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct BestTimes(BTreeMap<String, f32>);

impl BestTimes {
    /// Reads them, with a word on what is wrong with the file. Times that no slide can have taken are left out.
    #[must_use]
    pub fn load(store: &PlayerFolder) -> (Self, Option<String>) {
        let (Self(mut times), problem) = store.load(FILE);
        times.retain(|_, time| time.is_finite() && *time > 0.0);
        (Self(times), problem)
    }

    /// Notes a time, and keeps all in the store with what another window has kept since. Returns whether it is the best.
    ///
    /// # Errors
    /// When the file cannot be written; the time counts all the same until the program ends.
    pub fn add(&mut self, slide: &str, time: f32, store: &PlayerFolder) -> (bool, io::Result<()>) {
        for (slide, time) in Self::load(store).0.0 {
            self.note(&slide, time);
        }
        if !self.note(slide, time) {
            return (false, Ok(()));
        }
        (true, store.save(FILE, self))
    }

    fn note(&mut self, slide: &str, time: f32) -> bool {
        let is_best = self.of(slide).is_none_or(|best| time < best);
        if is_best {
            self.0.insert(slide.to_owned(), time);
        }
        is_best
    }

    /// Whether no slide was done yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The best time for a slide, s.
    #[must_use]
    pub fn of(&self, slide: &str) -> Option<f32> {
        self.0.get(slide).copied()
    }

    /// The most stars that the player got for a slide.
    #[must_use]
    pub fn stars(&self, name: &str, slide: &Slide) -> u32 {
        self.of(name).map_or(0, |time| stars_for(slide, time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::files::tests::Folder;

    #[test]
    fn the_best_time_of_each_slide_is_kept_over_a_restart() {
        let (_folder, store) = Folder::new("slides");
        let mut times = BestTimes::load(&store).0;
        let added = [("a", 30.0), ("a", 40.0), ("b", 9.0), ("a", 20.0)].map(|(slide, time)| {
            let (is_best, kept) = times.add(slide, time, &store);
            kept.unwrap();
            is_best
        });
        assert_eq!(added, [true, false, true, true]);
        let again = BestTimes::load(&store).0;
        assert_eq!(["a", "b", "c"].map(|slide| again.of(slide)), [Some(20.0), Some(9.0), None]);
        let mut other = BestTimes::default();
        assert!(other.add("c", 5.0, &store).0 && other == BestTimes::load(&store).0, "another window's are kept");
        assert_eq!(other.of("a"), Some(20.0));
    }

    #[test]
    fn times_that_cannot_be_are_left_out() {
        let (_folder, store) = Folder::new("odd-times");
        store.write(FILE, b"a = -1.0\nb = nan\nc = inf\nd = 0.0\ne = 7.5\n").unwrap();
        let (times, problem) = BestTimes::load(&store);
        assert_eq!((times.0.len(), times.of("e"), problem), (1, Some(7.5), None));
        store.write(FILE, b"a = \"soon\"\n").unwrap();
        let (times, problem) = BestTimes::load(&store);
        assert!(times.0.is_empty() && problem.is_some(), "a broken file is put aside");
    }
}
