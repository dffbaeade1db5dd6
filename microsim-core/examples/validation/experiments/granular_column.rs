//! Collapse of a column of grains.

use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, add_floor, exponent, particles, run};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, FluidBlockSpec, FluidMode, FluidParams, Material, Placement, World};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "granular_column",
    title: "Granular column",
    source: "In the plane: Lube, Huppert, Sparks and Freundt 2005, Phys. Rev. E 72, 041301: run-out over width 1.2 a for a < 1.8, \
             1.9 a^(2/3) for a > 2.8; Balmforth and Kerswell 2005, J. Fluid Mech. 538, 399: a^(0.9 ± 0.1) in wide channels, \
             a^(0.65 ± 0.05) in narrow slots, coefficients that depend on the material",
    words: "Columns of grains, 20 spacings wide, friction 0.5, collapse from a wall onto a floor of the same friction. \
            The run-out is that of 99 % of the grains. The bounds are the exponents of both papers with their errors, and half \
            to twice Lube's run-out, because coefficients depend on the material; our discs do not rotate.",
    run: measure,
    order: Order::None("where grains come to rest depends on every contact on the way"),
};

/// Height of the floor, units.
const FLOOR: f32 = 2.0;

/// Places of grains of a column of this width and aspect ratio after they have come to rest, relative to its lower left corner.
pub(crate) fn collapse([width, aspect]: [f32; 2], friction: f32, seconds: f32) -> Result<Vec<Vec2>, Error> {
    let size = Vec2::new(width, width * aspect);
    let length = width * (4.0 + 6.0 * aspect);
    let mut world = World::new(Stepping::DEFAULT.room(Vec2::new(length, size.y + 10.0), GRAVITY))?;
    add_floor(&mut world, FLOOR, Material { friction, restitution: 0.0 })?;
    let fluid = FluidParams { mode: FluidMode::Granular, viscosity: 0.0, friction, ..FluidParams::default() };
    let centre = 0.5 * size + Vec2::new(0.0, FLOOR);
    let column = world.spawn(&FluidBlockSpec { size, fluid }.into(), Placement::at(centre.x, centre.y))?;
    run(&mut world, seconds);
    Ok(particles(&world, column).iter().map(|grain| grain.position - Vec2::new(0.0, FLOOR)).collect())
}

/// Run-out over the column's width.
pub(crate) fn run_out(width: f32, grains: &[Vec2]) -> f64 {
    let mut xs: Vec<f32> = grains.iter().map(|grain| grain.x).collect();
    xs.sort_by(f32::total_cmp);
    f64::from((xs[xs.len() - 1 - xs.len() / 100] + 0.5) / width) - 1.0
}

fn lube(aspect: f64) -> f64 {
    if aspect < 2.3 { 1.2 * aspect } else { 1.9 * aspect.powf(2.0 / 3.0) }
}

fn measure() -> Result<Outcome, Error> {
    const WIDTH: f32 = 20.0;
    let mut points = Vec::new();
    for aspect in [0.5, 1.0, 1.5, 3.0, 5.0, 8.0f32] {
        points.push([f64::from(aspect), run_out(WIDTH, &collapse([WIDTH, aspect], 0.5, 15.0)?)]);
    }
    let mut rows: Vec<Row> = points
        .iter()
        .map(|&[aspect, ours]| {
            let [least, most] = [0.5, 2.0].map(|share| share * lube(aspect));
            let published = super::plot::number(lube(aspect));
            Row::between(format!("run-out over width, aspect {aspect}"), &published, [least, most], ours)
        })
        .collect();
    rows.push(Row::between("exponent, aspects 3 to 8", "0.65 to 0.9", [0.6, 1.0], exponent(&points[3..])));
    let published = points.iter().map(|&[aspect, _]| [aspect, lube(aspect)]).collect();
    let curves = vec![Curve::dots("ours", points), Curve::line("Lube et al. 2005", published)];
    let plot = Plot { axes: ["aspect ratio", "run-out over width"], is_logarithmic: true, curves };
    let cause = "the lowest column is ten rows high; what its run-out lacks is an eighth of a grain.";
    Ok(Outcome { rows, plot: Some(plot), cause })
}
