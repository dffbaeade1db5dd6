//! The corpora of the fuzz targets (folder `fuzz`), replayed: what once was found stays mended.
//!
//! `cargo test -p microsim-core --features scenario,snapshot --test corpora -- --ignored` writes the seeds.
#![cfg(all(feature = "scenario", feature = "snapshot"))]

#[path = "common/sequence/mod.rs"]
mod sequence;
#[path = "../../fuzz/src/targets.rs"]
mod targets;

use microsim_core::replay::{Ending, Recorder, Replay};
use microsim_core::scenario::{Scenario, builtins};
use microsim_core::snapshot::Checkpoint;
use microsim_core::{Inputs, Intent, World, glam::Vec2};
use std::fs;
use std::num::NonZeroU32;
use std::path::PathBuf;

fn folder(target: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "..", "fuzz", "corpus", target].iter().collect()
}

/// Shows every file of a corpus to its target.
fn show(target: &str, to: fn(&[u8])) {
    let files: Vec<PathBuf> = fs::read_dir(folder(target)).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(!files.is_empty(), "no corpus of {target}");
    files.iter().for_each(|file| to(&fs::read(file).unwrap()));
}

#[test]
fn scenarios() {
    show("scenario", targets::scenario);
}

#[test]
fn snapshots() {
    show("snapshot", targets::snapshot);
}

#[test]
fn replays() {
    show("replay", targets::replay);
}

#[test]
fn sequences() {
    show("api", |bytes| {
        sequence::run(bytes, sequence::Limits::SHORT).unwrap();
    });
}

/// What the corpora grow from is no rubbish to the present readers.
#[test]
fn seeds_are_accepted() {
    let read = |target, name: &str| fs::read(folder(target).join(name)).unwrap().split_off(1);
    for name in ["room", "small"] {
        let [world, content, run, run_content] = [0, 1, 2, 3].map(|kind| read("snapshot", &format!("{name}-{kind}")));
        World::from_snapshot(&world).unwrap();
        World::from_snapshot(&targets::sealed(*b"MSIMWRLD", &content)).unwrap();
        Checkpoint::from_bytes(&run).unwrap();
        Checkpoint::from_bytes(&targets::sealed(*b"MSIMRUN\0", &run_content)).unwrap();
    }
    assert_eq!(Replay::read(&read("replay", "whole")).unwrap().ending(), Ending::Complete);
    Replay::read(&targets::chunked(&read("replay", "chunks"))).unwrap();
    Scenario::parse(&fs::read_to_string(folder("scenario").join("small")).unwrap(), &[]).unwrap();
}

/// A small world with prey, obstacles, a furrow and a command.
const SMALL: &str = r#"
schema = 1
[world]
size = [40.0, 30.0]
[step]
substeps = 3
[amoeboid_cell.cell]
radii = [6.0, 6.0]
[agar.pellet]
radius = 0.8
[platelet.stone]
radius = 2.0
[wander.idle]
interval = [0.1, 0.3]
[[spawn]]
of = "cell"
at = [15.0, 15.0]
name = "cell"
controller = "idle"
[[spawn]]
of = "pellet"
at = [30.0, 15.0]
[[spawn]]
of = "stone"
at = [34.0, 24.0]
[[disc]]
at = [35.0, 5.0]
radius = 2.0
[[polygon]]
points = [[3.0, 3.0], [6.0, 3.0], [3.0, 5.0]]
[[command]]
of = "cell"
divide = "other"
[[command]]
of = "cell"
at = 0.1
grow = { nodes = 1, particles = 1 }
[invariants]
leaks = 0
divided = 3
[[expect]]
measure = "divided"
min = 1
by = 20.0
"#;

fn write(target: &str, name: &str, content: &[u8]) {
    fs::create_dir_all(folder(target)).unwrap();
    fs::write(folder(target).join(name), content).unwrap();
}

/// Snapshots of a world and of its run, each also without what is around its content.
fn write_snapshots(name: &str, text: &str) {
    let scenario = Scenario::parse(text, &[]).unwrap();
    let mut run = scenario.build().unwrap();
    (0..12).for_each(|_| run.step(&Inputs::new()));
    let world = run.world.to_snapshot().unwrap();
    let run = Checkpoint { origin: scenario.origin(), run }.to_bytes().unwrap();
    // Magic, version and length come before the content, the checksum after it.
    let content = |file: &[u8]| file[20..file.len() - 8].to_vec();
    for (kind, bytes) in [(0, world.clone()), (1, content(&world)), (2, run.clone()), (3, content(&run))] {
        write("snapshot", &format!("{name}-{kind}"), &[&[kind][..], &bytes].concat());
    }
}

/// A replay for the target that adds lengths and checksums itself: kind, length and content of each chunk.
fn chunks(file: &[u8]) -> Vec<u8> {
    // Magic and version come first, then chunks of kind, length, content and checksum.
    let mut chunks = vec![1];
    let mut rest = &file[12..];
    while let [kind, a, b, c, d, after @ ..] = rest {
        let length = u32::from_le_bytes([*a, *b, *c, *d]) as usize;
        if *kind != 0 {
            chunks.extend([*kind, u8::try_from(length).unwrap()]);
            chunks.extend(&after[..length]);
        }
        rest = &after[length + 4..];
    }
    chunks
}

#[test]
#[ignore = "writes the seeds of the corpora"]
fn write_seeds() {
    for scenario in builtins() {
        write("scenario", scenario.name, scenario.text.as_bytes());
    }
    write("scenario", "small", SMALL.as_bytes());
    write_snapshots("room", targets::ROOM);
    write_snapshots("small", SMALL);
    let file = recorded();
    write("replay", "whole", &[&[0][..], &file].concat());
    write("replay", "chunks", &chunks(&file));
}

fn recorded() -> Vec<u8> {
    let scenario = Scenario::parse(targets::ROOM, &[]).unwrap();
    let mut run = scenario.build().unwrap();
    let probe = run.world.organisms().nth(1).unwrap();
    let (mut recorder, mut file) = Recorder::new(scenario.origin(), NonZeroU32::new(8).unwrap());
    let mut told = Inputs::new();
    for step in 0..20u8 {
        match step % 5 {
            0 => told.set(probe, Intent::toward(Vec2::new(f32::from(step), 10.0)).unwrap()),
            2 => told.set(probe, Intent::REST.digesting(true)),
            4 => told.remove(probe),
            _ => {}
        }
        run.step(&told);
        file.extend(recorder.step(&told, &run.world));
    }
    file.extend(recorder.finish(&run.world));
    file
}
