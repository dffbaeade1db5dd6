//! `inspect`: a snapshot or a checkpoint in words.

use crate::checkpoint;
use crate::console::stdout;
use crate::failure::Failure;
use crate::summary::{Table, rounded};
use microsim_core::World;
use microsim_core::snapshot::SnapshotError;
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

/// `inspect`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Snapshots are written at the times of output.snapshots, checkpoints by run --checkpoint-every."
)]
pub(crate) struct InspectArgs {
    /// A snapshot, a checkpoint, or the folder of a run that was stopped
    #[arg(value_name = "FILE|DIR")]
    pub file: PathBuf,
}

/// Says what is in a file.
pub(crate) fn inspect(args: &InspectArgs) -> Result<(), Failure> {
    let path = if args.file.is_dir() { args.file.join(checkpoint::FILE) } else { args.file.clone() };
    let bytes = fs::read(&path).map_err(|error| Failure::file("read", &path, &error))?;
    let mut table = Table::default();
    match World::from_snapshot(&bytes) {
        Ok(world) => {
            table.row("what", "snapshot of a world");
            describe(&world, &mut table);
        }
        Err(SnapshotError::Foreign) => {
            let accepted = "accepted: what output.snapshots or run --checkpoint-every wrote";
            let refuse = |why: String| Failure::Message(format!("{}: {why}, {accepted}", path.display()));
            let (saved, run) = checkpoint::parse(&bytes).map_err(refuse)?;
            table.row("what", "checkpoint of a run");
            table.row("scenario", &saved.source);
            table.row("seed", run.origin.seed);
            table.row("steps in all", saved.steps);
            table.row("broken so far", saved.broken.as_deref().unwrap_or("nothing"));
            describe(&run.run.world, &mut table);
        }
        Err(error) => return Err(Failure::Message(format!("{}: {error}; write it anew", path.display()))),
    }
    Ok(table.print(stdout())?)
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
