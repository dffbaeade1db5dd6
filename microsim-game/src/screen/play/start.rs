//! How rounds begin.

use super::super::chain_scene;
use super::super::context::AppContext;
use super::super::done::DoneNote;
use super::super::follow::Follow;
use super::super::steer::Hands;
use super::super::{Paused, new_seed};
use super::Play;
use crate::clock::Tempo;
use crate::game_choice::GameChoice;
use crate::hud::marks;
use crate::hud::pulse::Pulses;
use crate::input::Action;
use crate::rules::food_chain::NAME;
use crate::rules::ghost::Ghost;
use crate::rules::round::Round;
use crate::rules::threat::Alarm;
use crate::rules::two_players::{self, TwoPlayers};
use crate::slides;
use crate::viewer::{Viewer, first_view};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;
use microsim_core::replay::Replay;

impl Play {
    /// A new round of the game, or of the one beside it.
    ///
    /// # Errors
    /// Says what is wrong with the scenario, for the player to read.
    pub(in super::super) fn start(played: Paused, context: &AppContext) -> Result<Self, String> {
        Ok(Self::new(context.game_of(played).round(new_seed(context))?, played, context))
    }

    /// A slide.
    ///
    /// # Errors
    /// As for [`Play::start`].
    pub(in super::super) fn slide(index: usize, context: &AppContext) -> Result<Self, String> {
        let name = slides::all().nth(index).map_or("", |slide| slide.name);
        let game = GameChoice { source: name.into(), overrides: Vec::new(), seed: None };
        Ok(Self::new(game.round(new_seed(context))?, Paused::Slide(index), context))
    }

    /// The food chain.
    ///
    /// # Errors
    /// As for [`Play::start`].
    pub(in super::super) fn food_chain(seed: u64, context: &AppContext) -> Result<Self, String> {
        let game = GameChoice { source: NAME.into(), overrides: Vec::new(), seed: Some(seed) };
        Ok(Self::new(game.round(seed)?, Paused::FoodChain(seed), context))
    }

    /// Two cells on one slide.
    ///
    /// # Errors
    /// As for [`Play::start`].
    pub(in super::super) fn two_players(way: TwoPlayers, context: &AppContext) -> Result<Self, String> {
        let game = GameChoice { source: two_players::NAME.into(), overrides: Vec::new(), seed: None };
        Ok(Self::new(game.round(new_seed(context))?, Paused::TwoPlayers(way), context))
    }

    /// The last round again.
    ///
    /// # Errors
    /// When there is none, or it cannot be read.
    pub(in super::super) fn replay(context: &AppContext) -> Result<Self, String> {
        let record = context.last_game.as_ref().ok_or_else(|| words::text(Key::LastGameNone))?;
        let replay = Replay::read(record).ok().and_then(|replay| Round::again(&replay).ok());
        let round = replay.ok_or_else(|| words::text(Key::LastGameBroken))?;
        Ok(Self::new(round, Paused::Replay, context))
    }

    fn new(round: Round, played: Paused, context: &AppContext) -> Self {
        let world = round.world();
        // Of a match in the food chain one line is followed.
        let is_of_lines = played == Paused::Replay && round.chain().is_some();
        let two = (round.players().count() > 1 && !is_of_lines).then_some(match played {
            Paused::TwoPlayers(way) => way,
            _ => TwoPlayers::Versus,
        });
        let has_ghost = round.chain().is_some() && !round.is_replay();
        let best_life = if has_ghost { context.best_life.record() } else { None };
        let ghost = best_life.and_then(|record| Ghost::of(record, world));
        let own = if is_of_lines { context.last_seat } else { 0 };
        let screen = context.pen.screen();
        let seen = chain_scene::seen(&round, Some(own)).unwrap_or(round.player());
        let (follow, around) = Follow::new(&round, seen, screen);
        let camera = if two.is_some() { first_view(world, None, 1.0, screen) } else { around };
        let viewer = Viewer::new(world, camera);
        Self {
            // Pictures that are made frame by frame do not wait.
            has_begun: round.is_replay() || context.pace.is_exact,
            bot: two.and_then(|way| way.bot(world.config().seed)),
            task: round.attempt().map(|attempt| slides::told(attempt.slide()).task),
            round,
            played,
            viewer,
            gains: marks::Gains::default(),
            pulses: Pulses::default(),
            done: DoneNote::default(),
            fullest: Vec::new(),
            heard: Vec::new(),
            alarm: Alarm::default(),
            follow,
            own,
            hands: Hands::default(),
            two,
            tempo: Tempo::default(),
            last_place: Vec2::ZERO,
            last_life: None,
            over_for: 0.0,
            ghost,
            lunge_key: context.settings.keys.label(Action::Lunge),
            divide_key: context.settings.keys.label(Action::Divide),
            optics_key: context.settings.keys.label(Action::Optics),
            tempo_keys: [Action::Slower, Action::Faster, Action::Pause]
                .map(|action| context.settings.keys.label(action)),
        }
    }
}
