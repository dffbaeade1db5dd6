//! The files that a run leaves behind.

mod common;

use common::{Folder, run, stderr};
use std::fs;
use std::path::Path;
use std::process::Stdio;

/// Files that must not depend on anything but scenario, seed and steps.
const DATA: [&str; 5] = ["frame.svg", "frame.png", "frames.png", "measures.csv", "events.jsonl"];

fn write(folder: &Folder, out: &str, more: &[&str]) -> std::process::Output {
    let file = folder.crowd();
    let out = folder.path(out);
    run(&[&["run", &file, "--steps", "30", "--out", &out], more].concat())
}

fn size_of_png(path: &Path) -> (u32, u32) {
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert!(bytes.iter().any(|byte| *byte != bytes[0]), "the picture is empty");
    (info.width, info.height)
}

#[test]
fn equal_runs_leave_equal_bytes() {
    let folder = Folder::new("equal");
    for out in ["a", "b"] {
        let output = write(&folder, out, &["--seed", "5"]);
        assert!(output.status.success(), "{}", stderr(&output));
    }
    for name in DATA {
        let [a, b] = ["a", "b"].map(|out| fs::read(folder.root().join(out).join(name)).unwrap());
        assert!(!a.is_empty() || name == "events.jsonl", "{name}");
        assert_eq!(a, b, "{name}");
    }
    let names = fs::read_dir(folder.root().join("a")).unwrap();
    assert_eq!(names.count(), DATA.len() + 1, "nothing temporary is left");
}

#[test]
fn the_files_hold_what_they_say() {
    let folder = Folder::new("hold");
    assert!(write(&folder, "new/deep", &[]).status.success());
    let out = folder.root().join("new/deep");
    let (width, height) = size_of_png(&out.join("frame.png"));
    assert!(width == 1200 && (900..975).contains(&height), "{width} x {height}");
    size_of_png(&out.join("frames.png"));

    let svg = fs::read_to_string(out.join("frame.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert_eq!(svg.matches("<g ").count(), svg.matches("</g>").count());
    assert_eq!(svg.matches('<').count(), svg.matches('>').count());
    assert!(!svg.contains("NaN") && !svg.contains("inf"));

    let measures = fs::read_to_string(out.join("measures.csv")).unwrap();
    // The header, the start, and every sixth of 30 steps.
    assert_eq!(measures.lines().count(), 7);
    let header = measures.lines().next().unwrap();
    for column in ["step", "time", "organisms", "leaks", "improper_absorptions", "events", "ring_error_mean"] {
        assert!(header.split(',').any(|name| name == column), "{column}");
    }
    for line in fs::read_to_string(out.join("events.jsonl")).unwrap().lines() {
        let event: serde_json::Value = serde_json::from_str(line).unwrap();
        assert!(event["step"].is_u64() && event["kind"].is_string(), "{line}");
        assert!(event["organisms"][0].as_str().unwrap().contains(':'), "{line}");
    }
    let description = common::read_json(out.join("run.json"));
    assert_eq!(description["steps"], 30);
    assert_eq!(description["scenario_text"], common::crowd());
}

#[test]
fn a_folder_in_use_is_refused_and_untouched() {
    let folder = Folder::new("refused");
    fs::create_dir(folder.root().join("used")).unwrap();
    folder.file("used/mine.txt", b"precious");
    let output = write(&folder, "used", &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("--force"), "{}", stderr(&output));
    assert_eq!(fs::read_dir(folder.root().join("used")).unwrap().count(), 1);
    assert_eq!(fs::read(folder.root().join("used/mine.txt")).unwrap(), b"precious");
    assert_eq!(write(&folder, "used/mine.txt", &[]).status.code(), Some(2));
}

#[test]
fn force_keeps_the_files_of_others() {
    let folder = Folder::new("forced");
    fs::create_dir(folder.root().join("used")).unwrap();
    folder.file("used/mine.txt", b"precious");
    folder.file("used/frame.svg", b"old");
    let output = write(&folder, "used", &["--force"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(fs::read(folder.root().join("used/mine.txt")).unwrap(), b"precious");
    assert!(fs::read(folder.root().join("used/frame.svg")).unwrap().len() > 1000);
}

#[cfg(unix)]
#[test]
fn an_interrupt_still_leaves_complete_files() {
    let folder = Folder::new("interrupt");
    let out = folder.path("out");
    let file = folder.crowd();
    let arguments = ["run", &file, "--steps", "1000000000", "--out", &out];
    let mut child = common::heeding_signals(&arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    // Once the folder is there, the program listens.
    while !folder.root().join("out").exists() {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let description = common::read_json(folder.root().join("out/run.json"));
    assert_eq!(description["interrupted"], true);
    size_of_png(&folder.root().join("out/frame.png"));
}
