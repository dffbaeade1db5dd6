//! Outputs that are chosen in the scenario or by flags, and runs that are stopped and resumed.

mod common;

use common::{Folder, read_json, refused, run, stderr, success};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Everything that is in a folder but for what depends on the clock, by name.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            all.extend(content(&entry.path()).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else if name != "run.json" {
            all.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    all
}

const CHOSEN: &str = "[output]\nsnapshots = [0.25]\nevents = false\npictures = false\n\
[output.measures]\nformats = ['csv', 'jsonl', 'csv']\nevery = 0.0\nof = ['leaks', 'bodies']\n\
[output.trajectories]\nformats = ['csv', 'jsonl']\n[output.frames]\nat = [0.1]\nwidth = 200\n";

#[test]
fn a_scenario_chooses_its_outputs() {
    let folder = Folder::new("chosen");
    let file = folder.file("s.toml", (common::crowd() + CHOSEN).as_bytes());
    success(&["run", &file, "--steps", "30", "--out", &folder.path("out")]);
    let files = content(&folder.root().join("out"));
    let names: Vec<&str> = files.keys().map(String::as_str).collect();
    let expected = [
        "frames/00000006.png",
        "measures.csv",
        "measures.jsonl",
        "snapshots/00000015.snapshot",
        "trajectories.csv",
        "trajectories.jsonl",
    ];
    assert_eq!(names, expected);
    let measures = String::from_utf8(files["measures.csv"].clone()).unwrap();
    assert_eq!(measures.lines().next(), Some("step,time,events,leaks,bodies"));
    assert_eq!(measures.lines().count(), 32);
    let line: serde_json::Value =
        serde_json::from_slice(files["trajectories.jsonl"].split(|b| *b == b'\n').next().unwrap()).unwrap();
    assert_eq!((&line["step"], &line["kind"], &line["x"]), (&0.into(), &"amoeboid_cell".into(), &25.0.into()));
    // Every file is in the description, with its digest.
    let described = read_json(folder.root().join("out/run.json"));
    assert_eq!(described["files"].as_object().unwrap().keys().collect::<Vec<_>>(), names.iter().collect::<Vec<_>>());
    assert_eq!(described["files"]["measures.csv"].as_str().unwrap().len(), 64);
}

#[test]
fn the_effective_scenario_makes_the_same_run() {
    let folder = Folder::new("effective");
    let out = |name: &str| folder.path(name);
    let arguments = ["run", "platelets", "--set", "count=7", "--seed", "4", "--steps", "20", "--no-pictures", "--out"];
    success(&[&arguments[..], &[&out("a")]].concat());
    let first = read_json(folder.root().join("a/run.json"));
    let file = folder.file("effective.toml", first["effective_scenario"].as_str().unwrap().as_bytes());
    success(&["run", &file, "--steps", "20", "--out", &out("b")]);
    let second = read_json(folder.root().join("b/run.json"));
    assert_eq!(first["digest"], second["digest"]);
    assert_eq!(first["files"], second["files"]);
    assert_eq!(first["effective_scenario"], second["effective_scenario"]);
}

#[test]
fn a_dry_run_writes_nothing() {
    let folder = Folder::new("dry");
    let output = run(&["run", "empty", "--out", &folder.path("out"), "--dry-run"]);
    assert!(output.status.success() && common::stdout(&output).contains("would take"), "{}", stderr(&output));
    assert!(!folder.root().join("out").exists());
}

/// All formats that can be resumed, and pictures.
const STREAMS: &str = "[output]\ncheckpoint_every = 7\nsnapshots = [0.5]\n[output.measures]\nformats = ['csv', 'jsonl']\n\
[output.trajectories]\nformats = ['csv', 'jsonl']\n[output.frames]\nat = [0.2]\nwidth = 100\n\
[invariants]\norganisms = 3\n[[spawn]]\nof = 'food'\nat = [10, 10]\nname = 'f'\n";

/// A reference and the digests that a run has, however often it is stopped.
struct Trial {
    folder: Folder,
    scenario: String,
    reference: BTreeMap<String, Vec<u8>>,
    /// Time that the whole run takes.
    length: Duration,
}

impl Trial {
    const STEPS: &'static str = "400";

    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        let scenario = folder.file("s.toml", (common::crowd() + STREAMS).as_bytes());
        let start = Instant::now();
        let output = run(&["run", &scenario, "--steps", Self::STEPS, "--out", &folder.path("whole")]);
        let length = start.elapsed();
        assert_eq!(output.status.code(), Some(1), "an invariant breaks at once: {}", stderr(&output));
        let reference = content(&folder.root().join("whole"));
        Self { folder, scenario, reference, length }
    }

    /// Starts or resumes the run and stops it after a time. Returns whether it finished first.
    fn stop_after(&self, out: &str, first: bool, after: Duration, signal: &str) -> bool {
        let start = ["run", &self.scenario, "--steps", Self::STEPS, "--out", out];
        let resume = ["resume", out];
        let mut command = common::heeding_signals(if first { &start[..] } else { &resume[..] });
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(after);
        let _ = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
        let code = child.wait().unwrap().code();
        assert!(matches!(code, None | Some(1 | 130)), "{signal} {code:?}");
        code == Some(1)
    }

    fn has(&self, name: &str, file: &str) -> bool {
        self.folder.root().join(name).join(file).exists()
    }

    /// Stops a run at up to three moments. Returns whether it has to begin again.
    fn stop(&self, k: u64, name: &str, stops: &mut u64, length: &mut Duration) -> bool {
        let out = self.folder.path(name);
        let signal = if k.is_multiple_of(2) { "-KILL" } else { "-INT" };
        let (mut first, before) = (true, *stops);
        while *stops < before + 3 {
            let share = 5 + (k * 7919 + *stops * 104_729) % 90;
            let after = *length * share as u32 / 100;
            if self.stop_after(&out, first, after, signal) {
                *length = *length * 3 / 4;
                if *stops > before {
                    break;
                }
                let _ = fs::remove_dir_all(&out);
                first = true;
                continue;
            }
            *stops += 1;
            // Killed before its first checkpoint it has to begin again.
            first = !self.has(name, "checkpoint");
            if first {
                let _ = fs::remove_dir_all(&out);
            }
        }
        first
    }

    /// Runs to the end, from the beginning or from the last checkpoint.
    fn finish(&self, name: &str, first: bool) {
        let out = self.folder.path(name);
        let again = if first {
            vec!["run", &self.scenario, "--steps", Self::STEPS, "--out", &out]
        } else {
            vec!["resume", &out]
        };
        let output = run(&again);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    }

    fn check(&self, name: &str) {
        let out = self.folder.root().join(name);
        let files = content(&out);
        assert_eq!(files.keys().collect::<Vec<_>>(), self.reference.keys().collect::<Vec<_>>(), "{name}");
        for (file, bytes) in &files {
            assert_eq!(bytes, &self.reference[file], "{name}: {file}");
        }
        let [whole, resumed] = [self.folder.root().join("whole"), out].map(|folder| read_json(folder.join("run.json")));
        for field in
            ["digest", "digest_at_start", "steps", "events", "failures", "leaks", "files", "effective_scenario"]
        {
            assert_eq!(whole[field], resumed[field], "{name}: {field}");
        }
    }
}

#[cfg(unix)]
#[test]
fn a_run_that_is_stopped_at_20_moments_is_resumed_to_the_same_bytes() {
    let trial = Trial::new("resume");
    // The machine may be busier now than later: a run that ends before it is stopped shortens what is waited for.
    let (mut stops, mut length) = (0, trial.length);
    // 20 different moments, half of them killed, half interrupted; some runs are stopped several times.
    for k in 0..20 {
        let name = format!("stopped-{k}");
        let first = trial.stop(k, &name, &mut stops, &mut length);
        if !trial.has(&name, "run.json") {
            trial.finish(&name, first);
        }
        trial.check(&name);
    }
    assert!(stops >= 20, "only {stops} stops");
}

#[test]
fn inspect_says_what_is_in_a_file() {
    let folder = Folder::new("inspect");
    let out = folder.path("out");
    let arguments = ["run", "empty", "--steps", "30", "--snapshots", "0.25", "--out", &out];
    success(&arguments);
    let output = run(&["inspect", &format!("{out}/snapshots/00000015.snapshot")]);
    let text = common::stdout(&output);
    assert!(text.contains("snapshot of a world") && text.contains("15 (0.25 s)"), "{text}{}", stderr(&output));
    let other = folder.file("other", b"something else");
    refused(&["inspect", &other], "accepted: ");
}

#[test]
fn a_finished_run_has_nothing_to_resume() {
    let folder = Folder::new("finished");
    let out = folder.path("out");
    success(&["run", "empty", "--steps", "5", "--checkpoint-every", "2", "--out", &out]);
    refused(&["resume", &out], "its run is finished");
}

#[cfg(feature = "parquet")]
#[test]
fn a_parquet_file_has_the_rows_of_the_other_formats() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;
    let folder = Folder::new("parquet");
    let file = folder.file("s.toml", common::crowd().as_bytes());
    for out in ["a", "b"] {
        let arguments =
            ["run", &file, "--steps", "30", "--measures", "csv,parquet", "--trajectories", "parquet", "--out"];
        success(&[&arguments[..], &[&folder.path(out)]].concat());
    }
    let [a, b] = ["a", "b"].map(|out| content(&folder.root().join(out)));
    assert!(a == b && a.contains_key("trajectories.parquet") && !a.keys().any(|name| name.ends_with("-rows")));
    let csv = String::from_utf8(a["measures.csv"].clone()).unwrap();
    let reader = SerializedFileReader::new(fs::File::open(folder.root().join("a/measures.parquet")).unwrap()).unwrap();
    let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    assert_eq!(rows.len() + 1, csv.lines().count());
    for (row, line) in rows.iter().zip(csv.lines().skip(1)) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(row.get_long(0).unwrap() as f64, cells[0]);
        assert!((3..cells.len()).all(|k| row.get_double(k).unwrap() as f32 == cells[k] as f32), "{line}");
    }
}

#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_is_refused_where_it_was_not_built_in() {
    let folder = Folder::new("no-parquet");
    let output = run(&["run", "empty", "--measures", "parquet", "--out", &folder.path("out")]);
    assert!(output.status.code() == Some(2) && stderr(&output).contains("--features parquet"), "{}", stderr(&output));
    assert!(!folder.root().join("out").exists());
}
