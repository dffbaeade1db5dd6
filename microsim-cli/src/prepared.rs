//! Reads a scenario from its built-in text, a file or stdin, and builds it.

use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::read;
use crate::scenario_args::{Changes, ScenarioArgs};
use microsim_core::scenario::{Built, Diagnostics, Scenario, builtin, builtins};
use std::io::{self, Read};
use std::path::Path;

/// Longest scenario that is read, bytes; also keeps endless devices from filling the memory.
const LONGEST: u64 = 16 << 20;

/// A scenario that was parsed and built, with its changes from the command line.
#[derive(Debug)]
pub(crate) struct Prepared {
    pub source: ScenarioText,
    pub scenario: Scenario,
    pub built: Built,
    /// Changes from the command line, `key=value`.
    pub overrides: Vec<(String, String)>,
}

impl Prepared {
    /// Reads the text and makes its world.
    pub(crate) fn new(source: ScenarioText, changes: &Changes) -> Result<Self, Failure> {
        match build(&source, changes) {
            Ok((scenario, built)) => Ok(Self { source, scenario, built, overrides: changes.set.clone() }),
            Err(problems) => Err(Failure::Scenario(source, problems)),
        }
    }

    /// The scenario's name; where it has none, its file's.
    pub(crate) fn name(&self) -> &str {
        let name = self.scenario.name();
        if name.is_empty() { &self.source.origin } else { name }
    }

    /// Steps in `seconds` of simulated time; `None` is the scenario's duration.
    pub(crate) fn steps_in(&self, seconds: Option<f64>) -> u64 {
        let seconds = seconds.unwrap_or(f64::from(self.scenario.duration()));
        (seconds / f64::from(self.scenario.config().dt)).round() as u64
    }
}

fn build(source: &ScenarioText, changes: &Changes) -> Result<(Scenario, Built), Diagnostics> {
    let mut scenario = Scenario::parse(&source.text, &changes.set)?;
    if let Some(seed) = changes.seed {
        scenario.set_seed(seed);
    }
    let built = scenario.build()?;
    Ok((scenario, built))
}

/// Reads, parses and builds: whatever is wrong with a scenario is found here, before anything is written.
pub(crate) fn prepare(args: &ScenarioArgs) -> Result<Prepared, Failure> {
    Prepared::new(load(&args.scenario)?, &args.changes)
}

pub(crate) fn load(name: &str) -> Result<ScenarioText, Failure> {
    if name == "-" {
        return read_text("<stdin>", Path::new("stdin"), io::stdin().lock());
    }
    if let Some(found) = builtin(name) {
        return Ok(ScenarioText::new(format!("<built-in {name}>"), found.text.to_owned()));
    }
    let path = Path::new(name);
    if !(is_path(name) || path.exists()) {
        return Err(unknown(name));
    }
    if path.is_dir() {
        return Err(Failure::Message(format!("{name} is a directory, accepted: a scenario file")));
    }
    let file = read::open(path).map_err(|error| Failure::file("read", path, &error))?;
    read_text(name, path, file)
}

fn is_path(name: &str) -> bool {
    name.ends_with(".toml") || name.contains(std::path::is_separator)
}

fn read_text(origin: &str, path: &Path, from: impl Read) -> Result<ScenarioText, Failure> {
    let mut bytes = Vec::new();
    from.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|error| Failure::file("read", path, &error))?;
    if bytes.len() as u64 > LONGEST {
        return Err(Failure::Message(format!("{origin} is longer than {LONGEST} bytes, accepted: a scenario in TOML")));
    }
    let text = String::from_utf8(bytes).map_err(|error| not_text(origin, &error))?;
    Ok(ScenarioText::new(origin.to_owned(), text))
}

fn not_text(origin: &str, error: &std::string::FromUtf8Error) -> Failure {
    let at = error.utf8_error().valid_up_to();
    let before = &error.as_bytes()[..at];
    let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
    Failure::Message(format!(
        "{origin}:{line}: byte {at} is not UTF-8 text, accepted: a scenario in TOML, which is UTF-8"
    ))
}

fn unknown(name: &str) -> Failure {
    let names: Vec<&str> = builtins().iter().map(|known| known.name).collect();
    let hint = nearest(name, &names).map_or(String::new(), |near| format!("; did you mean {near}?"));
    let advice = [
        format!("built-in scenarios: {}", names.join(", ")),
        "a file needs a name that ends in .toml or contains a separator".to_owned(),
    ];
    Failure::Advised(format!("there is no scenario {name:?}{hint}"), advice.into())
}

/// The name that was probably meant.
fn nearest<'a>(name: &str, names: &[&'a str]) -> Option<&'a str> {
    let distance = |other: &str| strsim::damerau_levenshtein(&name.to_lowercase(), other);
    let best = names.iter().min_by_key(|other| distance(other))?;
    let tolerated = 1 + best.len() / 4;
    (distance(best) <= tolerated).then_some(*best)
}

/// For tests: two cells too far apart to fuse, one of which is told to from the first step on, every sixth. Each time is an
/// event.
#[cfg(test)]
pub(crate) fn apart(more: &str) -> Prepared {
    let text = format!(
        r#"
        schema = 1
        name = "apart"
        [world]
        size = [40.0, 30.0]
        [amoeboid_cell.cell]
        radii = [5.0, 5.0]
        [[spawn]]
        of = "cell"
        at = [10.0, 15.0]
        name = "one"
        [[spawn]]
        of = "cell"
        at = [30.0, 15.0]
        name = "other"
        [[command]]
        of = "one"
        every = 0.1
        fuse = "other"
        {more}
    "#
    );
    let source = ScenarioText::new("apart".to_owned(), text);
    Prepared::new(source, &Changes::default()).unwrap_or_else(|failure| panic!("{failure:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_is_recognised() {
        let names = ["empty", "platelets", "crowd"];
        assert_eq!(nearest("Emtpy", &names), Some("empty"));
        assert_eq!(nearest("platelet", &names), Some("platelets"));
        assert_eq!(nearest("zebra", &names), None);
    }

    #[test]
    fn paths_are_told_from_names() {
        assert!(is_path("a.toml") && is_path("./a") && !is_path("crowd"));
    }
}
