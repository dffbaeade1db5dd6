//! Steps a world from one picture to the next: by its scenario's script, or as a replay recorded it.

use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::prepared::{Prepared, prepare};
use crate::scenario_args::{Changes, ScenarioArgs};
use crate::world_file::{play, read_replay};
use microsim_core::World;
use microsim_core::replay::{Player, Replay};
use microsim_core::scenario::Script;
use std::path::Path;

/// Whether an argument names a replay rather than a scenario.
fn is_replay(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("replay"))
}

/// The scenario, and the record if a replay is named.
pub(super) fn open(args: &ScenarioArgs) -> Result<(Prepared, Option<Replay>), Failure> {
    if !is_replay(&args.scenario) {
        return Ok((prepare(args)?, None));
    }
    if args.changes.seed.is_some() || !args.changes.set.is_empty() {
        let text = format!("{}: --seed and --set cannot change a replay, accepted: a scenario", args.scenario);
        return Err(Failure::Message(text));
    }
    let replay = read_replay(Path::new(&args.scenario))?;
    let origin = replay.origin();
    let source = ScenarioText::new(format!("<scenario in {}>", args.scenario), origin.text.clone());
    let changes = Changes { seed: Some(origin.seed), set: origin.overrides.clone() };
    Ok((Prepared::new(source, &changes)?, Some(replay)))
}

/// A world that is stepped.
pub(super) enum Projector {
    /// By its scenario's script.
    Script(Box<World>, Box<Script>),
    /// As it was recorded.
    Replay(Box<Player>),
}

impl Projector {
    pub(super) fn new(prepared: &Prepared, replay: Option<&Replay>, path: &Path) -> Result<Self, Failure> {
        Ok(match replay {
            Some(replay) => Self::Replay(Box::new(play(replay, path)?)),
            None => Self::Script(Box::new(prepared.built.world.clone()), Box::new(prepared.built.script.clone())),
        })
    }

    pub(super) fn world(&self) -> &World {
        match self {
            Self::Script(world, _) => world,
            Self::Replay(player) => player.world(),
        }
    }

    /// One step.
    pub(super) fn step(&mut self) -> Result<(), Failure> {
        match self {
            Self::Script(world, script) => {
                let inputs = script.before_step(world);
                world.step(inputs);
                Ok(())
            }
            Self::Replay(player) => match player.next() {
                Some(Ok(())) => Ok(()),
                Some(Err(mismatch)) => Err(Failure::Broken(vec![mismatch.to_string()])),
                None => {
                    let end = player.world().time();
                    Err(Failure::Message(format!("the record ends at {end:.2} s, accepted: times up to that")))
                }
            },
        }
    }
}
