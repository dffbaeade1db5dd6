//! Heat maps: a value for every pair of two others.

use super::chart::open;
use super::page::escape;
use super::scale::{Scale, short};
use std::fmt::Write;

/// From the least to the greatest value; each step is about as much lighter than the one before.
const RAMP: [[f64; 3]; 5] =
    [[68.0, 1.0, 84.0], [59.0, 82.0, 139.0], [33.0, 145.0, 140.0], [94.0, 201.0, 98.0], [253.0, 231.0, 37.0]];

/// The values of a heat map, row by row; `None` where there is none.
pub(super) struct HeatMap<'a> {
    pub columns: (&'a str, &'a [String]),
    pub rows: (&'a str, &'a [String]),
    pub values: Vec<Option<f64>>,
}

impl HeatMap<'_> {
    pub(super) fn svg(&self) -> String {
        let (left, right, top, bottom) = (64.0, 70.0, 6.0, 40.0);
        let (columns, rows) = (self.columns.1.len().max(1), self.rows.1.len().max(1));
        let cell = (300.0 / columns as f64).clamp(4.0, 60.0);
        let height = (cell * 0.7).max(160.0 / rows as f64).clamp(4.0, 40.0);
        let (width, depth) = (cell * columns as f64, height * rows as f64);
        let heat = Scale::over(self.values.iter().flatten().copied(), 0.0, 1.0);
        let mut svg = open(left + width + right, top + depth.max(80.0) + bottom);
        for (index, value) in self.values.iter().enumerate() {
            let (i, j) = (index % columns, index / columns);
            let (x, y) = (left + i as f64 * cell, top + depth - (j + 1) as f64 * height);
            self.cell(&mut svg, [x, y, cell, height], [i, j], value.map(|value| (value, heat.share(value))));
        }
        let x_labels = labels(self.columns.1, cell, 34.0);
        for (i, label) in x_labels {
            let x = left + (i as f64 + 0.5) * cell;
            let _ =
                write!(svg, "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>", top + depth + 14.0);
        }
        for (j, label) in labels(self.rows.1, height, 13.0) {
            let y = top + depth - (j as f64 + 0.5) * height + 4.0;
            let _ = write!(svg, "<text x=\"{:.1}\" y=\"{y:.1}\" text-anchor=\"end\">{label}</text>", left - 5.0);
        }
        let (middle, below) = (left + width / 2.0, top + depth + 30.0);
        let (x_name, y_name) = (escape(self.columns.0), escape(self.rows.0));
        let _ = write!(svg, "<text x=\"{middle:.1}\" y=\"{below:.1}\" text-anchor=\"middle\">{x_name}</text>");
        let y = top + depth / 2.0;
        let _ =
            write!(svg, "<text transform=\"translate(11 {y:.1}) rotate(-90)\" text-anchor=\"middle\">{y_name}</text>");
        key(&mut svg, left + width + 12.0, top, depth.max(80.0), heat.ends());
        svg + "</svg>"
    }

    fn cell(&self, svg: &mut String, [x, y, width, height]: [f64; 4], [i, j]: [usize; 2], value: Option<(f64, f64)>) {
        let Some((value, share)) = value.filter(|(value, _)| value.is_finite()) else {
            return;
        };
        let title =
            format!("{} {}, {} {}: {}", self.columns.0, self.columns.1[i], self.rows.0, self.rows.1[j], short(value));
        let _ = write!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{}\"><title>{}</title></rect>",
            colour(share),
            escape(title)
        );
        if width >= 34.0 && height >= 14.0 {
            let ink = if share > 0.55 { "#111" } else { "#fff" };
            let (x, y) = (x + width / 2.0, y + height / 2.0 + 4.0);
            let text = short(value);
            let _ = write!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" style=\"fill:{ink}\">{text}</text>"
            );
        }
    }
}

/// As many labels as there is room for, with their places.
fn labels(all: &[String], room: f64, needed: f64) -> impl Iterator<Item = (usize, String)> {
    let every = (needed / room).ceil().max(1.0) as usize;
    all.iter().enumerate().step_by(every).map(|(index, label)| (index, escape(label)))
}

fn key(svg: &mut String, x: f64, y: f64, height: f64, [low, high]: [f64; 2]) {
    const STEPS: u32 = 24;
    let step = height / f64::from(STEPS);
    for k in 0..STEPS {
        let (y, fill) = (y + height - f64::from(k + 1) * step, colour((f64::from(k) + 0.5) / f64::from(STEPS)));
        let _ =
            write!(svg, "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"10\" height=\"{:.1}\" fill=\"{fill}\"/>", step + 0.3);
    }
    let (x, top, bottom) = (x + 14.0, y + 9.0, y + height);
    let _ = write!(svg, "<text x=\"{x:.1}\" y=\"{top:.1}\">{}</text>", short(high));
    let _ = write!(svg, "<text x=\"{x:.1}\" y=\"{bottom:.1}\">{}</text>", short(low));
}

fn colour(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (RAMP.len() - 1) as f64;
    let index = (at as usize).min(RAMP.len() - 2);
    let [r, g, b] = [0, 1, 2].map(|c| {
        let (from, to) = (RAMP[index][c], RAMP[index + 1][c]);
        (from + (to - from) * (at - index as f64)).round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_has_a_cell_that_says_what_it_is() {
        let names = |count: usize| (0..count).map(|k| format!("{k}")).collect::<Vec<_>>();
        let (columns, rows) = (names(3), names(2));
        let values = vec![Some(1.0), Some(2.0), None, Some(4.0), Some(5.0), Some(f64::NAN)];
        let svg = HeatMap { columns: ("a", &columns), rows: ("b", &rows), values }.svg();
        assert_eq!(svg.matches("<title>").count(), 4);
        assert!(svg.contains("a 1, b 1: 5") && !svg.contains("NaN"), "{svg}");
        assert_eq!((colour(0.0), colour(1.0)), ("#440154".to_owned(), "#fde725".to_owned()));
    }
}
