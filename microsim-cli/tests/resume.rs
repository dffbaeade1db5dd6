//! A stopped run can be resumed whatever has failed in between, and its folder is taken for no other.
#![cfg(unix)]

mod common;

use common::{Folder, crowd, heeding_signals, microsim, refused, run, stderr, success};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// The crowd with every kind of table that this build writes.
fn scenario() -> String {
    let parquet = if cfg!(feature = "parquet") { ", \"parquet\"" } else { "" };
    let output = format!(
        r#"
        [output]
        checkpoint_every = 5
        [output.measures]
        formats = ["csv", "jsonl"{parquet}]
        every = 0.0
        [output.trajectories]
        formats = ["csv"{parquet}]
        every = 0.0
    "#
    );
    crowd() + &output
}

/// A run that is never stopped by itself within a test.
fn start(folder: &Folder, out: &str) -> Child {
    let scenario = folder.file("crowd.toml", scenario().as_bytes());
    let mut command = heeding_signals(&["run", &scenario, "--steps", "100000000", "--out", out, "--quiet"]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while !Path::new(out).join("checkpoint").exists() {
        sleep(Duration::from_millis(2));
    }
    child
}

fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args(["-s", name, &child.id().to_string()]).status().unwrap().success());
}

/// A run of 300 steps that was stopped by `kill -9`, and its folder.
fn stopped(name: &str) -> (Folder, String) {
    let folder = Folder::new(name);
    let scenario = folder.file("crowd.toml", scenario().as_bytes());
    let out = folder.path("out");
    let mut child = microsim(&["run", &scenario, "--steps", "300", "--out", &out, "--quiet"]).spawn().unwrap();
    while !Path::new(&out).join("checkpoint").exists() {
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!Path::new(&out).join("run.json").exists(), "it was too late to stop it");
    success(&["run", &scenario, "--steps", "300", "--out", &folder.path("reference"), "--quiet"]);
    (folder, out)
}

/// All files but the lock, which a killed run leaves.
fn files(folder: impl AsRef<Path>) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .filter(|path| !path.ends_with(".lock"))
        .map(|path| (path.file_name().unwrap().into(), fs::read(&path).unwrap()))
        .collect()
}

/// Resumes the run and compares all of its files but `run.json`, which holds times.
fn check_resumed(folder: &Folder, out: &str) {
    success(&["resume", out, "--quiet"]);
    let (mut resumed, mut reference) = (files(out), files(folder.path("reference")));
    for files in [&mut resumed, &mut reference] {
        assert!(files.remove(Path::new("run.json")).is_some());
    }
    assert!(resumed.keys().eq(reference.keys()), "{:?}", resumed.keys());
    assert!(resumed == reference);
}

#[test]
fn a_folder_in_use_is_refused_and_not_touched() {
    let folder = Folder::new("in-use");
    let out = folder.path("out");
    let mut child = start(&folder, &out);
    signal(&child, "STOP");
    let before = files(&out);
    refused(&["resume", &out], "another run writes to it");
    refused(&["run", "empty", "--steps", "1", "--out", &out, "--force"], "another run writes to it");
    let is_untouched = files(&out) == before;
    signal(&child, "KILL");
    child.wait().unwrap();
    assert!(is_untouched);
}

#[test]
fn a_resumption_without_room_leaves_the_run_resumable() {
    let (folder, out) = stopped("no-room");
    // Blocks of 512 or 1024 bytes: less than the tables hold already.
    for _ in 0..2 {
        let limited =
            format!("trap '' XFSZ; ulimit -f 4; exec {:?} resume {out:?} --quiet", env!("CARGO_BIN_EXE_microsim"));
        let output = Command::new("sh").args(["-c", &limited]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    }
    check_resumed(&folder, &out);
}

#[test]
fn a_table_that_does_not_fit_its_checkpoint_is_refused_and_not_touched() {
    let (folder, out) = stopped("table");
    let table = Path::new(&out).join(".measures.csv.partial");
    let content = fs::read(&table).unwrap();
    let aside = folder.path("aside");
    let mut damaged = content.clone();
    damaged.iter_mut().filter(|byte| **byte == b'\n').for_each(|byte| *byte = b' ');
    for (damaged, words) in [(&content[..9], "shorter than its checkpoint"), (&damaged, "no end of a row")] {
        fs::write(&table, damaged).unwrap();
        let before = files(&out);
        refused(&["resume", &out], words);
        assert!(files(&out) == before);
    }
    fs::rename(&table, &aside).unwrap();
    symlink("/dev/zero", &table).unwrap();
    refused(&["resume", &out], "not a regular file");
    fs::rename(&aside, &table).unwrap();
    fs::write(&table, content).unwrap();
    check_resumed(&folder, &out);
}

/// Links to these targets and a pipe are refused in the place of a file of the run, which is put back.
fn refuse_in_place_of(name: &str, folder: &Folder, out: &str, targets: &[&str]) {
    let (path, aside) = (Path::new(out).join(name), folder.path("aside"));
    let is_there = fs::rename(&path, &aside).is_ok();
    for target in targets {
        symlink(target, &path).unwrap();
        refused(&["resume", out], "not a regular file");
        fs::remove_file(&path).unwrap();
    }
    assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
    refused(&["resume", out], "not a regular file");
    fs::remove_file(&path).unwrap();
    if is_there {
        fs::rename(&aside, &path).unwrap();
    }
}

#[test]
fn a_folder_that_leads_elsewhere_is_refused_and_nothing_of_others_is_touched() {
    let (folder, out) = stopped("elsewhere");
    let mine = folder.file("mine", b"precious\n");
    let place = folder.path("place");
    fs::create_dir(&place).unwrap();
    let fifo = folder.path("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    for name in
        [".lock", ".checkpoint.partial", ".measures.jsonl.partial", "run.json", "events.jsonl", ".events.jsonl.partial"]
    {
        refuse_in_place_of(name, &folder, &out, &[&mine, &folder.path("dangling"), &fifo]);
    }
    let frames = Path::new(&out).join("frames");
    symlink(&place, &frames).unwrap();
    refused(&["resume", &out], "not a regular file");
    fs::remove_file(&frames).unwrap();
    assert_eq!(fs::read(&mine).unwrap(), b"precious\n");
    assert!(!Path::new(&folder.path("dangling")).exists() && fs::read_dir(&place).unwrap().next().is_none());
    check_resumed(&folder, &out);
}

#[test]
fn what_has_the_name_of_a_temporary_file_is_replaced_and_not_followed() {
    let folder = Folder::new("temporary");
    let (mine, out) = (folder.file("mine", b"precious\n"), folder.path("out"));
    fs::create_dir(&out).unwrap();
    symlink(&mine, Path::new(&out).join(".measures.csv.partial")).unwrap();
    assert!(Command::new("mkfifo").arg(Path::new(&out).join(".events.jsonl.partial")).status().unwrap().success());
    success(&["run", "empty", "--steps", "3", "--out", &out, "--force", "--measures", "csv", "--no-pictures"]);
    assert_eq!(fs::read(&mine).unwrap(), b"precious\n");
    assert!(fs::symlink_metadata(Path::new(&out).join("measures.csv")).unwrap().is_file());
    symlink(&mine, Path::new(&out).join(".lock")).unwrap();
    refused(&["run", "empty", "--steps", "3", "--out", &out, "--force"], "not a regular file");
}

#[test]
fn a_resumed_run_leaves_nothing_behind_that_only_an_unfinished_one_needs() {
    let (folder, out) = stopped("behind");
    let waiting = |name: &str| name.starts_with(".moment-");
    let names = || files(&out).into_keys().map(|name| name.display().to_string()).collect::<Vec<_>>();
    assert!(names().iter().any(|name| waiting(name)), "{:?}", names());
    check_resumed(&folder, &out);
    assert!(names().iter().all(|name| !name.starts_with('.')), "{:?}", names());
    assert!(!names().contains(&"checkpoint".to_owned()));
}

#[test]
fn a_limit_on_the_length_of_files_is_an_error_in_words() {
    let (folder, out) = stopped("limit");
    let limited = format!("ulimit -f 4; exec {:?} resume {out:?} --quiet", env!("CARGO_BIN_EXE_microsim"));
    let output = Command::new("sh").args(["-c", &limited]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("File too large"), "{}", stderr(&output));
    check_resumed(&folder, &out);
}

#[test]
fn signals_stop_a_run_that_can_be_resumed() {
    for (name, code) in [("INT", 130), ("TERM", 143), ("HUP", 129)] {
        let folder = Folder::new(&format!("signal-{name}"));
        let out = folder.path("out");
        let mut child = start(&folder, &out);
        signal(&child, name);
        assert_eq!(child.wait().unwrap().code(), Some(code), "{name}");
        let mut child = heeding_signals(&["resume", &out, "--quiet"]).stdout(Stdio::null()).spawn().unwrap();
        sleep(Duration::from_millis(1000));
        signal(&child, name);
        assert_eq!(child.wait().unwrap().code(), Some(code), "{name}, resumed");
    }
}

#[test]
fn what_is_no_regular_file_is_refused() {
    let folder = Folder::new("devices");
    let fifo = folder.path("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let out = folder.path("out");
    for path in ["/dev/zero", &fifo] {
        for arguments in [
            &["inspect", path][..],
            &["replay", path],
            &["diff", path, path],
            &["check", path],
            &["report", path, "-o", &out],
            &["sweep", "status", path, "--store", &folder.path("store")],
        ] {
            refused(arguments, "not a regular file");
        }
    }
    assert!(run(&["list"]).status.success());
}
