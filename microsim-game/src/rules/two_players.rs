//! Two under glass: two cells on one slide, which is data, `games/two-under-glass.toml`. Both are scored for themselves.

use super::bot::{Bot, Policy};

/// Name of its scenario.
pub const NAME: &str = "two-under-glass";
/// Its scenario.
pub const TEXT: &str = include_str!("../../games/two-under-glass.toml");

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
    pub fn label(self) -> &'static str {
        match self {
            Self::Versus => "Against each other",
            Self::Together => "Together",
            Self::Bot => "Against the program",
        }
    }

    /// Who steers the second cell, if nobody does.
    #[must_use]
    pub fn bot(self, seed: u64) -> Option<Bot> {
        (self == Self::Bot).then(|| Bot::new(Policy::Greedy, seed))
    }

    /// What the status says of the points so far.
    #[must_use]
    pub fn summary(self, [first, second]: [u32; 2]) -> String {
        match self {
            Self::Versus => format!("1: {first}   2: {second}"),
            Self::Together => format!("Together {}", first + second),
            Self::Bot => format!("You: {first}   Program: {second}"),
        }
    }

    /// What the end says.
    #[must_use]
    pub fn verdict(self, [first, second]: [u32; 2]) -> String {
        let names =
            if self == Self::Bot { ["You win", "The program wins"] } else { ["Player 1 wins", "Player 2 wins"] };
        match first.cmp(&second) {
            _ if self == Self::Together => format!("{} points together", first + second),
            std::cmp::Ordering::Equal => format!("A draw, {first} points each"),
            std::cmp::Ordering::Greater => format!("{}, {first} to {second}", names[0]),
            std::cmp::Ordering::Less => format!("{}, {second} to {first}", names[1]),
        }
    }
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
    fn a_verdict_names_the_better_one_or_the_sum() {
        assert_eq!(TwoPlayers::Versus.verdict([50, 20]), "Player 1 wins, 50 to 20");
        assert_eq!(TwoPlayers::Bot.verdict([20, 50]), "The program wins, 50 to 20");
        assert_eq!(TwoPlayers::Versus.verdict([30, 30]), "A draw, 30 points each");
        assert_eq!(TwoPlayers::Together.verdict([50, 20]), "70 points together");
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
