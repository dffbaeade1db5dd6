//! `check`: whether a scenario can be run.

use crate::console::print;
use crate::counted::counted;
use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::prepared::{Prepared, prepare};
use crate::scenario_args::ScenarioArgs;
use crate::{json, sanitize};
use microsim_core::Census;
use microsim_core::scenario::{Diagnostic, Diagnostics};
use serde::Serialize;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "All problems are shown at once, at most twenty of a kind, each with its line and what would be accepted."
)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub scenario: ScenarioArgs,
    /// For people, or one JSON object on stdout
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = AnswerFormat::Text)]
    pub format: AnswerFormat,
}

/// How the answer is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum AnswerFormat {
    Text,
    Json,
}

/// Checks a scenario and prints its size or its problems.
pub(crate) fn check(args: &CheckArgs) -> Result<(), Failure> {
    match (prepare(&args.scenario), args.format) {
        (Ok(prepared), AnswerFormat::Text) => print_summary(&prepared),
        (Ok(prepared), AnswerFormat::Json) => Ok(print(json::pretty(&Answer::sound(&prepared))?)?),
        (Err(Failure::Scenario(source, problems)), AnswerFormat::Json) => {
            print(json::pretty(&Answer::refused(&source, &problems))?)?;
            Err(Failure::Reported)
        }
        (Err(failure), _) => Err(failure),
    }
}

fn print_summary(prepared: &Prepared) -> Result<(), Failure> {
    let Census { organisms, bodies, particles, constraints, .. } = prepared.built.world.census();
    let name = prepared.scenario.name();
    let counts = [(organisms, "organism"), (bodies, "body"), (particles, "particle"), (constraints, "constraint")];
    let size = counts.map(|(count, noun)| counted(count, noun)).join(", ");
    Ok(print(format!("ok: {}, {size}\n", sanitize::line(name)))?)
}

/// The JSON of `--format json`.
#[derive(Serialize)]
struct Answer<'a> {
    ok: bool,
    file: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario: Option<ScenarioSummary<'a>>,
    problems: Vec<Problem<'a>>,
    /// Of kinds of which enough are listed.
    left_out: Vec<More<'a>>,
}

#[derive(Serialize)]
struct ScenarioSummary<'a> {
    name: &'a str,
    seed: u64,
    duration: f32,
    organisms: usize,
    bodies: usize,
    particles: usize,
    constraints: usize,
}

#[derive(Serialize)]
struct Problem<'a> {
    /// From 1; absent when it came from the command line.
    line: Option<usize>,
    /// In characters, from 1.
    column: Option<usize>,
    /// First byte of the value and the one after its last.
    span: Option<[usize; 2]>,
    field: &'a str,
    message: &'a str,
    accepted: Option<&'a str>,
}

#[derive(Serialize)]
struct More<'a> {
    kind: &'a str,
    count: usize,
}

impl<'a> Answer<'a> {
    fn sound(prepared: &'a Prepared) -> Self {
        let Census { organisms, bodies, particles, constraints, .. } = prepared.built.world.census();
        let (name, seed, duration) = (prepared.scenario.name(), prepared.scenario.seed(), prepared.scenario.duration());
        let scenario = ScenarioSummary { name, seed, duration, organisms, bodies, particles, constraints };
        Self {
            ok: true,
            file: &prepared.source.origin,
            scenario: Some(scenario),
            problems: Vec::new(),
            left_out: Vec::new(),
        }
    }

    fn refused(source: &'a ScenarioText, problems: &'a Diagnostics) -> Self {
        let problem = |problem: &'a Diagnostic| Problem {
            line: problem.line,
            column: problem.column,
            span: problem.span.as_ref().map(|span| [span.start, span.end]),
            field: &problem.field,
            message: &problem.message,
            accepted: problem.accepted.as_deref(),
        };
        let left_out = problems.left_out().iter().map(|more| More { kind: &more.kind, count: more.count });
        let (problems, left_out) = (problems.iter().map(problem).collect(), left_out.collect());
        Self { ok: false, file: &source.origin, scenario: None, problems, left_out }
    }
}
