//! `run`: a whole scenario, with its files.

use crate::args::RunArgs;
use crate::console::{Console, stdout};
use crate::draw::png::Picture;
use crate::draw::{self, svg};
use crate::failure::Failure;
use crate::interrupt;
use crate::moments::Moments;
use crate::output::Outputs;
use crate::record::Recording;
use crate::report::{EventFile, MeasureFile, RunReport};
use crate::simulate::{Tally, simulate};
use crate::source::{Prepared, prepare};
use indicatif::ProgressBar;
use microsim_core::World;
use microsim_core::scenario::{Built, Script};
use serde::Serialize;
use std::io::Write;
use std::time::{Duration, Instant};

/// Longer side of the picture of the last frame, pixels.
const FRAME: u32 = 1600;

/// Runs a scenario, writes its files and says what came of it.
pub(crate) fn run(args: &RunArgs, console: &Console) -> Result<(), Failure> {
    let prepared = prepare(&args.scenario)?;
    interrupt::listen();
    let outputs = args.out.as_deref();
    let outputs = outputs.map(|folder| Outputs::open(folder, args.force)).transpose()?;
    let steps = args.steps.unwrap_or_else(|| prepared.steps_in(args.seconds));
    let mut built = prepared.built.clone();
    let mut record = outputs.as_ref().map(|outputs| Record::start(outputs, &built.world, steps)).transpose()?;
    let mut recording = args.keep.start(prepared.scenario.origin())?;
    let bar = console.progress(steps);
    let keepers = Keepers { record: record.as_mut(), recording: recording.as_mut() };
    let (tally, failures) = advance(&mut built, steps, args.validate, &bar, keepers)?;
    bar.finish_and_clear();
    recording.map_or(Ok(()), |recording| recording.finish(&built.world))?;
    args.keep.save(prepared.scenario.origin(), &built)?;
    let report = RunReport { failures, ..RunReport::new(&prepared, &built.world, tally) };
    if let (Some(record), Some(outputs)) = (record, &outputs) {
        record.finish(outputs, &built.world)?;
        write_description(outputs, &prepared, args, &report)?;
        console.note(&format!("wrote {}", outputs.folder().display()));
    }
    print(&report, args.json)?;
    verdict(&report, prepared.name())
}

/// Takes the steps. Returns also what failed: the first check that broke, the first violation if the state is to be
/// validated, then commands that were refused.
fn advance(
    built: &mut Built,
    steps: u64,
    validates: bool,
    bar: &ProgressBar,
    mut keepers: Keepers<'_>,
) -> Result<(Tally, Vec<String>), Failure> {
    let Built { world, script, checks, .. } = built;
    let mut broken = None;
    let mut invalid = None;
    let see = |world: &World| {
        bar.set_position(world.step_index());
        broken = broken.or_else(|| checks.after_step(world).first().copied());
        if validates && invalid.is_none() {
            invalid = world.validate().err().map(|violation| format!("after step {}: {violation}", world.step_index()));
        }
        keepers.add(world)
    };
    let tally = simulate(world, steps, |world| timed_step(world, script), see)?;
    let refusals = script.refusals().iter().map(ToString::to_string);
    Ok((tally, broken.iter().map(ToString::to_string).chain(invalid).chain(refusals).collect()))
}

fn verdict(report: &RunReport, name: &str) -> Result<(), Failure> {
    if report.interrupted {
        return Err(Failure::Interrupted);
    }
    if report.failures.is_empty() {
        return Ok(());
    }
    let line = |failure: &String| format!("{name} with seed {}: {failure}", report.seed);
    Err(Failure::Broken(report.failures.iter().map(line).collect()))
}

fn timed_step(world: &mut World, script: &mut Script) -> Duration {
    let inputs = script.before_step(world);
    let start = Instant::now();
    world.step(inputs);
    start.elapsed()
}

/// What writes while the run goes on.
struct Keepers<'a> {
    record: Option<&'a mut Record>,
    recording: Option<&'a mut Recording>,
}

impl Keepers<'_> {
    fn add(&mut self, world: &World) -> Result<(), Failure> {
        self.recording.as_mut().map_or(Ok(()), |recording| recording.add(world))?;
        self.record.as_mut().map_or(Ok(()), |record| record.add(world))
    }
}

/// What `--out` collects while the run goes on.
#[derive(Debug)]
struct Record {
    measures: MeasureFile,
    events: EventFile,
    moments: Moments,
}

impl Record {
    fn start(outputs: &Outputs, world: &World, steps: u64) -> Result<Self, Failure> {
        let mut moments = Moments::new(steps);
        moments.look_at(world);
        Ok(Self { measures: MeasureFile::create(outputs)?, events: EventFile::create(outputs)?, moments })
    }

    fn add(&mut self, world: &World) -> Result<(), Failure> {
        self.moments.look_at(world);
        self.events.add(world)?;
        self.measures.add(world)
    }

    fn finish(self, outputs: &Outputs, world: &World) -> Result<(), Failure> {
        self.measures.finish()?;
        self.events.finish()?;
        let drawing = draw::draw(world);
        outputs.write("frame.svg", svg::write(&drawing, FRAME).as_bytes())?;
        outputs.write("frame.png", &Picture::of(&drawing, FRAME).encoded()?)?;
        outputs.write("frames.png", &self.moments.sheet().encoded()?)
    }
}

/// `run.json`: the report, and what is needed to run it again.
#[derive(Serialize)]
struct Description<'a> {
    #[serde(flatten)]
    report: &'a RunReport,
    target: String,
    source: &'a str,
    overrides: &'a [(String, String)],
    scenario_text: &'a str,
}

fn write_description(
    outputs: &Outputs,
    prepared: &Prepared,
    args: &RunArgs,
    report: &RunReport,
) -> Result<(), Failure> {
    let description = Description {
        report,
        target: format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
        source: prepared.source.origin(),
        overrides: &args.scenario.set,
        scenario_text: prepared.source.text(),
    };
    let mut text = serde_json::to_string_pretty(&description).map_err(std::io::Error::from)?;
    text.push('\n');
    outputs.write("run.json", text.as_bytes())
}

fn print(report: &RunReport, is_json: bool) -> Result<(), Failure> {
    let mut out = stdout();
    if is_json {
        serde_json::to_writer(&mut out, report).map_err(std::io::Error::from)?;
        writeln!(out)?;
        return Ok(out.flush()?);
    }
    Ok(report.table().print(out)?)
}
