//! One task and its result.

use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::hex;
use crate::prepared::Prepared;
use crate::scenario_args::Changes;
use crate::summary::rounded;
use microsim_core::Measure;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// This program, as far as results depend on it.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// One line of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Task {
    /// Hash of all that decides the result.
    pub key: String,
    /// The scenario's name, for people.
    pub scenario: String,
    pub seed: u64,
    /// The parameters that differ between tasks.
    pub set: BTreeMap<String, String>,
    pub steps: u64,
    /// Version of the program that it was planned for.
    pub version: String,
    /// The scenario, with everything put in.
    pub text: String,
}

/// The result of a task. It holds no clock times: it is the same wherever and whenever the task is run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct TaskOutcome {
    pub key: String,
    pub scenario: String,
    pub seed: u64,
    pub set: BTreeMap<String, String>,
    pub steps: u64,
    pub simulated_seconds: f64,
    /// Digest of the world at the end.
    pub digest: String,
    /// The first invariant or expectation that broke, and commands that were refused.
    pub failures: Vec<String>,
    /// Number of events of each kind.
    pub events: BTreeMap<String, u64>,
    /// Time of the first event of each kind, s.
    pub first: BTreeMap<String, f64>,
    /// Every measure at the end.
    pub measures: BTreeMap<String, f64>,
}

impl Task {
    pub(crate) fn new(prepared: &Prepared, set: BTreeMap<String, String>, steps: u64) -> Self {
        let text = prepared.scenario.effective();
        let (scenario, seed) = (prepared.name().to_owned(), prepared.scenario.seed());
        let mut task = Self { key: String::new(), scenario, seed, set, steps, version: VERSION.to_owned(), text };
        task.key = task.hash();
        task
    }

    /// The first half of a SHA-256 of all other fields.
    pub(crate) fn hash(&self) -> String {
        let Self { key: _, scenario, seed, set, steps, version, text } = self;
        let content = format!("microsim {version}\n{scenario:?} {seed} {set:?} {steps}\n{text}");
        hex(&hmac_sha256::Hash::hash(content.as_bytes())[..16])
    }

    /// Reads a line of a plan.
    pub(crate) fn parse(line: &str, origin: &str) -> Result<Self, Failure> {
        let refuse = |why: String| Failure::Message(format!("{origin}: {why}"));
        let task: Self = serde_json::from_str(line)
            .map_err(|error| refuse(format!("not a task: {error}; plan it with `microsim sweep plan`")))?;
        if task.key != task.hash() {
            return Err(refuse("the task was changed: its key does not fit; plan it again".to_owned()));
        }
        if task.version != VERSION {
            let why = format!("planned for version {}, this is {VERSION}; plan it again", task.version);
            return Err(refuse(why));
        }
        Ok(task)
    }

    /// Runs it; `None` when the user asked to stop.
    pub(crate) fn run(&self) -> Result<Option<TaskOutcome>, Failure> {
        let source = ScenarioText::new(format!("<task {}>", self.key), self.text.clone());
        let mut built = Prepared::new(source, &Changes::default())?.built;
        let mut broken = None;
        let (mut events, mut first) = (BTreeMap::new(), BTreeMap::new());
        for _ in 0..self.steps {
            if interrupt::is_asked() {
                return Ok(None);
            }
            let inputs = built.script.before_step(&mut built.world);
            built.world.step(inputs);
            broken = broken.or_else(|| built.checks.after_step(&built.world).first().copied());
            for event in built.world.events() {
                *events.entry(event.name().to_owned()).or_insert(0) += 1;
                first.entry(event.name().to_owned()).or_insert(rounded(built.world.time()));
            }
        }
        let refusals = built.script.refusals().iter().map(ToString::to_string);
        let of = |measure: &Measure| (measure.name().to_owned(), shortest(measure.of(&built.world)));
        Ok(Some(TaskOutcome {
            key: self.key.clone(),
            scenario: self.scenario.clone(),
            seed: self.seed,
            set: self.set.clone(),
            steps: self.steps,
            simulated_seconds: rounded(built.world.time()),
            digest: format!("{:016x}", built.world.digest()),
            failures: broken.iter().map(ToString::to_string).chain(refusals).collect(),
            events,
            first,
            measures: Measure::ALL.iter().map(of).collect(),
        }))
    }
}

impl TaskOutcome {
    /// Whether it is the result of a task.
    pub(super) fn is_of(&self, task: &Task) -> bool {
        (&self.key, &self.scenario, self.seed, &self.set, self.steps)
            == (&task.key, &task.scenario, task.seed, &task.set, task.steps)
    }
}

/// Most measures are single precision: the number with the shortest digits that mean them.
fn shortest(value: f64) -> f64 {
    (value as f32).to_string().parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepared::{apart, prepare};
    use crate::scenario_args::ScenarioArgs;

    fn task(seed: u64) -> Task {
        let changes = Changes { seed: Some(seed), set: Vec::new() };
        let prepared = prepare(&ScenarioArgs { scenario: "empty".to_owned(), changes }).ok().unwrap();
        Task::new(&prepared, BTreeMap::new(), 5)
    }

    #[test]
    fn a_key_is_of_the_content() {
        assert_eq!(task(1), task(1));
        assert_ne!(task(1).key, task(2).key);
        assert_eq!(task(1).key.len(), 32);
    }

    #[test]
    fn a_changed_task_is_refused() {
        let sound = task(1);
        let line = |task: &Task| serde_json::to_string(task).unwrap();
        assert_eq!(Task::parse(&line(&sound), "plan:1").ok(), Some(sound.clone()));
        let changed = [
            Task { steps: 6, ..sound.clone() },
            Task { scenario: "other".to_owned(), ..sound.clone() },
            Task { seed: 2, ..sound.clone() },
            Task { set: [("a".to_owned(), "1".to_owned())].into(), ..sound.clone() },
            Task { text: sound.text.replace('1', "2"), ..sound },
        ];
        assert!(changed.iter().all(|task| Task::parse(&line(task), "plan:1").is_err()));
        assert!(Task::parse("{}", "plan:1").is_err());
    }

    #[test]
    fn a_task_has_one_outcome() {
        let (a, b) = (task(3).run().ok().flatten().unwrap(), task(3).run().ok().flatten().unwrap());
        assert_eq!(a, b);
    }

    #[test]
    fn events_are_counted_and_the_first_of_each_kind_is_timed() {
        let outcome = Task::new(&apart(""), BTreeMap::new(), 20).run().ok().flatten().unwrap();
        assert_eq!(outcome.events, [("fusion_refused".to_owned(), 4)].into());
        assert_eq!(outcome.first, [("fusion_refused".to_owned(), 0.016667)].into());
    }
}
