//! The picture: time of a step against bodies, both logarithmic, a line for each engine.

use crate::Scene;
use crate::measure::Row;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;
use std::path::Path;

/// Distinguishable with any kind of colour vision (Okabe and Ito 2008); the first is ours.
const COLOURS: [RGBColor; 7] = [
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(120, 120, 120),
    RGBColor(150, 110, 0),
];

/// Time between two frames at 60 Hz, ms.
const FRAME: f64 = 1e3 / 60.0;

/// Draws the platelet field's rows.
///
/// # Errors
/// When the file cannot be written, or there is nothing to draw.
pub(crate) fn draw(rows: &[Row], path: &Path) -> Result<(), String> {
    let rows: Vec<&Row> = rows.iter().filter(|row| row.scene == Scene::Platelets).collect();
    try_draw(&rows, path).map_err(|error| format!("{}: {error}", path.display()))
}

fn try_draw(rows: &[&Row], path: &Path) -> Result<(), Box<dyn Error>> {
    let bodies = range(rows.iter().map(|row| row.bodies as f64)).ok_or("no rows")?;
    let times = range(rows.iter().map(|row| row.ms_median)).ok_or("no rows")?;
    let root = SVGBackend::new(path, (900, 560)).into_drawing_area();
    root.fill(&WHITE)?;
    // Room for the names at the right ends of the lines.
    let x = (bodies.0 * 0.85..bodies.1 * 2.2).log_scale();
    let y = (times.0 * 0.7..times.1 * 2.0).log_scale();
    let mut chart = ChartBuilder::on(&root)
        .caption("Platelet field, one thread: ms per step", ("sans-serif", 22))
        .margin(16)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .light_line_style(RGBColor(240, 240, 240))
        .bold_line_style(RGBColor(215, 215, 215))
        .x_desc("bodies (30 per platelet)")
        .y_desc("ms per step")
        .label_style(("sans-serif", 15))
        .x_labels(4)
        .x_max_light_lines(1)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y}"))
        .draw()?;
    let frame = [(bodies.0 * 0.85, FRAME), (bodies.1 * 2.2, FRAME)];
    chart.draw_series(DashedLineSeries::new(frame, 6, 4, BLACK.mix(0.5).into()))?;
    let anchor = Pos::new(HPos::Left, VPos::Bottom);
    let style = ("sans-serif", 14).into_font().color(&BLACK.mix(0.6)).pos(anchor);
    chart.draw_series([Text::new("one frame at 60 Hz", (bodies.0 * 0.88, FRAME * 1.03), style)])?;
    for (engine, colour) in engines(rows).into_iter().zip(COLOURS.into_iter().cycle()) {
        let of_engine = rows.iter().filter(|row| row.engine == engine);
        let points: Vec<(f64, f64)> = of_engine.map(|row| (row.bodies as f64, row.ms_median)).collect();
        let width = if engine.starts_with("microsim") { 4 } else { 2 };
        chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(width)))?;
        chart.draw_series(points.iter().map(|&point| Circle::new(point, width + 1, colour.filled())))?;
    }
    for (engine, at, colour) in names(rows) {
        let style = ("sans-serif", 15).into_font().color(&colour).pos(Pos::new(HPos::Left, VPos::Center));
        chart.draw_series([Text::new(engine.to_owned(), (bodies.1 * 1.06, at), style)])?;
    }
    root.present()?;
    Ok(())
}

/// Engines in the order of their first rows.
fn engines<'a>(rows: &[&'a Row]) -> Vec<&'a str> {
    let mut engines: Vec<&'a str> = rows.iter().map(|row| row.engine.as_str()).collect();
    let mut seen = Vec::new();
    engines.retain(|engine| {
        !seen.contains(engine) && {
            seen.push(*engine);
            true
        }
    });
    engines
}

/// Each engine's name, the height at its last point, moved up where it would lie on the one below, and its colour.
fn names<'a>(rows: &[&'a Row]) -> Vec<(&'a str, f64, RGBColor)> {
    let last = |engine: &str| rows.iter().filter(|row| row.engine == engine).map(|row| row.ms_median).next_back();
    let of_engine = engines(rows).into_iter().zip(COLOURS.into_iter().cycle());
    let mut names: Vec<_> = of_engine.filter_map(|(engine, colour)| Some((engine, last(engine)?, colour))).collect();
    names.sort_by(|a, b| a.1.total_cmp(&b.1));
    for k in 1..names.len() {
        names[k].1 = names[k].1.max(names[k - 1].1 * 1.22);
    }
    names
}

/// Least and largest value.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, v| Some(range.map_or((v, v), |(low, high): (f64, f64)| (low.min(v), high.max(v)))))
}
