//! What is played in a match: the first member of a room chooses it.

use super::pacing::Pacing;
use crate::rules::round::Round;
use crate::rules::two_players::{self, TwoPlayers};
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
    pub const ALL: [Self; 2] = [Self::Versus, Self::Together];

    /// What players read.
    #[must_use]
    pub fn label(self) -> Key {
        self.rules().label()
    }

    /// What the status says of the points so far.
    #[must_use]
    pub fn summary(self, round: &Round) -> String {
        self.rules().summary(&round.scores())
    }

    /// What the end says.
    #[must_use]
    pub fn verdict(self, round: &Round, names: &[String]) -> String {
        self.rules().verdict(&round.scores(), names)
    }

    fn rules(self) -> TwoPlayers {
        match self {
            Self::Versus => TwoPlayers::Versus,
            Self::Together => TwoPlayers::Together,
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
    };
    let mut scenario = Scenario::parse(&text, &[]).map_err(|problems| problems.to_string())?;
    scenario.set_seed(seed);
    Round::new(&scenario)
}
