//! The lunge: for half a second a cell crawls twice as fast. It costs cytoplasm, and then the cell has to recover. What it does to the
//! world it does between two steps, so a replay has it.

use crate::words::Key;
use microsim_core::{OrganismId, World};

/// How many times as fast it crawls: a power of two, so that its own speed comes back to the bit. The world's speed limit stays.
const FACTOR: f32 = 2.0;
/// From which factor on a cell that is faster after a step lunges: changes of the body make it less fast.
const LEAP: f32 = 1.5;
/// How long it takes, and until the next one can begin after it, s.
const TIME: f32 = 0.5;
const RECOVERY: f32 = 3.0;
/// One of so many particles of cytoplasm is used up.
const PRICE: u32 = 20;

/// How a player's cell stands with its lunges.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lunge {
    /// The cell that is faster now.
    cell: Option<OrganismId>,
    /// Time until it can begin again, s.
    left: f32,
}

impl Lunge {
    /// Begins one.
    ///
    /// # Errors
    /// When the cell still recovers, is too small or divides: what the player is told.
    pub fn begin(&mut self, world: &mut World, cell: OrganismId) -> Result<(), Key> {
        if self.left > 0.0 {
            return Err(Key::HudLungeEarly);
        }
        let view = world.view().organism(cell).ok_or(Key::HudLungeSmall)?;
        let (speed, price) = (view.speed(), super::food_chain::bites::cytoplasm(view) / PRICE);
        world.set_speed(cell, FACTOR * speed).map_err(|_| Key::HudLungeSmall)?;
        if world.shrink(cell, price.max(1)).is_err() {
            // It was its own a moment ago.
            let _ = world.set_speed(cell, speed);
            return Err(Key::HudLungeSmall);
        }
        *self = Self { cell: Some(cell), left: TIME + RECOVERY };
        Ok(())
    }

    /// Lets a step pass, before it.
    pub fn before_step(&mut self, world: &mut World) {
        self.left = (self.left - world.config().dt).max(0.0);
        if self.left < RECOVERY
            && let Some(cell) = self.cell.take()
            && let Some(speed) = world.view().organism(cell).map(|cell| cell.speed())
        {
            // The range of speeds has all that was there before.
            let _ = world.set_speed(cell, speed / FACTOR);
        }
    }

    /// Looks on after a step of a replay, which does what a lunge does by itself: the cell was this fast before.
    pub fn after_replayed_step(&mut self, world: &World, cell: OrganismId, before: f32) {
        let dt = world.config().dt;
        self.left = (self.left - dt).max(0.0);
        if self.left < RECOVERY {
            self.cell = None;
        }
        if world.view().organism(cell).is_some_and(|cell| cell.speed() > LEAP * before) {
            *self = Self { cell: Some(cell), left: TIME + RECOVERY - dt };
        }
    }

    /// Whether the cell is faster now.
    #[must_use]
    pub fn is_on(&self) -> bool {
        self.cell.is_some()
    }

    /// Whether it began with the last step, of this length, s.
    #[must_use]
    pub fn is_new(&self, dt: f32) -> bool {
        self.left + 1.5 * dt > TIME + RECOVERY
    }

    /// How far the cell has recovered, 0 to 1; `None` when it can lunge.
    #[must_use]
    pub fn recovered(&self) -> Option<f32> {
        (self.left > 0.0).then(|| (1.0 - self.left / RECOVERY).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::bot::{Bot, Policy};
    use crate::rules::food_chain::bites::cytoplasm;
    use crate::rules::food_chain::change::Change;
    use crate::rules::food_chain::{self, Deed};
    use crate::rules::round::Round;
    use crate::rules::two_players;
    use crate::sound::Cue;
    use microsim_core::glam::Vec2;
    use microsim_core::replay::Replay;
    use microsim_core::scenario::{Scenario, builtin};
    use microsim_core::{Intent, OrganismView};

    fn round(text: &str) -> Round {
        Round::new(&Scenario::parse(text, &[]).unwrap()).unwrap()
    }

    /// A room with nothing but the player's cell, of this radius.
    fn room(radius: f32) -> Round {
        round(&text_of(radius, 11.0))
    }

    fn text_of(radius: f32, speed: f32) -> String {
        format!(
            "schema = 1\nname = \"room\"\n[world]\nsize = [200.0, 60.0]\ndamping = 1.5\nmax_speed = 24.0\n\
             [amoeboid_cell.cell]\nradii = [{radius}, {radius}]\nspeed = {speed:?}\n\
             [[spawn]]\nof = \"cell\"\nplayer = true\nat = [30.0, 30.0]\n[game]\ntime = 60.0\n"
        )
    }

    fn cell(round: &Round) -> OrganismView<'_> {
        round.world().view().organism(round.player()).unwrap()
    }

    fn crawl(round: &mut Round, time: f32) -> f32 {
        let from = cell(round).centroid().x;
        (0..(60.0 * time) as u32).for_each(|_| round.step(Intent::toward(Vec2::new(190.0, 30.0)).unwrap()));
        cell(round).centroid().x - from
    }

    #[test]
    fn a_lunge_goes_far_within_the_speed_limit_and_costs_cytoplasm_and_then_all_is_as_before() {
        let [mut slow, mut fast] = [room(7.0), room(7.0)];
        [&mut slow, &mut fast].into_iter().for_each(|round| assert!(crawl(round, 1.0) > 0.0));
        let before = cytoplasm(cell(&fast));
        assert_eq!((fast.lunge(0), fast.lunge_of(0).is_on()), (Ok(()), true));
        let paid = before - cytoplasm(cell(&fast));
        assert!(paid == before / PRICE && paid > 1, "{paid} of {before}");
        let [usual, far] = [&mut slow, &mut fast].map(|round| crawl(round, TIME));
        assert!(far > 1.6 * usual && far < 24.0 * TIME, "{far} in place of {usual}");
        let [usual, after] = [&mut slow, &mut fast].map(|round| {
            crawl(round, 0.5);
            crawl(round, 1.0)
        });
        assert!(!fast.lunge_of(0).is_on() && (after - usual).abs() < 0.1 * usual, "{after} {usual}");
        assert_eq!(cell(&fast).speed().to_bits(), cell(&slow).speed().to_bits());
    }

    #[test]
    fn a_cell_has_to_recover_before_the_next_one() {
        let mut round = room(7.0);
        let mut lunges = Vec::new();
        let mut shares = vec![0.0];
        for step in 0..600 {
            if round.lunge(0).is_ok() {
                lunges.push(step);
            }
            round.step(Intent::REST);
            assert_eq!(round.heard().any(|cue| cue == Cue::Lunge), lunges.last() == Some(&step), "{step}");
            shares.extend(round.lunge_of(0).recovered().filter(|_| lunges.len() == 1));
        }
        assert_eq!(lunges[0], 0);
        assert!(lunges.windows(2).all(|pair| (210..=211).contains(&(pair[1] - pair[0]))), "{lunges:?}: every 3.5 s");
        assert!(shares.is_sorted() && shares.last().is_some_and(|share| *share > 0.98));
        round.lunge(0).unwrap_or_default();
        assert_eq!(round.lunge(0), Err(Key::HudLungeEarly));
    }

    #[test]
    fn a_cell_that_is_too_small_or_divides_is_refused_and_nothing_changes() {
        let mut divided = round(food_chain::TEXT);
        divided.divide(0);
        divided.step(Intent::REST);
        let fastest = round(&text_of(7.0, 600.0));
        for (mut round, what) in [(room(4.0), "small"), (divided, "divides"), (fastest, "as fast as cells can be")] {
            let before = round.world().digest();
            assert_eq!((round.lunge(0), round.world().digest()), (Err(Key::HudLungeSmall), before), "{what}");
        }
    }

    #[test]
    fn there_are_lunges_in_the_game_and_in_the_food_chain_but_not_on_slides_or_for_two_in_the_game() {
        let slide = crate::slides::find("first-steps").unwrap();
        let texts = [builtin("game").unwrap().text.to_owned(), food_chain::text(1), food_chain::text(4)];
        let without = [slide.text.to_owned(), two_players::TEXT.to_owned()];
        for (text, is_there) in texts.map(|text| (text, true)).into_iter().chain(without.map(|text| (text, false))) {
            let mut round = round(&text);
            assert_eq!((round.has_lunges(), round.lunge(0).is_ok()), (is_there, is_there));
            round.act(1, Deed::Lunge);
            assert_eq!(round.lunge_of(1).is_on(), is_there && round.players().count() > 1);
        }
    }

    #[test]
    fn a_change_of_speed_during_a_lunge_stays() {
        let mut round = round(food_chain::TEXT);
        let before = cell(&round).speed();
        round.lunge(0).unwrap();
        round.change(0, Change::Speed);
        crawl(&mut round, 1.0);
        assert_eq!(cell(&round).speed(), 1.12 * before);
    }

    #[test]
    fn a_bot_that_lunges_loses_nothing_through_membranes_and_plays_again_to_the_bit() {
        for text in [builtin("game").unwrap().text, food_chain::TEXT] {
            let mut round = round(text);
            let seen = |round: &Round| {
                let lunge = round.lunge_of(0);
                (lunge.is_on(), lunge.recovered(), round.heard().any(|cue| cue == Cue::Lunge))
            };
            let (mut bot, mut lunges, mut looks) = (Bot::new(Policy::Greedy, 1), 0, Vec::new());
            while round.world().time() < 25.0 && !round.is_over() {
                lunges += u32::from(round.lunge(0).is_ok());
                let intent = bot.intent(round.world(), round.player()).digesting(true);
                round.step(intent);
                looks.push(seen(&round));
                let census = round.world().census();
                assert_eq!(census.leaks + census.improper_absorptions + census.quarantined, 0, "{census:?}");
            }
            assert!(lunges > 4, "{lunges}");
            let mut again = Round::again(&Replay::read(&round.record().unwrap()).unwrap()).unwrap();
            assert!(!again.has_lunges());
            for (step, look) in looks.into_iter().enumerate() {
                again.step(Intent::REST);
                assert_eq!(seen(&again), look, "rings and streaks of step {step}");
            }
            again.step(Intent::REST);
            assert!(again.is_over());
            assert_eq!((again.mismatch(), again.world().digest()), (None, round.world().digest()));
        }
    }
}
