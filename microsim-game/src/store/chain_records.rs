//! What the player has reached in the food chain: the most of all lives, and the longest one in the water of a day.

use super::files::PlayerFolder;
use crate::rules::food_chain::feats::Feats;
use serde::{Deserialize, Serialize};
use std::io;

/// File that they are kept in.
const FILE: &str = "food-chain.toml";

/// How many days before the last one are kept: together a week.
const BEFORE: usize = 6;

/// What is kept of all lives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ChainRecords {
    /// The last day on which the water of the day was played, and the longest life in it, s.
    day: u64,
    days_best: u32,
    /// How many lives that were, and the longest ones on the days before, the last one first, s; 0 where there was none.
    lives: u32,
    before: [u32; BEFORE],
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
        self.merge(Self::load(store).0);
        self.best = self.best.most(life);
        if let Some(day) = day.filter(|day| *day >= self.day) {
            self.begin(day);
            self.days_best = self.days_best.max(life.time);
            self.lives += 1;
        }
        store.save(FILE, self)
    }

    fn merge(&mut self, kept: Self) {
        let newer = if (kept.day, kept.lives) >= (self.day, self.lives) { kept } else { *self };
        let days_best = if kept.day == self.day { kept.days_best.max(self.days_best) } else { newer.days_best };
        *self = Self { best: self.best.most(kept.best), days_best, ..newer };
    }

    /// Goes on to a day, if it is another one.
    fn begin(&mut self, day: u64) {
        let Some(passed) = usize::try_from(day - self.day).ok().filter(|passed| *passed > 0) else { return };
        let before = std::array::from_fn(|k| self.ago(k + 1, passed));
        *self = Self { day, days_best: 0, lives: 0, before, ..*self };
    }

    /// The longest life so many days before the day that is so many days after the last one.
    fn ago(&self, days: usize, passed: usize) -> u32 {
        let of_kept =
            |age| if age == 0 { self.days_best } else { self.before.get(age - 1).copied().unwrap_or_default() };
        days.checked_sub(passed).map_or(0, of_kept)
    }

    /// The longest life in the water of a day, s, and how many there were.
    #[must_use]
    pub fn of_day(&self, day: u64) -> Option<[u32; 2]> {
        (self.day == day && self.days_best > 0).then_some([self.days_best, self.lives.max(1)])
    }

    /// The longest lives in the waters of the days before one, the last day first, s; 0 where there was none.
    #[must_use]
    pub fn before(&self, day: u64) -> [u32; BEFORE] {
        let passed = usize::try_from(day.saturating_sub(self.day)).unwrap_or(usize::MAX);
        std::array::from_fn(|k| self.ago(k + 1, passed))
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
        assert_eq!((records.best, records.of_day(20), records.of_day(21)), (life(90, 2), Some([70, 2]), None));
        let mut records = records;
        records.add(life(30, 0), Some(21), &store).unwrap();
        let records = ChainRecords::load(&store).0;
        assert_eq!(
            [19, 20, 21].map(|day| records.of_day(day)),
            [None, None, Some([30, 1])],
            "another day, another water"
        );
        assert_eq!(
            [21, 22, 25].map(|day| records.before(day)[..4].to_vec()),
            [[70, 0, 0, 0], [30, 70, 0, 0], [0, 0, 0, 30]]
        );
    }

    #[test]
    fn a_week_is_kept_and_files_of_before_it_are_read() {
        let (_folder, store) = Folder::new("week");
        let mut records: ChainRecords = crate::store::toml_value::from_toml("day = 20\ndays_best = 70\n").unwrap();
        assert_eq!((records.of_day(20), records.before(21)), (Some([70, 1]), [70, 0, 0, 0, 0, 0]));
        for day in [22, 23, 27, 28] {
            records.add(Feats { time: day, ..Feats::default() }, Some(u64::from(day)), &store).unwrap();
        }
        assert_eq!(ChainRecords::load(&store).0.before(28), [27, 0, 0, 0, 23, 22]);
    }
}
