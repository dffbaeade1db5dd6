//! What is played in a match: the first member of a room chooses it.

use super::rollback_pacing::Pacing;
use crate::rules::attempt::Attempt;
use crate::rules::food_chain;
use crate::rules::round::Round;
use crate::rules::two_players::{self, TwoPlayers};
use crate::rules::verdict::chain_verdict;
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
    /// The food chain: whose line lives longest.
    FoodChain,
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
    pub const ALL: [Self; 6] =
        [Self::Versus, Self::Together, Self::FoodChain, Self::Slide(0), Self::Slide(1), Self::Slide(2)];

    /// What players read.
    #[must_use]
    pub fn label(self) -> String {
        match self {
            Self::Versus => text(Key::TwoVersus).to_owned(),
            Self::Together => text(Key::TwoTogether).to_owned(),
            Self::FoodChain => text(Key::TitleFoodChain).to_owned(),
            Self::Slide(_) => self.slide().map_or_else(String::new, |shared| shared.slide.title()),
        }
    }

    /// The slide for two that is played; none if it is another way, or one that this version does not know.
    fn slide(self) -> Option<&'static SharedSlide> {
        if let Self::Slide(place) = self { SHARED.get(usize::from(place)) } else { None }
    }

    /// What the status says of the points of each player, or of the goals, so far.
    #[must_use]
    pub fn summary(self, round: &Round) -> Vec<(Option<usize>, String)> {
        let of_attempt = |attempt: &Attempt| vec![(None, attempt.summary())];
        round.attempt().map_or_else(|| self.rules().summary(&round.scores()), of_attempt)
    }

    /// What the end says.
    #[must_use]
    pub fn verdict(self, round: &Round, names: &[String]) -> String {
        let scores = round.scores();
        match round.attempt() {
            Some(attempt) => slide_verdict(attempt),
            None if self == Self::FoodChain => chain_verdict(&scores, names),
            None => self.rules().verdict(&scores, names),
        }
    }

    fn rules(self) -> TwoPlayers {
        if self == Self::Together { TwoPlayers::Together } else { TwoPlayers::Versus }
    }
}

/// Stars and time of an attempt, or what was done in time.
fn slide_verdict(attempt: &Attempt) -> String {
    if attempt.is_lost() {
        return text(Key::SlideEndTaken).to_owned();
    }
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
        Way::FoodChain => food_chain::text(players),
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
    fn every_way_has_a_round_of_two_to_four_and_one_that_is_not_known_has_none() {
        assert_eq!(Way::ALL.len(), 3 + SHARED.len());
        let names = ["Ada", "Ben", "Cleo", "Dan"].map(str::to_owned);
        for (way, players) in Way::ALL.into_iter().flat_map(|way| [2, 3, 4].map(|players| (way, players))) {
            let round = round_of(way, players, 1).unwrap_or_else(|problem| panic!("{way:?}: {problem}"));
            assert_eq!(round.players().count(), players, "{way:?}");
            assert_eq!(round.attempt().is_some(), way.slide().is_some());
            assert_eq!(round.chain().is_some(), way == Way::FoodChain);
            let told = [way.label(), way.verdict(&round, &names)];
            let parts = way.summary(&round).into_iter().map(|(_, part)| part);
            assert!(told.into_iter().chain(parts).all(|words| !words.is_empty()), "{way:?}");
        }
        let strange = Way::Slide(u8::MAX);
        assert!(round_of(strange, 2, 1).is_err() && strange.label().is_empty());
    }
}
