//! Which game is played: a scenario with changed values, and the seed of its rounds.

use crate::rules::round::Round;
use crate::scene_source::SceneSource;
use microsim_core::scenario::Scenario;

/// The game that is played.
#[derive(Clone, Debug, PartialEq)]
pub struct GameChoice {
    /// Its scenario.
    pub source: SceneSource,
    /// Values of the scenario that were changed on the command line.
    pub overrides: Vec<(String, String)>,
    /// Seed of every round; `None` for a new seed in each round.
    pub seed: Option<u64>,
}

impl GameChoice {
    /// A new round. `seed` counts unless the game has a seed of its own.
    ///
    /// # Errors
    /// Says what is wrong with the scenario, for the player to read.
    pub fn round(&self, seed: u64) -> Result<Round, String> {
        Round::new(&self.scenario(seed)?)
    }

    fn scenario(&self, seed: u64) -> Result<Scenario, String> {
        let text = self.source.text()?;
        let mut scenario = Scenario::parse(&text, &self.overrides).map_err(|diagnostics| diagnostics.to_string())?;
        scenario.set_seed(self.seed.unwrap_or(seed));
        Ok(scenario)
    }

    /// Whether it is a game or a slide, and not a simulation to look at.
    #[must_use]
    pub fn is_game(&self) -> bool {
        self.scenario(1).is_ok_and(|scenario| scenario.game().is_some() || scenario.slide().is_some())
    }

    /// Key of its high scores: the scenario and what was changed of it.
    #[must_use]
    pub fn label(&self) -> String {
        let seed = self.seed.map(|seed| ("seed".to_owned(), seed.to_string()));
        let changes = self.overrides.iter().chain(&seed).map(|(key, value)| format!(", {key} = {value}"));
        let source = match &self.source {
            SceneSource::File(path) => path.canonicalize().unwrap_or_else(|_| path.clone()).display().to_string(),
            builtin => builtin.to_string(),
        };
        source + &changes.collect::<String>()
    }

    /// Whether it is one of the program, with no value changed.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.overrides.is_empty() && !matches!(self.source, SceneSource::File(_))
    }

    /// Time of a round, s; `None` if the scenario is no game.
    #[must_use]
    pub fn time(&self) -> Option<f32> {
        Some(self.scenario(1).ok()?.game()?.time)
    }
}
