//! Every call that changes a file fails once, in each way: afterwards the old state or the new one is whole.
//!
//! The method is SQLite's (<https://www.sqlite.org/testing.html>, I/O error and crash testing): the work is repeated with the
//! next call failing until none is left, and a power cut loses what was written since the last sync: of a file its content, of a
//! folder its names.
//! `cargo test -p microsim-cli --lib fault_tests -- --nocapture` prints how many calls failed.

use crate::args::Args;
use crate::console::Console;
use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::output::fault::{self, Fault};
use crate::output::{CHECKPOINT, Outputs};
use crate::prepared::Prepared;
use crate::record_args::RecordArgs;
use crate::scenario_args::Changes;
use crate::session::Session;
use crate::verbs::{self, Task};
use clap::{CommandFactory, Parser};
use microsim_core::replay::{Ending, Replay};
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};

const FAULTS: [Fault; 6] = [
    // EIO has no kind of its own.
    Fault::Once(ErrorKind::Other),
    Fault::Once(ErrorKind::StorageFull),
    Fault::Once(ErrorKind::Interrupted),
    Fault::Crash,
    Fault::PowerCut,
    Fault::LostNames,
];

const SCENARIO: &str = r#"
    schema = 1
    name = "faults"
    duration = 0.1
    [world]
    size = [80.0, 60.0]
    [platelet.stone]
    radius = 2.5
    [[spawn]]
    of = "stone"
    at = [40.0, 30.0]
    [output]
    snapshots = [0.05]
    checkpoint_every = 2
    [output.measures]
    formats = ["csv", "jsonl"]
    every = 0.0
    [output.trajectories]
    formats = ["csv"]
    every = 0.0
    [output.frames]
    at = [0.05]
    width = 32
"#;

/// The scenario, with a table in every format that this build writes.
fn scenario() -> String {
    if cfg!(feature = "parquet") {
        SCENARIO.replace("\"jsonl\"]", "\"jsonl\", \"parquet\"]")
    } else {
        SCENARIO.to_owned()
    }
}

type Contents = BTreeMap<PathBuf, Vec<u8>>;

/// A folder of its own that is removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("microsim-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// An empty place.
    fn cleared(&self, name: &str) -> PathBuf {
        let path = self.0.join(name);
        let _ = fs::remove_dir_all(&path);
        path
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn quiet() -> Console {
    Console::new(clap::ColorChoice::Never, true, false)
}

fn prepared(seed: u64, set: Vec<(String, String)>) -> Prepared {
    let source = ScenarioText::new("faults".to_owned(), scenario());
    Prepared::new(source, &Changes { seed: Some(seed), set }).unwrap_or_else(|failure| panic!("{failure:?}"))
}

fn run(folder: &Path, has_pictures: bool, steps: u64) -> Result<(), Failure> {
    run_with(folder, steps, "output.pictures", &has_pictures.to_string())
}

fn run_with(folder: &Path, steps: u64, key: &str, value: &str) -> Result<(), Failure> {
    let set = [("output.pictures", "false"), (key, value)].map(|(key, value)| (key.to_owned(), value.to_owned()));
    let prepared = prepared(0, set.into());
    let record = RecordArgs { record: None, digest_every: NonZeroU32::MIN, save: None };
    let outputs = Outputs::open(folder, true)?;
    Session::start(prepared, steps, Some(&outputs), false, &record)?.complete(&quiet()).map(drop)
}

fn resume(folder: &Path) -> Result<(), Failure> {
    let outputs = Outputs::reopen(folder)?;
    Session::resume(&outputs)?.complete(&quiet()).map(drop)
}

/// All files but `run.json`, which holds times.
fn results(folder: &Path) -> Contents {
    let mut all = contents(folder);
    assert!(all.remove(Path::new("run.json")).is_some(), "no run.json in {folder:?}");
    all.retain(|path, _| !path.file_name().unwrap().to_string_lossy().starts_with('.'));
    all
}

fn contents(folder: &Path) -> Contents {
    let mut all = Contents::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for path in fs::read_dir(next).into_iter().flatten().map(|entry| entry.unwrap().path()) {
            match path.is_dir() {
                true => folders.push(path),
                false => drop(all.insert(path.strip_prefix(folder).unwrap().to_owned(), fs::read(&path).unwrap())),
            }
        }
    }
    all
}

fn copy(from: &Path, to: &Path) {
    for (name, content) in contents(from) {
        fs::create_dir_all(to.join(&name).parent().unwrap()).unwrap();
        fs::write(to.join(name), content).unwrap();
    }
}

/// Completes what a failed run has left, as a user would.
fn complete(folder: &Path, has_pictures: bool, steps: u64) {
    if folder.join(CHECKPOINT).exists() {
        resume(folder).unwrap_or_else(|failure| panic!("{failure:?}"));
    } else if !folder.join("run.json").exists() {
        run(folder, has_pictures, steps).unwrap_or_else(|failure| panic!("{failure:?}"));
    }
}

/// Fails each call of some work in each way. What interrupts must not show.
fn try_all(faults: &[Fault], work: impl Fn() -> Result<(), Failure>, check: impl Fn(&str)) {
    let (result, calls) = fault::with(None, &work);
    assert!(result.is_ok() && calls > 0, "{result:?}");
    println!("{calls} calls, {} runs", calls * faults.len() as u64);
    for number in 0..calls {
        for &planned in faults {
            let (result, _) = fault::with(Some((number, planned)), &work);
            let is_silent = planned == Fault::Once(ErrorKind::Interrupted);
            assert!(!is_silent || result.is_ok(), "call {number}: {result:?}");
            check(&format!("call {number} of {calls}, {planned:?}: {result:?}"));
        }
    }
}

fn a_run_survives(name: &str, faults: &[Fault], has_pictures: bool, steps: u64) {
    let scratch = Scratch::new(name);
    let reference = scratch.cleared("reference");
    run(&reference, has_pictures, steps).ok().unwrap();
    let reference = results(&reference);
    let work = || run(&scratch.cleared("run"), has_pictures, steps);
    try_all(faults, work, |what| {
        let folder = scratch.0.join("run");
        complete(&folder, has_pictures, steps);
        assert!(results(&folder) == reference, "{what}");
    });
}

#[test]
fn a_run_survives_every_fault() {
    a_run_survives("run", &FAULTS, false, 5);
}

#[test]
fn pictures_survive_every_power_cut() {
    a_run_survives("pictures", &[Fault::PowerCut, Fault::LostNames], true, 2);
}

#[test]
fn a_finished_run_is_on_the_disk() {
    let scratch = Scratch::new("finished");
    let folder = scratch.cleared("run");
    fault::with(None, || run(&folder, true, 5)).0.ok().unwrap();
    let finished = results(&folder);
    fault::cut_power(Fault::LostNames);
    let mut left = results(&folder);
    // The removal of the checkpoint is taken back too, which does no harm.
    left.remove(Path::new(CHECKPOINT));
    assert!(left == finished);
}

#[test]
fn a_stopped_run_survives_every_fault_of_its_resumption() {
    let scratch = Scratch::new("resume");
    let reference = scratch.cleared("reference");
    let (_, calls) = fault::with(None, || run(&reference, false, 5));
    let reference = results(&reference);
    for share in 1..4 {
        let stopped = scratch.cleared("stopped");
        let _ = fault::with(Some((calls * share / 4, Fault::Crash)), || run(&stopped, false, 5));
        if !stopped.join(CHECKPOINT).exists() {
            continue;
        }
        let work = || {
            let folder = scratch.cleared("run");
            copy(&stopped, &folder);
            resume(&folder)
        };
        try_all(&FAULTS, work, |what| {
            let folder = scratch.0.join("run");
            complete(&folder, false, 5);
            assert!(results(&folder) == reference, "{what}");
        });
    }
}

#[test]
fn a_stopped_run_or_the_one_in_its_place_survives_every_fault() {
    let scratch = Scratch::new("forced");
    let (old, new) = (scratch.cleared("old"), scratch.cleared("new"));
    let wider = |folder: &Path| run_with(folder, 5, "platelet.stone.radius", "3.0");
    let (_, calls) = fault::with(None, || wider(&old));
    run(&new, false, 5).ok().unwrap();
    let (old, new) = (results(&old), results(&new));
    assert!(old != new);
    let stopped = scratch.cleared("stopped");
    let _ = fault::with(Some((calls / 2, Fault::Crash)), || wider(&stopped));
    assert!(stopped.join(CHECKPOINT).exists());
    let work = || {
        let folder = scratch.cleared("run");
        copy(&stopped, &folder);
        run(&folder, false, 5)
    };
    try_all(&FAULTS, work, |what| {
        let folder = scratch.0.join("run");
        complete(&folder, false, 5);
        let left = results(&folder);
        assert!(left == old || left == new, "{what}");
    });
}

/// Does what a command line says.
fn perform(line: &str) -> Result<(), Failure> {
    let args = Args::try_parse_from(line.split_whitespace()).unwrap();
    verbs::perform(&args.verb, Args::command(), &quiet())
}

/// A command line that replaces the file `new` in its folder leaves the old one or the new one.
fn a_file_survives(scratch: &Scratch, line: &str, file: &str) {
    let file = scratch.0.join(file);
    perform(line).ok().unwrap();
    let new = fs::read(&file).unwrap();
    let work = || {
        fs::write(&file, "old").unwrap();
        let done = perform(line);
        assert!(done.is_err() || fs::read(&file).unwrap() == new);
        done
    };
    try_all(&FAULTS, work, |what| {
        let left = fs::read(&file).unwrap();
        assert!(left == b"old" || left == new, "{what}");
    });
}

#[test]
fn pages_and_pictures_survive_every_fault() {
    let scratch = Scratch::new("files");
    let folder = scratch.0.display();
    fs::write(scratch.0.join("a.toml"), scenario()).unwrap();
    run(&scratch.0.join("run"), false, 3).ok().unwrap();
    a_file_survives(&scratch, &format!("microsim report {folder}/run -o {folder}/page.html"), "page.html");
    for name in ["still.png", "film.gif", "film.apng"] {
        let when = if name == "still.png" { "--at 0" } else { "--from 0 --to 0.1" };
        let line = format!("microsim render {folder}/a.toml {when} --size 16x16 --threads 1 -o {folder}/{name}");
        a_file_survives(&scratch, &line, name);
    }
    a_file_survives(&scratch, &format!("microsim new {folder}/b.toml --force"), "b.toml");
}

#[test]
fn a_sweep_survives_every_fault() {
    let scratch = Scratch::new("sweep");
    let task =
        |seed| serde_json::to_string(&Task::new(&prepared(seed, Vec::new()), BTreeMap::new(), 2)).unwrap() + "\n";
    let tasks = [1, 2].map(task).concat();
    let plan = scratch.0.join("plan.jsonl");
    fs::write(&plan, tasks).unwrap();
    let line = |store: &Path| format!("microsim sweep run {} --store {} --jobs 1", plan.display(), store.display());
    let store = scratch.cleared("reference");
    perform(&line(&store)).ok().unwrap();
    for table in ["table.csv", "table.jsonl"] {
        let (plan, store, to) = (plan.display(), store.display(), scratch.0.display());
        a_file_survives(&scratch, &format!("microsim sweep merge {plan} --store {store} -o {to}/{table}"), table);
    }
    let reference = contents(&store);
    assert_eq!(reference.len(), 2);
    let work = || perform(&line(&scratch.cleared("store")));
    try_all(&FAULTS, work, |what| {
        let store = scratch.0.join("store");
        perform(&line(&store)).unwrap_or_else(|failure| panic!("{what}: {failure:?}"));
        let mut results = contents(&store);
        results.retain(|path, _| !path.to_string_lossy().starts_with('.'));
        assert!(results == reference, "{what}");
    });
}

#[test]
fn a_record_survives_every_fault() {
    let scratch = Scratch::new("record");
    let [record, save] = ["record", "save"].map(|name| scratch.0.join(name));
    let record_args =
        RecordArgs { record: Some(record.clone()), digest_every: NonZeroU32::MIN, save: Some(save.clone()) };
    let work = || Session::start(prepared(0, Vec::new()), 4, None, false, &record_args)?.complete(&quiet()).map(drop);
    work().ok().unwrap();
    let (played, saved) = (Replay::read(&fs::read(&record).unwrap()).unwrap(), fs::read(&save).unwrap());
    assert_eq!((played.steps(), played.ending()), (4, Ending::Complete));
    let from_old = || {
        fs::write(&record, "old").unwrap();
        fs::write(&save, "old").unwrap();
        let done = work();
        assert!(done.is_err() || fs::read(&save).unwrap() == saved);
        done
    };
    try_all(&FAULTS, from_old, |what| {
        let left = fs::read(&record).unwrap();
        let is_readable = Replay::read(&left).is_ok_and(|left| !matches!(left.ending(), Ending::Damaged { .. }));
        assert!(left == b"old" || is_readable, "{what}");
        let left = fs::read(&save).unwrap();
        assert!(left == b"old" || left == saved, "{what}");
    });
}
