//! Killed at any moment, a run leaves nothing behind that cannot be read.

mod common;

use common::{Folder, crowd, microsim, run, stderr};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

const TIMES: u64 = 20;

#[test]
fn whatever_a_killed_run_leaves_is_whole_or_readable() {
    let folder = Folder::new("kill");
    let scenario = folder.file("crowd.toml", crowd().as_bytes());
    let (mut records, mut longest) = (0, 0);
    for round in 0..TIMES {
        let out = folder.path(&format!("out-{round}"));
        let (record, saved) = (folder.path(&format!("{round}.replay")), folder.path(&format!("{round}.run")));
        let files = ["--record", &record, "--digest-every", "5", "--save", &saved, "--out", &out];
        let arguments = [&["run", &scenario, "--steps", "400", "--quiet"][..], &files].concat();
        let mut child = microsim(&arguments).stdout(Stdio::null()).spawn().unwrap();
        // Every other one dies while it begins, the others later and later, some after the end.
        let begins = round % 2 == 0;
        let started = (0..5000).take_while(|_| !begins && !Path::new(&record).exists());
        started.for_each(|_| sleep(Duration::from_millis(2)));
        sleep(Duration::from_millis(if begins { round } else { 3 * round * round }));
        let _ = child.kill();
        child.wait().unwrap();
        if Path::new(&record).exists() {
            records += 1;
            let output = run(&["replay", &record, "--json"]);
            assert!(output.status.success(), "round {round}: {}", stderr(&output));
            let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
            longest = longest.max(report["steps"].as_u64().unwrap());
        }
        if Path::new(&saved).exists() {
            let output = run(&["diff", &saved, &record]);
            assert!(output.status.success(), "round {round}: {}", stderr(&output));
        }
        check_outputs(Path::new(&out), round);
    }
    assert!(records > 0 && longest > 0, "no run lived long enough to leave anything");
}

/// A file under its own name is whole; what was not finished has another.
fn check_outputs(folder: &Path, round: u64) {
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let content = fs::read(&path).unwrap();
        let is_whole = match path.extension().and_then(|extension| extension.to_str()) {
            Some("partial") => continue,
            Some("png") => content.starts_with(b"\x89PNG") && content.windows(4).any(|chunk| chunk == b"IEND"),
            Some("svg") => content.trim_ascii_end().ends_with(b"</svg>"),
            Some("json") => serde_json::from_slice::<serde_json::Value>(&content).is_ok(),
            Some("jsonl") => content.is_empty() || content.ends_with(b"}\n"),
            Some("csv") => content.ends_with(b"\n"),
            _ => false,
        };
        assert!(is_whole, "round {round}: {name} is not whole");
    }
}
