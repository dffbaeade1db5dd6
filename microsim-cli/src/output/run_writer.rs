//! Writes the outputs of a scenario while it runs: tables, events, pictures and snapshots.

use super::events::Events;
use super::folder::Outputs;
use super::measures::Measures;
use super::moments::{Moments, moment_name};
use super::table::{DataTable, file_name};
use super::trajectories::{self, Trajectories};
use super::{CHECKPOINT, Rhythm};
use crate::draw::png::Picture;
use crate::draw::{self, svg};
use crate::failure::Failure;
use crate::read;
use microsim_core::World;
use microsim_core::scenario::{Built, OutputPlan, TableFormat};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

/// Longer side of the picture of the end, pixels.
const FRAME: u32 = 1200;

/// The files of a run and what they still wait for.
#[derive(Debug)]
pub(crate) struct RunWriter<'o> {
    outputs: &'o Outputs,
    measures: Option<Measures>,
    trajectories: Option<Trajectories>,
    events: Option<Events>,
    moments: Option<Moments>,
    /// Steps that are pictured.
    frames: PicturedSteps,
    frame_width: u32,
    /// Steps of which the state is written.
    snapshots: Vec<u64>,
    /// Whether it must be possible to resume.
    is_resumable: bool,
}

/// Lengths and names of the files that a run has written so far.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct FileProgress {
    /// Bytes of the files that grow.
    lengths: BTreeMap<String, u64>,
    /// Events that no row of the measures counts yet.
    events: u64,
    /// Files that were written whole.
    whole: Vec<String>,
}

impl FileProgress {
    /// Refuses files that are not those of the plan, lie elsewhere or do not end with a row. Changes nothing.
    fn check(&self, outputs: &Outputs, plan: &OutputPlan) -> Result<(), Failure> {
        let refuse = |why: String| {
            let path = outputs.folder().join(CHECKPOINT);
            Err(Failure::Message(format!("{}: {why}; run the scenario again", path.display())))
        };
        let table = |name, formats: &[TableFormat]| formats.iter().map(|&f| file_name(name, f)).collect::<Vec<_>>();
        let tables = [table("measures", &plan.measures.formats), table("trajectories", &plan.trajectories.formats)];
        let events = plan.events.then(|| Events::FILE.to_owned());
        let expected: BTreeSet<String> = tables.into_iter().flatten().chain(events).collect();
        if !self.lengths.keys().eq(&expected) {
            return refuse("its tables are not those of its scenario".to_owned());
        }
        for name in &self.whole {
            let is_plain = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
            if !is_plain || name.is_empty() {
                return refuse(format!("{name:?} is no name of a file in the folder"));
            }
            let path = outputs.folder().join(name);
            read::open(&path).map_err(|error| Failure::file("read", &path, &error))?;
        }
        self.lengths.iter().try_for_each(|(name, &length)| outputs.check_resumable(name, length))
    }
}

/// Refuses formats that this program was built without.
pub(crate) fn check_formats(plan: &OutputPlan) -> Result<(), Failure> {
    let mut wanted = plan.measures.formats.iter().chain(&plan.trajectories.formats);
    if cfg!(feature = "parquet") || !wanted.any(|format| *format == TableFormat::Parquet) {
        return Ok(());
    }
    let accepted = "accepted: csv, jsonl, or a build with --features parquet";
    Err(Failure::Message(format!("output.formats: this program was built without Parquet, {accepted}")))
}

impl<'o> RunWriter<'o> {
    /// Opens new files and writes the world before its first step.
    pub(crate) fn start(outputs: &'o Outputs, plan: &OutputPlan, built: &Built, steps: u64) -> Result<Self, Failure> {
        let mut writer = Self::open(outputs, plan, built, steps, &BTreeMap::new())?;
        writer.look_at(&built.world)?;
        Ok(writer)
    }

    /// Continues the files of a run from a checkpoint.
    pub(crate) fn resume(
        outputs: &'o Outputs,
        plan: &OutputPlan,
        built: &Built,
        steps: u64,
        progress: &FileProgress,
    ) -> Result<Self, Failure> {
        progress.check(outputs, plan)?;
        let mut moments = plan.pictures.then(|| Moments::new(steps));
        if let Some(moments) = &mut moments {
            moments.take_up(outputs.folder(), &built.world)?;
        }
        let mut writer = Self::open(outputs, plan, built, steps, &progress.lengths)?;
        writer.moments = moments;
        if let Some(measures) = &mut writer.measures {
            *measures.pending_events() = progress.events;
        }
        outputs.note_written(&progress.whole);
        Ok(writer)
    }

    /// Puts the files on the disk and returns their lengths and names.
    pub(crate) fn progress(&mut self) -> Result<FileProgress, Failure> {
        let mut lengths = BTreeMap::new();
        let measures = self.measures.iter_mut().map(|m| &mut m.table);
        for table in measures.chain(self.trajectories.iter_mut().map(|t| &mut t.table)) {
            lengths.extend(table.lengths()?);
        }
        if let Some(events) = &mut self.events {
            lengths.insert(Events::FILE.to_owned(), events.0.keep()?);
        }
        let events = self.measures.as_mut().map_or(0, |measures| *measures.pending_events());
        Ok(FileProgress { lengths, events, whole: self.outputs.names_written() })
    }

    /// Opens the files, at their `lengths` if the run is resumed.
    fn open(
        outputs: &'o Outputs,
        plan: &OutputPlan,
        built: &Built,
        steps: u64,
        lengths: &BTreeMap<String, u64>,
    ) -> Result<Self, Failure> {
        let world = &built.world;
        let length = |name: &str| lengths.get(name).copied();
        let open = |name: &str, formats: &[TableFormat], columns: Vec<&'static str>| {
            let table = || DataTable::open(outputs, name, formats, columns, length);
            (!formats.is_empty()).then(table).transpose()
        };
        let measures = open("measures", &plan.measures.formats, Measures::columns(&plan.measured))?;
        let rhythm = Rhythm::every(plan.measures.every, world);
        let measures = measures.map(|table| Measures::new(table, &plan.measured, rhythm));
        let trajectories = open("trajectories", &plan.trajectories.formats, trajectories::COLUMNS.to_vec())?;
        let rhythm = Rhythm::every(plan.trajectories.every, world);
        let trajectories = trajectories.map(|table| Trajectories::new(table, &built.named, rhythm));
        let events = match length(Events::FILE) {
            _ if !plan.events => None,
            Some(length) => Some(Events(outputs.resume(Events::FILE, length)?)),
            None => Some(Events(outputs.file(Events::FILE)?)),
        };
        let moments = plan.pictures.then(|| Moments::new(steps));
        let (frames, frame_width) = (PicturedSteps::of(plan, world), plan.frames.width);
        let snapshots = plan.snapshots.iter().map(|&time| step_at(time, world)).collect();
        let is_resumable = plan.checkpoint_every > 0;
        Ok(Self { outputs, measures, trajectories, events, moments, frames, frame_width, snapshots, is_resumable })
    }

    /// Writes the outputs that are due after a step.
    pub(crate) fn look_at(&mut self, world: &World) -> Result<(), Failure> {
        let step = world.step_index();
        let moment = self.moments.as_mut().and_then(|moments| moments.look_at(world));
        if let Some(picture) = moment.filter(|_| self.is_resumable) {
            self.outputs.replace(&moment_name(step), &picture.to_raw())?;
        }
        if let Some(events) = &mut self.events {
            events.look_at(world)?;
        }
        if let Some(measures) = &mut self.measures {
            measures.look_at(world)?;
        }
        if let Some(trajectories) = &mut self.trajectories {
            trajectories.look_at(world)?;
        }
        if self.frames.contains(step) {
            let picture = Picture::of(&draw::draw(world), self.frame_width);
            self.outputs.write(&format!("frames/{step:08}.png"), &picture.encoded()?)?;
        }
        if self.snapshots.contains(&step) {
            let bytes = world.to_snapshot();
            let bytes = bytes.map_err(|error| Failure::Message(format!("cannot write a snapshot: {error}")))?;
            self.outputs.write(&format!("snapshots/{step:08}.snapshot"), &bytes)?;
        }
        Ok(())
    }

    /// Gives all files their names. Returns those that only an unfinished run needs, for [`crate::checkpoint::remove`].
    pub(crate) fn finish(self, world: &World) -> Result<Vec<PathBuf>, Failure> {
        let outputs = self.outputs;
        let mut needless = Vec::new();
        let (measures, trajectories) = (self.measures.map(|m| m.table), self.trajectories.map(|t| t.table));
        for table in [measures, trajectories].into_iter().flatten() {
            needless.extend(table.finish(outputs)?);
        }
        if let Some(events) = self.events {
            outputs.finish(events.0)?;
        }
        let Some(moments) = self.moments else {
            return Ok(needless);
        };
        let page = draw::draw(world);
        outputs.write("frame.svg", svg::write(&page, FRAME).as_bytes())?;
        outputs.write("frame.png", &Picture::of(&page, FRAME).encoded()?)?;
        outputs.write("frames.png", &moments.sheet().encoded()?)?;
        let waiting = moments.until(u64::MAX).filter(|_| self.is_resumable);
        needless.extend(waiting.map(|step| outputs.folder().join(moment_name(step))));
        Ok(needless)
    }
}

fn step_at(time: f32, world: &World) -> u64 {
    (f64::from(time) / f64::from(world.config().dt)).round() as u64
}

/// Steps that are pictured: a run of any length keeps only those that are named.
#[derive(Debug)]
struct PicturedSteps {
    named: Vec<u64>,
    every: Option<u64>,
}

impl PicturedSteps {
    fn of(plan: &OutputPlan, world: &World) -> Self {
        let every = (plan.frames.every > 0.0).then(|| step_at(plan.frames.every, world).max(1));
        Self { named: plan.frames.at.iter().map(|&time| step_at(time, world)).collect(), every }
    }

    fn contains(&self, step: u64) -> bool {
        self.named.contains(&step) || self.every.is_some_and(|every| step.is_multiple_of(every))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepared::{Prepared, apart};
    use crate::session::timed_step;
    use std::fs;

    const TABLES: &str = "
        [output]
        pictures = false
        [output.measures]
        formats = ['csv']
        of = ['organisms']
        every = 0.166667
        [output.trajectories]
        formats = ['csv']
        every = 1.0
    ";

    fn place(name: &str) -> PathBuf {
        std::env::temp_dir().join(format!("microsim-{name}-{}", std::process::id()))
    }

    fn advance(built: &mut Built, writer: &mut RunWriter<'_>, to: u64) {
        while built.world.step_index() < to {
            timed_step(built);
            writer.look_at(&built.world).unwrap();
        }
    }

    #[test]
    fn rows_name_their_organisms_and_count_events_across_a_resumption() {
        let folder = place("rows");
        let outputs = Outputs::open(&folder, true).unwrap();
        let Prepared { scenario, mut built, .. } = apart(TABLES);
        let mut writer = RunWriter::start(&outputs, scenario.output(), &built, 20).unwrap();
        advance(&mut built, &mut writer, 8);
        let progress = writer.progress().unwrap();
        drop(writer);
        let mut writer = RunWriter::resume(&outputs, scenario.output(), &built, 20, &progress).unwrap();
        advance(&mut built, &mut writer, 20);
        writer.finish(&built.world).unwrap();
        let [measures, trajectories] =
            ["measures.csv", "trajectories.csv"].map(|name| fs::read_to_string(folder.join(name)).unwrap());
        drop(outputs);
        fs::remove_dir_all(&folder).unwrap();
        // There are events in steps 1, 7, 13 and 19.
        assert_eq!(measures, "step,time,events,organisms\n0,0,0,2\n10,0.166667,2,2\n20,0.333333,2,2\n");
        let rows: Vec<&str> = trajectories.lines().skip(1).collect();
        assert!(rows[0].starts_with("0,0,0:0,amoeboid_cell,one,10,15,0,"), "{rows:?}");
        assert!(rows[1].starts_with("0,0,1:0,amoeboid_cell,other,30,15,0,"), "{rows:?}");
    }

    #[test]
    fn a_name_is_no_formula_in_a_table() {
        let folder = place("formula");
        let outputs = Outputs::open(&folder, true).unwrap();
        let more = format!("[[spawn]]\nof = 'cell'\nname = '-A1'\nat = [20.0, 6.0]\n{TABLES}");
        let Prepared { scenario, built, .. } = apart(&more);
        let writer = RunWriter::start(&outputs, scenario.output(), &built, 20).unwrap();
        writer.finish(&built.world).unwrap();
        let rows = fs::read_to_string(folder.join("trajectories.csv")).unwrap();
        drop(outputs);
        fs::remove_dir_all(&folder).unwrap();
        assert!(rows.contains(",'-A1,") && !rows.contains(",-A1,"), "{rows}");
    }

    #[test]
    fn pictures_wait_in_the_folder_only_where_the_run_can_be_resumed() {
        for every in [0, 5] {
            let folder = place("waiting");
            let outputs = Outputs::open(&folder, true).unwrap();
            let Prepared { scenario, built, .. } = apart(&format!("[output]\ncheckpoint_every = {every}"));
            let writer = RunWriter::start(&outputs, scenario.output(), &built, 20).unwrap();
            assert_eq!(folder.join(moment_name(0)).exists(), every > 0);
            drop(writer);
            drop(outputs);
            let _ = fs::remove_dir_all(&folder);
        }
    }

    #[test]
    fn what_is_not_in_the_folder_is_not_taken_up() {
        let folder = place("elsewhere");
        let outputs = Outputs::open(&folder, true).unwrap();
        let Prepared { scenario, built, .. } = apart(TABLES);
        let progress = RunWriter::start(&outputs, scenario.output(), &built, 20).unwrap().progress().unwrap();
        assert!(progress.check(&outputs, scenario.output()).is_ok());
        fs::create_dir_all(folder.join("deep")).unwrap();
        let missing = format!("cannot read {}: ", folder.join("deep/none").display());
        for (name, words) in
            [("deep/../.lock", "is no name of a file"), ("", "is no name of a file"), ("deep/none", &missing)]
        {
            let progress = FileProgress { whole: vec![name.to_owned()], lengths: progress.lengths.clone(), events: 0 };
            let refused = format!("{:?}", progress.check(&outputs, scenario.output()));
            assert!(refused.contains(words), "{refused}");
        }
        drop(outputs);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn frames_are_at_the_moments_that_are_named_and_at_those_between() {
        let steps = |frames: &str| {
            let Prepared { scenario, built, .. } = apart(&format!("[output.frames]\nat = [0.15, 0.2]\n{frames}"));
            let pictured = PicturedSteps::of(scenario.output(), &built.world);
            (0..=20).filter(|&step| pictured.contains(step)).collect::<Vec<u64>>()
        };
        assert_eq!(steps(""), [9, 12]);
        assert_eq!(steps("every = 0.1"), [0, 6, 9, 12, 18]);
        let Prepared { scenario, built, .. } = apart("[output.frames]\nevery = 0.1\n");
        let pictured = PicturedSteps::of(scenario.output(), &built.world);
        assert!(pictured.contains(u64::MAX / 6 * 6) && pictured.named.is_empty(), "a run of any length keeps no list");
    }
}
