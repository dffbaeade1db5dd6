//! `sweep plan`, and reading its files.

use super::task::Task;
use super::{Axis, PlanArgs};
use crate::console::{Console, print};
use crate::counted::counted;
use crate::failure::Failure;
use crate::json;
use crate::prepared::{Prepared, load};
use crate::read as file;
use crate::scenario_args::Changes;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Most tasks of one plan.
const MOST: usize = 1_000_000;

/// Prints the plan. All tasks are built, so that whatever is wrong with any of them shows before anything is run.
pub(super) fn plan(args: &PlanArgs, console: &Console) -> Result<(), Failure> {
    let source = load(&args.scenario)?;
    let combinations = combinations(&args.grid)?;
    let seeds = args.seeds.as_ref().map_or(vec![None], |seeds| seeds.0.iter().copied().map(Some).collect());
    let count = combinations.len() * seeds.len();
    if count > MOST {
        return Err(Failure::Message(format!("{count} tasks, accepted: at most {MOST}; take fewer values or seeds")));
    }
    let bar = console.progress(count as u64, "task");
    let mut lines = String::new();
    for combination in &combinations {
        for &seed in &seeds {
            let set = args.set.iter().chain(combination).cloned().collect();
            let prepared = Prepared::new(source.clone(), &Changes { seed, set })?;
            let steps = args.steps.unwrap_or_else(|| prepared.steps_in(args.seconds));
            let varied: BTreeMap<_, _> = combination.iter().cloned().collect();
            lines += &json::line(&Task::new(&prepared, varied, steps))?;
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    print(lines)?;
    console.note(&counted(count, "task"));
    Ok(())
}

/// Every combination of the axes' values, the last axis the fastest.
fn combinations(axes: &[Axis]) -> Result<Vec<Vec<(String, String)>>, Failure> {
    let mut all = vec![Vec::new()];
    for (index, Axis { key, values }) in axes.iter().enumerate() {
        if axes[..index].iter().any(|other| other.key == *key) {
            return Err(Failure::Message(format!("--grid {key}: given twice, accepted: each key once")));
        }
        if all.len().saturating_mul(values.len()) > MOST {
            return Err(Failure::Message(format!("--grid {key}: more than {MOST} tasks; take fewer values")));
        }
        let with = |start: &Vec<(String, String)>, value: &String| {
            start.iter().cloned().chain([(key.clone(), value.clone())]).collect()
        };
        all = all.iter().flat_map(|start| values.iter().map(move |value| with(start, value))).collect();
    }
    Ok(all)
}

/// Reads a plan, `-` for stdin.
pub(super) fn read(path: &Path) -> Result<Vec<Task>, Failure> {
    let read = if path == Path::new("-") {
        file::limited(io::stdin().lock(), 0).and_then(file::in_utf8)
    } else {
        file::text(path)
    };
    let text = read.map_err(|error| Failure::file("read", path, &error))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let tasks = lines.map(|(index, line)| Task::parse(line, &format!("{}:{}", path.display(), index + 1)));
    let tasks = tasks.collect::<Result<Vec<_>, _>>()?;
    if tasks.is_empty() {
        let message = format!("{} has no tasks; plan some with `microsim sweep plan`", path.display());
        return Err(Failure::Message(message));
    }
    Ok(tasks)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_go_through_the_last_axis_first() {
        let axis = |text: &str| text.parse::<Axis>().unwrap();
        let all = combinations(&[axis("a=1..2"), axis("b=x,y,z")]).ok().unwrap();
        let second: Vec<&str> = all.iter().map(|set| set[1].1.as_str()).collect();
        assert_eq!(second, ["x", "y", "z", "x", "y", "z"]);
        assert_eq!(combinations(&[]).ok().unwrap(), [vec![]]);
        assert!(combinations(&[axis("a=1"), axis("a=2")]).is_err());
    }
}
