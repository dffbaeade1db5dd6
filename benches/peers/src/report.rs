//! Telling the rows: JSON for programs, Markdown tables, which a terminal shows as well, for people.

use crate::Scene;
use crate::engines::ENGINES;
use crate::measure::Row;
use crate::quality::CrowdQuality;
use comfy_table::Table;
use comfy_table::presets::ASCII_MARKDOWN;
use std::io::{Result, Write, stdout};

/// One array, a row a line.
pub(crate) fn json(rows: &[Row]) -> Result<()> {
    let lines = rows.iter().map(serde_json::to_string).collect::<serde_json::Result<Vec<_>>>()?;
    writeln!(stdout(), "[\n{}\n]", lines.join(",\n"))
}

/// A column: its title, and what it tells of a row.
type Column = (&'static str, fn(&Row) -> String);

const COMMON: &[Column] = &[
    ("count", |row| row.count.to_string()),
    ("bodies", |row| row.bodies.to_string()),
    ("engine", |row| row.engine.clone()),
    ("ms/step", |row| format!("{:.3}", row.ms_median)),
    ("p99", |row| format!("{:.3}", row.ms_p99)),
    ("x ours", |row| format!("{:.2}", row.times_microsim)),
];

const PLATELETS: &[Column] = &[
    ("ring error mean", |row| percent(row.quality.ring_error_mean)),
    ("max", |row| percent(row.quality.ring_error_max)),
    ("penetration max", |row| number(row.quality.penetration_max)),
    ("intruders", |row| row.quality.intruders_max.map_or_else(String::new, |n| n.to_string())),
    ("off anchor: stirred", |row| number(row.quality.anchor_offset_stirred)),
    ("rested mean", |row| number(row.quality.anchor_offset_returned)),
    ("rested max", |row| number(row.quality.anchor_offset_returned_max)),
];

const FLUID: &[Column] = &[
    ("compression max", |row| percent(row.quality.compression_max)),
    ("end", |row| percent(row.quality.compression_end)),
    ("lost", |row| row.quality.lost.map_or_else(String::new, |n| n.to_string())),
    ("energy per particle, end", |row| number(row.quality.kinetic_energy_end)),
];

const CROWD: &[Column] = &[
    ("leaks end", |row| crowd(row, |crowd| crowd.leaks_end.to_string())),
    ("max", |row| crowd(row, |crowd| crowd.leaks_max.to_string())),
    ("intruders", |row| crowd(row, |crowd| crowd.intruders_max.to_string())),
    ("longest link", |row| crowd(row, |crowd| format!("{:.2}", crowd.longest_link))),
    ("speed", |row| crowd(row, |crowd| format!("{:.2}", crowd.speed))),
    ("area end", |row| crowd(row, |crowd| format!("{:.2}", crowd.area_end))),
    ("least", |row| crowd(row, |crowd| format!("{:.2}", crowd.area_least))),
];

const MEMORY: Column = ("bytes/body", |row| row.bytes_per_body.map_or_else(String::new, |bytes| format!("{bytes:.0}")));

/// The tables, with the settings of the engines and the processor.
pub(crate) fn tables(rows: &[Row]) -> Result<()> {
    let mut out = stdout().lock();
    writeln!(out, "Processor: {}\n", processor())?;
    for engine in ENGINES {
        writeln!(out, "- `{}`: {}", engine.name, engine.settings)?;
    }
    let scenes = [
        (Scene::Platelets, "Platelet field", PLATELETS),
        (Scene::Fluid, "Fluid block", FLUID),
        (Scene::Crowd, "Crowd", CROWD),
    ];
    for (scene, title, own) in scenes.into_iter().filter(|scene| rows.iter().any(|row| row.scene == scene.0)) {
        let mut columns = [COMMON, own].concat();
        if rows.iter().any(|row| row.bytes_per_body.is_some()) {
            columns.push(MEMORY);
        }
        let mut table = Table::new();
        table.load_preset(ASCII_MARKDOWN).set_header(columns.iter().map(|(title, _)| *title));
        for row in rows.iter().filter(|row| row.scene == scene) {
            table.add_row(columns.iter().map(|(_, tell)| tell(row)));
        }
        writeln!(out, "\n{title}:\n\n{table}")?;
    }
    growth(&mut out, rows)
}

/// Fewest cells of the rows from which growth is told: with fewer, what does not grow counts.
const GROWTH_FROM: usize = 50;

/// By which power of the number of cells each engine's step grows.
fn growth(out: &mut impl Write, rows: &[Row]) -> Result<()> {
    let rows: Vec<&Row> = rows.iter().filter(|row| row.scene == Scene::Crowd && row.count >= GROWTH_FROM).collect();
    let mut engines: Vec<&str> = Vec::new();
    for row in &rows {
        if !engines.contains(&row.engine.as_str()) {
            engines.push(&row.engine);
        }
    }
    for engine in engines {
        let of_engine = rows.iter().filter(|row| row.engine == engine);
        let points: Vec<(f64, f64)> = of_engine.map(|row| ((row.count as f64).ln(), row.ms_median.ln())).collect();
        if points.len() > 1 {
            writeln!(out, "- `{engine}`: ms/step grows with the power {:.2} of the number of cells", slope(&points))?;
        }
    }
    Ok(())
}

/// Of the line of least squares through the points.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let sum = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>();
    let (x, y) = (sum(|p| p.0) / count, sum(|p| p.1) / count);
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

fn crowd(row: &Row, tell: fn(&CrowdQuality) -> String) -> String {
    row.quality.crowd.as_ref().map_or_else(String::new, tell)
}

fn percent(share: Option<f64>) -> String {
    share.map_or_else(String::new, |share| format!("{:.2} %", 100.0 * share))
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:.3}"))
}

/// What the system calls its processor.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("model name"));
    line.map_or_else(|| "unknown".to_owned(), |name| name.trim_start_matches([' ', '\t', ':']).to_owned())
}

#[cfg(test)]
mod tests {
    use super::slope;

    #[test]
    fn slope_of_a_power_is_its_exponent() {
        let points = [50.0_f64, 200.0, 1000.0].map(|n| (n.ln(), (3.0 * n.powf(1.2)).ln()));
        assert!((slope(&points) - 1.2).abs() < 1e-9);
    }
}
