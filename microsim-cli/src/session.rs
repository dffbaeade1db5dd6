//! A run with its files, from its first step or from a checkpoint on.

use crate::checkpoint::{self, CheckpointHeader};
use crate::console::{Console, print_json};
use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::{FileProgress, Outputs, RunWriter, write_description};
use crate::prepared::Prepared;
use crate::record_args::{RecordArgs, ReplayWriter};
use crate::summary::RunReport;
use crate::tally::Tally;
use microsim_core::World;
use microsim_core::scenario::{Built, OutputPlan};
use microsim_core::snapshot::Checkpoint;
use std::path::Path;
use std::time::{Duration, Instant};

/// A run that is under way.
#[derive(Debug)]
pub(crate) struct Session<'o> {
    /// The scenario and its world at the current step.
    prepared: Prepared,
    header: CheckpointHeader,
    outputs: Option<&'o Outputs>,
    writer: Option<RunWriter<'o>>,
    replay: Option<ReplayWriter>,
    record: Option<&'o RecordArgs>,
}

impl<'o> Session<'o> {
    pub(crate) fn start(
        prepared: Prepared,
        steps: u64,
        outputs: Option<&'o Outputs>,
        validates: bool,
        record: &'o RecordArgs,
    ) -> Result<Self, Failure> {
        if let Some(outputs) = outputs {
            checkpoint::give_up(outputs)?;
        }
        let start = |outputs| RunWriter::start(outputs, prepared.scenario.output(), &prepared.built, steps);
        let writer = outputs.map(start).transpose()?;
        let replay = record.start(prepared.scenario.origin())?;
        let header = CheckpointHeader {
            source: prepared.source.origin.clone(),
            steps,
            progress: FileProgress::default(),
            tally: Tally::default(),
            validates,
            broken: None,
            digest_at_start: format!("{:016x}", prepared.built.world.digest()),
        };
        Ok(Self { prepared, header, outputs, writer, replay, record: Some(record) })
    }

    /// Continues the run of a folder from its checkpoint.
    pub(crate) fn resume(outputs: &'o Outputs) -> Result<Self, Failure> {
        let (header, Checkpoint { origin, run: built, .. }) = checkpoint::read(outputs.folder())?;
        let source = ScenarioText::new(header.source.clone(), origin.text.clone());
        let scenario = match origin.scenario() {
            Ok(scenario) => scenario,
            Err(problems) => return Err(Failure::Scenario(source, problems)),
        };
        let writer = RunWriter::resume(outputs, scenario.output(), &built, header.steps, &header.progress)?;
        let prepared = Prepared { source, scenario, built, overrides: origin.overrides };
        Ok(Self { prepared, header, outputs: Some(outputs), writer: Some(writer), replay: None, record: None })
    }

    pub(crate) fn plan(&self) -> &OutputPlan {
        self.prepared.scenario.output()
    }

    /// Takes the remaining steps, finishes the files and prints the summary. Fails if a check of the scenario did.
    pub(crate) fn run(self, is_json: bool, console: &Console) -> Result<(), Failure> {
        let name = self.prepared.name().to_owned();
        let report = self.complete(console)?;
        let printed = if is_json { print_json(&report) } else { report.table().print() };
        // A reader that has gone away does not change the verdict.
        verdict(&report, &name).and(printed.map_err(Failure::from))
    }

    /// Takes the remaining steps and finishes the files.
    pub(crate) fn complete(mut self, console: &Console) -> Result<RunReport, Failure> {
        let (name, seed, first) = (self.prepared.name(), self.prepared.scenario.seed(), self.header.tally.steps);
        console.detail(|| format!("running {name} with seed {seed}: steps {first} to {}", self.header.steps));
        let bar = console.progress(self.header.steps, "step");
        let start = Instant::now();
        let every = self.checkpoint_every();
        while self.header.tally.steps < self.header.steps && !interrupt::is_asked() {
            self.step()?;
            bar.set_position(self.header.tally.steps);
            if every.is_some_and(|every| self.header.tally.steps.is_multiple_of(every)) {
                self.save()?;
            }
        }
        bar.finish_and_clear();
        self.header.tally.wall = start.elapsed();
        self.header.tally.is_interrupted = self.header.tally.steps < self.header.steps;
        match self.outputs {
            Some(outputs) if self.header.tally.is_interrupted && every.is_some() => Err(self.leave(outputs)?),
            _ => self.conclude(console),
        }
    }

    fn step(&mut self) -> Result<(), Failure> {
        let built = &mut self.prepared.built;
        let took = timed_step(built);
        self.header.tally.add(&built.world, took);
        let broken = built.checks.after_step(&built.world).first().map(ToString::to_string);
        let violation = || if self.header.validates { violation(&built.world) } else { None };
        self.header.broken = self.header.broken.take().or(broken).or_else(violation);
        if let Some(replay) = &mut self.replay {
            replay.add(&built.world)?;
        }
        if let Some(writer) = &mut self.writer {
            writer.look_at(&built.world)?;
        }
        Ok(())
    }

    fn checkpoint_every(&self) -> Option<u64> {
        let every = u64::from(self.plan().checkpoint_every);
        self.outputs.filter(|_| every > 0).map(|_| every)
    }

    fn save(&mut self) -> Result<(), Failure> {
        let (Some(outputs), Some(writer)) = (self.outputs, &mut self.writer) else {
            return Ok(());
        };
        self.header.progress = writer.progress()?;
        let run = self.prepared.built.clone();
        checkpoint::write(outputs, &self.header, &Checkpoint { origin: self.prepared.scenario.origin(), run })
    }

    /// Stops so that the run can be resumed. Returns what to tell the user.
    fn leave(mut self, outputs: &Outputs) -> Result<Failure, Failure> {
        self.save()?;
        let (step, folder) = (self.header.tally.steps, shown(outputs.folder()));
        Ok(Failure::Stopped(format!("stopped after step {step}; to continue: microsim resume {folder}")))
    }

    fn conclude(self, console: &Console) -> Result<RunReport, Failure> {
        let built = &self.prepared.built;
        // What fails here must not take the folder of results with it.
        let recorded = self.replay.map_or(Ok(()), |replay| replay.finish(&built.world));
        let saved = self.record.map_or(Ok(()), |record| record.save(self.prepared.scenario.origin(), built));
        let refusals = built.script.refusals().iter().map(ToString::to_string);
        let failures = self.header.broken.into_iter().chain(refusals).collect();
        let report = RunReport { failures, ..RunReport::new(&self.prepared, &built.world, self.header.tally) };
        if let (Some(writer), Some(outputs)) = (self.writer, self.outputs) {
            let waiting = writer.finish(&built.world)?;
            write_description(outputs, &self.prepared, &report, &self.header.digest_at_start)?;
            // Names that a power cut takes back would be missed once there is no checkpoint.
            outputs.sync()?;
            checkpoint::remove(outputs.folder(), waiting);
            console.note(&format!("wrote {}", outputs.folder().display()));
        }
        recorded.and(saved)?;
        Ok(report)
    }
}

/// The first violation of the state, if any.
fn violation(world: &World) -> Option<String> {
    world.validate().err().map(|violation| format!("after step {}: {violation}", world.step_index()))
}

/// A path as a shell takes it.
fn shown(path: &Path) -> String {
    let text = path.display().to_string();
    if text.contains(char::is_whitespace) { format!("'{text}'") } else { text }
}

/// Takes a step of a scenario.
pub(crate) fn timed_step(built: &mut Built) -> Duration {
    let inputs = built.script.before_step(&mut built.world);
    let start = Instant::now();
    built.world.step(inputs);
    start.elapsed()
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
