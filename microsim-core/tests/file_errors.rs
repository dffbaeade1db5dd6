//! Every public function that reads or writes a file's bytes, with each kind of error that it can give.
#![cfg(all(feature = "scenario", feature = "snapshot"))]

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::replay::{Player, Recorder, Replay};
use microsim_core::scenario::{Origin, Scenario};
use microsim_core::snapshot::Checkpoint;
use microsim_core::{Obstacle, World, WorldConfig};
use std::collections::BTreeSet;
use std::num::NonZeroU32;

#[path = "../../fuzz/src/targets.rs"]
mod targets;

/// What the content of a file ends with.
const CHECKSUM: usize = 8;
/// Where the version is, and where the content begins.
const VERSION_AT: usize = 8;
const CONTENT_AT: usize = 20;

/// The name of an error's kind.
fn kind(error: impl std::fmt::Debug) -> String {
    let text = format!("{error:?}");
    text.split([' ', '(', '{']).next().unwrap_or_default().to_owned()
}

fn world() -> World {
    World::new(WorldConfig::default()).unwrap()
}

/// With an obstacle of a shape that files do not know.
fn hilly() -> World {
    let heights = SharedShape::heightfield(vec![1.0, 2.0, 1.0], Vec2::splat(9.0));
    let mut world = world();
    world.add_obstacle(Obstacle::new(heights, Pose::translation(30.0, 30.0))).unwrap();
    world
}

fn checkpoint() -> Checkpoint {
    let scenario = Scenario::parse(targets::ROOM, &[]).unwrap();
    Checkpoint { origin: scenario.origin(), run: scenario.build().unwrap() }
}

fn with_flipped_bit(file: &[u8], at: usize) -> Vec<u8> {
    let mut bytes = file.to_vec();
    bytes[at] ^= 1;
    bytes
}

/// Each damage to a whole file, and the kind of error that it gives.
fn damaged(file: &[u8]) -> [(&'static str, Vec<u8>); 6] {
    let change = |at| with_flipped_bit(file, at);
    let magic = file[..VERSION_AT].try_into().unwrap();
    let content = &file[CONTENT_AT..file.len() - CHECKSUM];
    [
        ("Foreign", change(0)),
        ("Version", change(VERSION_AT)),
        ("Truncated", file[..file.len() - 1].to_vec()),
        ("Trailing", [file, b"x"].concat()),
        ("Corrupt", change(CONTENT_AT)),
        ("Invalid", targets::sealed(magic, &content[..content.len() - 1])),
    ]
}

#[test]
fn snapshots() {
    let mut kinds = BTreeSet::new();
    for (expected, bytes) in damaged(&world().to_snapshot().unwrap()) {
        assert_eq!(kind(World::from_snapshot(&bytes).unwrap_err()), expected, "World::from_snapshot");
        kinds.insert(expected.to_owned());
    }
    for (expected, bytes) in damaged(&checkpoint().to_bytes().unwrap()) {
        assert_eq!(kind(Checkpoint::from_bytes(&bytes).unwrap_err()), expected, "Checkpoint::from_bytes");
    }
    kinds.insert(kind(hilly().to_snapshot().unwrap_err()));
    let mut run = checkpoint();
    run.run.world = hilly();
    assert_eq!(kind(run.to_bytes().unwrap_err()), "UnknownShape");
    assert_eq!(kinds, variants(include_str!("../src/snapshot/error.rs"), "SnapshotError"));
}

/// A run of the room: no steps.
fn replay(origin: Origin) -> Vec<u8> {
    let (recorder, mut file) = Recorder::new(origin, NonZeroU32::MIN);
    file.extend(recorder.finish(&world()));
    file
}

#[test]
fn replays() {
    let file = replay(checkpoint().origin);
    let kinds = [0, VERSION_AT, VERSION_AT + 4].map(|at| kind(Replay::read(&with_flipped_bit(&file, at)).unwrap_err()));
    assert_eq!(BTreeSet::from(kinds), variants(include_str!("../src/replay/mod.rs"), "ReplayError"));
    let unknown = Origin { text: "schema = 7".to_owned(), ..checkpoint().origin };
    let replay = Replay::read(&replay(unknown)).unwrap();
    assert!(Player::new(&replay).unwrap_err().to_string().contains("schema"));
}

/// Names of an enum's variants, from its source.
fn variants(source: &str, name: &str) -> BTreeSet<String> {
    let body = source.split(&format!("pub enum {name} {{")).nth(1).unwrap().split("\n}").next().unwrap();
    let variants =
        body.lines().filter_map(|line| line.strip_prefix("    ")).filter(|line| line.starts_with(char::is_uppercase));
    variants.map(|line| line.trim_end_matches([' ', '{', ',']).to_owned()).collect()
}

/// Public functions in a source that give one of these errors.
fn fallible<'a>(source: &'a str, errors: &[&str]) -> Vec<&'a str> {
    let code = source.split("#[cfg(test)]").next().unwrap_or_default();
    let signature = |rest: &'a str| rest.split(['{', ';']).next().unwrap_or_default();
    let signatures = code.split("pub fn ").skip(1).map(signature);
    let failing = signatures.filter(|text| errors.iter().any(|error| text.contains(&format!(", {error}>"))));
    failing.map(|text| text.split(['(', '<']).next().unwrap_or_default()).collect()
}

#[test]
fn no_function_that_can_fail_is_missing() {
    let errors = ["SnapshotError", "ReplayError", "Diagnostics"];
    let sources = [
        include_str!("../src/snapshot/mod.rs"),
        include_str!("../src/snapshot/checkpoint.rs"),
        include_str!("../src/replay/mod.rs"),
        include_str!("../src/replay/player.rs"),
        include_str!("../src/replay/recorder.rs"),
    ];
    let found: Vec<&str> = sources.iter().flat_map(|source| fallible(source, &errors)).collect();
    assert_eq!(found, ["to_snapshot", "from_snapshot", "to_bytes", "from_bytes", "read", "new"]);
}
