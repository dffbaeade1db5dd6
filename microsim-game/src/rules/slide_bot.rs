//! A bot that plays slides: it does one goal after another, and sees obstacles.

use super::path::PathMap;
use super::round::Round;
use super::slide::wanted;
use microsim_core::glam::Vec2;
use microsim_core::scenario::Goal;
use microsim_core::{Intent, World};

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

/// The nearest place or prey that a goal asks for.
fn target(round: &Round) -> Option<Vec2> {
    let (world, player) = (round.world(), round.player());
    let at = world.centroid(player)?;
    let open = round.attempt()?.goals().filter(|&(goal, done)| done < wanted(goal));
    let places = open.flat_map(|(goal, _)| match *goal {
        Goal::Reach { low, high } => vec![0.5 * (low + high)],
        Goal::Digest { kind, .. } => {
            let view = world.view();
            let free = view.organisms().filter(|prey| prey.kind() == kind && prey.held_by().is_none());
            free.map(|prey| prey.centroid()).collect()
        }
    });
    places.min_by(|a, b| (*a - at).length().total_cmp(&(*b - at).length()))
}
