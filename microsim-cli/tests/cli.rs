//! The program as its users see it: exit codes, streams, files.

mod common;

use common::{Folder, json, microsim, run, stderr, stdout, success};
use std::fs;
use std::io::Write;
use std::process::Stdio;

/// Whether a value has some type.
type HasType = fn(&serde_json::Value) -> bool;

/// Fields of `run --json` and whether they have the type that they must have.
const FIELDS: [(&str, HasType); 13] = [
    ("scenario", serde_json::Value::is_string),
    ("seed", serde_json::Value::is_u64),
    ("steps", serde_json::Value::is_u64),
    ("simulated_seconds", serde_json::Value::is_f64),
    ("bodies", serde_json::Value::is_u64),
    ("particles", serde_json::Value::is_u64),
    ("constraints", serde_json::Value::is_u64),
    ("digest", serde_json::Value::is_string),
    ("leaks", serde_json::Value::is_u64),
    ("improper_absorptions", serde_json::Value::is_u64),
    ("events", serde_json::Value::is_object),
    ("step_ms", serde_json::Value::is_object),
    ("wall_seconds", serde_json::Value::is_f64),
];

#[test]
fn list_names_the_built_in_scenarios() {
    let output = run(&["list"]);
    assert!(output.status.success());
    let names: Vec<String> = stdout(&output).lines().map(|line| line.split("  ").next().unwrap().to_owned()).collect();
    assert!(names.iter().any(|name| name == "empty"), "{names:?}");
    for name in names {
        assert_eq!(json(&["check", &name, "--format", "json"])["ok"], true, "{name}");
    }
}

#[test]
fn run_reports_every_field() {
    let report = json(&["run", "empty", "--steps", "5", "--json"]);
    for (field, is_right) in FIELDS {
        assert!(is_right(&report[field]), "{field}: {}", report[field]);
    }
    assert_eq!(report["steps"], 5);
    let digest = report["digest"].as_str().unwrap();
    assert!(digest.len() == 16 && digest.chars().all(|c| c.is_ascii_hexdigit()), "{digest}");
    for share in ["median", "p90", "p99"] {
        assert!(report["step_ms"][share].is_f64());
    }
}

#[test]
fn bench_reports_phases_and_quality() {
    let report = json(&["bench", "empty", "--steps", "4", "--warmup", "2", "--json"]);
    for (field, is_right) in FIELDS {
        assert!(is_right(&report[field]), "{field}: {}", report[field]);
    }
    assert_eq!((&report["steps"], &report["warmup"]), (&4.into(), &2.into()));
    assert!(report["substeps"].is_u64());
    assert_eq!(report["phases"].as_object().unwrap().len(), microsim_core::Phase::ALL.len());
    for measure in ["ring_error_mean", "ring_error_max", "penetration_max", "edge_stretch_max"] {
        assert!(report["quality"][measure].is_number(), "{measure}");
    }
    let run = json(&["run", "empty", "--steps", "6", "--json"]);
    assert_eq!(run["digest"], report["digest"]);
}

#[test]
fn what_people_read_is_on_stdout() {
    let output = run(&["run", "empty", "--steps", "3"]);
    assert!(stdout(&output).contains("digest") && stderr(&output).is_empty());
    let output = run(&["bench", "empty", "--steps", "3", "--warmup", "0"]);
    assert!(stdout(&output).contains("project_fluids") && stderr(&output).is_empty());
}

#[test]
fn equal_seeds_give_equal_digests() {
    let crowd = common::crowd();
    let folder = Folder::new("digests");
    let file = folder.file("crowd.toml", crowd.as_bytes());
    let digest = |seed: &str| json(&["run", &file, "--steps", "20", "--seed", seed, "--json"])["digest"].clone();
    assert_eq!(digest("7"), digest("7"));
    assert_ne!(digest("7"), digest("8"));
    assert_eq!(json(&["run", &file, "--steps", "1", "--seed", "9", "--json"])["seed"], 9);
}

#[test]
fn set_replaces_a_value() {
    let plain = json(&["bench", "empty", "--steps", "1", "--json"]);
    let changed = json(&["bench", "empty", "--steps", "1", "--set", "step.substeps=13", "--json"]);
    assert_ne!(plain["substeps"], 13);
    assert_eq!(changed["substeps"], 13);
    let refused = run(&["run", "empty", "--set", "step.substeps=99"]);
    assert_eq!(refused.status.code(), Some(2));
    let text = stderr(&refused);
    assert!(text.contains("step.substeps") && text.contains("1 to 64"), "{text}");
}

#[test]
fn seconds_become_steps() {
    let report = json(&["run", "empty", "--seconds", "0.5", "--json"]);
    assert_eq!(report["simulated_seconds"], 0.5);
}

#[test]
fn a_scenario_is_read_from_stdin() {
    let mut child =
        microsim(&["run", "-", "--steps", "2", "--json"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(common::crowd().as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["scenario"], "crowd-of-the-test");
}

#[test]
fn an_unknown_name_gets_a_suggestion() {
    let output = run(&["run", "emtpy"]);
    assert_eq!(output.status.code(), Some(2));
    let text = stderr(&output);
    assert!(text.contains("did you mean empty?") && text.contains("built-in scenarios:"), "{text}");
}

#[test]
fn missing_files_and_folders_are_named() {
    let folder = Folder::new("missing");
    for (path, reason) in [(folder.path("no.toml"), "No such file"), (folder.path("."), "directory")] {
        let output = run(&["run", &path]);
        assert_eq!(output.status.code(), Some(2));
        let text = stderr(&output);
        assert!(text.contains(&path), "{text}");
        assert!(cfg!(windows) || text.contains(reason), "{text}");
    }
}

#[test]
fn wrong_usage_exits_with_2() {
    for arguments in [
        &["fly"][..],
        &["run"],
        &["run", "empty", "--steps", "x"],
        &["run", "empty", "--steps", "1", "--seconds", "1"],
        &["run", "empty", "--seconds", "-1"],
        &["run", "empty", "--set", "nothing"],
        &["run", "empty", "--force"],
        &["bench", "empty", "--steps", "0"],
    ] {
        assert_eq!(run(arguments).status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    for arguments in [&["list"][..], &["run", "empty", "--steps", "1", "--json"]] {
        let mut child = microsim(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(stderr(&output), "");
    }
}

#[test]
fn colour_is_obeyed() {
    let folder = Folder::new("colour");
    let file = folder.file("bad.toml", b"name = 3\n");
    let text = |arguments: &[&str]| stderr(&run(&[&["check", &file], arguments].concat()));
    assert!(!text(&[]).contains('\x1b'));
    assert!(text(&["--color", "always"]).contains('\x1b'));
    assert!(!text(&["--color", "never"]).contains('\x1b'));
}

#[test]
fn check_counts_what_there_would_be() {
    let folder = Folder::new("check");
    let file = folder.crowd();
    let output = success(&["check", &file]);
    assert!(stdout(&output).starts_with("ok: crowd-of-the-test, 4 organisms"), "{}", stdout(&output));
    assert_eq!(fs::read_dir(folder.root()).unwrap().count(), 1);
}
