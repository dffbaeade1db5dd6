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
    /// Who played; empty if that was not said.
    #[serde(default)]
    pub name: String,
    /// Days since 1 January 1970; 0 if that is not known.
    #[serde(default)]
    pub day: u32,
}

impl Score {
    /// The day as year, month and day of the Gregorian calendar, as in ISO 8601; empty if it is not known.
    #[must_use]
    pub fn date(&self) -> String {
        if self.day == 0 {
            return String::new();
        }
        // Years begin in March, so that a leap day is the last one; 400 of them have as many days each time.
        let days = u64::from(self.day) + 719_468;
        let (era, day_of_era) = (days / 146_097, days % 146_097);
        let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
        let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let month = (5 * day_of_year + 2) / 153;
        let day = day_of_year - (153 * month + 2) / 5 + 1;
        let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
        format!("{}-{month:02}-{day:02}", 400 * era + year_of_era + later)
    }
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

    /// The best ones of a game, however long its rounds were.
    pub fn of_game<'a>(&'a self, game: &'a str) -> impl Iterator<Item = &'a Score> {
        self.score.iter().filter(move |score| score.game == game)
    }

    /// The best ones of a game, the best first.
    pub fn of<'a>(&'a self, game: &'a str, time: f32) -> impl Iterator<Item = &'a Score> {
        self.of_game(game).filter(move |score| score.time == time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::files::tests::Folder;

    fn score(points: u32, time: f32) -> Score {
        Score { game: "game".to_owned(), time, points, small: 0, rigid: 0, name: String::new(), day: 0 }
    }

    #[test]
    fn days_are_dates() {
        let date = |day| Score { day, ..score(1, 90.0) }.date();
        let dates = [0, 1, 58, 59, 11_016, 11_017, 19_782, 20_785, 47_540, 47_541].map(date);
        let expected = ["", "1970-01-02", "1970-02-28", "1970-03-01", "2000-02-29", "2000-03-01", "2024-02-29"];
        assert_eq!(dates[..7], expected);
        assert_eq!(dates[7..], ["2026-11-28", "2100-02-28", "2100-03-01"], "no leap day in 2100");
    }

    #[test]
    fn scores_of_before_have_neither_name_nor_date() {
        let text = "[[score]]\ngame = \"game\"\ntime = 90.0\npoints = 5\nsmall = 1\nrigid = 0\n";
        let scores: Scores = toml::from_str(text).unwrap();
        assert_eq!(scores.score, [Score { small: 1, ..score(5, 90.0) }]);
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
