//! `sweep status` and `sweep merge`.

use super::store::ResultStore;
use super::task::{Task, TaskOutcome};
use super::{MergeArgs, StatusArgs, plan};
use crate::console::{Console, print};
use crate::failure::Failure;
use crate::output::Outputs;
use crate::{json, sanitize};
use std::collections::BTreeSet;
use std::path::Path;

/// Prints the keys of missing tasks.
pub(super) fn status(args: &StatusArgs, console: &Console) -> Result<(), Failure> {
    let tasks = plan::read(&args.from.plan)?;
    let (outcomes, missing) = gather(&tasks, &ResultStore::open(&args.from.store)?)?;
    let broken = outcomes.iter().filter(|outcome| !outcome.failures.is_empty()).count();
    console.note(&format!("{} of {} tasks done, {broken} with failures", outcomes.len(), tasks.len()));
    let printed = print(missing.iter().map(|task| format!("{}\n", task.key)).collect::<String>());
    if missing.is_empty() { Ok(printed?) } else { Err(Failure::Negative) }
}

pub(super) fn merge(args: &MergeArgs, console: &Console) -> Result<(), Failure> {
    let is_csv = match args.output.extension().and_then(|ending| ending.to_str()) {
        Some("csv") => true,
        Some("jsonl") => false,
        _ if args.output == Path::new("-") => false,
        _ => {
            let message = format!("-o {}: accepted: a name that ends in .csv or .jsonl, or -", args.output.display());
            return Err(Failure::Message(message));
        }
    };
    let tasks = plan::read(&args.from.plan)?;
    let (outcomes, missing) = gather(&tasks, &ResultStore::open(&args.from.store)?)?;
    if !missing.is_empty() {
        let mut told = vec![format!("{} of {} results are missing:", missing.len(), tasks.len())];
        told.extend(missing.iter().map(|task| task.key.clone()));
        if !args.partial {
            told.push("run `microsim sweep run` again, or write the others with --partial".to_owned());
            return Err(Failure::Broken(told));
        }
        told.iter().for_each(|line| console.note(line));
    }
    let text = if is_csv { csv(&outcomes)? } else { lines(&outcomes)? };
    if args.output == Path::new("-") {
        return Ok(print(&text)?);
    }
    let (outputs, name) = Outputs::beside(&args.output)?;
    outputs.write(&name, &text)?;
    console.note(&format!("wrote {}: {} results", args.output.display(), outcomes.len()));
    Ok(())
}

/// Results in the order of the plan, and tasks without one.
fn gather<'a>(tasks: &'a [Task], store: &ResultStore) -> Result<(Vec<TaskOutcome>, Vec<&'a Task>), Failure> {
    let (mut outcomes, mut missing) = (Vec::new(), Vec::new());
    for task in tasks {
        match store.get(task)? {
            Some(outcome) => outcomes.push(outcome),
            None => missing.push(task),
        }
    }
    Ok((outcomes, missing))
}

/// The results as JSON, one a line.
pub(crate) fn lines(outcomes: &[TaskOutcome]) -> Result<Vec<u8>, Failure> {
    let mut text = Vec::new();
    for outcome in outcomes {
        text.extend(json::line(outcome)?.into_bytes());
    }
    Ok(text)
}

fn header(set: &BTreeSet<&str>, events: &BTreeSet<&str>, measures: &BTreeSet<&str>) -> Vec<String> {
    let mut header: Vec<String> = ["key", "scenario", "seed"].map(str::to_owned).into();
    header.extend(set.iter().map(|name| (*name).to_owned()));
    header.extend(["steps", "simulated_seconds", "digest", "failures"].map(str::to_owned));
    header.extend(events.iter().flat_map(|name| [format!("events.{name}"), format!("first.{name}")]));
    header.extend(measures.iter().map(|name| (*name).to_owned()));
    header
}

/// The results as one table.
pub(crate) fn csv(outcomes: &[TaskOutcome]) -> Result<Vec<u8>, Failure> {
    fn names<'a>(of: impl Iterator<Item = &'a String>) -> BTreeSet<&'a str> {
        of.map(String::as_str).collect()
    }
    let set = names(outcomes.iter().flat_map(|outcome| outcome.set.keys()));
    let events = names(outcomes.iter().flat_map(|outcome| outcome.events.keys()));
    let measures = names(outcomes.iter().flat_map(|outcome| outcome.measures.keys()));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut rows = vec![header(&set, &events, &measures)];
    for outcome in outcomes {
        let mut row = vec![outcome.key.clone(), outcome.scenario.clone(), outcome.seed.to_string()];
        row.extend(set.iter().map(|name| outcome.set.get(*name).cloned().unwrap_or_default()));
        let (time, failures) = (outcome.simulated_seconds.to_string(), outcome.failures.join("; "));
        row.extend([outcome.steps.to_string(), time, outcome.digest.clone(), failures]);
        for name in &events {
            row.push(outcome.events.get(*name).unwrap_or(&0).to_string());
            row.push(outcome.first.get(*name).map_or(String::new(), f64::to_string));
        }
        row.extend(measures.iter().map(|name| outcome.measures.get(*name).map_or(String::new(), f64::to_string)));
        rows.push(row);
    }
    let written =
        rows.iter().try_for_each(|row| writer.write_record(row.iter().map(|text| sanitize::cell(text).into_owned())));
    let fail = |error: &dyn std::fmt::Display| Failure::Message(format!("cannot write the table: {error}"));
    written.map_err(|error| fail(&error))?;
    writer.into_inner().map_err(|error| fail(&error))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(key: &str) -> TaskOutcome {
        let json = format!(
            r#"{{"key": "{key}", "scenario": "s", "seed": 1, "set": {{}}, "steps": 2, "simulated_seconds": 0.5,
                "digest": "d", "failures": [], "events": {{}}, "first": {{}}, "measures": {{}}}}"#
        );
        serde_json::from_str(&json).unwrap()
    }

    #[test]
    fn a_table_has_a_column_for_whatever_any_result_has() {
        let one = TaskOutcome { set: [("speed".to_owned(), "3".to_owned())].into(), ..outcome("one") };
        let other = TaskOutcome {
            events: [("divided".to_owned(), 4)].into(),
            first: [("divided".to_owned(), 0.25)].into(),
            measures: [("leaks".to_owned(), 7.0)].into(),
            failures: ["a".to_owned(), "b".to_owned()].into(),
            ..outcome("other")
        };
        let table = csv(&[one, other]).ok().unwrap();
        let expected = "key,scenario,seed,speed,steps,simulated_seconds,digest,failures,events.divided,first.divided,leaks\n\
            one,s,1,3,2,0.5,d,,0,,\n\
            other,s,1,,2,0.5,d,a; b,4,0.25,7\n";
        assert_eq!(String::from_utf8(table).unwrap(), expected);
    }
}
