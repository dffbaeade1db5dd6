//! Checkpoints: a run of a scenario as bytes, with its world, script and checks.

use super::envelope::Format;
use super::{SnapshotError, decode, encode, invalid};
use crate::id::OrganismId;
use crate::scenario::spawner::SpawnerState;
use crate::scenario::{Built, Checks, Origin, Script};
use crate::world::World;

/// Changes with every change of a type that is part of a run, but not with one of a world.
pub(super) const RUN: Format = Format { magic: *b"MSIMRUN\0", version: 7 };

/// Content of a checkpoint; the world is a snapshot.
pub(super) type Content =
    (Origin, Option<OrganismId>, Vec<(String, OrganismId)>, Script, Vec<SpawnerState>, Checks, Vec<u8>);

/// A run of a scenario that can be resumed with the same results as without the interruption.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// What the scenario was read from.
    pub origin: Origin,
    /// The run.
    pub run: Built,
}

impl Checkpoint {
    /// The run as bytes.
    ///
    /// # Errors
    /// As for [`World::to_snapshot`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, SnapshotError> {
        let Built { world, player, named, script, checks, .. } = &self.run;
        let spawners: Vec<_> = script.spawner_states().collect();
        Ok(RUN.seal(&encode(&(&self.origin, player, named, script, spawners, checks, world.to_snapshot()?))?))
    }

    /// The run that was written.
    ///
    /// # Errors
    /// As for [`World::from_snapshot`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let (origin, player, named, script, spawners, checks, world): Content = decode(RUN.open(bytes)?)?;
        let world = World::from_snapshot(&world)?;
        let built = origin.scenario().and_then(|scenario| scenario.build());
        let Built { script: file, chemicals, game, slide, .. } =
            built.map_err(|problems| invalid(problems.to_string()))?;
        let script = script.with_spawner_states(file, spawners);
        let script = script.ok_or_else(|| invalid("the scenario has other organisms to come".to_owned()))?;
        Ok(Self { origin, run: Built { world, player, named, script, checks, chemicals, game, slide } })
    }

    /// The first difference of two runs other than in their worlds: `player`, `names` of organisms, `script` (with its supplies
    /// of organisms) or `checks`. The sources of the scenarios are not compared.
    #[must_use]
    pub fn difference_beside_worlds(&self, other: &Self) -> Option<&'static str> {
        let parts = |Built { player, named, script, checks, .. }: &Built| {
            let spawners: Vec<_> = script.spawner_states().collect();
            [
                ("player", encode(player)),
                ("names", encode(named)),
                ("script", encode(&(script, spawners))),
                ("checks", encode(checks)),
            ]
        };
        let mut pairs = parts(&self.run).into_iter().zip(parts(&other.run));
        pairs.find(|(one, other)| one != other).map(|((name, _), _)| name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Scenario, builtin};

    #[test]
    fn a_run_comes_back_and_what_differs_beside_the_worlds_is_named() {
        let scenario = Scenario::parse(builtin("empty").unwrap().text, &[]).unwrap();
        let run = || Checkpoint { origin: scenario.origin(), run: scenario.build().unwrap() };
        let (one, mut other) = (run(), run());
        let back = Checkpoint::from_bytes(&one.to_bytes().unwrap()).unwrap();
        assert_eq!([&back, &other].map(|other| one.difference_beside_worlds(other)), [None, None]);
        let nobody = OrganismId { index: 0, generation: 0 };
        other.run.named.push(("nobody".to_owned(), nobody));
        assert_eq!(one.difference_beside_worlds(&other), Some("names"));
        other.run.player = Some(nobody);
        assert_eq!(one.difference_beside_worlds(&other), Some("player"));
    }
}
