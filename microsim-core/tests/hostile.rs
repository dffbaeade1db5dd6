//! A small file takes little memory to read, whatever it says is in it.
#![cfg(all(feature = "scenario", feature = "snapshot"))]

#[path = "../../fuzz/src/targets.rs"]
mod targets;

use cap::Cap;
use microsim_core::{World, WorldConfig};
use std::alloc::System;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Bytes of each file.
const LENGTH: usize = 1_000_000;
/// Most memory that reading takes, in lengths of the file.
const TIMES: usize = 40;

/// What an empty world writes ends with a zero for each of these, most of them lengths of lists; and the fewest bytes that
/// an element of the list takes.
const END: [(&str, usize); 24] = [
    ("particles.free", 1),
    ("organisms.slots", 2),
    ("organisms.free", 1),
    ("templates", 7),
    ("blocks", 75),
    ("fluids", 15),
    ("chemicals", 17),
    ("exemptions.pairs", 2),
    ("exemptions.gates", 2),
    ("touching", 4),
    ("events", 5),
    ("guard.wrong_side", 0),
    ("guard.net_fired", 0),
    ("joints.slots", 2),
    ("joints.free", 1),
    ("fields.slots", 2),
    ("fields.free", 1),
    ("obstacle_table.slots", 2),
    ("obstacle_table.free", 1),
    ("presences", 5),
    ("contact_reports.reporting", 0),
    ("contact_reports.points", 30),
    ("contact_reports.surfaces", 4),
    ("contact_reports.hits", 4),
];

/// A length as it is written.
fn varint(mut number: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    while number >= 128 {
        bytes.push(number as u8 | 128);
        number >>= 7;
    }
    bytes.push(number as u8);
    bytes
}

/// The content of a world with zeros for as many elements of one of its lists as there is room for.
fn bomb(empty: &[u8], place: usize, least: usize) -> Vec<u8> {
    let at = empty.len() - END.len() + place;
    let count = LENGTH / least;
    [&empty[..at], &varint(count), &vec![0; count * least], &empty[at + 1..]].concat()
}

/// The most memory that was ever in use is compared, so each file but the one that takes the most may be lost in another's
/// shadow; all of them are of one length.
#[test]
fn what_a_file_says_is_not_believed() {
    let world = World::new(WorldConfig::default()).unwrap().to_snapshot().unwrap();
    let empty = &world[20..world.len() - 8];
    assert!(empty.ends_with(&[0; END.len()]));
    let allowed = |name: &str| {
        let most = ALLOCATOR.max_allocated();
        assert!(most < TIMES * LENGTH, "{name}: {most} bytes for a file of {LENGTH}");
    };
    for (place, (name, least)) in END.into_iter().enumerate().filter(|(_, (_, least))| *least > 0) {
        drop(World::from_snapshot(&targets::sealed(*b"MSIMWRLD", &bomb(empty, place, least))));
        allowed(name);
    }
    // Obstacles come first.
    let obstacles = [&varint(LENGTH / 20)[..], &[0; LENGTH], &empty[1..]].concat();
    assert!(World::from_snapshot(&targets::sealed(*b"MSIMWRLD", &obstacles)).is_err());
    allowed("obstacles");
}
