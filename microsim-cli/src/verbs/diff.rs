//! `diff`: the first step and the first field in which two worlds differ.

use crate::console::{Console, print};
use crate::failure::Failure;
use crate::world_file::{Playback, WorldFile, lost};
use microsim_core::World;
use microsim_core::replay::Ending;
use microsim_core::snapshot::Checkpoint;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Two replays are played side by side up to the first step after which their worlds differ; a replay and a snapshot or\n\
checkpoint are compared at the step of the latter. Of two checkpoints the player, names, script and checks are compared\n\
too, but not the texts of their scenarios. The exit code is 0 if nothing differs and 1 if something does, or if a replay\n\
is not the run that was recorded: its first digest that differs is named on stderr. It is 2 for a damaged replay in which\n\
nothing differs up to the damage."
)]
pub(crate) struct DiffArgs {
    /// A snapshot, a checkpoint or a replay
    #[arg(value_name = "A")]
    pub one: PathBuf,
    /// The one to compare it with
    #[arg(value_name = "B")]
    pub other: PathBuf,
}

/// The result of a comparison.
#[derive(Debug)]
struct Comparison {
    difference: Option<String>,
    /// What was compared.
    compared: &'static str,
    /// Where replays differ from their records.
    mismatches: Vec<String>,
}

/// Compares two files and says where they differ.
pub(crate) fn diff(args: &DiffArgs, console: &Console) -> Result<(), Failure> {
    let (one, other) = (WorldFile::read(&args.one)?, WorldFile::read(&args.other)?);
    let mut damage = Vec::new();
    for (saved, path) in [(&one, &args.one), (&other, &args.other)] {
        let WorldFile::Replay(replay) = saved else { continue };
        match lost(replay, path) {
            Some(text) if matches!(replay.ending(), Ending::Damaged { .. }) => damage.push(text),
            Some(text) => console.note(&text),
            None => {}
        }
    }
    let comparison = match (one, other) {
        (WorldFile::Replay(one), WorldFile::Replay(other)) => {
            compare_replays(Playback::start(&one, &args.one)?, Playback::start(&other, &args.other)?)
        }
        (WorldFile::Run(one), WorldFile::Run(other)) => compare_checkpoints(&one, &other),
        (one, other) => compare_worlds((one, args.one.as_path()), (other, args.other.as_path()))?,
    };
    let told = comparison.tell();
    if damage.is_empty() {
        return told;
    }
    // Where they differ, that is the answer; the damage may be why.
    let text = damage.join("; ");
    told.inspect_err(|_| console.complain(&format!("error: {text}")))?;
    Err(Failure::Message(text))
}

impl Comparison {
    /// Prints the difference. Fails if there is one, or if a replay differs from its record.
    fn tell(self) -> Result<(), Failure> {
        let Self { difference, compared, mismatches } = self;
        let is_equal = difference.is_none() && mismatches.is_empty();
        let as_played = if mismatches.is_empty() { "" } else { ", as played now" };
        let printed = print(difference.unwrap_or_else(|| format!("no difference{compared}{as_played}")) + "\n");
        if is_equal { Ok(printed?) } else { Err(Failure::Broken(mismatches)) }
    }
}

fn compare_replays(mut one: Playback<'_>, mut other: Playback<'_>) -> Comparison {
    let difference = first_difference_of_runs(&mut one, &mut other);
    let mismatches = [one, other].iter().filter_map(Playback::mismatch).collect();
    Comparison { difference, compared: "", mismatches }
}

fn compare_checkpoints(one: &Checkpoint, other: &Checkpoint) -> Comparison {
    let world = &one.run.world;
    let beside = || Some(format!("step {}: not the same {}", world.step_index(), one.difference_beside_worlds(other)?));
    let difference = first_difference(world, &other.run.world).or_else(beside);
    Comparison { difference, compared: " in world, player, names, script and checks", mismatches: Vec::new() }
}

/// Compares the worlds of two files at the step of the one that has a single step.
fn compare_worlds(one: (WorldFile, &Path), other: (WorldFile, &Path)) -> Result<Comparison, Failure> {
    let step = one.0.step().or(other.0.step()).unwrap_or_default();
    let are_played = [&one.0, &other.0].map(|saved| matches!(saved, WorldFile::Replay(_)));
    let (one, mismatch) = one.0.world_at(step, one.1)?;
    let (other, mismatch_of_other) = other.0.world_at(step, other.1)?;
    let mismatches = mismatch.into_iter().chain(mismatch_of_other).collect();
    let ends = are_played.into_iter().zip([&one, &other]).filter(|(is_played, _)| *is_played);
    let end = ends.map(|(_, world)| world.step_index()).find(|end| *end < step);
    let difference = end.map(|end| format!("step {end}: the replay ends")).or_else(|| first_difference(&one, &other));
    Ok(Comparison { difference, compared: " in the world", mismatches })
}

/// The first difference between two worlds, with the step.
fn first_difference(one: &World, other: &World) -> Option<String> {
    let difference = one.first_difference(other)?;
    Some(format!("step {}: {difference}", one.step_index()))
}

/// Plays two replays side by side, up to the first difference.
fn first_difference_of_runs(one: &mut Playback<'_>, other: &mut Playback<'_>) -> Option<String> {
    loop {
        if one.world().digest() != other.world().digest() {
            return first_difference(one.world(), other.world());
        }
        match (one.step(), other.step()) {
            (true, true) => {}
            (false, false) => return None,
            (is_longer, _) => {
                let ended = if is_longer { "second" } else { "first" };
                let step = one.world().step_index().min(other.world().step_index());
                return Some(format!("step {step}: the {ended} replay ends"));
            }
        }
    }
}
