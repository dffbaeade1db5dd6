//! Sweeps: the merged result does not depend on who ran which task, when and how often.

mod common;

use common::{Folder, heeding_signals, run, stderr, stdout, success};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Tasks of the sweep.
const TASKS: usize = 200;

/// A plan and what it comes to when one worker runs it.
struct Trial {
    folder: Folder,
    plan: String,
    reference: Vec<u8>,
}

impl Trial {
    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        let scenario = folder.crowd();
        let grid =
            ["--grid", "agar.food.radius=0.8..1.2/5", "--grid", "amoeboid_cell.cell.speed=4,8", "--seeds", "0..19"];
        let output = success(&[&["sweep", "plan", &scenario, "--steps", "8"], &grid[..]].concat());
        assert_eq!(stdout(&output).lines().count(), TASKS);
        let plan = folder.file("plan.jsonl", &output.stdout);
        let mut trial = Self { folder, plan, reference: Vec::new() };
        assert_eq!(trial.work("one", &["--jobs", "1"]), Some(0));
        trial.reference = trial.merge("one");
        assert_eq!(trial.reference.split(|byte| *byte == b'\n').count(), TASKS + 1);
        trial
    }

    fn work(&self, store: &str, more: &[&str]) -> Option<i32> {
        let store = self.folder.path(store);
        run(&[&["sweep", "run", &self.plan, "--store", &store], more].concat()).status.code()
    }

    fn merge(&self, store: &str) -> Vec<u8> {
        let (store, file) = (self.folder.path(store), self.folder.path(&format!("{store}.jsonl")));
        success(&["sweep", "merge", &self.plan, "--store", &store, "-o", &file]);
        fs::read(file).unwrap()
    }

    fn done(&self, store: &str) -> usize {
        let results = fs::read_dir(self.folder.path(store)).map(|entries| entries.flatten().collect::<Vec<_>>());
        let is_result = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().len() == 32 + ".json".len();
        results.unwrap_or_default().iter().filter(|entry| is_result(entry)).count()
    }

    /// Starts work and ends it with a signal once some tasks are done.
    fn stop(&self, store: &str, signal: &str) -> Option<i32> {
        let folder = self.folder.path(store);
        let mut command = heeding_signals(&["sweep", "run", &self.plan, "--store", &folder, "--jobs", "2"]);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        while self.done(store) < 10 && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(5));
        }
        let _ = Command::new("kill").args([signal, &child.id().to_string()]).status();
        child.wait().unwrap().code()
    }
}

#[cfg(unix)]
#[test]
fn a_sweep_of_200_tasks_comes_to_the_same_however_it_is_run() {
    let trial = Trial::new("sweep");
    assert_eq!(trial.work("two", &["--jobs", "2"]), Some(0));
    assert!(trial.merge("two") == trial.reference, "two jobs");
    for shard in ["2/4", "0/4", "3/4", "1/4"] {
        assert_eq!(trial.work("shards", &["--shard", shard]), Some(0));
    }
    assert!(trial.merge("shards") == trial.reference, "shards");

    assert_eq!(trial.stop("killed", "-KILL"), None);
    let done = trial.done("killed");
    assert!((10..TASKS).contains(&done), "{done} done when it was killed");
    let store = trial.folder.path("killed");
    let status = run(&["sweep", "status", &trial.plan, "--store", &store]);
    assert_eq!((status.status.code(), stdout(&status).lines().count()), (Some(1), TASKS - done));
    let early = run(&["sweep", "merge", &trial.plan, "--store", &store, "-o", &trial.folder.path("early.jsonl")]);
    assert!(early.status.code() == Some(1) && !trial.folder.root().join("early.jsonl").exists());
    assert!(stderr(&early).contains(stdout(&status).lines().next().unwrap()), "missing keys are listed");
    assert_eq!(trial.work("killed", &[]), Some(0));
    assert!(trial.merge("killed") == trial.reference, "killed");

    assert_eq!(trial.stop("interrupted", "-INT"), Some(130));
    assert!(trial.done("interrupted") < TASKS);
    assert_eq!(trial.work("interrupted", &[]), Some(0));
    assert!(trial.merge("interrupted") == trial.reference, "interrupted");
    // Work that is done is not done again.
    let before = fs::metadata(trial.folder.root().join("killed")).unwrap().modified().unwrap();
    assert_eq!(trial.work("killed", &[]), Some(0));
    assert_eq!(fs::metadata(trial.folder.root().join("killed")).unwrap().modified().unwrap(), before);
}

#[test]
fn one_task_alone_is_run_by_run() {
    let folder = Folder::new("task");
    let plan = run(&["sweep", "plan", "empty", "--steps", "3", "--seeds", "1,2"]);
    let store = folder.path("store");
    let second = folder.file("task.jsonl", stdout(&plan).lines().nth(1).unwrap().as_bytes());
    for told in ["1 run, 0 found", "0 run, 1 found"] {
        let output = run(&["run", "--task", &second, "--store", &store]);
        assert!(output.status.success() && stderr(&output).contains(told), "{}", stderr(&output));
    }
    let plan = folder.file("plan.jsonl", &plan.stdout);
    let partial = run(&["sweep", "merge", &plan, "--store", &store, "-o", "-", "--partial"]);
    assert!(partial.status.success() && stdout(&partial).lines().count() == 1);
}

#[test]
fn a_task_that_breaks_an_invariant_has_a_result_and_says_so() {
    let folder = Folder::new("broken-task");
    let plan = run(&["sweep", "plan", "empty", "--steps", "3", "--set", "invariants.bodies=[5, 9]"]);
    let plan = folder.file("plan.jsonl", &plan.stdout);
    for _ in 0..2 {
        let output = run(&["sweep", "run", &plan, "--store", &folder.path("store")]);
        assert_eq!(output.status.code(), Some(1));
        assert!(stderr(&output).contains("bodies is 0 after step 1"), "{}", stderr(&output));
    }
    let status = success(&["sweep", "status", &plan, "--store", &folder.path("store")]);
    assert!(stderr(&status).contains("1 of 1 tasks done, 1 with failures"), "{}", stderr(&status));
    let merged = run(&["sweep", "merge", &plan, "--store", &folder.path("store"), "-o", "-"]);
    assert!(merged.status.success() && stdout(&merged).contains("bodies is 0"));
}

/// The Python with HyperQueue in it: `MICROSIM_HYPERQUEUE_PYTHON`, or the one on the path.
fn python() -> String {
    std::env::var("MICROSIM_HYPERQUEUE_PYTHON").unwrap_or_else(|_| "python3".to_owned())
}

#[cfg(unix)]
#[test]
fn a_hyperqueue_cluster_comes_to_the_same_although_it_is_killed_in_the_middle() {
    let has_it = Command::new(python()).args(["-c", "import hyperqueue"]).stderr(Stdio::null()).status();
    if !has_it.is_ok_and(|status| status.success()) {
        eprintln!("skipped: HyperQueue is not there; pip install hyperqueue, or set MICROSIM_HYPERQUEUE_PYTHON");
        return;
    }
    let trial = Trial::new("hyperqueue");
    // The first task breaks an invariant; all others are run nevertheless.
    let broken = success(&["sweep", "plan", "empty", "--steps", "3", "--set", "invariants.bodies=[5, 9]"]);
    let tasks = [broken.stdout, fs::read(&trial.plan).unwrap()].concat();
    let plan = trial.folder.file("with-broken.jsonl", &tasks);
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/common/hyperqueue_sweep.py");
    let store = trial.folder.path("cluster");
    let cluster = || {
        let mut command = Command::new(python());
        command.arg(&script).args([env!("CARGO_BIN_EXE_microsim"), &plan, &store]).arg(trial.folder.path("hq"));
        // Every task leaves its output where the cluster was started.
        command.stdout(Stdio::null()).stderr(Stdio::null()).current_dir(trial.folder.root());
        command
    };
    let mut first = cluster().spawn().unwrap();
    while trial.done("cluster") < 10 && first.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(5));
    }
    // Server and workers are threads of one process.
    first.kill().unwrap();
    first.wait().unwrap();
    let done = trial.done("cluster");
    assert!((10..TASKS).contains(&done), "{done} done when the cluster was killed");
    assert!(cluster().status().unwrap().success());
    assert_eq!(trial.done("cluster"), TASKS + 1);
    assert!(trial.merge("cluster") == trial.reference);
}

/// A plan of two tasks, and the names of their results.
fn two_tasks(folder: &Folder, more: &[&str]) -> (String, Vec<String>) {
    let plan = success(&[&["sweep", "plan", "empty", "--steps", "3", "--grid", "world.damping=0.5,1"], more].concat());
    let text = stdout(&plan);
    let names = text.lines().map(|line| {
        let task: serde_json::Value = serde_json::from_str(line).unwrap();
        format!("{}.json", task["key"].as_str().unwrap())
    });
    (folder.file("plan.jsonl", &plan.stdout), names.collect())
}

#[test]
fn a_torn_or_swapped_result_counts_as_missing_and_is_made_again() {
    let folder = Folder::new("torn");
    let (plan, names) = two_tasks(&folder, &[]);
    let store = folder.path("store");
    success(&["sweep", "run", &plan, "--store", &store]);
    let [one, other] = [0, 1].map(|k| Path::new(&store).join(&names[k]));
    let sound = fs::read(&one).unwrap();
    for bad in [&sound[..sound.len() / 2], b"", b"\xff", &fs::read(&other).unwrap()] {
        fs::write(&one, bad).unwrap();
        let status = run(&["sweep", "status", &plan, "--store", &store]);
        assert_eq!((status.status.code(), stdout(&status).lines().count()), (Some(1), 1));
        success(&["sweep", "run", &plan, "--store", &store]);
        assert!(fs::read(&one).unwrap() == sound);
    }
}

#[test]
fn a_result_that_cannot_be_read_is_named_and_not_taken_for_missing() {
    let folder = Folder::new("unreadable");
    let (plan, names) = two_tasks(&folder, &[]);
    let store = folder.path("store");
    success(&["sweep", "run", &plan, "--store", &store]);
    let one = Path::new(&store).join(&names[0]);
    fs::remove_file(&one).unwrap();
    fs::create_dir(&one).unwrap();
    common::refused(&["sweep", "status", &plan, "--store", &store], &names[0]);
}

#[test]
fn a_task_whose_parameters_were_changed_is_refused() {
    let folder = Folder::new("swapped");
    let (plan, _) = two_tasks(&folder, &[]);
    let text = fs::read_to_string(&plan).unwrap();
    let swapped = text.replace(r#""world.damping":"0.5""#, r#""world.damping":"1""#);
    assert_ne!(swapped, text);
    let plan = folder.file("swapped.jsonl", swapped.as_bytes());
    common::refused(&["sweep", "run", &plan, "--store", &folder.path("store")], "plan it again");
}

#[test]
fn a_task_that_keeps_going_exits_with_0_and_names_what_broke() {
    let folder = Folder::new("keep-going");
    let (plan, _) = two_tasks(&folder, &["--set", "invariants.bodies=[5, 9]"]);
    let store = folder.path("store");
    let output = success(&["run", "--task", &plan, "--store", &store, "--keep-going"]);
    assert!(stderr(&output).contains("bodies is 0"), "{}", stderr(&output));
    let merged = success(&["sweep", "merge", &plan, "--store", &store, "-o", "-"]);
    assert_eq!(stdout(&merged).matches("bodies is 0").count(), 2);
    assert_eq!(run(&["run", "--task", &plan, "--store", &store]).status.code(), Some(1));
}
