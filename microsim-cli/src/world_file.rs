//! Files that hold worlds: snapshots, checkpoints and replays.

use crate::checkpoint;
use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::output::CHECKPOINT;
use crate::read;
use microsim_core::World;
use microsim_core::replay::{Ending, Mismatch, Player, Replay, ReplayError};
use microsim_core::snapshot::{Checkpoint, SnapshotError};
use std::path::Path;

/// The content of a file.
#[derive(Debug)]
pub(crate) enum WorldFile {
    World(Box<World>),
    Run(Box<Checkpoint>),
    Replay(Replay),
}

impl WorldFile {
    /// Reads a file of any of these kinds.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let bytes = bytes_of(path)?;
        let refuse = |error: &dyn std::error::Error| refused(path, error);
        match (World::from_snapshot(&bytes), Checkpoint::from_bytes(&bytes), Replay::read(&bytes)) {
            (Ok(world), ..) => Ok(Self::World(Box::new(world))),
            (_, Ok(run), _) => Ok(Self::Run(Box::new(run))),
            (.., Ok(replay)) => Ok(Self::Replay(replay)),
            (Err(SnapshotError::Foreign), Err(SnapshotError::Foreign), Err(ReplayError::Foreign)) => {
                let accepted = "a snapshot, a checkpoint or a replay";
                Err(Failure::Message(format!("{}: not a file of microsim, accepted: {accepted}", path.display())))
            }
            (Err(SnapshotError::Foreign), Err(SnapshotError::Foreign), Err(error)) => Err(refuse(&error)),
            (Err(SnapshotError::Foreign), Err(error), _) | (Err(error), ..) => Err(refuse(&error)),
        }
    }

    /// The step of its world; a replay has many.
    pub(crate) fn step(&self) -> Option<u64> {
        match self {
            Self::World(world) => Some(world.step_index()),
            Self::Run(checkpoint) => Some(checkpoint.run.world.step_index()),
            Self::Replay(_) => None,
        }
    }

    /// Its world, of a replay after `step` steps or at its end, and where the replay differed from its record until then.
    pub(crate) fn world_at(self, step: u64, path: &Path) -> Result<(World, Option<String>), Failure> {
        match self {
            Self::World(world) => Ok((*world, None)),
            Self::Run(checkpoint) => Ok((checkpoint.run.world, None)),
            Self::Replay(replay) => {
                let mut playing = Playback::start(&replay, path)?;
                while playing.world().step_index() < step && playing.step() {}
                Ok((playing.world().clone(), playing.mismatch()))
            }
        }
    }
}

/// A replay that is played to its end, even if it differs from its record.
#[derive(Debug)]
pub(crate) struct Playback<'a> {
    player: Player,
    replay: &'a Replay,
    path: &'a Path,
    first: Option<Mismatch>,
}

impl<'a> Playback<'a> {
    pub(crate) fn start(replay: &'a Replay, path: &'a Path) -> Result<Self, Failure> {
        Ok(Self { player: play(replay, path)?, replay, path, first: None })
    }

    pub(crate) fn world(&self) -> &World {
        self.player.world()
    }

    /// Takes a step; `false` at the end.
    pub(crate) fn step(&mut self) -> bool {
        let played = self.player.next();
        self.first = self.first.or(played.and_then(Result::err));
        played.is_some()
    }

    /// Where it first differed from its record.
    pub(crate) fn mismatch(&self) -> Option<String> {
        self.first.map(|mismatch| in_words(&mismatch, self.replay, self.path))
    }
}

/// What a damaged or cut-off replay has lost.
pub(crate) fn lost(replay: &Replay, path: &Path) -> Option<String> {
    let path = path.display();
    match replay.ending() {
        Ending::Complete => None,
        Ending::Unrecordable => Some(format!("{path}: ends before a change that cannot be recorded")),
        Ending::CutOff => Some(format!("{path}: cut off, played to its last whole record")),
        Ending::Damaged { at } => Some(format!("{path}: damaged at byte {at}, played to the last whole record")),
    }
}

/// Where a replay first differs from its record.
pub(crate) fn in_words(mismatch: &Mismatch, replay: &Replay, path: &Path) -> String {
    let (recorder, own) = (replay.made_by(), env!("CARGO_PKG_VERSION"));
    let version = if recorder == own { String::new() } else { format!(" by version {recorder}; this is {own}") };
    format!("{}: {mismatch}{version}", path.display())
}

pub(crate) fn read_replay(path: &Path) -> Result<Replay, Failure> {
    let bytes = bytes_of(path)?;
    Replay::read(&bytes).map_err(|error| refused(path, &error))
}

fn refused(path: &Path, error: &dyn std::error::Error) -> Failure {
    Failure::Message(format!("{}: {error}; write it again", path.display()))
}

/// A player at the start of a replay.
pub(crate) fn play(replay: &Replay, path: &Path) -> Result<Player, Failure> {
    Player::new(replay).map_err(|problems| {
        let origin = format!("<scenario in {}>", path.display());
        Failure::Scenario(ScenarioText::new(origin, replay.origin().text.clone()), problems)
    })
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    let path = if path.is_dir() { path.join(CHECKPOINT) } else { path.to_owned() };
    let bytes = read::whole(&path).map_err(|error| Failure::file("read", &path, &error))?;
    Ok(checkpoint::run_of(&bytes).map(<[u8]>::to_vec).unwrap_or(bytes))
}
