//! What happens in the steps between two pictures, for those who look and listen.

use super::hint::taken_in;
use super::referee::Gain;
use super::round::Round;
use crate::sound::Cue;
use microsim_core::glam::Vec2;
use microsim_core::{Intent, OrganismId};

/// What has happened since the last picture.
#[derive(Debug, Default)]
pub struct News {
    /// [`Round::heard`].
    pub heard: Vec<Cue>,
    /// [`Round::gains`].
    pub gains: Vec<Gain>,
    /// Place and half extent of what was taken in.
    pub meals: Vec<(Vec2, f32)>,
    /// [`Round::is_division_refused`].
    pub is_division_refused: bool,
}

impl News {
    /// One step of a round, and what happens in it. Once the round is over, its last step is no news.
    pub fn step(&mut self, round: &mut Round, intents: &[Intent]) {
        if round.is_over() {
            return;
        }
        round.step_all(intents);
        self.heard.extend(round.heard());
        self.gains.extend(round.gains());
        let cells: Vec<OrganismId> = round.players().collect();
        self.meals.extend(taken_in(round.world(), &cells));
        self.is_division_refused |= round.is_division_refused();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::slide_bot::SlideBot;
    use crate::slides;
    use microsim_core::scenario::Scenario;

    #[test]
    fn what_ended_a_round_is_told_once() {
        let slide = slides::all().find(|slide| slide.name == "first-meal").unwrap();
        let mut round = Round::new(&Scenario::parse(slide.text, &[]).unwrap()).unwrap();
        let (mut bots, mut news) = (SlideBot::all(&round), News::default());
        let mut step = |round: &mut Round| {
            let intents: Vec<Intent> = bots.iter_mut().map(|bot| bot.intent(round)).collect();
            news.step(round, &intents);
        };
        while !round.is_over() {
            step(&mut round);
        }
        (0..90).for_each(|_| step(&mut round));
        assert_eq!(news.gains.len(), 6, "one for each piece of agar");
        assert!(news.meals.len() >= 6);
        assert_eq!(news.heard.iter().filter(|cue| **cue == Cue::End).count(), 1);
    }
}
