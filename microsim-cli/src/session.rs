//! A run with its files, from its first step or from a checkpoint on.

use crate::checkpoint::{self, Saved};
use crate::console::{Console, stdout};
use crate::diagnostics::ScenarioText;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::{Outputs, Recorder, write_description};
use crate::record::{KeepArgs, Recording};
use crate::simulate::Tally;
use crate::source::Prepared;
use crate::summary::RunReport;
use microsim_core::World;
use microsim_core::scenario::{Built, OutputPlan};
use microsim_core::snapshot::Checkpoint;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

/// A run that is under way.
#[derive(Debug)]
pub(crate) struct Session<'o> {
    /// What is run, and the world as it is now.
    prepared: Prepared,
    /// Steps that it takes in all.
    steps: u64,
    outputs: Option<&'o Outputs>,
    recorder: Option<Recorder<'o>>,
    tally: Tally,
    /// Whether the whole state is checked after every step.
    validates: bool,
    /// The first check that broke, or what was wrong with the state.
    broken: Option<String>,
    digest_at_start: String,
    recording: Option<Recording>,
    keep: Option<&'o KeepArgs>,
}

impl<'o> Session<'o> {
    /// Begins a run.
    pub(crate) fn start(
        prepared: Prepared,
        steps: u64,
        outputs: Option<&'o Outputs>,
        validates: bool,
        keep: &'o KeepArgs,
    ) -> Result<Self, Failure> {
        let start = |outputs| Recorder::start(outputs, prepared.scenario.output(), &prepared.built, steps);
        let recorder = outputs.map(start).transpose()?;
        let digest_at_start = format!("{:016x}", prepared.built.world.digest());
        let recording = keep.start(prepared.scenario.origin())?;
        let (tally, broken, keep) = (Tally::default(), None, Some(keep));
        Ok(Self { prepared, steps, outputs, recorder, tally, validates, broken, digest_at_start, recording, keep })
    }

    /// Goes on with the run of a folder.
    pub(crate) fn resume(outputs: &'o Outputs) -> Result<Self, Failure> {
        let (saved, Checkpoint { origin, run: built, .. }) = checkpoint::read(outputs.folder())?;
        let source = ScenarioText::new(saved.source.clone(), origin.text.clone());
        let scenario = match origin.scenario() {
            Ok(scenario) => scenario,
            Err(problems) => return Err(Failure::Scenario(source, problems)),
        };
        let recorder = Recorder::resume(outputs, scenario.output(), &built, saved.steps, &saved.progress)?;
        let prepared = Prepared { source, scenario, built, overrides: origin.overrides };
        Ok(Self {
            prepared,
            steps: saved.steps,
            outputs: Some(outputs),
            recorder: Some(recorder),
            tally: saved.tally,
            validates: saved.validates,
            broken: saved.broken,
            digest_at_start: saved.digest_at_start,
            recording: None,
            keep: None,
        })
    }

    pub(crate) fn plan(&self) -> &OutputPlan {
        self.prepared.scenario.output()
    }

    /// Takes the steps that are left, finishes the files, prints what came of it, and says whether all that must hold did.
    pub(crate) fn run(mut self, is_json: bool, console: &Console) -> Result<(), Failure> {
        let (name, seed, first) = (self.prepared.name(), self.prepared.scenario.seed(), self.tally.steps);
        console.detail(|| format!("running {name} with seed {seed}: steps {first} to {}", self.steps));
        let bar = console.progress(self.steps, "step");
        let start = Instant::now();
        let every = self.checkpoint_every();
        while self.tally.steps < self.steps && !interrupt::is_asked() {
            self.step()?;
            bar.set_position(self.tally.steps);
            if every.is_some_and(|every| self.tally.steps.is_multiple_of(every)) {
                self.save()?;
            }
        }
        bar.finish_and_clear();
        self.tally.wall = start.elapsed();
        self.tally.is_interrupted = self.tally.steps < self.steps;
        match self.outputs {
            Some(outputs) if self.tally.is_interrupted && every.is_some() => self.leave(outputs),
            _ => self.conclude(is_json, console),
        }
    }

    fn step(&mut self) -> Result<(), Failure> {
        let built = &mut self.prepared.built;
        let took = timed_step(built);
        self.tally.add(&built.world, &built.world.census(), took);
        let broken = built.checks.after_step(&built.world).first().map(ToString::to_string);
        let violation = || if self.validates { violation(&built.world) } else { None };
        self.broken = self.broken.take().or(broken).or_else(violation);
        self.recording.as_mut().map_or(Ok(()), |recording| recording.add(&built.world))?;
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.look_at(&built.world))
    }

    fn checkpoint_every(&self) -> Option<u64> {
        let every = u64::from(self.plan().checkpoint_every);
        self.outputs.filter(|_| every > 0).map(|_| every)
    }

    /// Writes a checkpoint.
    fn save(&mut self) -> Result<(), Failure> {
        let (Some(outputs), Some(recorder)) = (self.outputs, &mut self.recorder) else {
            return Ok(());
        };
        let saved = Saved {
            source: self.prepared.source.origin().to_owned(),
            steps: self.steps,
            progress: recorder.progress()?,
            tally: self.tally.clone(),
            validates: self.validates,
            broken: self.broken.clone(),
            digest_at_start: self.digest_at_start.clone(),
        };
        let run = self.prepared.built.clone();
        checkpoint::write(outputs, &saved, &Checkpoint { origin: self.prepared.scenario.origin(), run })
    }

    /// Stops so that the run can be resumed.
    fn leave(mut self, outputs: &Outputs) -> Result<(), Failure> {
        self.save()?;
        self.recorder.map_or(Ok(()), Recorder::leave)?;
        let (step, folder) = (self.tally.steps, shown(outputs.folder()));
        Err(Failure::Stopped(format!("stopped after step {step}; to go on: microsim resume {folder}")))
    }

    fn conclude(self, is_json: bool, console: &Console) -> Result<(), Failure> {
        let built = &self.prepared.built;
        self.recording.map_or(Ok(()), |recording| recording.finish(&built.world))?;
        self.keep.map_or(Ok(()), |keep| keep.save(self.prepared.scenario.origin(), built))?;
        let refusals = built.script.refusals().iter().map(ToString::to_string);
        let failures = self.broken.into_iter().chain(refusals).collect();
        let report = RunReport { failures, ..RunReport::new(&self.prepared, &built.world, self.tally) };
        if let (Some(recorder), Some(outputs)) = (self.recorder, self.outputs) {
            let waiting = recorder.finish(&built.world)?;
            write_description(outputs, &self.prepared, &report, &self.digest_at_start)?;
            checkpoint::remove(outputs.folder(), waiting);
            console.note(&format!("wrote {}", outputs.folder().display()));
        }
        print(&report, is_json)?;
        verdict(&report, self.prepared.name())
    }
}

/// What is wrong with the state, if anything is.
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

fn print(report: &RunReport, is_json: bool) -> Result<(), Failure> {
    let mut out = stdout();
    if is_json {
        serde_json::to_writer(&mut out, report).map_err(std::io::Error::from)?;
        writeln!(out)?;
        return Ok(out.flush()?);
    }
    Ok(report.table().print(out)?)
}
