//! Plots of points and lines as SVG.

use std::fmt::Write;

const SIZE: [f64; 2] = [720.0, 340.0];
/// Left, top, right with the legend, bottom.
const MARGIN: [f64; 4] = [72.0, 16.0, 216.0, 48.0];
/// Colours that are told apart by most people with colour blindness (Okabe and Ito 2008).
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#555555"];
/// Most steps between the marks of a linear axis.
const STEPS: f64 = 6.0;

/// Curves over common axes.
pub(crate) struct Plot {
    pub axes: [&'static str; 2],
    /// Whether both axes are logarithmic.
    pub is_logarithmic: bool,
    pub curves: Vec<Curve>,
}

/// Points, drawn as such or joined by a line.
pub(crate) struct Curve {
    pub label: String,
    pub points: Vec<[f64; 2]>,
    pub is_line: bool,
}

impl Curve {
    pub(crate) fn line(label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { label: label.into(), points, is_line: true }
    }

    pub(crate) fn dots(label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { label: label.into(), points, is_line: false }
    }
}

impl Plot {
    pub(crate) fn svg(&self) -> String {
        let [width, height] = SIZE;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
             font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
        );
        let axes = [self.axis(0), self.axis(1)];
        self.draw_axes(&mut svg, &axes);
        for ((k, curve), colour) in self.curves.iter().enumerate().zip(COLOURS.iter().cycle()) {
            draw_curve(&mut svg, curve, colour, &|point: &[f64; 2]| [0, 1].map(|k| axes[k].place(point[k])));
            let y = MARGIN[1] + 16.0 * (k as f64 + 1.0);
            let x = width - MARGIN[2] + 12.0;
            let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" fill=\"{colour}\">{}</text>", curve.label);
        }
        svg + "</svg>\n"
    }

    /// The axis of one coordinate, over all that is drawn.
    fn axis(&self, k: usize) -> Axis {
        let values = self.curves.iter().flat_map(|curve| curve.points.iter().map(|point| point[k]));
        let [low, high] =
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        let ticks = if self.is_logarithmic { logarithmic_ticks(low, high) } else { linear_ticks(low, high) };
        let screen = if k == 0 { [MARGIN[0], SIZE[0] - MARGIN[2]] } else { [SIZE[1] - MARGIN[3], MARGIN[1]] };
        Axis { ticks, screen, is_logarithmic: self.is_logarithmic }
    }

    fn draw_axes(&self, svg: &mut String, axes: &[Axis; 2]) {
        let ([left, right], [bottom, top]) = (axes[0].screen, axes[1].screen);
        let _ = writeln!(svg, "<path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" stroke=\"black\"/>");
        for &value in &axes[0].ticks {
            let (at, y) = (axes[0].place(value), bottom + 16.0);
            let _ = writeln!(svg, "<text x=\"{at:.1}\" y=\"{y}\" text-anchor=\"middle\">{}</text>", number(value));
        }
        for &value in &axes[1].ticks {
            let (x, y) = (left - 6.0, axes[1].place(value) + 4.0);
            let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y:.1}\" text-anchor=\"end\">{}</text>", number(value));
        }
        let (middle, below) = (0.5 * (left + right), bottom + 36.0);
        let _ = writeln!(svg, "<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{}</text>", self.axes[0]);
        let middle = 0.5 * (bottom + top);
        let turned = format!("transform=\"translate(14 {middle}) rotate(-90)\" text-anchor=\"middle\"");
        let _ = writeln!(svg, "<text {turned}>{}</text>", self.axes[1]);
    }
}

/// Where values lie on the picture.
struct Axis {
    /// Values with a mark; the first and the last are the ends.
    ticks: Vec<f64>,
    screen: [f64; 2],
    is_logarithmic: bool,
}

impl Axis {
    fn place(&self, value: f64) -> f64 {
        let along = |value: f64| if self.is_logarithmic { value.log10() } else { value };
        let [low, high] = [self.ticks[0], self.ticks[self.ticks.len() - 1]].map(along);
        self.screen[0] + (self.screen[1] - self.screen[0]) * (along(value) - low) / (high - low)
    }
}

/// Multiples of a round number that enclose a range.
fn linear_ticks(low: f64, high: f64) -> Vec<f64> {
    let low = if low > 0.0 && low < 0.5 * high { 0.0 } else { low };
    let power = 10f64.powf(((high - low) / STEPS).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    let step = steps.into_iter().find(|step| STEPS * step >= high - low).unwrap_or(steps[3]);
    let [first, last] = [(low / step).floor() as i64, (high / step).ceil() as i64];
    (first..=last).map(|k| k as f64 * step).collect()
}

/// Powers of ten that enclose a range; over two of them and less also 2 and 5 times each.
fn logarithmic_ticks(low: f64, high: f64) -> Vec<f64> {
    let [first, last] = [low.log10().floor() as i32, high.log10().ceil() as i32];
    let factors: &[f64] = if last - first > 2 { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let all: Vec<f64> = (first..=last).flat_map(|k| factors.iter().map(move |factor| factor * 10f64.powi(k))).collect();
    let from = all.iter().rposition(|&tick| tick <= low).unwrap_or(0);
    let to = all.iter().position(|&tick| tick >= high).unwrap_or(all.len() - 1);
    all[from..=to].to_vec()
}

fn draw_curve(svg: &mut String, curve: &Curve, colour: &str, place: &dyn Fn(&[f64; 2]) -> [f64; 2]) {
    let places = curve.points.iter().map(place);
    if curve.is_line {
        let line: Vec<String> = places.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let _ = writeln!(svg, "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\"/>", line.join(" "));
    } else {
        for [x, y] in places {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>");
        }
    }
}

/// A number with four digits that count.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    match size {
        0.0 => "0".into(),
        _ if !(1e-3..1e5).contains(&size) => format!("{value:.2e}"),
        _ => {
            let decimals = (3 - size.log10().floor() as i32).max(0) as usize;
            let text = format!("{value:.decimals$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
        }
    }
}
