//! The page of a sweep.

use super::chart;
use super::data;
use super::heat_map::HeatMap;
use super::page::{Page, escape, figure, figures, folded};
use super::scale::short;
use crate::counted::counted;
use crate::failure::Failure;
use crate::verbs::sweep::TaskOutcome;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A name and its value in each task.
type Quantity = (String, Vec<f64>);

pub(super) fn make(path: &Path) -> Result<String, Failure> {
    let outcomes: Vec<TaskOutcome> = data::lines(path)?;
    let Some(first) = outcomes.first() else {
        let accepted = "accepted: the folder of a run, or what `microsim sweep merge -o NAME.jsonl` wrote";
        return Err(Failure::Message(format!("{} has no results, {accepted}", path.display())));
    };
    let title = format!("Sweep of {}", first.scenario);
    let axes = axes(&outcomes);
    let seeds: BTreeSet<u64> = outcomes.iter().map(|outcome| outcome.seed).collect();
    let over: Vec<&str> = axes.iter().map(|(name, _)| name.as_str()).collect();
    let over = if over.is_empty() { String::new() } else { format!(" over {}", over.join(", ")) };
    let mut page =
        Page::new(&title, &format!("{}{over}, {}", counted(outcomes.len(), "task"), counted(seeds.len(), "seed")));
    page.warning(&broken(&outcomes));
    let quantities = quantities(&outcomes);
    let all: Vec<String> = quantities.iter().map(|quantity| picture(quantity, &outcomes, &axes)).collect();
    let results = if all.is_empty() { "<p>All tasks have equal results.</p>".to_owned() } else { figures(&all) };
    page.section("Results", &results);
    page.section("All tasks", &folded(&counted(outcomes.len(), "task"), &tasks(&outcomes, &axes, &quantities)));
    Ok(page.finish(&title))
}

/// The varied parameters, and their values in the order of the plan.
fn axes(outcomes: &[TaskOutcome]) -> Vec<(String, Vec<String>)> {
    let mut axes: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (name, value) in outcomes.iter().flat_map(|outcome| &outcome.set) {
        let values = axes.entry(name).or_default();
        if !values.contains(value) {
            values.push(value.clone());
        }
    }
    axes.into_iter().filter(|(_, values)| values.len() > 1).map(|(name, values)| (name.to_owned(), values)).collect()
}

fn broken(outcomes: &[TaskOutcome]) -> Vec<String> {
    let count = outcomes.iter().filter(|outcome| !outcome.failures.is_empty()).count();
    if count == 0 {
        return Vec::new();
    }
    let first = outcomes.iter().find_map(|outcome| Some((outcome, outcome.failures.first()?)));
    let example = first.map(|(outcome, failure)| format!("for example with seed {}: {failure}", outcome.seed));
    [format!("{count} of {} tasks failed a check", outcomes.len())].into_iter().chain(example).collect()
}

/// All results that differ between tasks; NaN where a task has none.
fn quantities(outcomes: &[TaskOutcome]) -> Vec<Quantity> {
    let names = |of: fn(&TaskOutcome) -> Vec<&String>| -> BTreeSet<&String> { outcomes.iter().flat_map(of).collect() };
    let mut all: Vec<Quantity> = Vec::new();
    all.push(("failures".to_owned(), outcomes.iter().map(|outcome| outcome.failures.len() as f64).collect()));
    for name in names(|outcome| outcome.events.keys().collect()) {
        let count = |outcome: &TaskOutcome| *outcome.events.get(name).unwrap_or(&0) as f64;
        all.push((format!("{}, events", name.replace('_', " ")), outcomes.iter().map(count).collect()));
        let first = |outcome: &TaskOutcome| outcome.first.get(name).copied().unwrap_or(f64::NAN);
        all.push((format!("first {}, s", name.replace('_', " ")), outcomes.iter().map(first).collect()));
    }
    for name in names(|outcome| outcome.measures.keys().collect()) {
        let value = |outcome: &TaskOutcome| outcome.measures.get(name).copied().unwrap_or(f64::NAN);
        all.push((format!("{} at the end", name.replace('_', " ")), outcomes.iter().map(value).collect()));
    }
    all.retain(|(_, values)| {
        let mut finite = values.iter().filter(|value| value.is_finite());
        let first = finite.next();
        finite.any(|value| Some(value) != first)
    });
    all
}

/// Means over all seeds, by the varied parameters.
fn picture((name, values): &Quantity, outcomes: &[TaskOutcome], axes: &[(String, Vec<String>)]) -> String {
    let of = |outcome: &TaskOutcome, axis: &str| outcome.set.get(axis).cloned().unwrap_or_default();
    let finite = || outcomes.iter().zip(values.iter().copied()).filter(|(_, value)| value.is_finite());
    let chart = match axes {
        [] => chart::histogram(values, name),
        [(axis, steps)] => {
            let at = |(index, step): (usize, &String)| step.parse().unwrap_or(index as f64);
            let group =
                |step: &String| finite().filter(|(o, _)| of(o, axis) == *step).map(|(_, value)| value).collect();
            let mut groups: Vec<(f64, Vec<f64>)> =
                steps.iter().enumerate().map(|place| (at(place), group(place.1))).collect();
            groups.retain(|(_, values)| !values.is_empty());
            chart::spread(&groups, axis)
        }
        [(x, columns), (y, rows), ..] => {
            let mean = |row: &String, column: &String| {
                let here = finite().filter(|(o, _)| of(o, x) == *column && of(o, y) == *row).map(|(_, value)| value);
                let (sum, count) = here.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
                (count > 0.0).then_some(sum / count)
            };
            let values = rows.iter().flat_map(|row| columns.iter().map(move |column| mean(row, column))).collect();
            HeatMap { columns: (x, columns), rows: (y, rows), values }.svg()
        }
    };
    figure(name, &chart)
}

fn tasks(outcomes: &[TaskOutcome], axes: &[(String, Vec<String>)], quantities: &[Quantity]) -> String {
    let names = axes.iter().map(|(name, _)| name).chain(quantities.iter().map(|(name, _)| name));
    let header: String = names.map(|name| format!("<th>{}</th>", escape(name))).collect();
    let mut html = format!("<div class=\"all\"><table><tr><th>seed</th>{header}<th>digest</th></tr>");
    for (index, outcome) in outcomes.iter().enumerate() {
        let set = axes.iter().map(|(name, _)| outcome.set.get(name).cloned().unwrap_or_default());
        let values = quantities.iter().map(|(_, values)| short(values[index]));
        let cells: String = set.chain(values).map(|cell| format!("<td>{}</td>", escape(cell))).collect();
        html += &format!("<tr><td>{}</td>{cells}<td>{}</td></tr>", outcome.seed, escape(&outcome.digest));
    }
    html + "</table></div>"
}
