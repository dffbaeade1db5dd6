//! What is played in a match: the first member of a room chooses it.

use super::pacing::Pacing;
use crate::rules::attempt::Attempt;
use crate::rules::round::Round;
use crate::rules::two_players::{self, TwoPlayers};
use crate::slides::{SHARED, SharedSlide};
use crate::words::{Key, number, text, text_with};
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
    /// A slide for two, by its place in the list; others may know more of them.
    Slide(u8),
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
    pub const ALL: [Self; 5] = [Self::Versus, Self::Together, Self::Slide(0), Self::Slide(1), Self::Slide(2)];

    /// What players read.
    #[must_use]
    pub fn label(self) -> String {
        match self {
            Self::Versus => text(Key::TwoVersus).to_owned(),
            Self::Together => text(Key::TwoTogether).to_owned(),
            Self::Slide(_) => self.slide().map_or_else(String::new, |shared| shared.slide.title()),
        }
    }

    /// The slide for two that is played; none if it is another way, or one that this version does not know.
    fn slide(self) -> Option<&'static SharedSlide> {
        if let Self::Slide(place) = self { SHARED.get(usize::from(place)) } else { None }
    }

    /// What the status says of the points or goals so far.
    #[must_use]
    pub fn summary(self, round: &Round) -> String {
        round.attempt().map_or_else(|| self.rules().summary(&round.scores()), Attempt::summary)
    }

    /// What the end says.
    #[must_use]
    pub fn verdict(self, round: &Round, names: &[String]) -> String {
        round.attempt().map_or_else(|| self.rules().verdict(&round.scores(), names), slide_verdict)
    }

    fn rules(self) -> TwoPlayers {
        if self == Self::Versus { TwoPlayers::Versus } else { TwoPlayers::Together }
    }
}

/// Stars and time of an attempt, or what was done in time.
fn slide_verdict(attempt: &Attempt) -> String {
    let Some(time) = attempt.time() else {
        return text_with(Key::MatchSlideLate, &[("done", (&attempt.summary()).into())]);
    };
    let stars = text_with(Key::MenuStars, &[("stars", attempt.stars().into())]);
    text_with(Key::MatchSlideDone, &[("stars", (&stars).into()), ("time", (&number(time, 1)).into())])
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
    let source = match way {
        Way::Versus | Way::Together => two_players::text(players),
        Way::Slide(_) => way.slide().ok_or("no such slide")?.text(players),
    };
    let mut scenario = Scenario::parse(&source, &[]).map_err(|problems| problems.to_string())?;
    scenario.set_seed(seed);
    Round::new(&scenario)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_has_a_round_and_one_that_is_not_known_has_none() {
        assert_eq!(Way::ALL.len(), 2 + SHARED.len());
        for (way, players) in Way::ALL.into_iter().flat_map(|way| [2, 3, 4].map(|players| (way, players))) {
            let round = round_of(way, players, 1).unwrap_or_else(|problem| panic!("{way:?}: {problem}"));
            assert_eq!(round.players().count(), players, "{way:?}");
            assert_eq!(round.attempt().is_some(), way.slide().is_some());
            assert!(!way.label().is_empty() && !way.summary(&round).is_empty());
        }
        let strange = Way::Slide(u8::MAX);
        assert!(round_of(strange, 2, 1).is_err() && strange.label().is_empty());
    }
}
