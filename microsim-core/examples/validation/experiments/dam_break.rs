//! Collapse of a column of liquid.

use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, particles, run_observed, value_at};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, FluidBlockSpec, FluidParams, Placement, World};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "dam_break",
    title: "Dam break",
    source: "Martin and Moyce 1952, Phil. Trans. R. Soc. A 244, 312, columns as high as wide and twice as high, 2.25 inches wide (tables of \
             fronts and heights; of the column twice as high tables 2 and 6), and the front of one 1.125 inches wide (readings of figure 3), \
             all as they are given in later work",
    words: "Columns of 20 x 20 and 20 x 40 spacings without viscosity, default step. Lengths are in widths `a` and in first heights `n² a`; \
            times are `n t sqrt(g / a)` for the front and `t sqrt(g / a)` for the height at the wall. The front is where 99.5 % of the \
            particles are behind.",
    run: measure,
    order: Order::None("what is compared is an experiment; the difference is that of particles of a finite size"),
};

/// Width of the column, units.
const WIDTH: f32 = 20.0;

/// Front over width at `n t sqrt(g / a)`, of a column 2.25 inches wide and twice as high.
const FRONT_TALL: [[f64; 2]; 14] = [
    [0.84, 1.22],
    [1.19, 1.44],
    [1.43, 1.67],
    [1.63, 1.89],
    [1.83, 2.11],
    [1.98, 2.33],
    [2.20, 2.56],
    [2.32, 2.78],
    [2.51, 3.00],
    [2.65, 3.22],
    [2.83, 3.44],
    [2.98, 3.67],
    [3.11, 3.89],
    [3.33, 4.11],
];
/// The same of one 1.125 inches wide.
const FRONT_NARROW: [[f64; 2]; 5] = [[0.85, 1.25], [1.21, 1.44], [1.60, 1.88], [2.28, 2.69], [2.95, 3.73]];
/// The same of one 2.25 inches wide and as high.
const FRONT_SQUARE: [[f64; 2]; 16] = [
    [0.62, 1.22],
    [0.80, 1.44],
    [0.97, 1.67],
    [1.14, 1.89],
    [1.29, 2.11],
    [1.45, 2.33],
    [1.62, 2.56],
    [1.76, 2.78],
    [1.93, 3.00],
    [2.07, 3.22],
    [2.24, 3.44],
    [2.40, 3.67],
    [2.54, 3.89],
    [2.71, 4.11],
    [2.87, 4.33],
    [3.04, 4.56],
];
/// Height at the wall over that of the column at `t sqrt(g / a)`, of the tall one 2.25 inches wide.
const HEIGHT_TALL: [[f64; 2]; 12] = [
    [0.56, 0.94],
    [0.77, 0.89],
    [0.93, 0.83],
    [1.08, 0.78],
    [1.28, 0.72],
    [1.46, 0.67],
    [1.66, 0.61],
    [1.84, 0.56],
    [2.00, 0.50],
    [2.21, 0.44],
    [2.45, 0.39],
    [2.70, 0.33],
];
/// The same of the square one.
const HEIGHT_SQUARE: [[f64; 2]; 6] =
    [[0.80, 0.89], [1.29, 0.78], [1.74, 0.67], [2.15, 0.56], [2.57, 0.44], [3.08, 0.33]];

/// Front over width at `n t sqrt(g / a)`, and height at the wall over that of the column at `t sqrt(g / a)`, of a column so many
/// times as high as wide.
fn collapse(stepping: Stepping, aspect: f32) -> Result<[Vec<[f64; 2]>; 2], Error> {
    let size = Vec2::new(WIDTH, aspect * WIDTH);
    let mut world = World::new(stepping.room(Vec2::new(9.0 * WIDTH, 3.0 * WIDTH), GRAVITY))?;
    let fluid = FluidParams { viscosity: 0.0, ..FluidParams::default() };
    let column = world.spawn(&FluidBlockSpec { size, fluid }.into(), Placement::at(0.5 * size.x, 0.5 * size.y))?;
    let unit = f64::from((GRAVITY / WIDTH).sqrt());
    let (mut fronts, mut heights) = (vec![[0.0, 1.0]], vec![[0.0, 1.0]]);
    run_observed(&mut world, 5.0, |world| {
        let mut xs: Vec<f32> = particles(world, column).iter().map(|p| p.position.x).collect();
        xs.sort_by(f32::total_cmp);
        let front = xs[xs.len() - xs.len() / 200] + 0.5;
        let at_wall = particles(world, column).into_iter().filter(|p| p.position.x < 2.0);
        let height = at_wall.map(|p| p.position.y + 0.5).fold(0.0, f32::max);
        let time = world.time() * unit;
        fronts.push([time * f64::from(aspect).sqrt(), f64::from(front / size.x)]);
        heights.push([time, f64::from(height / size.y)]);
    });
    Ok([fronts, heights])
}

/// Mean of the differences of a curve from published points, as shares, and the largest.
fn differences(curve: &[[f64; 2]], published: &[[f64; 2]]) -> [f64; 2] {
    let shares: Vec<f64> = published.iter().map(|[t, value]| (value_at(curve, *t) / value - 1.0).abs()).collect();
    [shares.iter().sum::<f64>() / shares.len() as f64, shares.iter().copied().fold(0.0, f64::max)]
}

fn measure() -> Result<Outcome, Error> {
    let [square_fronts, square_heights] = collapse(Stepping::DEFAULT, 1.0)?;
    let [fronts, heights] = collapse(Stepping::DEFAULT, 2.0)?;
    let mut rows = Vec::new();
    let mut curves = Vec::new();
    for (name, curve, published) in [
        ("front, n² 2, a 57 mm", &fronts, &FRONT_TALL[..]),
        ("front, n² 2, a 29 mm", &fronts, &FRONT_NARROW[..]),
        ("height, n² 2, a 57 mm", &heights, &HEIGHT_TALL[..]),
        ("front, n² 1, a 57 mm", &square_fronts, &FRONT_SQUARE[..]),
        ("height, n² 1, a 57 mm", &square_heights, &HEIGHT_SQUARE[..]),
    ] {
        let [mean, largest] = differences(curve, published);
        rows.push(Row::between(format!("{name}: mean difference, share"), "0", [0.0, 0.08], mean));
        rows.push(Row::between(format!("{name}: largest difference, share"), "0", [0.0, 0.15], largest));
        curves.push(Curve::dots(name, published.to_vec()));
    }
    let until = |curve: Vec<[f64; 2]>, end: f64| curve.into_iter().filter(|point| point[0] < end).collect();
    for (name, curve) in [
        ("front, n² 2, ours", fronts),
        ("height, n² 2, ours", heights),
        ("front, n² 1, ours", square_fronts),
        ("height, n² 1, ours", square_heights),
    ] {
        curves.push(Curve::line(name, until(curve, 3.5)));
    }
    let axes = ["time: n t sqrt(g / a) for fronts, t sqrt(g / a) for heights", "front, height"];
    Ok(Outcome { rows, plot: Some(Plot { axes, is_logarithmic: false, curves }), ..Outcome::default() })
}
