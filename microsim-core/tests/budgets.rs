//! A small scenario file takes little memory and time to read and build, whatever it asks for: what would take much is refused
//! with its place, and what is there many times costs no more than its number.
#![cfg(feature = "scenario")]
#![allow(clippy::disallowed_types, reason = "this test measures time")]

use cap::Cap;
use microsim_core::scenario::Scenario;
use std::alloc::System;
use std::fmt::Write;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);
/// Memory and time are those of one test alone.
static ALONE: Mutex<()> = Mutex::new(());

/// Most memory that any test takes, bytes.
const MEMORY: usize = 250_000_000;

const ROOM: &str =
    "schema = 1\nworld.size = [1000.0, 1000.0]\nagar.pellet.radius = 0.5\nrigid_cell.cell.radii = [8.0, 6.0]\n";

/// What is said of a file that is refused without much memory.
fn refused(text: &str, overrides: &[(String, String)]) -> String {
    let built = Scenario::parse(text, overrides).and_then(|scenario| scenario.build());
    let most = ALLOCATOR.max_allocated();
    assert!(most < MEMORY, "{most} bytes for a file of {}", text.len());
    built.map(|_| "accepted".to_owned()).unwrap_or_else(|diagnostics| diagnostics.to_string())
}

/// The shorter one of two times to read and build a file, s.
fn time(text: &str) -> f64 {
    let once = || {
        let start = Instant::now();
        let _ = Scenario::parse(text, &[]).and_then(|scenario| scenario.build());
        start.elapsed().as_secs_f64()
    };
    let [first, second] = [once(), once()];
    if first < second { first } else { second }
}

#[test]
fn what_takes_much_memory_is_refused_with_its_place() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut chemicals = ROOM.to_owned();
    (0..100).for_each(|k| write!(chemicals, "[chemical.c{k:02}]\nspacing = 1.0\n").unwrap());
    let numbers = |count: usize| vec!["1"; count].join(",");
    let corners = |count: usize| format!("{ROOM}[[polygon]]\npoints = [{}]\n", vec!["[1,2]"; count].join(","));
    let fine = format!("{ROOM}[chemical.c]\nspacing = 1.0\n");
    let slanted = "[[block]]\nat = [500, 500]\nsize = [900, 1]\nangle = 45\n";
    let long = format!("{:?}", "\n".repeat(100_000));
    let uses = vec!["'$p'"; 50_000].join(",");
    for (text, expected) in [
        (
            chemicals,
            "line 14, column 11: chemical.c04.spacing: 1 is out of range \
            (accepted: so large that 0 cells fill the room: 4000000 for all chemicals together)",
        ),
        (
            fine + &slanted.repeat(40),
            "line 5, column 2: chemical: there are too many cells in obstacles (accepted: at most 16000000 cells",
        ),
        (corners(200_000), "the file and what is set have 1200"),
        (corners(60_000), "line 6, column 10: polygon.0.points: is an array of 60000 (accepted: 3 to 200 corners"),
        (
            format!("{ROOM}[output.frames]\nat = [{}]\n", numbers(300_000)),
            "one value too many (accepted: at most 200000 values in a file)",
        ),
        (
            format!("{ROOM}[output]\nsnapshots = [{uses}]\n[parameters]\np = {long}\n"),
            "line 8, column 5: parameters.p: 100000 characters (accepted: at most 400 characters)",
        ),
        (
            format!("{ROOM}[output]\nsnapshots = [{uses}]\n[parameters]\np = [{}]\n", numbers(50_000)),
            "line 8, column 5: parameters.p: not a single value",
        ),
    ] {
        let words = refused(&text, &[]);
        assert!(words.contains(expected), "`{}` instead of `{expected}`", words.chars().take(300).collect::<String>());
    }
    let set = [("output.frames.at".to_owned(), format!("[{}]", numbers(600_000)))];
    assert!(refused(ROOM, &set).contains("(accepted: at most 1000000 bytes)"));
}

#[test]
fn values_in_each_other_take_no_more_memory() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    for values in ["[],".repeat(333_000), "1,".repeat(499_000), "{a={}},".repeat(142_000)] {
        let begin: String = values.chars().take(30).collect();
        assert!(refused(&format!("x = [{values}]"), &[]).contains("one value too many"), "{begin}");
    }
}

#[test]
fn mistakes_take_no_more_memory() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    for mistake in ["=\n", "[]\n", "= = \n", "[\n", "a b\n", "x=\"\\q\"\n", "\u{1}"] {
        assert!(refused(&mistake.repeat(999_999 / mistake.len()), &[]).contains("accepted: TOML"), "{mistake:?}");
    }
    for key in ["a.a.a.a.a.a.a.a", "a . a . a . a", "1.1 .1 .1 .1 .1", "'a'.'='.\"a\".a"] {
        let lines = [format!("[{key}]\n"), format!("{key}=1\n"), format!("{{{key}=1}},")];
        for line in lines {
            assert!(
                refused(&line.repeat(999_000 / line.len()), &[]).contains("dots in keys (accepted: at most 50000)")
            );
        }
    }
    let nested = format!("[{}]\n{}", "k".repeat(400_000), (0..50_000).map(|k| format!("a{k}=1\n")).collect::<String>());
    assert!(refused(&nested, &[]).contains("names that are too long"));
    let many = ("output.snapshots".to_owned(), format!("[{}]", vec!["-1"; 199_000].join(",")));
    assert!(refused(ROOM, &[many]).contains("more: -… is out of range, as set by"));
    let deep = ("world.".repeat(150_000) + "x", "1".to_owned());
    assert!(refused(ROOM, &[deep]).contains("a path of 150001 parts"));
    let long = ("k".repeat(400_000), "1".to_owned());
    assert!(refused(ROOM, &[long]).contains("unknown parameter"));
    let keys: String = (0..110_000).map(|k| format!("a{k:x}=1\n")).collect();
    assert!(refused(&keys, &[]).contains("and 109,980 more: unknown field"));
}

#[test]
#[ignore = "measures time: by hand, in release"]
fn twice_as_many_mistakes_take_twice_as_long() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    for mistake in ["=\n", "x=\"\\q\"\n", "x=1_\n", "x={a=1,a=2}\n"] {
        let [few, many] = [45_000, 90_000].map(|bytes| time(&mistake.repeat(bytes / mistake.len())));
        assert!(many < 3.0 * few, "{mistake:?}: {few} s and {many} s");
    }
}

#[test]
#[ignore = "measures time: by hand, in release"]
fn problems_in_one_line_take_as_long_as_in_many() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let file = |between: &str| format!("{ROOM}[output.frames]\nat = [{}]\n", vec!["-1"; 180_000].join(between));
    let [one, many] = [",", ",\n"].map(|between| time(&file(between)));
    assert!(one < 2.5 * many, "{one} s for one line, {many} s for many");
}

#[test]
#[ignore = "measures time: by hand, in release"]
fn one_large_organism_does_not_make_the_places_of_small_ones_dear() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let pellets = format!("{ROOM}[[spawn]]\nof = 'pellet'\ncount = 60000\n");
    let both = format!("{pellets}[[spawn]]\nof = 'cell'\nat = [250.0, 250.0]\nscale = 25.0\n");
    let [both, pellets] = [both, pellets].map(|text| time(&text));
    assert!(both < 3.0 * pellets, "{both} s with it, {pellets} s without it");
}

#[test]
#[ignore = "measures time: by hand, in release"]
fn obstacles_far_away_cost_a_place_and_a_chemical_nothing() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut discs = String::new();
    for k in 0..4000 {
        write!(discs, "[[disc]]\nat = [{}, {}]\nradius = 1\n", 15 * (k % 64) + 9, 15 * (k / 64) + 9).unwrap();
    }
    let pellets = "[[spawn]]\nof = 'pellet'\ncount = 8000\n";
    let chemical = "[chemical.scent]\nspacing = 1.0\n";
    for thing in [pellets, chemical] {
        let [alone, together, discs] =
            [format!("{ROOM}{thing}"), format!("{ROOM}{thing}{discs}"), format!("{ROOM}{discs}")]
                .map(|text| time(&text));
        assert!(together < 2.0 * (alone + discs) + 0.1, "{together} s together, {alone} s and {discs} s alone");
    }
}
