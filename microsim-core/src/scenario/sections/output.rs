//! Files that a run writes: the table `[output]`. The library itself writes none; the program that runs a scenario does.

use crate::Measure;
use crate::scenario::reader::{Fields, Keyword};

/// Longest time that makes sense, s.
const LONGEST: f32 = 1e6;
/// Time between two samples of a file that does not say, s.
const EVERY: f32 = 0.1;
/// Width of pictures of a file that does not say, pixels.
const WIDTH: u32 = 1280;

/// What a scenario wants written while it runs.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct OutputPlan {
    /// Measures over time.
    pub measures: TablePlan,
    /// Which measures.
    pub measured: Vec<Measure>,
    /// Place, speed and area of every organism over time.
    pub trajectories: TablePlan,
    /// Whether all events are written.
    pub events: bool,
    /// Whether the end and six moments are pictured.
    pub pictures: bool,
    /// Pictures of moments.
    pub frames: FramePlan,
    /// Times at which the whole state is written, s.
    pub snapshots: Vec<f32>,
    /// Number of steps between two checkpoints; 0 for none.
    pub checkpoint_every: u32,
}

/// A table that grows while a scenario runs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TablePlan {
    /// Formats in which it is written; none: it is not.
    pub formats: Vec<TableFormat>,
    /// Time between two samples, s; 0 for every step.
    pub every: f32,
}

/// Pictures while a scenario runs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FramePlan {
    /// Times, s.
    pub at: Vec<f32>,
    /// Time between two more pictures, s; 0 for none.
    pub every: f32,
    /// Longer side, pixels.
    pub width: u32,
}

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    /// Values separated by commas, with a header.
    Csv,
    /// One JSON object a line.
    Jsonl,
    /// Apache Parquet.
    Parquet,
}

impl TableFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Csv, Self::Jsonl, Self::Parquet];

    /// Its name, which is also the end of a file's.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.keyword()
    }
}

/// Reads the `[output]` table.
pub(crate) fn read(root: &mut Fields<'_>) -> OutputPlan {
    let mut fields = root.table("output");
    let mut measures = fields.table("measures");
    let measured = read_measured(&mut measures);
    let plan = OutputPlan {
        measures: read_table(measures, vec![TableFormat::Csv]),
        measured,
        trajectories: read_table(fields.table("trajectories"), Vec::new()),
        events: fields.or("events", true),
        pictures: fields.or("pictures", true),
        frames: read_frames(fields.table("frames")),
        snapshots: times(&mut fields, "snapshots"),
        checkpoint_every: fields.or("checkpoint_every", 0),
    };
    fields.finish();
    plan
}

fn read_table(mut fields: Fields<'_>, formats: Vec<TableFormat>) -> TablePlan {
    let mut formats = fields.or("formats", formats);
    let mut seen = Vec::new();
    formats.retain(|format| {
        let is_new = !seen.contains(format);
        seen.push(*format);
        is_new
    });
    let every = fields.number("every", EVERY, [0.0, LONGEST]);
    fields.finish();
    TablePlan { formats, every }
}

/// The measures named, or all.
fn read_measured(fields: &mut Fields<'_>) -> Vec<Measure> {
    let Some(names) = fields.get::<Vec<String>>("of") else {
        return Measure::ALL.to_vec();
    };
    let mut measured = Vec::new();
    for (index, name) in names.iter().enumerate() {
        match Measure::named(name) {
            Some(measure) => measured.push(measure),
            None => {
                let known = Measure::ALL.iter().map(|measure| measure.name());
                fields.refuse_unknown(&format!("of.{index}"), "measure", name, known);
            }
        }
    }
    measured
}

fn read_frames(mut fields: Fields<'_>) -> FramePlan {
    let at = times(&mut fields, "at");
    let every = fields.number("every", 0.0, [0.0, LONGEST]);
    let width = fields.or("width", WIDTH);
    if !(16..=8192).contains(&width) {
        fields.refuse("width", format!("{width} is out of range"), "16 to 8192");
    }
    fields.finish();
    FramePlan { at, every, width }
}

fn times(fields: &mut Fields<'_>, field: &'static str) -> Vec<f32> {
    let times = fields.or(field, Vec::<f32>::new());
    let is_sound =
        |(index, time): &(usize, &f32)| fields.is_within(&format!("{field}.{index}"), **time, [0.0, LONGEST]);
    times.iter().enumerate().filter(is_sound).map(|(_, time)| *time).collect()
}

impl Keyword for TableFormat {
    const KEYWORDS: &'static [(&'static str, Self)] =
        &[("csv", Self::Csv), ("jsonl", Self::Jsonl), ("parquet", Self::Parquet)];
}
