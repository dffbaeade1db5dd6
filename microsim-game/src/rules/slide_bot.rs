//! A bot that plays slides: it does one goal after another, and sees obstacles.

use super::attempt::wanted;
use super::hint::{Readiness, readiness};
use super::path::PathMap;
use super::prey;
use super::round::Round;
use microsim_core::glam::Vec2;
use microsim_core::scenario::Goal;
use microsim_core::{Intent, Kind, OrganismView, View, World};

/// Steps between two decisions.
const INTERVAL: u64 = 10;

/// The bot.
#[derive(Clone, Debug)]
pub struct SlideBot {
    map: PathMap,
    intent: Intent,
}

impl SlideBot {
    /// A bot for a round of a slide.
    #[must_use]
    pub fn new(world: &World) -> Self {
        Self { map: PathMap::new(world), intent: Intent::REST }
    }

    /// What it does in the next step.
    pub fn intent(&mut self, round: &Round) -> Intent {
        if round.world().step_index().is_multiple_of(INTERVAL) {
            let heading = round.world().centroid(round.player()).zip(target(round));
            let next = heading.and_then(|(at, to)| Intent::toward(self.map.next(at, to)).ok());
            self.intent = next.unwrap_or(Intent::REST).digesting(true);
        }
        self.intent
    }
}

/// The nearest place or prey that a goal asks for, or food to grow on.
fn target(round: &Round) -> Option<Vec2> {
    let view = round.world().view();
    let player = view.organism(round.player())?;
    let at = player.centroid();
    let open = round.attempt()?.goals().filter(|&(goal, done)| done < wanted(goal));
    let places = open.flat_map(|(goal, _)| match *goal {
        Goal::Reach { low, high } => vec![0.5 * (low + high)],
        Goal::Digest { kind, .. } => prey_of(view, player, kind),
    });
    places.min_by(|a, b| (*a - at).length().total_cmp(&(*b - at).length()))
}

/// Where prey of a kind is that the player can take in now; where food is if there is none.
fn prey_of(view: View<'_>, player: OrganismView<'_>, kind: Kind) -> Vec<Vec2> {
    let is_ready = |prey: OrganismView<'_>| !prey::is_soft(prey) || readiness(player, prey) == Some(Readiness::Ready);
    let free = |is_wanted: &dyn Fn(OrganismView<'_>) -> bool| -> Vec<Vec2> {
        let wanted = view.organisms().filter(|prey| is_wanted(*prey) && prey.held_by().is_none());
        wanted.filter(|prey| is_ready(*prey)).map(|prey| prey.centroid()).collect()
    };
    let wanted = free(&|prey| prey.kind() == kind);
    if wanted.is_empty() { free(&prey::is_small) } else { wanted }
}
