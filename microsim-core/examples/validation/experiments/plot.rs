//! Plots of points and lines as SVG.

use std::fmt::Write;

const SIZE: [f64; 2] = [560.0, 340.0];
/// Left, top, right, bottom.
const MARGIN: [f64; 4] = [64.0, 16.0, 16.0, 48.0];
/// Colours that are told apart by most people with colour blindness (Okabe and Ito 2008).
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#555555"];
const TICKS: usize = 5;

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
            let x = width - MARGIN[2] - 8.0;
            let _ =
                writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" fill=\"{colour}\">{}</text>", curve.label);
        }
        svg + "</svg>\n"
    }

    /// The axis of one coordinate, over all that is drawn.
    fn axis(&self, k: usize) -> Axis {
        let values = self.curves.iter().flat_map(|curve| curve.points.iter().map(|point| point[k]));
        let values: Vec<f64> = values.map(|value| if self.is_logarithmic { value.log10() } else { value }).collect();
        let low = values.iter().fold(f64::INFINITY, |low, &value| low.min(value));
        let high = values.iter().fold(f64::NEG_INFINITY, |high, &value| high.max(value));
        let low = if !self.is_logarithmic && low > 0.0 && low < 0.5 * high { 0.0 } else { low };
        let screen = if k == 0 { [MARGIN[0], SIZE[0] - MARGIN[2]] } else { [SIZE[1] - MARGIN[3], MARGIN[1]] };
        Axis { range: [low, high], screen, is_logarithmic: self.is_logarithmic }
    }

    fn draw_axes(&self, svg: &mut String, axes: &[Axis; 2]) {
        let ([left, right], [bottom, top]) = (axes[0].screen, axes[1].screen);
        let _ = writeln!(svg, "<path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" stroke=\"black\"/>");
        for [at, value] in axes[0].ticks() {
            let y = bottom + 16.0;
            let _ = writeln!(svg, "<text x=\"{at:.1}\" y=\"{y}\" text-anchor=\"middle\">{}</text>", number(value));
        }
        for [at, value] in axes[1].ticks() {
            let (x, y) = (left - 6.0, at + 4.0);
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
    /// Of what is drawn; of its logarithms where the axis is logarithmic.
    range: [f64; 2],
    screen: [f64; 2],
    is_logarithmic: bool,
}

impl Axis {
    fn place(&self, value: f64) -> f64 {
        let value = if self.is_logarithmic { value.log10() } else { value };
        let [low, high] = self.range;
        self.screen[0] + (self.screen[1] - self.screen[0]) * (value - low) / (high - low)
    }

    /// Places and values of its ticks.
    fn ticks(&self) -> Vec<[f64; 2]> {
        let [low, high] = self.range;
        let tick = |k: usize| low + (high - low) * k as f64 / TICKS as f64;
        let value = |k: usize| if self.is_logarithmic { 10f64.powf(tick(k)) } else { tick(k) };
        (0..=TICKS).map(|k| [self.place(value(k)), value(k)]).collect()
    }
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
