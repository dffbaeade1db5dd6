//! High scores.

use super::files::PlayerFolder;
use serde::{Deserialize, Serialize};
use std::io;

/// File that they are kept in.
const FILE: &str = "scores.toml";
/// Scores that are kept for each game.
pub const KEPT: usize = 10;

/// One score.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// What was played: the scenario, and what was changed of it.
    pub game: String,
    /// Time that it lasted, s: scores of different lengths are not compared.
    pub time: f32,
    /// The points.
    pub points: u32,
    /// Number of small things that were digested.
    pub small: u32,
    /// Number of rigid cells that were digested.
    pub rigid: u32,
}

/// All scores that are kept, the best ones first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    score: Vec<Score>,
}

impl Scores {
    /// Reads them, with a word on what is wrong with the file.
    #[must_use]
    pub fn load(store: &PlayerFolder) -> (Self, Option<String>) {
        store.load(FILE)
    }

    /// Adds a score and keeps all in the store. Returns its place from 0, if it is one of the best.
    ///
    /// # Errors
    /// When the file cannot be written; the score counts all the same until the program ends.
    pub fn add(&mut self, score: Score, store: &PlayerFolder) -> (Option<usize>, io::Result<()>) {
        self.join(Self::load(store).0);
        let is_same_game = |other: &Score| other.game == score.game && other.time == score.time;
        let place = self.score.iter().filter(|other| is_same_game(other) && other.points >= score.points).count();
        if place >= KEPT || score.points == 0 {
            return (None, Ok(()));
        }
        self.insert(score);
        self.trim();
        (Some(place), store.save(FILE, self))
    }

    fn insert(&mut self, score: Score) {
        let at = self.score.iter().position(|other| other.points < score.points).unwrap_or(self.score.len());
        self.score.insert(at, score);
    }

    /// Leaves the best ones of each game.
    fn trim(&mut self) {
        let all = std::mem::take(&mut self.score);
        for score in all {
            if self.of(&score.game, score.time).count() < KEPT {
                self.score.push(score);
            }
        }
    }

    /// Takes over what another window has kept since.
    fn join(&mut self, kept: Self) {
        let count = |scores: &[Score], wanted: &Score| scores.iter().filter(|score| *score == wanted).count();
        for score in kept.score.iter().filter(|score| score.points > 0) {
            if count(&self.score, score) < count(&kept.score, score) {
                self.insert(score.clone());
            }
        }
        self.trim();
    }

    /// Whether there are none, of any game.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.score.is_empty()
    }

    /// The best ones of a game, the best first.
    pub fn of<'a>(&'a self, game: &'a str, time: f32) -> impl Iterator<Item = &'a Score> {
        self.score.iter().filter(move |score| score.game == game && score.time == time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::files::tests::Folder;

    fn score(points: u32, time: f32) -> Score {
        Score { game: "game".to_owned(), time, points, small: 0, rigid: 0 }
    }

    #[test]
    fn the_best_ten_of_each_game_are_kept_over_a_restart() {
        let (_folder, store) = Folder::new("scores");
        let mut scores = Scores::load(&store).0;
        assert_eq!(scores.add(score(5, 10.0), &store).0, Some(0));
        for points in 1..=14 {
            let (place, kept) = scores.add(score(points * 10, 90.0), &store);
            assert_eq!(place, Some(0));
            kept.unwrap();
        }
        assert_eq!(scores.add(score(20, 90.0), &store).0, None);
        assert_eq!(scores.add(score(0, 30.0), &store).0, None, "nothing is no score");
        assert_eq!(scores.add(score(100, 90.0), &store).0, Some(5), "behind the equal one");
        let again = Scores::load(&store).0;
        assert_eq!(again, scores);
        let points: Vec<u32> = again.of("game", 90.0).map(|score| score.points).collect();
        assert_eq!(points, [140, 130, 120, 110, 100, 100, 90, 80, 70, 60]);
        assert_eq!(again.of("game", 10.0).count(), 1);
    }

    #[test]
    fn two_windows_lose_no_score_of_each_other() {
        let (_folder, store) = Folder::new("windows");
        let mut windows = [Scores::default(), Scores::default()];
        for (points, window) in [(30, 0), (50, 1), (40, 0), (50, 1)] {
            windows[window].add(score(points, 90.0), &store).1.unwrap();
        }
        let points: Vec<u32> = Scores::load(&store).0.of("game", 90.0).map(|score| score.points).collect();
        assert_eq!(points, [50, 50, 40, 30]);
    }
}
