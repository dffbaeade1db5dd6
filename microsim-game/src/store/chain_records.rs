//! What the player has reached in the food chain: the most of all lives, and the longest one in the water of a day.

use super::files::PlayerFolder;
use crate::rules::food_chain::feats::Feats;
use serde::{Deserialize, Serialize};
use std::io;

/// File that they are kept in.
const FILE: &str = "food-chain.toml";

/// What is kept of all lives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ChainRecords {
    /// The last day on which the water of the day was played, and the longest life in it, s.
    day: u64,
    days_best: u32,
    /// The most of all lives.
    pub best: Feats,
}

impl ChainRecords {
    /// Reads them, with a word on what is wrong with the file.
    #[must_use]
    pub fn load(store: &PlayerFolder) -> (Self, Option<String>) {
        store.load(FILE)
    }

    /// Notes a life in the water of a day, or another one, and keeps all in the store with what another window has kept since.
    ///
    /// # Errors
    /// When the file cannot be written; the life counts all the same until the program ends.
    pub fn add(&mut self, life: Feats, day: Option<u64>, store: &PlayerFolder) -> io::Result<()> {
        let kept = Self::load(store).0;
        self.note(kept.best, Some(kept.day), kept.days_best);
        self.note(life, day, life.time);
        store.save(FILE, self)
    }

    fn note(&mut self, life: Feats, day: Option<u64>, time: u32) {
        self.best = self.best.most(life);
        if let Some(day) = day.filter(|day| *day >= self.day) {
            self.days_best = if day > self.day { time } else { self.days_best.max(time) };
            self.day = day;
        }
    }

    /// The longest life in the water of a day, s.
    #[must_use]
    pub fn of_day(&self, day: u64) -> Option<u32> {
        (self.day == day && self.days_best > 0).then_some(self.days_best)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::files::tests::Folder;

    #[test]
    fn the_most_of_all_lives_and_the_best_of_the_day_are_kept_over_a_restart() {
        let (_folder, store) = Folder::new("chain");
        let life = |time, changes| Feats { time, changes, ..Feats::default() };
        let mut records = ChainRecords::load(&store).0;
        records.add(life(70, 1), Some(20), &store).unwrap();
        records.add(life(50, 2), Some(20), &store).unwrap();
        ChainRecords::default().add(life(90, 0), None, &store).unwrap();
        let records = ChainRecords::load(&store).0;
        assert_eq!((records.best, records.of_day(20), records.of_day(21)), (life(90, 2), Some(70), None));
        let mut records = records;
        records.add(life(30, 0), Some(21), &store).unwrap();
        let records = ChainRecords::load(&store).0;
        assert_eq!([19, 20, 21].map(|day| records.of_day(day)), [None, None, Some(30)], "another day, another water");
    }
}
