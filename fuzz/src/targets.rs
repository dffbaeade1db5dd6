//! What is done with the bytes that a fuzzer makes up. The ordinary tests do the same with the committed corpora.
#![allow(dead_code, reason = "each target uses one")]

use microsim_core::glam::Vec2;
use microsim_core::replay::{Player, Replay};
use microsim_core::scenario::Scenario;
use microsim_core::snapshot::Checkpoint;
use microsim_core::{Inputs, Intent, World};

/// So small that nothing takes long.
const LIMITS: [(&str, &str); 2] = [("world.max_particles", "1500"), ("step.substeps", "2")];
/// Steps that are taken with what is accepted.
const STEPS: usize = 3;

/// The text of a scenario.
pub(crate) fn scenario(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let limits = LIMITS.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let Ok(scenario) = Scenario::parse(text, &limits).or_else(|_| Scenario::parse(text, &[])) else { return };
    if scenario.config().max_particles <= 1500 {
        let Ok(mut run) = scenario.build() else { return };
        for _ in 0..STEPS {
            run.step(&Inputs::new());
            let _ = run.checks.after_step(&run.world);
        }
    }
}

/// A snapshot or a checkpoint. Of the first byte the lowest bits say which, and whether the rest is the file or only its
/// content, to be wrapped up with a checksum that is right.
pub(crate) fn snapshot(bytes: &[u8]) {
    let Some((&kind, rest)) = bytes.split_first() else { return };
    match kind % 4 {
        0 => world(World::from_snapshot(rest).ok()),
        1 => world(World::from_snapshot(&sealed(WORLD, rest)).ok()),
        2 => run(Checkpoint::from_bytes(rest).ok()),
        _ => run(Checkpoint::from_bytes(&sealed(*b"MSIMRUN\0", rest)).ok()),
    }
}

/// A replay: the file if the first byte is even, else chunks for a scenario of its own: kind, length and content of each.
pub(crate) fn replay(bytes: &[u8]) {
    let Some((&kind, rest)) = bytes.split_first() else { return };
    let file = if kind % 2 == 0 { rest.to_vec() } else { chunked(rest) };
    let Ok(replay) = Replay::read(&file) else { return };
    if replay.origin().text == ROOM
        && let Ok(player) = Player::new(&replay)
    {
        let _ = player.take(8 * STEPS).count();
    }
}

/// What is accepted can be used: whatever it says, nothing panics, and what becomes of it can be written and read.
fn world(accepted: Option<World>) {
    let Some(mut world) = accepted else { return };
    read_back(&world);
    let handles: Vec<_> = world.organisms().collect();
    let mut inputs = Inputs::new();
    for &organism in &handles {
        inputs.set(organism, Intent::toward(Vec2::ONE).unwrap_or(Intent::REST).digesting(true));
    }
    for _ in 0..STEPS {
        world.step(&inputs);
        read_back(&world);
    }
    let _ = (world.census(), world.quality(), world.validate(), world.view().organisms().count());
    for organism in handles {
        let _ = (world.divide(organism), world.grow(organism, 1, 1), world.remove(organism));
    }
    world.step(&inputs);
    read_back(&world);
}

fn read_back(world: &World) {
    let bytes = world.to_snapshot().expect("a world can be written");
    let again = World::from_snapshot(&bytes).expect("what was written can be read");
    assert_eq!(again.digest(), world.digest());
}

fn run(accepted: Option<Checkpoint>) {
    let Some(Checkpoint { mut run, .. }) = accepted else { return };
    for _ in 0..STEPS {
        run.step(&Inputs::new());
        let _ = run.checks.after_step(&run.world);
    }
    world(Some(run.world));
}

/// Content as it lies in a file (docs/determinism.md).
pub(crate) fn sealed(magic: [u8; 8], content: &[u8]) -> Vec<u8> {
    let mut bytes = magic.to_vec();
    let version: u32 = if magic == WORLD { WORLD_VERSION } else { RUN_VERSION };
    bytes.extend(version.to_le_bytes());
    bytes.extend((content.len() as u64).to_le_bytes());
    bytes.extend(content);
    let sum = fnv1a(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

/// How a snapshot of a world begins.
const WORLD: [u8; 8] = *b"MSIMWRLD";
const WORLD_VERSION: u32 = 12;
/// Of checkpoints.
const RUN_VERSION: u32 = 7;
/// Of replays.
const REPLAY_VERSION: u32 = 4;

/// The scenario of replays that are made up.
pub(crate) const ROOM: &str = r#"
schema = 1
[world]
size = [30.0, 20.0]
[step]
substeps = 2
[agar.pellet]
radius = 1.0
[probe.needle]
radius = 1.0
[[spawn]]
of = "pellet"
at = [10.0, 10.0]
[[spawn]]
of = "needle"
at = [20.0, 10.0]
"#;

/// A replay of chunks: kind, length and content of each.
pub(crate) fn chunked(mut rest: &[u8]) -> Vec<u8> {
    let mut bytes = b"MSIMPLAY".to_vec();
    bytes.extend(REPLAY_VERSION.to_le_bytes());
    // Library, interval, text, overrides, seed.
    let mut header = vec![1, b'0', 60];
    header.extend([(ROOM.len() % 128) as u8 | 128, (ROOM.len() / 128) as u8]);
    header.extend(ROOM.bytes());
    header.extend([0, 0]);
    chunk(&mut bytes, 0, &header);
    while let [kind, length, after @ ..] = rest {
        let (content, after) = after.split_at(usize::from(*length).min(after.len()));
        chunk(&mut bytes, *kind, content);
        rest = after;
    }
    bytes
}

fn chunk(bytes: &mut Vec<u8>, kind: u8, content: &[u8]) {
    bytes.push(kind);
    bytes.extend((content.len() as u32).to_le_bytes());
    bytes.extend(content);
    let sum = fnv1a(bytes);
    bytes.extend(((sum >> 32) as u32 ^ sum as u32).to_le_bytes());
}

fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}
