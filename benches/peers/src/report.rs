//! Telling the rows: JSON for programs, Markdown tables, which a terminal shows as well, for people.

use crate::Scene;
use crate::engines::ENGINES;
use crate::measure::Row;
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

const MEMORY: Column = ("bytes/body", |row| row.bytes_per_body.map_or_else(String::new, |bytes| format!("{bytes:.0}")));

/// The tables, with the settings of the engines and the processor.
pub(crate) fn tables(rows: &[Row]) -> Result<()> {
    let mut out = stdout().lock();
    writeln!(out, "Processor: {}\n", processor())?;
    for engine in ENGINES {
        writeln!(out, "- `{}`: {}", engine.name, engine.settings)?;
    }
    for (scene, title, own) in [(Scene::Platelets, "Platelet field", PLATELETS), (Scene::Fluid, "Fluid block", FLUID)] {
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
    Ok(())
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
