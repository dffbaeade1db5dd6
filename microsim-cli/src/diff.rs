//! `diff`: the first step and the first field in which two worlds differ.

use crate::console::stdout;
use crate::failure::Failure;
use crate::saved::{Saved, play};
use microsim_core::World;
use microsim_core::replay::Player;
use std::io::Write;
use std::path::PathBuf;

/// `diff`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Two replays are played side by side up to the first step after which their worlds differ; a replay and a snapshot or\n\
checkpoint are compared at the step of the latter. The exit code is 0 if nothing differs and 1 if something does."
)]
pub(crate) struct DiffArgs {
    /// A snapshot, a checkpoint or a replay
    #[arg(value_name = "A")]
    pub one: PathBuf,
    /// The one to compare it with
    #[arg(value_name = "B")]
    pub other: PathBuf,
}

/// Compares two files and says where they differ.
pub(crate) fn diff(args: &DiffArgs) -> Result<(), Failure> {
    let (one, other) = (Saved::read(&args.one)?, Saved::read(&args.other)?);
    let found = match (&one, &other) {
        (Saved::Replay(a), Saved::Replay(b)) => compare_runs(&mut play(a, &args.one)?, &mut play(b, &args.other)?),
        _ => {
            let step = one.step().or(other.step()).unwrap_or_default();
            compare(&one.world_at(step, &args.one)?, &other.world_at(step, &args.other)?)
        }
    };
    let mut out = stdout();
    writeln!(out, "{}", found.as_deref().unwrap_or("no difference"))?;
    out.flush()?;
    // What differs is a result, on stdout; the exit code says that something does.
    found.map_or(Ok(()), |_| Err(Failure::Broken(Vec::new())))
}

/// The first difference between two worlds, with the step.
fn compare(one: &World, other: &World) -> Option<String> {
    let difference = one.first_difference(other)?;
    Some(format!("step {}: {difference}", one.step_index()))
}

/// Plays two replays side by side, up to the first difference.
fn compare_runs(one: &mut Player, other: &mut Player) -> Option<String> {
    loop {
        if one.world().digest() != other.world().digest() {
            return compare(one.world(), other.world());
        }
        match (one.next(), other.next()) {
            (Some(_), Some(_)) => {}
            (None, None) => return None,
            (longer, _) => {
                let ended = if longer.is_some() { "second" } else { "first" };
                return Some(format!(
                    "step {}: the {ended} replay ends",
                    one.world().step_index().min(other.world().step_index())
                ));
            }
        }
    }
}
