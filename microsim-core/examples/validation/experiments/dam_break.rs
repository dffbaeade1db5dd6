//! Collapse of a column of liquid.

use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, particles, run_observed, value_at};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, FluidBlockSpec, FluidParams, Placement, World};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "dam_break",
    title: "Dam break",
    source: "Martin and Moyce 1952, Phil. Trans. R. Soc. A 244, 312, columns twice as high as wide; numbers of the wider one as \
             they are tabulated in later work, of the narrower one readings of figure 3",
    words: "A column of 20 x 40 spacings without viscosity, default step. Times are `T = t sqrt(2 g / a)` for the front and \
            `t sqrt(g / a)` for the height at the wall, lengths in widths `a` and heights `2 a`. The front is where 99.5 % of \
            the particles are behind.",
    run: measure,
};

/// Width of the column, units.
const WIDTH: f32 = 20.0;

/// Front over width at `t sqrt(2 g / a)`, of a column 2.25 inches wide.
const FRONT_WIDE: [[f64; 2]; 14] = [
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
/// Height at the wall over that of the column at `t sqrt(g / a)`.
const HEIGHT: [[f64; 2]; 12] = [
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

/// Front over width, and height at the wall over that of the column, both over `t sqrt(g / a)`.
fn collapse(stepping: Stepping) -> Result<[Vec<[f64; 2]>; 2], Error> {
    let size = Vec2::new(WIDTH, 2.0 * WIDTH);
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
        fronts.push([time, f64::from(front / size.x)]);
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
    let [fronts, heights] = collapse(Stepping::DEFAULT)?;
    let fronts: Vec<[f64; 2]> = fronts.iter().map(|[t, z]| [t * 2f64.sqrt(), *z]).collect();
    let mut rows = Vec::new();
    for (name, curve, published) in [
        ("front, a = 57 mm", &fronts, &FRONT_WIDE[..]),
        ("front, a = 29 mm", &fronts, &FRONT_NARROW[..]),
        ("height", &heights, &HEIGHT[..]),
    ] {
        let [mean, largest] = differences(curve, published);
        rows.push(Row::between(format!("{name}: mean difference, share"), "0", [0.0, 0.08], mean));
        rows.push(Row::between(format!("{name}: largest difference, share"), "0", [0.0, 0.15], largest));
    }
    let until = |curve: Vec<[f64; 2]>, end: f64| curve.into_iter().filter(|point| point[0] < end).collect();
    let curves = vec![
        Curve::line("front over width, ours", until(fronts, 3.5)),
        Curve::dots("front, 57 mm", FRONT_WIDE.to_vec()),
        Curve::dots("front, 29 mm", FRONT_NARROW.to_vec()),
        Curve::line("height over first height, ours", until(heights, 3.5)),
        Curve::dots("height", HEIGHT.to_vec()),
    ];
    let axes = ["time: t sqrt(2 g / a) for fronts, t sqrt(g / a) for heights", "front, height"];
    Ok(Outcome { rows, plot: Some(Plot { axes, is_logarithmic: false, curves }), ..Outcome::default() })
}
