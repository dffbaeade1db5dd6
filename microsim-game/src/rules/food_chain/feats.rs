//! What is done in a life of the food chain, and the goals for which players come back.

use crate::words::{self, Key};
use serde::{Deserialize, Serialize};

/// What was done in one life; or, of many lives, the most of each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Feats {
    /// How long the line lived, s.
    pub time: u32,
    /// How often a body was changed.
    pub changes: u32,
    /// Small things that were digested.
    pub small: u32,
    /// Rigid cells that were digested.
    pub cells: u32,
    /// Pieces that were bitten out of amoebae.
    pub bites: u32,
    /// How often a cell divided.
    pub divisions: u32,
}

/// What goals ask for, in one life: what players call it, how much of it there is, and how much each goal asks for.
type Measure = (Key, fn(&Feats) -> u32, &'static [u32]);

const MEASURES: [Measure; 6] = [
    (Key::FeatChanges, |feats| feats.changes, &[1, 2, 3, 5, 8]),
    (Key::FeatTime, |feats| feats.time, &[45, 120, 180, 300, 600]),
    (Key::FeatSmall, |feats| feats.small, &[10, 50, 100]),
    (Key::FeatCells, |feats| feats.cells, &[1, 5, 15]),
    (Key::FeatDivisions, |feats| feats.divisions, &[1, 3]),
    (Key::FeatBites, |feats| feats.bites, &[10, 100]),
];

impl Feats {
    /// The most of each of two.
    #[must_use]
    pub fn most(self, other: Self) -> Self {
        Self {
            time: self.time.max(other.time),
            changes: self.changes.max(other.changes),
            small: self.small.max(other.small),
            cells: self.cells.max(other.cells),
            bites: self.bites.max(other.bites),
            divisions: self.divisions.max(other.divisions),
        }
    }

    /// All goals: what each measure is called, how much of it there is, and how much each of its goals asks for.
    pub fn measures(self) -> impl Iterator<Item = (Key, u32, &'static [u32])> {
        MEASURES.iter().map(move |(what, of, wanted)| (*what, of(&self), *wanted))
    }

    /// How many goals are reached, and how many there are.
    #[must_use]
    pub fn goals(&self) -> [usize; 2] {
        let reached = |(_, of, wanted): &Measure| wanted.iter().filter(|least| of(self) >= **least).count();
        [MEASURES.iter().map(reached).sum(), MEASURES.iter().map(|(_, _, wanted)| wanted.len()).sum()]
    }

    /// The goal that is nearest, with what the player has of it, in the words of a text; `None` when all are reached.
    #[must_use]
    pub fn next_goal(&self, text: Key) -> Option<String> {
        let open = MEASURES.iter().filter_map(|(what, of, wanted)| {
            let least = wanted.iter().copied().find(|least| of(self) < *least)?;
            Some((*what, of(self), least))
        });
        let share = |(_, done, least): &(Key, u32, u32)| f64::from(*done) / f64::from(*least);
        // Of equally near ones the first.
        let nearest = open.reduce(|a, b| if share(&b) > share(&a) { b } else { a });
        nearest.map(|(what, done, least)| {
            let args = [("what", words::text(what).into()), ("done", done.into()), ("least", least.into())];
            words::text_with(text, &args)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_goal_is_named_with_what_is_there_of_it() {
        let next = |feats: Feats| feats.next_goal(Key::ChainNext).unwrap();
        assert_eq!(next(Feats::default()), "Next goal: changes of the body, 0 of 1 in one life");
        let some = Feats { changes: 1, time: 67, small: 5, ..Feats::default() };
        assert_eq!(next(some), "Next goal: seconds alive, 67 of 120 in one life");
        assert_eq!((Feats::default().goals(), some.goals()), ([0, 20], [2, 20]));
        let all = Feats { time: 600, changes: 8, small: 100, cells: 15, bites: 100, divisions: 3 };
        assert_eq!((all.next_goal(Key::ChainNext), all.goals()), (None, [20, 20]));
    }

    #[test]
    fn of_two_lives_the_most_of_each_counts() {
        let a = Feats { time: 60, changes: 3, small: 1, ..Feats::default() };
        let b = Feats { time: 90, cells: 2, bites: 7, divisions: 1, ..Feats::default() };
        let most = Feats { time: 90, changes: 3, small: 1, cells: 2, bites: 7, divisions: 1 };
        assert_eq!((a.most(b), b.most(a)), (most, most));
    }
}
