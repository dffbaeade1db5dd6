//! Recordings: what a player did, step by step. With the scenario it is the whole round again, bit by bit.

use microsim_core::Intent;
use microsim_core::scenario::Scenario;

/// A round as it was played.
#[derive(Clone, Debug)]
pub struct Recording {
    scenario: Scenario,
    /// Intents, each with the number of steps for which it did not change.
    intents: Vec<(Intent, u32)>,
}

impl Recording {
    /// Nothing yet of a round of this scenario.
    #[must_use]
    pub fn new(scenario: Scenario) -> Self {
        Self { scenario, intents: Vec::new() }
    }

    /// What was played.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// Adds the intent of the next step.
    pub fn push(&mut self, intent: Intent) {
        match self.intents.last_mut() {
            Some((last, count)) if *last == intent => *count += 1,
            _ => self.intents.push((intent, 1)),
        }
    }

    /// The intents of all steps, in order.
    pub fn intents(&self) -> impl Iterator<Item = Intent> {
        self.intents.iter().flat_map(|&(intent, count)| (0..count).map(move |_| intent))
    }

    /// The intent of a step; rest when the recording is over.
    #[must_use]
    pub fn intent(&self, step: u64) -> Intent {
        let mut end = 0;
        let at = self.intents.iter().find(|(_, count)| {
            end += u64::from(*count);
            step < end
        });
        at.map_or(Intent::REST, |(intent, _)| *intent)
    }
}
