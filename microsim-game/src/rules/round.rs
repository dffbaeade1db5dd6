//! One round: a world, its player and the referee. Mouse, bots and replays play it in the same way, by intents.

use super::referee::Referee;
use microsim_core::scenario::{Scenario, Script};
use microsim_core::{Intent, OrganismId, World};

/// A round that is being played.
#[derive(Clone, Debug)]
pub struct Round {
    world: World,
    script: Script,
    player: OrganismId,
    referee: Referee,
}

impl Round {
    /// Sets up a round.
    ///
    /// # Errors
    /// Says what is wrong with the scenario, or that it is no game.
    pub fn new(scenario: &Scenario) -> Result<Self, String> {
        let built = scenario.build().map_err(|diagnostics| diagnostics.to_string())?;
        let (Some(game), Some(player)) = (built.game, built.player) else {
            return Err(format!("`{}` is no game: it has no table [game]", scenario.name()));
        };
        let referee = Referee::new(game, player, &built.world);
        Ok(Self { world: built.world, script: built.script, player, referee })
    }

    /// One step. Nothing happens any more when time is up.
    pub fn step(&mut self, intent: Intent) {
        if self.referee.is_over() {
            return;
        }
        let mut inputs = self.script.before_step(&mut self.world).clone();
        inputs.set(self.player, intent);
        self.world.step(&inputs);
        self.referee.after_step(&self.world);
    }

    /// Its world.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The cell that is played.
    #[must_use]
    pub fn player(&self) -> OrganismId {
        self.player
    }

    /// Score and time.
    #[must_use]
    pub fn referee(&self) -> &Referee {
        &self.referee
    }
}
