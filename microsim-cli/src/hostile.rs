//! What is done with the bytes that a fuzzer makes up (folder `fuzz`). The tests below do the same with the committed corpora.

use crate::checkpoint;
use crate::diagnostics::ScenarioText;
use crate::output::{CHECKPOINT, Outputs};
use crate::prepared::Prepared;
use crate::scenario_args::Changes;
use crate::session::Session;
use crate::verbs::{Task, csv, lines, outcome_of};
use microsim_core::snapshot::Checkpoint;
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

const ROOM: &str = r#"
    schema = 1
    name = "room"
    duration = 0.1
    [world]
    size = [30.0, 20.0]
    [agar.pellet]
    radius = 1.0
    [[spawn]]
    of = "pellet"
    at = [10.0, 10.0]
    [output]
    checkpoint_every = 1
    pictures = false
    [output.measures]
    formats = ["csv", "jsonl"]
    of = ["bodies"]
"#;

/// Files of a run of [`ROOM`] that was stopped after its first step.
const TABLES: [(&str, &str); 3] = [
    (".measures.csv.partial", "step,time,events,bodies\n0,0,0,1\n"),
    (".measures.jsonl.partial", "{\"step\":0,\"time\":0.0,\"events\":0,\"bodies\":1.0}\n"),
    (".events.jsonl.partial", ""),
];

fn prepared() -> Prepared {
    let source = ScenarioText::new("room".to_owned(), ROOM.to_owned());
    Prepared::new(source, &Changes::default()).expect("a sound scenario")
}

/// The run behind the line of a checkpoint.
static RUN: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let Prepared { scenario, mut built, .. } = prepared();
    crate::session::timed_step(&mut built);
    Checkpoint { origin: scenario.origin(), run: built }.to_bytes().expect("a run that can be written")
});

/// A place for a stopped run, beside a file that is not its.
static PLACE: LazyLock<PathBuf> = LazyLock::new(|| {
    let place = std::env::temp_dir().join(format!("microsim-hostile-{}", std::process::id()));
    fs::create_dir_all(place.join("run")).expect("a folder for files of no use");
    fs::write(place.join("mine"), "precious").expect("room for a file");
    place
});

/// A stopped run whose checkpoint has this line; the run and the checksum are right. Returns whether it can be resumed.
pub fn checkpoint(line: &[u8]) -> bool {
    let folder = PLACE.join("run");
    for (name, content) in TABLES {
        fs::write(folder.join(name), content).expect("room for a table");
    }
    fs::write(folder.join(CHECKPOINT), checkpoint::sealed(line, &RUN)).expect("room for a checkpoint");
    let outputs = Outputs::reopen(&folder).expect("nobody else has the folder");
    let is_resumed = Session::resume(&outputs).is_ok();
    for (name, content) in TABLES {
        let left = fs::read_to_string(folder.join(name)).expect("a table stays");
        assert!(if is_resumed { content.starts_with(&left) } else { left == content }, "{name}: {left:?}");
    }
    assert!(fs::read_dir(&*PLACE).expect("a folder").count() == 2);
    assert!(fs::read(PLACE.join("mine")).expect("a file") == b"precious");
    is_resumed
}

static TASK: LazyLock<Task> = LazyLock::new(|| Task::new(&prepared(), BTreeMap::new(), 2));

/// A result in the store of a sweep, and its rows of the merged tables. The lowest bits of the first byte say whether the rest
/// is the file, the fields that have to be the task's left out, or a line of a plan without its key.
pub fn store(bytes: &[u8]) {
    let Some((&kind, rest)) = bytes.split_first() else { return };
    let found = match kind % 3 {
        0 => outcome_of(&TASK, rest),
        1 => outcome_of(&TASK, &[start_of_outcome().as_bytes(), rest].concat()),
        _ => return plan(rest),
    };
    let Some(outcome) = found else { return };
    let other = TASK.run().expect("a sound task").expect("nobody interrupts it");
    let outcomes = [outcome, other];
    let table = csv(&outcomes).expect("a table");
    let mut rows = csv::Reader::from_reader(&table[..]);
    let header = rows.headers().expect("a header").clone();
    let rows: Vec<_> = rows.records().map(|row| row.expect("rows of equal length")).collect();
    assert_eq!(rows.len(), outcomes.len());
    rows.iter().chain([&header]).flatten().for_each(check_cell);
    let text = String::from_utf8(lines(&outcomes).expect("lines")).expect("text");
    let again = text.lines().map(|line| outcome_of(&TASK, line.as_bytes()));
    assert!(again.eq(outcomes.into_iter().map(Some)), "{text}");
}

/// The fields that say which task a result is of.
fn start_of_outcome() -> String {
    let Task { key, scenario, seed, steps, .. } = &*TASK;
    format!(r#"{{"key":"{key}","scenario":"{scenario}","seed":{seed},"set":{{}},"steps":{steps},"#)
}

/// A line of a plan whose key is right.
fn plan(line: &[u8]) {
    let Ok(mut task) = serde_json::from_slice::<Task>(line) else { return };
    task.key = task.hash();
    let line = serde_json::to_string(&task).expect("a task can be written");
    if let Ok(read) = Task::parse(&line, "plan") {
        assert_eq!(read, task);
    }
}

fn check_cell(text: &str) {
    let is_formula = text.starts_with(['=', '+', '-', '@']) && text.parse::<f64>().is_err();
    assert!(!is_formula && !text.contains(char::is_control), "{text:?}");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(target: &str) -> PathBuf {
        [env!("CARGO_MANIFEST_DIR"), "..", "fuzz", "corpus", target].iter().collect()
    }

    fn read(target: &str, name: &str) -> Vec<u8> {
        fs::read(folder(target).join(name)).unwrap()
    }

    fn show(target: &str, to: fn(&[u8])) {
        let files: Vec<PathBuf> = fs::read_dir(folder(target)).unwrap().map(|entry| entry.unwrap().path()).collect();
        assert!(!files.is_empty(), "no corpus of {target}");
        files.iter().for_each(|file| to(&fs::read(file).unwrap()));
    }

    /// One test, as there is one folder for the run.
    #[test]
    fn checkpoints() {
        assert!(checkpoint(&read("checkpoint", "line")), "the seed is rubbish to the present reader");
        show("checkpoint", |line| {
            checkpoint(line);
        });
        fs::remove_dir_all(&*PLACE).unwrap();
    }

    #[test]
    fn stores() {
        show("store", store);
        let [result, fields] = ["result", "fields"].map(|name| read("store", name).split_off(1));
        assert_eq!(outcome_of(&TASK, &result), TASK.run().ok().flatten());
        assert!(outcome_of(&TASK, &[start_of_outcome().as_bytes(), &fields].concat()).is_some());
    }

    #[test]
    #[ignore = "writes the seeds of the corpora"]
    fn write_seeds() {
        let write = |target: &str, name: &str, content: String| {
            fs::create_dir_all(folder(target)).unwrap();
            fs::write(folder(target).join(name), content).unwrap();
        };
        let [csv, jsonl] = [TABLES[0], TABLES[1]].map(|(_, content)| content.len());
        let lengths = format!(r#"{{"events.jsonl":0,"measures.csv":{csv},"measures.jsonl":{jsonl}}}"#);
        let progress = format!(r#""progress":{{"lengths":{lengths},"events":0,"whole":[]}}"#);
        let tally =
            r#""tally":{"steps":1,"leaks":0,"improper_absorptions":0,"events":{"divided":2},"is_interrupted":true}"#;
        let rest = r#""validates":false,"broken":null,"digest_at_start":"0123456789abcdef""#;
        write("checkpoint", "line", format!(r#"{{"source":"room","steps":6,{progress},{tally},{rest}}}"#));
        let outcome = serde_json::to_string(&TASK.run().ok().flatten().unwrap()).unwrap();
        let fields = outcome.split_once("\"steps\":2,").unwrap().1;
        write("store", "result", format!("\0{outcome}"));
        write("store", "fields", format!("\u{1}{fields}"));
        write("store", "plan", format!("\u{2}{}", serde_json::to_string(&*TASK).unwrap()));
    }
}
