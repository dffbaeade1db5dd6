//! The page of a run.

use super::chart::{self, COLOURS};
use super::data::{self, TextTable};
use super::page::{Page, escape, figure, figures, folded, table};
use super::scale::short;
use crate::failure::Failure;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Columns of the table of measures that are not measures.
const FIXED: [&str; 2] = ["step", "time"];
/// Most organisms that are drawn one by one.
const MOST: usize = 60;

pub(super) fn make(folder: &Path) -> Result<String, Failure> {
    let path = folder.join("run.json");
    let Some(bytes) = data::bytes(&path)? else {
        let message = format!("{} has no run.json, accepted: what `microsim run --out` wrote", folder.display());
        return Err(Failure::Message(message));
    };
    let run: Value =
        serde_json::from_slice(&bytes).map_err(|error| Failure::Message(format!("{}: {error}", path.display())))?;
    let title = text(&run["scenario"]);
    let seconds = run["simulated_seconds"].as_f64().unwrap_or_default();
    let lead = format!("seed {}, {} steps, {seconds:.2} s simulated", run["seed"], run["steps"]);
    let mut page = Page::new(&title, &lead);
    page.warning(&list(&run["failures"]));
    page.section("Pictures", &pictures(folder)?);
    let measures = TextTable::read(folder, "measures")?;
    let (varying, constant) = over_time(&measures);
    page.section("Organisms", &organisms(&TextTable::read(folder, "trajectories")?));
    page.section("Measures", &(figures(&varying) + &table(&constant)));
    page.section("Events", &events(folder, seconds)?);
    page.section("Speed of the simulation", &step_times(&run));
    page.section("Result", &table(&rows(&run)));
    let scenario = escape(text(&run["effective_scenario"]));
    page.section("Parameters", &folded("The scenario as it was run", &format!("<pre>{scenario}</pre>")));
    page.section("Files", &table(&pairs(&run["files"])));
    Ok(page.finish(&title))
}

fn pictures(folder: &Path) -> Result<String, Failure> {
    let mut html = String::new();
    for (name, caption) in [("frames.png", "From start to end"), ("frame.png", "At the end")] {
        if let Some(bytes) = data::bytes(&folder.join(name))? {
            let image = format!("<img alt=\"{caption}\" src=\"data:image/png;base64,{}\">", STANDARD.encode(bytes));
            html += &format!("<div class=\"wide\">{}</div>", figure(caption, &image));
        }
    }
    Ok(html)
}

/// A figure for each measure that changes, and a row for each that does not.
fn over_time(measures: &TextTable) -> (Vec<String>, Vec<(String, String)>) {
    let times = measures.numbers("time");
    let (mut varying, mut constant) = (Vec::new(), Vec::new());
    for name in measures.names.iter().filter(|name| !FIXED.contains(&name.as_str())) {
        let values = measures.numbers(name);
        let caption = name.replace('_', " ");
        if values.iter().all(|value| *value == values[0]) {
            constant.extend(values.first().map(|value| (caption, short(*value))));
        } else {
            let points: Vec<_> = times.iter().copied().zip(values).collect();
            varying.push(figure(&caption, &chart::line(&points, "time, s")));
        }
    }
    (varying, constant)
}

/// Samples of one organism.
#[derive(Default)]
struct Track<'a> {
    kind: &'a str,
    place: Vec<(f64, f64)>,
    speed: Vec<(f64, f64)>,
    area: Vec<(f64, f64)>,
}

/// The samples of each organism, by its name.
fn tracks(trajectories: &TextTable) -> BTreeMap<&str, Track<'_>> {
    let [organism, kind] = ["organism", "kind"].map(|name| trajectories.texts(name));
    let [time, x, y, speed, area] = ["time", "x", "y", "speed", "area"].map(|name| trajectories.numbers(name));
    let mut tracks: BTreeMap<&str, Track<'_>> = BTreeMap::new();
    for (k, id) in organism.iter().enumerate() {
        let track = tracks.entry(id).or_default();
        track.kind = kind[k];
        track.place.push((x[k], y[k]));
        track.speed.push((time[k], speed[k]));
        track.area.push((time[k], area[k]));
    }
    tracks
}

fn organisms(trajectories: &TextTable) -> String {
    let tracks = tracks(trajectories);
    if tracks.is_empty() {
        return String::new();
    }
    let mut kinds: Vec<&str> = tracks.values().map(|track| track.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let colour = |kind: &str| COLOURS[kinds.iter().position(|known| *known == kind).unwrap_or(0) % COLOURS.len()];
    let series = |of: fn(&Track<'_>) -> Vec<(f64, f64)>, is_wanted: fn(&str) -> bool| -> Vec<_> {
        let wanted = tracks.values().filter(|track| is_wanted(track.kind));
        wanted.take(MOST).map(|track| (colour(track.kind), of(track))).collect()
    };
    let is_cell = |kind: &str| kind == "amoeboid_cell";
    let mut all = vec![figure("Paths", &chart::paths(&series(|track| track.place.clone(), |_| true)))];
    let speeds = series(|track| track.speed.clone(), |_| true);
    all.push(figure("Speed, µm/s", &chart::lines(&speeds, "time, s")));
    let areas = series(|track| track.area.clone(), is_cell);
    if !areas.is_empty() {
        all.push(figure("Area of amoeboid cells, µm²", &chart::lines(&areas, "time, s")));
    }
    let names: Vec<_> = kinds.iter().map(|kind| (colour(kind), *kind)).collect();
    chart::legend(&names) + &figures(&all)
}

fn events(folder: &Path, end: f64) -> Result<String, Failure> {
    let mut kinds: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for event in data::lines::<Value>(&folder.join("events.jsonl"))? {
        kinds.entry(text(&event["kind"])).or_default().extend(event["time"].as_f64());
    }
    if kinds.is_empty() {
        return Ok(String::new());
    }
    let kinds: Vec<_> = kinds.into_iter().map(|(name, times)| (name.replace('_', " "), times)).collect();
    Ok(figure("Times of events", &chart::rows(&kinds, end)))
}

fn step_times(run: &Value) -> String {
    let medians = run["step_ms_over_time"].as_array().map(Vec::as_slice).unwrap_or_default();
    let steps = run["steps"].as_f64().unwrap_or_default();
    let at = |k: usize| (k as f64 + 0.5) * steps / medians.len() as f64;
    let points: Vec<_> = medians.iter().enumerate().filter_map(|(k, ms)| Some((at(k), ms.as_f64()?))).collect();
    if points.is_empty() {
        String::new()
    } else {
        figures(&[figure("Time of a step, ms", &chart::line(&points, "step"))])
    }
}

/// The rows of the run's summary.
fn rows(run: &Value) -> Vec<(String, String)> {
    let names = [
        "digest",
        "digest_at_start",
        "organisms",
        "bodies",
        "particles",
        "constraints",
        "leaks",
        "improper_absorptions",
        "quarantined",
        "wall_seconds",
        "version",
        "target",
    ];
    let row = |name: &str| (name.replace('_', " "), text(&run[name]));
    names.into_iter().filter(|name| !run[name].is_null()).map(row).collect()
}

fn pairs(object: &Value) -> Vec<(String, String)> {
    object.as_object().into_iter().flatten().map(|(name, value)| (name.clone(), text(value))).collect()
}

fn list(array: &Value) -> Vec<String> {
    array.as_array().into_iter().flatten().map(text).collect()
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}
