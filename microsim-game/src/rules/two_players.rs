//! Two under glass: two cells on one slide, which is data, `games/two-under-glass.toml`. Both are scored for themselves.

use super::bot::{Bot, Policy};
use super::seating::{OBSTACLES, seat};
use super::verdict::verdict;
use crate::words::{self, Key, text_with};

/// Name of its scenario.
pub const NAME: &str = "two-under-glass";
/// Its scenario.
pub const TEXT: &str = include_str!("../../games/two-under-glass.toml");

/// Cells of more players: the third is beside the first, the fourth beside the second.
const MORE: [(usize, [f32; 2]); 2] = [(3, [24.0, 66.0]), (4, [120.0, 15.0])];

/// How two cells play.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TwoPlayers {
    /// Two people, each for points of their own.
    Versus,
    /// Two people, for the sum of their points.
    Together,
    /// One person against a bot.
    Bot,
}

impl TwoPlayers {
    /// All ways.
    pub const ALL: [Self; 3] = [Self::Versus, Self::Together, Self::Bot];

    /// What players read.
    #[must_use]
    pub fn label(self) -> Key {
        match self {
            Self::Versus => Key::TwoVersus,
            Self::Together => Key::TwoTogether,
            Self::Bot => Key::TwoBot,
        }
    }

    /// What it is about.
    #[must_use]
    pub fn about(self) -> Key {
        match self {
            Self::Versus => Key::TwoVersusAbout,
            Self::Together => Key::TwoTogetherAbout,
            Self::Bot => Key::TwoBotAbout,
        }
    }

    /// Who steers the second cell, if nobody does.
    #[must_use]
    pub fn bot(self, seed: u64) -> Option<Bot> {
        (self == Self::Bot).then(|| Bot::new(Policy::Greedy, seed))
    }

    /// What the status says of the points so far, of each player or, the first without one, of all; and by how much somebody leads.
    #[must_use]
    pub fn summary(self, scores: &[u32]) -> Vec<(Option<usize>, String)> {
        if self == Self::Together {
            return vec![(None, text_with(Key::TwoSum, &[("points", scores.iter().sum::<u32>().into())]))];
        }
        let of = |(k, &points): (usize, &u32)| {
            let best_other = (0..).zip(scores).filter(|(other, _)| *other != k).map(|(_, points)| *points).max();
            let lead = best_other.and_then(|other| points.checked_sub(other)).filter(|lead| *lead > 0);
            let name = match self {
                Self::Bot => words::text([Key::TwoYou, Key::TwoProgram][k.min(1)]).to_owned(),
                _ => (k + 1).to_string(),
            };
            (Some(k), format!("{name}: {points}{}", lead.map_or_else(String::new, |lead| format!(" (+{lead})"))))
        };
        scores.iter().enumerate().map(of).collect()
    }

    /// What the end says. Players without a name have a number.
    #[must_use]
    pub fn verdict(self, scores: &[u32], names: &[String]) -> String {
        if self == Self::Together {
            return text_with(Key::TwoTogetherEnd, &[("points", scores.iter().sum::<u32>().into())]);
        }
        let is_first = scores.first() == scores.iter().max();
        let win = match self {
            Self::Bot if is_first => Key::TwoYouWin,
            Self::Bot => Key::TwoBotWins,
            _ => Key::TwoWins,
        };
        verdict([win, Key::TwoDraw, Key::TwoDrawBest], scores, names)
    }
}

/// What the scores of two who play together are kept as.
#[must_use]
pub fn together() -> String {
    format!("{NAME}, together")
}

/// Who has more points than all others.
#[must_use]
pub fn winner(scores: &[u32]) -> Option<usize> {
    let best = scores.iter().max()?;
    let mut best_ones = (0..scores.len()).filter(|&k| scores[k] == *best);
    best_ones.next().filter(|_| best_ones.next().is_none())
}

/// The rounds that were won one after the other in one way, by the first and by the second player.
#[derive(Clone, Copy, Debug, Default)]
pub struct RoundsWon(Option<TwoPlayers>, [u32; 2]);

impl RoundsWon {
    /// Counts a round, from the beginning if it was played in another way than the last one, and tells how it stands.
    pub fn count(&mut self, way: TwoPlayers, winner: Option<usize>) -> String {
        if self.0 != Some(way) {
            *self = Self(Some(way), [0; 2]);
        }
        if let Some(count) = winner.and_then(|winner| self.1.get_mut(winner)) {
            *count += 1;
        }
        let [first, second] = self.1;
        text_with(Key::TwoWon, &[("first", first.into()), ("second", second.into())])
    }
}

/// The scenario for so many players, 2 to 4.
#[must_use]
pub fn text(players: usize) -> String {
    seat(TEXT, OBSTACLES, players, "of = \"hunter\"", &MORE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::round::Round;
    use microsim_core::Intent;
    use microsim_core::glam::Vec2;
    use microsim_core::replay::Replay;
    use microsim_core::scenario::Scenario;

    fn round(seed: u64) -> Round {
        let mut scenario = Scenario::parse(TEXT, &[]).unwrap();
        scenario.set_seed(seed);
        Round::new(&scenario).unwrap()
    }

    /// Points after a whole round of two greedy bots, the first of which has the cell on the left.
    fn play(seed: u64, bots: [u64; 2]) -> (Round, [u32; 2]) {
        let mut round = round(seed);
        let mut bots = bots.map(|seed| Bot::new(Policy::Greedy, seed));
        while !round.is_over() {
            let cells: Vec<_> = round.players().collect();
            let intents = [0, 1].map(|k| bots[k].intent(round.world(), cells[k]));
            round.step_all(&intents);
        }
        let scores = round.scores();
        (round, [scores[0], scores[1]])
    }

    #[test]
    fn each_player_steers_a_cell_of_its_own() {
        let mut round = round(1);
        let cells: Vec<_> = round.players().collect();
        let start = [0, 1].map(|k| round.world().centroid(cells[k]).unwrap());
        let up = |at: Vec2, y| Intent::toward(at + Vec2::new(0.0, y)).unwrap();
        (0..90).for_each(|_| round.step_all(&[up(start[0], 20.0), up(start[1], -20.0)]));
        let moved = [0, 1].map(|k| round.world().centroid(cells[k]).unwrap().y - start[k].y);
        assert!(moved[0] > 5.0 && moved[1] < -5.0, "{moved:?}");
    }

    #[test]
    fn both_score_for_themselves_and_a_round_plays_again_as_it_was() {
        let (round, scores) = play(3, [1, 2]);
        assert!(scores.iter().all(|&points| points > 100), "{scores:?}");
        let record = round.record().unwrap();
        let mut again = Round::again(&Replay::read(&record).unwrap()).unwrap();
        while !again.is_over() {
            again.step(Intent::REST);
        }
        assert_eq!((again.scores(), again.mismatch()), (scores.to_vec(), None));
    }

    #[test]
    fn up_to_four_play_and_their_round_plays_again_as_it_was() {
        for players in 3..=4 {
            let scenario = Scenario::parse(&text(players), &[]).unwrap();
            let mut round = Round::new(&scenario).unwrap();
            let cells: Vec<_> = round.players().collect();
            assert_eq!(cells.len(), players);
            let mut bots: Vec<_> = (0..players).map(|k| Bot::new(Policy::Greedy, k as u64)).collect();
            while round.world().time() < 4.0 {
                let intents: Vec<_> = (0..players).map(|k| bots[k].intent(round.world(), cells[k])).collect();
                round.step_all(&intents);
            }
            let mut again = Round::again(&Replay::read(&round.record().unwrap()).unwrap()).unwrap();
            while !again.is_over() {
                again.step(Intent::REST);
            }
            assert_eq!((again.scores(), again.mismatch()), (round.scores(), None));
        }
    }

    #[test]
    fn a_round_that_was_taken_back_goes_on_as_before() {
        let play = |round: &mut Round, steps| {
            let mut bot = Bot::new(Policy::Greedy, 1);
            for _ in 0..steps {
                let intent = bot.intent(round.world(), round.player());
                round.step_all(&[intent, intent]);
            }
            (round.world().digest(), round.scores(), round.record())
        };
        let mut round = round(2);
        play(&mut round, 300);
        let mut kept = super::tests::round(9);
        kept.clone_from(&round);
        let first = play(&mut round, 200);
        round.clone_from(&kept);
        assert_eq!(play(&mut round, 200), first);
    }

    #[test]
    fn the_status_has_a_part_for_each_player_and_says_who_leads() {
        let told = |way: TwoPlayers, scores: &[u32]| {
            let parts = way.summary(scores).into_iter();
            parts.map(|(player, text)| format!("{player:?} {text}")).collect::<Vec<_>>().join(", ")
        };
        assert_eq!(told(TwoPlayers::Versus, &[30, 50]), "Some(0) 1: 30, Some(1) 2: 50 (+20)");
        assert_eq!(told(TwoPlayers::Versus, &[50, 50, 10]), "Some(0) 1: 50, Some(1) 2: 50, Some(2) 3: 10");
        assert_eq!(told(TwoPlayers::Bot, &[70, 50]), "Some(0) You: 70 (+20), Some(1) Program: 50");
        assert_eq!(told(TwoPlayers::Together, &[70, 50]), "None Together 120");
    }

    #[test]
    fn rounds_are_counted_while_two_go_on_in_the_same_way() {
        let mut won = RoundsWon::default();
        let mut after = |way, scores: &[u32]| won.count(way, winner(scores));
        assert_eq!(after(TwoPlayers::Versus, &[10, 20]), "Rounds won: 0 to 1");
        assert_eq!(after(TwoPlayers::Versus, &[10, 10]), "Rounds won: 0 to 1", "a draw");
        assert_eq!(after(TwoPlayers::Versus, &[30, 10]), "Rounds won: 1 to 1");
        assert_eq!(after(TwoPlayers::Bot, &[30, 10]), "Rounds won: 1 to 0");
    }

    #[test]
    fn a_verdict_names_the_better_one_or_the_sum() {
        assert_eq!(TwoPlayers::Versus.verdict(&[50, 20], &[]), "Player 1 wins, 50 to 20");
        assert_eq!(TwoPlayers::Bot.verdict(&[20, 50], &[]), "The program wins, 50 to 20");
        assert_eq!(TwoPlayers::Versus.verdict(&[30, 30], &[]), "A draw, 30 points each");
        assert_eq!(TwoPlayers::Together.verdict(&[50, 20], &[]), "70 points together");
        assert_eq!(TwoPlayers::Versus.verdict(&[20, 50, 30], &[]), "Player 2 wins, 50 to 20, 30");
        let names = ["Ada", "Ben"].map(str::to_owned);
        assert_eq!(TwoPlayers::Versus.verdict(&[20, 50], &names), "Ben wins, 50 to 20");
        assert_eq!(TwoPlayers::Versus.verdict(&[50, 50, 30], &[]), "A draw of the best, 50 points each");
    }

    /// By hand: `cargo test --release -p microsim-game --lib two_players -- --ignored --nocapture`.
    #[test]
    #[ignore = "two hundred rounds take minutes"]
    fn equal_bots_win_as_often_as_each_other_and_on_either_side() {
        let (mut first, mut left, mut draws) = (0, 0, 0);
        for seed in 0..100 {
            for [a, b] in [[1, 2], [2, 1]] {
                let (_, [of_left, of_right]) = play(seed, [a, b]);
                draws += u32::from(of_left == of_right);
                left += u32::from(of_left > of_right);
                first += u32::from(if a == 1 { of_left > of_right } else { of_right > of_left });
            }
        }
        let share = |count: u32| f64::from(count) / f64::from(200 - draws);
        println!("bot 1 {:.3}, left {:.3}, draws {draws} of 200", share(first), share(left));
        assert!([first, left].map(share).iter().all(|share| (0.45..=0.55).contains(share)));
    }
}
