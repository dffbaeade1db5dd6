//! The ghost: the best life in the same water, lived again beside the one that is played.

use super::round::Round;
use microsim_core::replay::Replay;
use microsim_core::{Intent, Moment, OrganismView, World};

/// A life of the food chain that is played again, step by step with another one.
#[derive(Debug)]
pub struct Ghost {
    round: Round,
    /// Before the last step.
    before: Moment,
}

impl Ghost {
    /// That of a record, if it begins with this world: in the same water, by the same version.
    #[must_use]
    pub fn of(record: &[u8], first: &World) -> Option<Self> {
        let round = Round::again(&Replay::read(record).ok()?).ok()?;
        let is_of_here = round.chain().is_some() && round.world().digest() == first.digest();
        is_of_here.then(|| Self { before: first.moment(), round })
    }

    /// One step.
    pub fn step(&mut self) {
        self.before = self.round.world().moment();
        self.round.step(Intent::REST);
    }

    /// Its cell, at a share of the way from the last step but one to the last; `None` when it is gone, or does not live as it did.
    #[must_use]
    pub fn cell(&self, alpha: f32) -> Option<OrganismView<'_>> {
        let is_true = self.round.mismatch().is_none() && !self.round.is_over();
        let view = is_true.then(|| self.round.world().view_since(&self.before, alpha))?;
        view.organism(self.round.player())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::food_chain::TEXT;
    use microsim_core::glam::Vec2;
    use microsim_core::scenario::Scenario;

    fn round(seed: u64) -> Round {
        let mut scenario = Scenario::parse(TEXT, &[]).unwrap();
        scenario.set_seed(seed);
        Round::new(&scenario).unwrap()
    }

    #[test]
    fn a_life_is_lived_again_step_by_step_beside_another_and_ends_where_it_ended() {
        let mut best = round(3);
        let intent = Intent::toward(best.world().centroid(best.player()).unwrap() + Vec2::new(9.0, 4.0)).unwrap();
        let mut places = Vec::new();
        for _ in 0..90 {
            best.step(intent);
            places.push(best.world().centroid(best.player()).unwrap());
        }
        let record = best.record().unwrap();
        let mut other = round(3);
        let mut ghost = Ghost::of(&record, other.world()).unwrap();
        for place in &places {
            other.step(Intent::REST);
            ghost.step();
            assert_eq!(ghost.cell(1.0).unwrap().centroid(), *place);
        }
        ghost.step();
        assert!(ghost.cell(1.0).is_none(), "it is over");
        let mut ghost = Ghost::of(&record, round(3).world()).unwrap();
        places.iter().for_each(|_| ghost.step());
        let between = ghost.cell(0.5).unwrap().centroid();
        assert!(between.distance(0.5 * (places[88] + places[89])) < 1e-3 && between != places[89]);
        assert_ne!(other.world().centroid(other.player()), Some(places[89]));
        assert!(Ghost::of(&record, round(4).world()).is_none(), "another water");
        assert!(Ghost::of(&record, other.world()).is_none(), "not the beginning");
        assert!(Ghost::of(b"nonsense", round(3).world()).is_none());
    }
}
