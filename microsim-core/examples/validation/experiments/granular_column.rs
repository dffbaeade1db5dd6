//! Collapse of a column of grains.

use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, add_floor, exponent, mean, run};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{Error, FluidBlockSpec, FluidMode, FluidParams, Material, Obstacle, Placement, Rng, World};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "granular_column",
    title: "Granular column",
    source: "In the plane: Lube, Huppert, Sparks and Freundt 2005, Phys. Rev. E 72, 041301: run-out over width 1.2 a for a < 1.8, \
             1.9 a^(2/3) for a > 2.8; Balmforth and Kerswell 2005, J. Fluid Mech. 538, 399: a^(0.9 ± 0.1) in wide channels, \
             a^(0.65 ± 0.05) in narrow slots, coefficients that depend on the material",
    words: "Columns of grains, 40 spacings wide, friction 0.5, that came to rest behind a smooth gate from loose random rows, collapse \
            from a wall onto a floor of the same friction when the gate is taken away; means of three seeds. The run-out is that of \
            99 % of the grains. The bounds are the exponents of both papers with their errors, and half \
            to twice Lube's run-out, because coefficients depend on the material; our discs do not rotate.",
    run: measure,
    order: Order::None("where grains come to rest depends on every contact on the way"),
};

/// Height of the floor, units.
const FLOOR: f32 = 2.0;

/// Grains in a unit of area, at random: they cover 0.82 of it.
const GRAINS: f32 = 1.04;

/// Places of grains of a column of this width and aspect ratio after they have come to rest, relative to its lower left corner. They
/// fall from loose rows behind a gate, and for so many seconds from when it is opened.
pub(crate) fn collapse([width, aspect]: [f32; 2], friction: f32, seconds: f32, seed: u64) -> Result<Vec<Vec2>, Error> {
    let (height, length) = (width * aspect, width * (4.0 + 6.0 * aspect));
    let mut world = World::new(Stepping::DEFAULT.room(Vec2::new(length, 2.0 * height + 20.0), GRAVITY))?;
    add_floor(&mut world, FLOOR, Material { friction, restitution: 0.0 })?;
    let gate =
        Obstacle::new(SharedShape::cuboid(1.0, height + 10.0), Pose::translation(width + 1.0, FLOOR + height + 10.0));
    let gate = world.add_obstacle(gate)?;
    let fluid = FluidParams { mode: FluidMode::Granular, viscosity: 0.0, friction, ..FluidParams::default() };
    for at in loose_rows(width, (width * height * GRAINS) as u32, seed) {
        world.spawn(&FluidBlockSpec { size: Vec2::ONE, fluid }.into(), Placement::at(at.x, FLOOR + at.y))?;
    }
    run(&mut world, 1.5 * height.sqrt());
    world.remove_obstacle(gate)?;
    run(&mut world, seconds);
    let grains = world.view().organisms().flat_map(|organism| organism.particles());
    Ok(grains.map(|grain| grain.position - Vec2::new(0.0, FLOOR)).collect())
}

/// So many places of grains in rows that are loose by a fifth to and fro.
fn loose_rows(width: f32, count: u32, seed: u64) -> Vec<Vec2> {
    let mut rng = Rng::new(seed, 0);
    let columns = ((width - 0.3) / 1.25) as u32;
    let pitch = (width - 0.3) / columns as f32;
    let place = |k: u32| 0.15 + 0.5 * pitch + pitch * (k % columns) as f32;
    (0..count)
        .map(|k| {
            Vec2::new(place(k) + rng.range(-0.12, 0.12), 0.7 + 1.25 * (k / columns) as f32 + rng.range(-0.12, 0.12))
        })
        .collect()
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
    const WIDTH: f32 = 40.0;
    let mut points = Vec::new();
    for aspect in [0.5, 1.0, 1.5, 3.0, 5.0, 8.0f32] {
        let of_seeds: Result<Vec<f64>, Error> =
            (1..=3).map(|seed| Ok(run_out(WIDTH, &collapse([WIDTH, aspect], 0.5, 15.0, seed)?))).collect();
        points.push([f64::from(aspect), mean(of_seeds?.into_iter())]);
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
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
