//! `sweep run` and `run --task`: tasks, several at once.

use super::store::ResultStore;
use super::task::Task;
use super::{SweepRunArgs, plan};
use crate::console::Console;
use crate::failure::Failure;
use crate::interrupt;
use indicatif::ProgressBar;
use std::collections::BTreeSet;
use std::path::Path;
use std::str::FromStr;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// `--shard`: which tasks of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    index: usize,
    count: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        let (index, count) = parts.filter(|(index, count)| index < count).ok_or("expected i/n with i from 0 to n-1")?;
        Ok(Self { index, count })
    }
}

pub(super) fn run(args: &SweepRunArgs, console: &Console) -> Result<(), Failure> {
    let tasks = plan::read(&args.from.plan)?;
    let Shard { index, count } = args.shard.unwrap_or(Shard { index: 0, count: 1 });
    // Two workers would write the one result of equal tasks at once.
    let mut known = BTreeSet::new();
    let tasks = tasks.into_iter().filter(|task| known.insert(task.key.clone()));
    let tasks: Vec<Task> = tasks.skip(index).step_by(count).collect();
    let jobs = args.jobs.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), usize::from);
    run_all(&tasks, &ResultStore::open(&args.from.store)?, jobs, console)
}

/// Runs the tasks of a file, one after the other. Where it `keeps_going`, checks that fail are named and in the results, but no
/// failure.
pub(crate) fn run_tasks(file: &str, store: &Path, keeps_going: bool, console: &Console) -> Result<(), Failure> {
    let tasks = plan::read(Path::new(file))?;
    match run_all(&tasks, &ResultStore::open(store)?, 1, console) {
        Err(broken @ Failure::Broken(_)) if keeps_going => {
            broken.report(console);
            Ok(())
        }
        result => result,
    }
}

fn run_all(tasks: &[Task], store: &ResultStore, jobs: usize, console: &Console) -> Result<(), Failure> {
    interrupt::listen();
    let pool = Pool { tasks, store, next: AtomicUsize::new(0), done: Mutex::default() };
    let bar = console.progress(tasks.len() as u64, "task");
    std::thread::scope(|scope| {
        (1..jobs.min(tasks.len())).for_each(|_| drop(scope.spawn(|| pool.work(&bar))));
        pool.work(&bar);
    });
    bar.finish_and_clear();
    let Done { run, found, broken, failure } = pool.done.into_inner().unwrap_or_default();
    console.note(&format!("{run} run, {found} found in the store, {} in all", tasks.len()));
    if let Some(failure) = failure {
        return Err(failure);
    }
    if interrupt::is_asked() {
        return Err(Failure::Interrupted);
    }
    if broken.is_empty() { Ok(()) } else { Err(Failure::Broken(broken)) }
}

/// Tasks that workers take one by one.
struct Pool<'a> {
    tasks: &'a [Task],
    store: &'a ResultStore,
    next: AtomicUsize,
    done: Mutex<Done>,
}

#[derive(Debug, Default)]
struct Done {
    run: usize,
    found: usize,
    /// Failed checks.
    broken: Vec<String>,
    /// Why work stopped.
    failure: Option<Failure>,
}

impl Pool<'_> {
    /// Takes tasks until there are none left, the user wants to stop, or something fails.
    fn work(&self, bar: &ProgressBar) {
        while let Some(task) = self.tasks.get(self.next.fetch_add(1, Ordering::Relaxed)) {
            if interrupt::is_asked() {
                return;
            }
            let result = self.finish(task);
            bar.inc(1);
            if let Err(failure) = result {
                self.next.store(self.tasks.len(), Ordering::Relaxed);
                self.note(|done| done.failure = Some(failure));
            }
        }
    }

    /// Runs a task unless its result is in the store.
    fn finish(&self, task: &Task) -> Result<(), Failure> {
        let found = self.store.get(task)?;
        let is_found = found.is_some();
        let Some(outcome) = found.map_or_else(|| task.run(), |outcome| Ok(Some(outcome)))? else {
            return Ok(());
        };
        if !is_found {
            self.store.put(&outcome)?;
        }
        self.note(|done| {
            done.found += usize::from(is_found);
            done.run += usize::from(!is_found);
            let name = |failure| format!("{} with seed {} ({}): {failure}", task.scenario, task.seed, task.key);
            done.broken.extend(outcome.failures.first().map(name));
        });
        Ok(())
    }

    fn note(&self, what: impl FnOnce(&mut Done)) {
        // A worker that panicked has left nothing half done.
        what(&mut self.done.lock().unwrap_or_else(std::sync::PoisonError::into_inner));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_counted_from_0() {
        assert_eq!("0/4".parse(), Ok(Shard { index: 0, count: 4 }));
        assert!(["4/4", "-1/4", "1", "a/b", "0/0"].iter().all(|text| text.parse::<Shard>().is_err()));
    }
}
