//! `inspect`: a snapshot, a checkpoint or a replay in words.

use crate::failure::Failure;
use crate::summary::{Table, rounded};
use crate::world_file::{WorldFile, lost};
use microsim_core::World;
use microsim_core::replay::{Ending, Replay};
use microsim_core::scenario::Origin;
use std::collections::BTreeMap;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Snapshots are written at the times of output.snapshots, checkpoints by run --checkpoint-every and --save, replays by\n\
run --record. The exit code is 2 for a damaged replay."
)]
pub(crate) struct InspectArgs {
    /// A snapshot, a checkpoint, a replay, or the folder of a run that was stopped
    #[arg(value_name = "FILE|DIR")]
    pub file: PathBuf,
}

pub(crate) fn inspect(args: &InspectArgs) -> Result<(), Failure> {
    let mut table = Table::default();
    let mut damage = None;
    match WorldFile::read(&args.file)? {
        WorldFile::World(world) => {
            table.row("what", "snapshot of a world");
            describe(&world, &mut table);
        }
        WorldFile::Run(checkpoint) => {
            table.row("what", "checkpoint of a run");
            origin(&checkpoint.origin, &mut table);
            describe(&checkpoint.run.world, &mut table);
        }
        WorldFile::Replay(replay) => {
            describe_replay(&replay, &mut table);
            damage = matches!(replay.ending(), Ending::Damaged { .. }).then(|| lost(&replay, &args.file)).flatten();
        }
    }
    table.print()?;
    damage.map_or(Ok(()), |text| Err(Failure::Message(text)))
}

fn origin(origin: &Origin, table: &mut Table) {
    let name = origin.scenario().map(|scenario| scenario.name().to_owned()).unwrap_or_default();
    table.row("scenario", name);
    for (key, value) in &origin.overrides {
        table.row("  with", format!("{key}={value}"));
    }
    table.row("seed", origin.seed);
}

fn describe_replay(replay: &Replay, table: &mut Table) {
    table.row("what", "replay of a run");
    origin(replay.origin(), table);
    table.row("recorded by", format!("version {}", replay.made_by()));
    table.row("steps", replay.steps());
    table.row("digest", format!("every {} steps", replay.interval()));
    let ending = match replay.ending() {
        Ending::Complete => "it is complete".to_owned(),
        Ending::Unrecordable => "it ends before a change that cannot be recorded".to_owned(),
        Ending::CutOff => "it was cut off".to_owned(),
        Ending::Damaged { at } => format!("it is damaged at byte {at}"),
    };
    table.row("end", ending);
}

fn describe(world: &World, table: &mut Table) {
    let census = world.census();
    let config = world.config();
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    for kind in world.organisms().filter_map(|id| world.kind(id)) {
        *kinds.entry(kind.name()).or_default() += 1;
    }
    table.row("step", format!("{} ({} s)", world.step_index(), rounded(world.time())));
    table.row("room", format!("{} by {} µm", config.size.x, config.size.y));
    table.row("organisms", census.organisms);
    for (kind, count) in kinds {
        table.row(&format!("  {kind}"), count);
    }
    table.row("bodies", census.bodies);
    table.row("particles", census.particles);
    table.row("constraints", census.constraints);
    table.row("obstacles", world.obstacles().count());
    table.row("leaks", census.leaks);
    table.row("quarantined", census.quarantined);
    table.row("digest", format!("{:016x}", world.digest()));
}
