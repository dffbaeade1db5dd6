//! Invariants, expectations and commands of scenarios.

mod common;

use common::{Folder, run, stderr, stdout};

/// A cell that wanders off, and what the file says of it.
fn scenario(more: &str) -> Vec<u8> {
    let start = "schema = 1\nname = 'watched'\nseed = 5\n[world]\nsize = [60.0, 40.0]\n\
                 [amoeboid_cell.cell]\nradii = [8.0, 8.0]\n\
                 [[spawn]]\nof = 'cell'\nat = [30.0, 20.0]\nname = 'it'\n";
    format!("{start}{more}").into_bytes()
}

/// Runs 30 steps (half a second) of it: exit code, stderr and stdout.
fn outcome(test: &str, more: &str) -> (Option<i32>, String, String) {
    let folder = Folder::new(test);
    let file = folder.file("watched.toml", &scenario(more));
    let output = run(&["run", &file, "--steps", "30"]);
    (output.status.code(), stderr(&output), stdout(&output))
}

#[test]
fn checks_that_pass_exit_with_0() {
    let more = "[invariants]\nleaks = 0\norganisms = [1, 1]\nedge_stretch_max = 0.25\n\
                [[expect]]\nby = 0.5\nmeasure = 'particles'\nmin = 20\n";
    let (code, said, _) = outcome("holds", more);
    assert_eq!((code, said.as_str()), (Some(0), ""));
}

#[test]
fn a_broken_invariant_exits_with_1_and_is_named_once() {
    let more = "[[command]]\nof = 'it'\nat = 0.25\ngrow = { nodes = 1 }\n[invariants]\nbodies = 29\n";
    let (code, said, printed) = outcome("broken", &more.replace("29", "24"));
    assert_eq!(code, Some(1), "{said}");
    let named = "watched with seed 5: bodies is ";
    assert!(said.starts_with(named) && said.contains(" after step 1 (0.02 s), accepted: at most 24"), "{said}");
    assert_eq!(said.lines().count(), 1);
    assert!(printed.contains("digest"), "the summary is printed all the same");
    // As many as there are at the start: the command of step 16 breaks it.
    let bodies = said.split_whitespace().nth(6).unwrap();
    let (code, said, _) = outcome("broken-later", &more.replace("29", bodies));
    assert!(code == Some(1) && said.contains(" after step 16 (0.27 s)"), "{said}");
}

#[test]
fn an_unmet_expectation_exits_with_1() {
    let expect = |by: f32| format!("[[expect]]\nby = {by}\nmeasure = 'ingested'\nmin = 1\n");
    let (code, said, _) = outcome("late", &expect(0.25));
    assert_eq!(code, Some(1));
    assert!(said.contains("ingested is 0 after step 15 (0.25 s), accepted: at least 1"), "{said}");
    let (code, said, _) = outcome("not-yet", &expect(1.0));
    assert_eq!(code, Some(0), "its time has not come: {said}");
}

#[test]
fn a_command_that_is_refused_exits_with_1() {
    let (code, said, _) = outcome("refused", "[[command]]\nof = 'it'\nevery = 0.1\ngrow = { particles = 9999 }\n");
    assert_eq!(code, Some(1));
    assert!(
        said.contains("command.0 was refused before step 1 (0.00 s): `particles` is ") && said.lines().count() == 1
    );
}

#[test]
fn everything_is_written_although_an_invariant_broke() {
    let folder = Folder::new("written");
    let file = folder.file("watched.toml", &scenario("[invariants]\norganisms = 0\n"));
    let output = run(&["run", &file, "--steps", "30", "--out", &folder.path("out")]);
    assert_eq!(output.status.code(), Some(1));
    let text = |name: &str| std::fs::read_to_string(folder.root().join("out").join(name)).unwrap();
    assert_eq!(text("measures.csv").lines().count(), 7);
    let report: serde_json::Value = serde_json::from_str(&text("run.json")).unwrap();
    let failure = report["failures"][0].as_str().unwrap();
    assert_eq!(failure, "organisms is 1 after step 1 (0.02 s), accepted: at most 0");
}

#[test]
fn a_valid_state_exits_with_0() {
    let output = run(&["run", "divide", "--steps", "60", "--validate"]);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
}

/// With three substeps and a speed limit this high a membrane does not hold under an absurd load, see `WorldConfig`.
#[test]
fn an_invalid_state_exits_with_1_and_is_described() {
    let absurd = ["step.substeps=3", "world.gravity=[0,-1000]", "world.max_speed=1000"].map(|change| ["--set", change]);
    let output = run(&[&["run", "crawl", "--steps", "60", "--validate"][..], absurd.as_flattened()].concat());
    assert_eq!(output.status.code(), Some(1));
    let said = stderr(&output);
    let flaw = ": amoeboid_cell 2 (generation 0): a ring of 78 nodes crosses itself";
    assert!(said.contains("crawl with seed 1: after step 19") && said.contains(flaw), "{said}");
}
