//! What is played in a match: the first member of a room chooses it.

use super::pacing::Pacing;
use crate::rules::food_chain;
use crate::rules::round::Round;
use crate::rules::two_players::{self, TwoPlayers};
use crate::rules::verdict::verdict;
use crate::words::Key;
use microsim_core::scenario::Scenario;
use serde::{Deserialize, Serialize};

/// What is played, and how fast.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plan {
    /// What is played.
    pub way: Way,
    /// How many frames a second have.
    pub rate: FrameRate,
}

/// Ways of playing in a room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Way {
    /// Cells on one slide, each for points of its own.
    #[default]
    Versus,
    /// The same for the sum of the points.
    Together,
    /// The food chain: whose line lives longest.
    FoodChain,
}

/// Frames that are exchanged in a second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FrameRate {
    /// 30.
    #[default]
    Usual,
    /// 60.
    Quick,
}

impl Way {
    /// All ways.
    pub const ALL: [Self; 3] = [Self::Versus, Self::Together, Self::FoodChain];

    /// What players read.
    #[must_use]
    pub fn label(self) -> Key {
        match self {
            Self::Versus => TwoPlayers::Versus.label(),
            Self::Together => TwoPlayers::Together.label(),
            Self::FoodChain => Key::TitleFoodChain,
        }
    }

    /// What the status says of the points so far.
    #[must_use]
    pub fn summary(self, round: &Round) -> String {
        let way = if self == Self::Together { TwoPlayers::Together } else { TwoPlayers::Versus };
        way.summary(&round.scores())
    }

    /// What the end says.
    #[must_use]
    pub fn verdict(self, round: &Round, names: &[String]) -> String {
        let scores = round.scores();
        match self {
            Self::Versus => TwoPlayers::Versus.verdict(&scores, names),
            Self::Together => TwoPlayers::Together.verdict(&scores, names),
            Self::FoodChain => verdict([Key::ChainWins, Key::ChainDraw, Key::ChainDrawBest], &scores, names),
        }
    }
}

impl FrameRate {
    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        if self == Self::Usual { Self::Quick } else { Self::Usual }
    }

    /// How a match of this rate goes.
    #[must_use]
    pub fn pacing(self) -> Pacing {
        match self {
            Self::Usual => Pacing::USUAL,
            Self::Quick => Pacing::QUICK,
        }
    }
}

/// The round of a match at its beginning.
pub(super) fn round_of(way: Way, players: usize, seed: u64) -> Result<Round, String> {
    let text = match way {
        Way::Versus | Way::Together => two_players::text(players),
        Way::FoodChain => food_chain::text(players),
    };
    let mut scenario = Scenario::parse(&text, &[]).map_err(|problems| problems.to_string())?;
    scenario.set_seed(seed);
    Round::new(&scenario)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_way_has_a_round_of_two_to_four_and_a_verdict() {
        let names = ["Ada", "Ben", "Cleo", "Dan"].map(str::to_owned);
        for way in Way::ALL {
            for players in 2..=4 {
                let round = round_of(way, players, 1).unwrap();
                assert_eq!((round.players().count(), round.chain().is_some()), (players, way == Way::FoodChain));
                assert!(!way.verdict(&round, &names).is_empty() && !way.summary(&round).is_empty());
            }
        }
    }
}
