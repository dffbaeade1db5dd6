//! `replay`: repeats a recorded run and compares it with the record.

use crate::console::{self, Console, print_json};
use crate::failure::Failure;
use crate::interrupt;
use crate::sanitize;
use crate::world_file::{in_words, lost, play, read_replay};
use microsim_core::replay::{Ending, Player, Replay};
use serde::Serialize;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The exit code is 1 if the run is not the one that was recorded: the first digest that differs is named on stderr.\n\
A record that was cut off is played up to its last whole frame."
)]
pub(crate) struct ReplayArgs {
    /// A replay that `run --record` has written
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Print one JSON object instead of a sentence
    #[arg(long)]
    pub json: bool,
}

#[derive(Serialize)]
struct ReplayReport<'a> {
    scenario: &'a str,
    seed: u64,
    recorded_by: &'a str,
    steps: u64,
    simulated_seconds: f64,
    digest: String,
    is_complete: bool,
}

/// Plays a replay and prints whether it is as recorded.
pub(crate) fn replay(args: &ReplayArgs, console: &Console) -> Result<(), Failure> {
    let replay = read_replay(&args.file)?;
    let mut player = play(&replay, &args.file)?;
    interrupt::listen();
    let bar = console.progress(replay.steps(), "step");
    for played in player.by_ref() {
        bar.inc(1);
        if let Err(mismatch) = played {
            bar.finish_and_clear();
            return Err(Failure::Broken(vec![in_words(&mismatch, &replay, &args.file)]));
        }
        if interrupt::is_asked() {
            return Err(Failure::Interrupted);
        }
    }
    bar.finish_and_clear();
    print(&replay, &player, args.json)?;
    match lost(&replay, &args.file) {
        Some(text) if matches!(replay.ending(), Ending::Damaged { .. }) => Err(Failure::Message(text)),
        Some(text) => {
            console.note(&text);
            Ok(())
        }
        None => Ok(()),
    }
}

fn print(replay: &Replay, player: &Player, is_json: bool) -> Result<(), Failure> {
    let world = player.world();
    let scenario = replay.origin().scenario().map(|scenario| scenario.name().to_owned()).unwrap_or_default();
    let report = ReplayReport {
        scenario: &scenario,
        seed: replay.origin().seed,
        recorded_by: replay.made_by(),
        steps: world.step_index(),
        simulated_seconds: crate::summary::rounded(world.time()),
        digest: format!("{:016x}", world.digest()),
        is_complete: replay.ending() == Ending::Complete,
    };
    if is_json {
        return Ok(print_json(&report)?);
    }
    let ReplayReport { steps, simulated_seconds, seed, digest, .. } = &report;
    let every = replay.interval();
    let played = format!(
        "{steps} steps ({simulated_seconds:.2} s) of {} with seed {seed} are as recorded",
        sanitize::line(&scenario)
    );
    Ok(console::print(format!("{played}\ndigest {digest}, compared every {every} steps\n"))?)
}
