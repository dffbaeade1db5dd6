//! Every public function that can fail, with each kind of error that it can give. Those for files: `file_errors.rs`.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod cases;
mod room;
#[path = "../common/sources.rs"]
#[allow(dead_code, reason = "the tests of layering use all of it")]
mod sources;

use cases::CASES;
use microsim_core::{Error, ErrorKind};
use room::Room;
use sources::sources;
use std::collections::BTreeSet;
use std::path::Path;

/// A function, the kind of the error and the field that it names, and a call that gives it.
type Case = (&'static str, &'static str, &'static str, fn(&mut Room) -> Error);

fn kind_of(error: &Error) -> &'static str {
    match error.kind() {
        ErrorKind::OutOfRange { .. } => "OutOfRange",
        ErrorKind::BadReference { .. } => "BadReference",
        ErrorKind::OutsideWorld { .. } => "OutsideWorld",
        ErrorKind::Overlap { .. } => "Overlap",
        ErrorKind::TooMany { .. } => "TooMany",
        ErrorKind::Stale => "Stale",
        ErrorKind::Unsupported { .. } => "Unsupported",
        _ => "a kind that this test does not know",
    }
}

#[test]
fn every_kind_of_error_names_its_field_and_changes_nothing() {
    for &(function, kind, field, call) in CASES {
        let mut room = Room::new();
        let error = call(&mut room);
        assert_eq!((kind_of(&error), error.field()), (kind, field), "{function}: {error}");
        assert!(error.to_string().contains(field), "{function}: {error}");
        assert_eq!(room.world.organisms().count(), 2, "{function} has changed the world");
        room.world.validate().unwrap();
    }
}

/// Names of public functions in a source that return the core's error.
fn fallible(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let signature = |rest: &str| rest.split(['{', ';']).next().unwrap_or_default().to_owned();
    let signatures = code.split("pub fn ").skip(1).map(signature).filter(|signature| signature.contains(", Error>"));
    signatures.map(|signature| signature.split(['(', '<']).next().unwrap_or_default().to_owned()).collect()
}

#[test]
fn no_function_that_can_fail_is_missing() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let listed: BTreeSet<&str> = CASES.iter().filter_map(|case| case.0.split("::").last()).collect();
    let mut count = 0;
    // Pictures have refusals of their own, tested in tests/microscope.rs.
    for source in sources(&root).iter().filter(|source| source.module() != "microscope") {
        for name in fallible(&std::fs::read_to_string(root.join(&source.path)).unwrap()) {
            count += 1;
            assert!(listed.contains(name.as_str()), "`{name}` of {} is not in CASES", source.path.display());
        }
    }
    assert!(count >= 18, "only {count} functions found: does the search still work?");
}
