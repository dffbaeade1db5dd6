//! The player's longest life in one water of the food chain, as a replay: the ghost of later lives there.

use super::files::PlayerFolder;
use microsim_core::replay::Replay;
use std::io;

/// File that it is kept in.
const FILE: &str = "best-life.replay";

/// What is kept.
#[derive(Clone, Debug, Default)]
pub struct BestLife(Option<Vec<u8>>);

/// What is compared of two lives: the water, by whom it was recorded, and how long it is, steps.
#[derive(Debug, PartialEq)]
struct Label {
    seed: u64,
    made_by: String,
    steps: u64,
}

impl Label {
    fn of(record: &[u8]) -> Option<Self> {
        let replay = Replay::read(record).ok()?;
        let seed = replay.origin().scenario().ok()?.seed();
        Some(Self { seed, made_by: replay.made_by().to_owned(), steps: replay.steps() })
    }
}

impl BestLife {
    /// Reads it.
    #[must_use]
    pub fn load(store: &PlayerFolder) -> Self {
        Self(store.read(FILE))
    }

    /// The replay.
    #[must_use]
    pub fn record(&self) -> Option<&[u8]> {
        self.0.as_deref()
    }

    /// Keeps a life in place of the one that was kept of the same water, if it is longer, or of another one; but what was kept of
    /// `today`'s water gives way to no other.
    ///
    /// # Errors
    /// When the file cannot be written; the life counts all the same until the program ends.
    pub fn add(&mut self, record: &[u8], today: u64, store: &PlayerFolder) -> io::Result<()> {
        // With what another window has kept since.
        let kept = store.read(FILE).or_else(|| self.0.take());
        let labels = [Some(record), kept.as_deref()].map(|record| record.and_then(Label::of));
        let gives_way = match labels {
            [None, _] => false,
            [_, None] => true,
            [Some(new), Some(kept)] if new.seed == kept.seed => new.made_by != kept.made_by || new.steps > kept.steps,
            [_, Some(kept)] => kept.seed != today,
        };
        self.0 = if gives_way { Some(record.to_owned()) } else { kept };
        if gives_way { store.write(FILE, record) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::food_chain::TEXT;
    use crate::rules::round::Round;
    use crate::store::files::tests::Folder;
    use microsim_core::Intent;
    use microsim_core::scenario::Scenario;

    fn life(seed: u64, steps: u64) -> Vec<u8> {
        let mut scenario = Scenario::parse(TEXT, &[]).unwrap();
        scenario.set_seed(seed);
        let mut round = Round::new(&scenario).unwrap();
        (0..steps).for_each(|_| round.step(Intent::REST));
        round.record().unwrap()
    }

    #[test]
    fn the_longest_life_of_a_water_is_kept_and_that_of_today_before_any_other() {
        let (_folder, store) = Folder::new("best-life");
        let today = 20;
        let (short, long, other) = (life(today, 2), life(today, 9), life(7, 30));
        let mut best = BestLife::load(&store);
        assert_eq!(best.record(), None);
        for (record, kept) in [(&other, &other), (&short, &short), (&long, &long), (&short, &long), (&other, &long)] {
            best.add(record, today, &store).unwrap();
            assert_eq!(best.record(), Some(&kept[..]));
            assert_eq!(BestLife::load(&store).record(), best.record());
        }
        best.add(&other, today + 1, &store).unwrap();
        assert_eq!(BestLife::load(&store).record(), Some(&other[..]), "another day");
        best.add(b"nonsense", today, &store).unwrap();
        assert_eq!(best.record(), Some(&other[..]));
        store.write(FILE, b"nonsense").unwrap();
        best.add(&short, today + 1, &store).unwrap();
        assert_eq!(best.record(), Some(&short[..]));
    }

    #[test]
    fn what_cannot_be_written_counts_until_the_program_ends() {
        let (store, record) = (PlayerFolder::nowhere(), life(1, 2));
        let mut best = BestLife::load(&store);
        best.add(&record, 1, &store).unwrap();
        assert_eq!(best.record(), Some(&record[..]));
    }
}
