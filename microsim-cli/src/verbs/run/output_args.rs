//! The options of `run` that change the output table of its scenario.

use crate::value_parser::duration;

/// Each option stands for a `--set output...`.
#[derive(Debug, clap::Args)]
pub(crate) struct OutputArgs {
    /// Formats of the measures over time: csv, jsonl, parquet, several with commas, or none
    #[arg(long, value_name = "FORMATS", requires = "out")]
    measures: Option<String>,
    /// Time between two rows of measures, s; 0 for every step
    #[arg(long, value_name = "S", value_parser = duration, requires = "out")]
    every: Option<f64>,
    /// Formats of the position, speed and area of every organism over time
    #[arg(long, value_name = "FORMATS", requires = "out")]
    trajectories: Option<String>,
    /// Times of more pictures, s, with commas
    #[arg(long, value_name = "TIMES", requires = "out", allow_hyphen_values = true)]
    frames: Option<String>,
    /// Times at which the whole state is written, s, with commas
    #[arg(long, value_name = "TIMES", requires = "out", allow_hyphen_values = true)]
    snapshots: Option<String>,
    /// Steps between two checkpoints, from which `resume` continues after Ctrl-C or a crash
    #[arg(long, value_name = "N", requires = "out")]
    checkpoint_every: Option<u32>,
    /// Leave out the pictures of the end and of six moments
    #[arg(long, requires = "out")]
    no_pictures: bool,
}

impl OutputArgs {
    /// As overrides of the scenario.
    pub(super) fn overrides(&self) -> Vec<(String, String)> {
        let formats = |list: &String| match list.as_str() {
            "none" => "[]".to_owned(),
            list => format!("[{}]", list.split(',').map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")),
        };
        let set = [
            ("output.measures.formats", self.measures.as_ref().map(formats)),
            ("output.measures.every", self.every.map(|every| every.to_string())),
            ("output.trajectories.formats", self.trajectories.as_ref().map(formats)),
            ("output.frames.at", self.frames.as_ref().map(|times| format!("[{times}]"))),
            ("output.snapshots", self.snapshots.as_ref().map(|times| format!("[{times}]"))),
            ("output.checkpoint_every", self.checkpoint_every.map(|every| every.to_string())),
            ("output.pictures", self.no_pictures.then(|| "false".to_owned())),
        ];
        set.into_iter().filter_map(|(key, value)| Some((key.to_owned(), value?))).collect()
    }
}
