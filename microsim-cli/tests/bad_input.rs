//! Everything that a command line can get wrong beside the text of a scenario (`refusal.rs`): each is refused with its place
//! and a remedy, exits with 2, and leaves nothing behind.

mod common;

use common::{Folder, microsim, run, stderr, success};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Arguments, with `{}` for the folder of the test; what is named, and what would be accepted.
const BAD: &[(&[&str], &str, &str)] = &[
    // Scenarios and what is set in them.
    (&["check", "emtpy"], "emtpy", "did you mean empty?"),
    (&["check", "{}/no.toml"], "no.toml", "No such file"),
    (&["check", "{}"], "is a directory", "a scenario file"),
    (&["run", "empty", "--set", "step.substeps=many"], "step.substeps", "a whole number"),
    (&["run", "empty", "--set", "step.substeps=99"], "step.substeps=99", "1 to 64"),
    (&["run", "platelets", "--set", "cuont=3"], "cuont", "did you mean `count`?"),
    (&["run", "platelets", "--set", "nothing"], "nothing", "KEY=VALUE"),
    (&["run", "platelets", "--set", "spawn.7.count=3"], "spawn.7.count", "0 to 0"),
    (&["run", "empty", "--seed", "-1"], "-1", "a whole number"),
    (&["run", "empty", "--seconds", "nan"], "nan", "0 to 1e9"),
    (&["run", "empty", "--steps", "1e3"], "1e3", "a whole number"),
    // Outputs.
    (&["run", "empty", "--out", "{}/file.toml"], "file.toml", "an empty or new one"),
    (&["run", "empty", "--out", "{}"], "is not empty", "--force"),
    (&["run", "empty", "--out", "{}/file.toml/deep"], "file.toml/deep", "a part of the path is a file"),
    (
        &["run", "empty", "--out", "{}/new", "--measures", "xls"],
        "output.measures.formats",
        "\"csv\", \"jsonl\" or \"parquet\"",
    ),
    (&["run", "empty", "--out", "{}/new", "--set", "output.measures.of=['leeks']"], "leeks", "did you mean `leaks`?"),
    (&["run", "empty", "--out", "{}/new", "--frames", "-3"], "output.frames.at", "0 to 1000000"),
    (&["run", "empty", "--out", "{}/new", "--snapshots", "soon"], "output.snapshots", "TOML"),
    (&["run", "empty", "--measures", "csv"], "--out", "required"),
    // What a plan says already.
    (&["run", "--task", "{}/file.toml", "--store", "{}/s", "--seed", "5"], "--seed", "cannot be used with"),
    (&["run", "--task", "{}/file.toml", "--store", "{}/s", "--set", "a=1"], "--set", "cannot be used with"),
    (&["run", "--task", "{}/file.toml", "--store", "{}/s", "--seconds", "1"], "--seconds", "cannot be used with"),
    (&["run", "--task", "{}/file.toml", "--store", "{}/s", "--save", "{}/end"], "--save", "cannot be used with"),
    (&["new", "{}/file.toml"], "file.toml exists", "--force"),
    (&["new", "{}/other.toml", "--from", "hnut"], "hnut", "hunt"),
    // Checkpoints, snapshots and reports.
    (&["resume", "{}/none"], "none", "the folder of a run"),
    (&["resume", "{}"], "there is no checkpoint", "output.checkpoint_every"),
    (&["resume", "{}/broken"], "broken/checkpoint", "run the scenario again"),
    (&["inspect", "{}/file.toml"], "file.toml", "a snapshot, a checkpoint or a replay"),
    (&["inspect", "{}/damaged.snapshot"], "damaged.snapshot", "write it again"),
    (&["replay", "{}/file.toml"], "file.toml", "write it again"),
    (&["diff", "{}/damaged.snapshot", "{}/file.toml"], "damaged.snapshot", "write it again"),
    (&["report", "{}", "-o", "{}/page.html"], "run.json", "microsim run --out"),
    (&["report", "{}/file.toml", "-o", "{}/page.html"], "file.toml:1", "expected"),
    // Sweeps.
    (&["sweep", "plan", "empty", "--grid", "seed"], "seed", "KEY=a..b"),
    (&["sweep", "plan", "empty", "--grid", "seed=9..1"], "9..1", "two whole numbers in order"),
    (&["sweep", "plan", "empty", "--grid", "wrold.damping=1,2"], "wrold.damping", "did you mean `world`?"),
    (&["sweep", "plan", "empty", "--grid", "world.damping=1,-2"], "world.damping=-2", "0 to 100"),
    (&["sweep", "plan", "empty", "--seeds", "one"], "one", "0..99"),
    (&["sweep", "plan", "empty", "--grid", "k=1..1000", "--seeds", "0..1000"], "1001000 tasks", "at most 1000000"),
    (&["sweep", "plan", "empty", "--grid", "k=1..1000", "--grid", "m=0..1000"], "m: more than", "fewer values"),
    (&["sweep", "run", "{}/none.jsonl", "--store", "{}/store"], "none.jsonl", "No such file"),
    (&["sweep", "run", "{}/file.toml", "--store", "{}/store"], "file.toml:1", "microsim sweep plan"),
    (&["sweep", "run", "{}/changed.jsonl", "--store", "{}/store"], "changed.jsonl:1", "plan it again"),
    (&["sweep", "run", "{}/plan.jsonl", "--store", "{}/file.toml"], "file.toml", "a directory"),
    (&["sweep", "run", "{}/plan.jsonl", "--store", "{}/store", "--shard", "4/4"], "4/4", "i from 0 to n-1"),
    (
        &["sweep", "merge", "{}/plan.jsonl", "--store", "{}/results", "-o", "{}/table.xls"],
        "table.xls",
        ".csv or .jsonl",
    ),
    (&["run", "empty", "--record", "{}/r", "--digest-every", "0"], "--digest-every", "1 to 4294967295"),
    (&["run", "--task", "{}/plan.jsonl"], "--store", "required"),
    (&["man", "walk"], "walk", "sweep"),
];

/// A folder with something wrong of every kind in it.
fn prepare() -> Folder {
    let folder = Folder::new("bad-input");
    folder.file("file.toml", b"schema = 1\n[world]\nsize = [9, 9]\n");
    let plan = run(&["sweep", "plan", "empty", "--steps", "2"]).stdout;
    folder.file("plan.jsonl", &plan);
    let plan = String::from_utf8(plan).unwrap();
    folder.file("changed.jsonl", plan.replace("\"steps\":2", "\"steps\":3").as_bytes());
    let key = serde_json::from_str::<serde_json::Value>(&plan).unwrap()["key"].as_str().unwrap().to_owned();
    fs::create_dir(folder.root().join("results")).unwrap();
    folder.file(&format!("results/{key}.json"), b"{\"key\"");
    fs::create_dir(folder.root().join("broken")).unwrap();
    folder.file("broken/checkpoint", b"{\"half\"");
    let out = folder.path("run");
    success(&["run", "empty", "--steps", "2", "--snapshots", "0", "--out", &out]);
    let mut snapshot = fs::read(folder.root().join("run/snapshots/00000000.snapshot")).unwrap();
    *snapshot.last_mut().unwrap() ^= 1;
    folder.file("damaged.snapshot", &snapshot);
    fs::remove_dir_all(folder.root().join("run")).unwrap();
    folder
}

/// All paths below a folder.
fn paths(folder: &Path) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        all.insert(entry.path().display().to_string());
        if entry.path().is_dir() {
            all.extend(paths(&entry.path()));
        }
    }
    all
}

#[test]
fn bad_input_is_refused_with_its_place_and_a_remedy() {
    assert!(BAD.len() >= 30);
    let folder = prepare();
    let before = paths(folder.root());
    let mut wrong = Vec::new();
    for (arguments, place, remedy) in BAD {
        let arguments: Vec<String> =
            arguments.iter().map(|argument| argument.replace("{}", folder.root().to_str().unwrap())).collect();
        let output = run(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
        let said = stderr(&output);
        let is_refused = output.status.code() == Some(2) && output.stdout.is_empty();
        let is_explained = said.contains(place) && said.contains(remedy) && said.lines().count() < 20;
        if !is_refused || !is_explained || paths(folder.root()) != before {
            wrong.push(format!("{arguments:?}: {place:?}, {remedy:?}, {:?}: {said}", output.status));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_stdout_is_named() {
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for arguments in [
        &["schema"][..],
        &["list"],
        &["--help"],
        &["run", "--help"],
        &["--version"],
        &["run", "empty", "--steps", "1"],
        &["man"],
    ] {
        let child = microsim(arguments).stdout(full()).stderr(Stdio::piped()).spawn().unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            stderr(&output).contains("stdout") && stderr(&output).contains("free some space"),
            "{}",
            stderr(&output)
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named_and_nothing_half_written_is_left() {
    let folder = Folder::new("full-disk");
    let disk = folder.path("disk");
    fs::create_dir(&disk).unwrap();
    let mounted =
        Command::new("mount").args(["-t", "tmpfs", "-o", "size=128k", "tmpfs", &disk]).stderr(Stdio::null()).status();
    if !mounted.is_ok_and(|status| status.success()) {
        eprintln!("skipped: only root can mount a small disk");
        return;
    }
    let out = format!("{disk}/out");
    let output = run(&["run", "platelets", "--steps", "60", "--out", &out, "--trajectories", "csv", "--every", "0"]);
    let sweep = run(&["sweep", "plan", "empty", "--steps", "2", "--seeds", "0..299"]);
    let plan = folder.file("plan.jsonl", &sweep.stdout);
    let sweep = run(&["sweep", "run", &plan, "--store", &format!("{disk}/store"), "--jobs", "1"]);
    let left = paths(Path::new(&disk));
    assert!(Command::new("umount").arg(&disk).status().unwrap().success());
    for output in [output, sweep] {
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        let said = stderr(&output);
        assert!(said.contains("No space left") && said.contains("free some space") && said.contains(&disk), "{said}");
    }
    assert!(left.iter().all(|path| !path.contains("partial")), "{left:?}");
}
