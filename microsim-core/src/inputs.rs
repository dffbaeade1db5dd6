//! Inputs: commands to organisms for one step, the same for mouse, bot and replay.

use crate::error::{Error, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use glam::Vec2;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// The command to one organism for one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Intent {
    #[serde(deserialize_with = "read_goal")]
    goal: Option<Vec2>,
    digests: bool,
}

impl Intent {
    /// To stay where it is.
    pub const REST: Self = Self { goal: None, digests: false };

    /// To move towards a point. The speed does not depend on how far away it is.
    ///
    /// # Errors
    /// When a coordinate is not finite or beyond ±1 000 000.
    pub fn toward(goal: Vec2) -> Result<Self, Error> {
        in_range("goal.x", goal.x, -1e6, 1e6)?;
        in_range("goal.y", goal.y, -1e6, 1e6)?;
        // Turns -0 into +0: equal intents have equal bits.
        let goal = with_default_float_environment(|| goal + Vec2::ZERO);
        Ok(Self { goal: Some(goal), digests: false })
    }

    /// The same, and to digest what is inside (or not to).
    #[must_use]
    pub fn digesting(mut self, digests: bool) -> Self {
        self.digests = digests;
        self
    }

    /// Whether to digest what is inside.
    #[must_use]
    pub fn digests(&self) -> bool {
        self.digests
    }

    /// Where to move, if anywhere.
    #[must_use]
    pub fn goal(&self) -> Option<Vec2> {
        self.goal
    }
}

/// A goal that [`Intent::toward`] accepts.
fn read_goal<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec2>, D::Error> {
    let goal = Option::<Vec2>::deserialize(from)?;
    let intent = goal.map_or(Ok(Intent::REST), Intent::toward).map_err(D::Error::custom)?;
    Ok(intent.goal)
}

/// The intents of one step. An organism that is not named here follows its own controller.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Vec<(OrganismId, Intent)>", into = "Vec<(OrganismId, Intent)>")]
pub struct Inputs {
    intents: Vec<(OrganismId, Intent)>,
}

impl Inputs {
    /// No commands.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Commands `organism`, in place of what it was commanded before. A handle that is stale by the time of the step has
    /// no effect.
    pub fn set(&mut self, organism: OrganismId, intent: Intent) {
        match self.intents.binary_search_by_key(&organism, |&(id, _)| id) {
            Ok(at) => self.intents[at].1 = intent,
            Err(at) => self.intents.insert(at, (organism, intent)),
        }
    }

    /// The command given to `organism`, if any.
    #[must_use]
    pub fn get(&self, organism: OrganismId) -> Option<Intent> {
        let at = self.intents.binary_search_by_key(&organism, |&(id, _)| id).ok()?;
        Some(self.intents[at].1)
    }

    /// All commands, by organism.
    pub fn iter(&self) -> impl Iterator<Item = (OrganismId, Intent)> + '_ {
        self.intents.iter().copied()
    }

    /// Removes the command given to `organism`, if there is one.
    pub fn remove(&mut self, organism: OrganismId) {
        self.intents.retain(|&(id, _)| id != organism);
    }

    /// Removes all commands.
    pub fn clear(&mut self) {
        self.intents.clear();
    }
}

impl From<Vec<(OrganismId, Intent)>> for Inputs {
    fn from(intents: Vec<(OrganismId, Intent)>) -> Self {
        let mut inputs = Self::new();
        for (organism, intent) in intents {
            inputs.set(organism, intent);
        }
        inputs
    }
}

impl From<Inputs> for Vec<(OrganismId, Intent)> {
    fn from(inputs: Inputs) -> Self {
        inputs.intents
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_commands_replace_earlier_ones() {
        let id = |index| OrganismId { index, generation: 0 };
        let mut inputs = Inputs::new();
        inputs.set(id(4), Intent::REST);
        inputs.set(id(1), Intent::toward(Vec2::ONE).unwrap());
        inputs.set(id(4), Intent::toward(Vec2::X).unwrap());
        assert_eq!(inputs.get(id(4)).unwrap().goal(), Some(Vec2::X));
        assert_eq!(inputs.get(id(2)), None);
        inputs.clear();
        assert_eq!(inputs.get(id(4)), None);
    }

    #[test]
    fn goals_must_be_finite() {
        assert_eq!(Intent::toward(Vec2::new(0.0, f32::NAN)).unwrap_err().field(), "goal.y");
        assert_eq!(Intent::toward(Vec2::new(1e9, 0.0)).unwrap_err().field(), "goal.x");
        assert_eq!(Intent::toward(-Vec2::ZERO).unwrap().goal().unwrap().x.to_bits(), 0);
    }
}
