//! Killed at any moment, a run leaves nothing behind that cannot be read.
#![cfg(unix)]

mod common;

use common::{Folder, crowd, json, microsim, run, stderr};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::BufReader;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::Duration;

const TIMES: u64 = 20;
const STEPS: u64 = 300;
/// Steps from one frame to the next.
const PACE: u64 = 15;
const SIGKILL: i32 = 9;

/// Everything that can be written, and two cells that are told to fuse, which is an event each time.
const OUTPUT: &str = r#"
    [amoeboid_cell.small]
    radii = [5.0, 5.0]
    [[spawn]]
    of = "small"
    at = [10.0, 51.0]
    name = "one"
    [[spawn]]
    of = "small"
    at = [10.0, 9.0]
    name = "other"
    [[command]]
    of = "one"
    every = 0.1
    until = 9.0
    fuse = "other"
    [output]
    snapshots = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5]
    [output.measures]
    formats = ["csv", "jsonl"]
    every = 0.0
    [output.trajectories]
    formats = ["csv", "jsonl"]
    every = 0.0
    [output.frames]
    every = 0.25
    width = 64
"#;

/// What the killed runs must have left, all together.
const LEFT: [&str; 8] = [
    "measures.csv",
    "measures.jsonl",
    "trajectories.csv",
    "trajectories.jsonl",
    "events.jsonl",
    "00000015.png",
    "00000030.snapshot",
    "checkpoint",
];

#[test]
fn whatever_a_killed_run_leaves_is_whole_or_readable() {
    let folder = Folder::new("kill");
    let scenario = folder.file("crowd.toml", (crowd() + OUTPUT).as_bytes());
    let (mut landed, mut recorded, mut resumed, mut left) = (0, 0, 0, BTreeSet::new());
    for round in 0..TIMES {
        let trial = Trial::new(&folder, round);
        let mut child = trial.start(&scenario);
        trial.wait(&mut child);
        let _ = child.kill();
        let status = child.wait().unwrap();
        let is_midway = trial.out.join("frames").exists() && !trial.out.join("run.json").exists();
        landed += u64::from(status.signal() == Some(SIGKILL) && is_midway);
        left.extend(check_outputs(&trial.out, round));
        recorded = recorded.max(trial.check_record());
        resumed += u64::from(trial.resume());
    }
    assert!(landed >= TIMES / 4, "only {landed} runs were killed while they were going on");
    assert!(recorded > 0, "no record has any steps");
    assert!(resumed > 0, "no run could be resumed");
    let missing: Vec<_> = LEFT.iter().filter(|name| !left.contains(**name)).collect();
    assert!(missing.is_empty(), "nothing is left of {missing:?}");
}

/// A run that is to be killed. The first ones are recorded, the others have checkpoints.
struct Trial {
    round: u64,
    is_recorded: bool,
    out: PathBuf,
    record: String,
    saved: String,
}

impl Trial {
    fn new(folder: &Folder, round: u64) -> Self {
        let [out, record, saved] = ["out", "replay", "run"].map(|what| folder.path(&format!("{round}.{what}")));
        Self { round, is_recorded: round < TIMES / 2, out: out.into(), record, saved }
    }

    fn start(&self, scenario: &str) -> Child {
        let (out, steps) = (self.out.to_str().unwrap(), STEPS.to_string());
        let kept = ["--record", &self.record, "--digest-every", "5", "--save", &self.saved];
        let kept = if self.is_recorded { &kept[..] } else { &["--checkpoint-every", "7"] };
        let arguments = [&["run", scenario, "--steps", &steps, "--quiet", "--out", out][..], kept].concat();
        microsim(&arguments).stdout(Stdio::null()).spawn().unwrap()
    }

    /// Every fourth dies while it begins, every fourth while it ends, the others on their way, later and later.
    fn wait(&self, child: &mut Child) {
        let sign = match self.round % 4 {
            0 => return sleep(Duration::from_millis(self.round)),
            2 => "measures.csv".to_owned(),
            _ => format!("frames/{:08}.png", PACE * self.round),
        };
        while !self.out.join(&sign).exists() && child.try_wait().unwrap().is_none() {
            sleep(Duration::from_millis(1));
        }
        sleep(Duration::from_millis(self.round % 5));
    }

    /// Number of steps that can be played.
    fn check_record(&self) -> u64 {
        if Path::new(&self.saved).exists() {
            let output = run(&["diff", &self.saved, &self.record]);
            assert!(output.status.success(), "round {}: {}", self.round, stderr(&output));
        }
        if !Path::new(&self.record).exists() {
            return 0;
        }
        json(&["replay", &self.record, "--json", "--quiet"])["steps"].as_u64().unwrap()
    }

    /// Resumes from the last checkpoint, if there is one, and checks the finished files.
    fn resume(&self) -> bool {
        if !self.out.join("checkpoint").exists() {
            return false;
        }
        let output = run(&["resume", self.out.to_str().unwrap(), "--quiet"]);
        assert!(output.status.success(), "round {}: {}", self.round, stderr(&output));
        check_outputs(&self.out, self.round);
        let described = common::read_json(self.out.join("run.json"));
        let named = described["files"].as_object().unwrap().keys();
        assert!(named.clone().count() > LEFT.len() && named.clone().all(|name| self.out.join(name).exists()));
        true
    }
}

/// Checks all files of a folder. Returns the names, or those to be, of the ones with something in them.
fn check_outputs(folder: &Path, round: u64) -> BTreeSet<String> {
    let mut left = BTreeSet::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            left.extend(check_outputs(&path, round));
            continue;
        }
        let name = path.file_name().unwrap().to_str().unwrap();
        let unfinished = name.strip_suffix(".partial").map(|name| name.trim_start_matches('.'));
        let is_sound = unfinished.map_or_else(|| is_whole(&path, name), |name| is_readable(&path, name));
        assert!(is_sound, "round {round}: {name} is not whole");
        if fs::metadata(&path).unwrap().len() > 0 {
            left.insert(unfinished.unwrap_or(name).to_owned());
        }
    }
    left
}

/// A file under its own name.
fn is_whole(path: &Path, name: &str) -> bool {
    let content = fs::read(path).unwrap();
    match name.rsplit('.').next() {
        Some("png") => is_picture(path),
        Some("svg") => content.trim_ascii_end().ends_with(b"</svg>"),
        Some("json") => serde_json::from_slice::<Value>(&content).is_ok(),
        Some("jsonl" | "csv") => (content.is_empty() || content.ends_with(b"\n")) && are_rows(&content, name),
        Some("lock") => content.is_empty(),
        Some("snapshot" | "checkpoint") => run(&["inspect", path.to_str().unwrap()]).status.success(),
        Some(moment) if moment.starts_with("moment-") => is_raw_picture(&content),
        _ => false,
    }
}

/// A table grows under another name, and may end within a row. All else is written at once: nobody reads what is left of
/// it before it has its name.
fn is_readable(path: &Path, name: &str) -> bool {
    let content = fs::read(path).unwrap();
    let end = content.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
    match name.rsplit('.').next() {
        Some("jsonl" | "csv") => are_rows(&content[..end], name),
        Some("png" | "svg" | "json" | "snapshot" | "checkpoint") => true,
        Some(moment) => moment.starts_with("moment-"),
        None => false,
    }
}

/// Whether each line is an object, or has as many cells as the first.
fn are_rows(content: &[u8], name: &str) -> bool {
    let Ok(text) = std::str::from_utf8(content) else { return false };
    let columns = text.lines().next().map_or(0, |header| header.split(',').count());
    let is_row = |line: &str| match name.ends_with(".csv") {
        true => line.split(',').count() == columns,
        false => serde_json::from_str::<Value>(line).is_ok_and(|row| row.is_object()),
    };
    text.lines().all(is_row)
}

fn is_picture(path: &Path) -> bool {
    let decoder = png::Decoder::new(BufReader::new(File::open(path).unwrap()));
    let Ok(mut reader) = decoder.read_info() else { return false };
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).is_ok() && reader.finish().is_ok()
}

/// A picture that waits for the sheet: width, height, and three bytes per pixel.
fn is_raw_picture(content: &[u8]) -> bool {
    let side = |at: usize| content.get(at..at + 4).map(|side| u32::from_le_bytes(side.try_into().unwrap()) as usize);
    side(0).zip(side(4)).is_some_and(|(width, height)| content.len() == 8 + 3 * width * height)
}
