//! What makes a scenario again: kept with checkpoints and replays, so that they stand alone.

use super::{Diagnostics, Scenario};
use serde::{Deserialize, Serialize};

/// Text, overrides and seed of a scenario.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// The text of its file.
    pub text: String,
    /// The overrides that it was read with.
    pub overrides: Vec<(String, String)>,
    /// Its seed.
    pub seed: u64,
}

impl Origin {
    /// Reads the scenario.
    ///
    /// # Errors
    /// As for [`Scenario::parse`].
    pub fn scenario(&self) -> Result<Scenario, Diagnostics> {
        let mut scenario = Scenario::parse(&self.text, &self.overrides)?;
        scenario.set_seed(self.seed);
        Ok(scenario)
    }
}
