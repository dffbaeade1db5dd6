//! A bot that plays slides: it does one goal after another, sees obstacles, and flees from what can take it in.

use super::attempt::wanted;
use super::flight::Flight;
use super::hint::{Readiness, readiness};
use super::path::PathMap;
use super::prey_class;
use super::round::Round;
use super::threat::engulfers;
use microsim_core::glam::Vec2;
use microsim_core::scenario::Goal;
use microsim_core::{Intent, Kind, OrganismView, View};
use std::sync::Arc;

/// Steps between two decisions.
const INTERVAL: u64 = 10;

/// The bot.
#[derive(Clone, Debug)]
pub struct SlideBot {
    /// Never changed, so that bots are cheap to keep.
    map: Arc<PathMap>,
    /// Which of the players it is.
    player: usize,
    intent: Intent,
}

impl SlideBot {
    /// Bots for all players of a round of a slide.
    #[must_use]
    pub fn all(round: &Round) -> Vec<Self> {
        let map = Arc::new(PathMap::new(round.world()));
        (0..round.players().count()).map(|player| Self { map: map.clone(), player, intent: Intent::REST }).collect()
    }

    /// What it does in the next step.
    pub fn intent(&mut self, round: &Round) -> Intent {
        if round.world().step_index().is_multiple_of(INTERVAL) {
            let cell = round.players().nth(self.player);
            let at = cell.and_then(|cell| round.world().centroid(cell));
            let next = at.and_then(|at| Intent::toward(self.next(round, at)?).ok());
            self.intent = next.unwrap_or(Intent::REST).digesting(true);
        }
        self.intent
    }

    /// Where it heads for: on the way to what a goal asks for, or away from threats.
    fn next(&self, round: &Round, at: Vec2) -> Option<Vec2> {
        let view = round.world().view();
        let threats = engulfers(view, round.players().nth(self.player)?);
        let places = places(round, self.player)?;
        if threats.is_empty() {
            let nearest = places.into_iter().min_by(|a, b| (*a - at).length().total_cmp(&(*b - at).length()));
            return nearest.map(|to| self.map.next(at, to));
        }
        let flight = Flight::new(&self.map, at, &threats);
        let to = flight.nearest(&places).or_else(|| flight.refuge())?;
        Some(self.map.next_past(at, to, |cell| flight.risk(cell)))
    }
}

/// The places or prey that a goal asks for, or food to grow on.
fn places(round: &Round, player: usize) -> Option<Vec<Vec2>> {
    let view = round.world().view();
    let cell = view.organism(round.players().nth(player)?)?;
    let open = round.attempt()?.goals().filter(|&(goal, done)| done < wanted(goal));
    let mut is_first = true;
    let places = open.flat_map(|(goal, _)| match *goal {
        Goal::Reach { low, high } => vec![0.5 * (low + high)],
        // All go for the same two places.
        Goal::Together { places } if std::mem::take(&mut is_first) => {
            share(round, player, places).into_iter().collect()
        }
        Goal::Together { .. } => Vec::new(),
        Goal::Digest { kind, .. } => prey_of(view, cell, kind),
    });
    Some(places.collect())
}

/// Which of two places a player goes to so that the sum of both ways is the shortest; none if two others are nearer.
fn share(round: &Round, player: usize, places: [[Vec2; 2]; 2]) -> Option<Vec2> {
    let middles = places.map(|[low, high]| 0.5 * (low + high));
    let at: Vec<Vec2> = round.players().filter_map(|cell| round.world().centroid(cell)).collect();
    let pairs = (0..at.len()).flat_map(|a| (0..at.len()).map(move |b| [a, b])).filter(|[a, b]| a != b);
    let way = |[a, b]: &[usize; 2]| (at[*a] - middles[0]).length() + (at[*b] - middles[1]).length();
    let pair = pairs.min_by(|one, other| way(one).total_cmp(&way(other)))?;
    pair.iter().zip(middles).find(|(who, _)| **who == player).map(|(_, middle)| middle)
}

/// Where prey of a kind is that the player can take in now; where food is if there is none.
fn prey_of(view: View<'_>, player: OrganismView<'_>, kind: Kind) -> Vec<Vec2> {
    let is_ready =
        |prey: OrganismView<'_>| !prey_class::is_soft(prey) || readiness(player, prey) == Some(Readiness::Ready);
    let free = |is_wanted: &dyn Fn(OrganismView<'_>) -> bool| -> Vec<Vec2> {
        let wanted = view.organisms().filter(|prey| is_wanted(*prey) && prey.held_by().is_none());
        wanted.filter(|prey| is_ready(*prey)).map(|prey| prey.centroid()).collect()
    };
    let wanted = free(&|prey| prey.kind() == kind);
    if wanted.is_empty() { free(&prey_class::is_small) } else { wanted }
}
