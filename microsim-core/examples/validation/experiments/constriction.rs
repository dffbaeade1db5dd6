//! Cells in constrictions.

use super::plot::{Curve, Plot};
use super::scene::Stepping;
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{AmoeboidCellSpec, Error, Inputs, Intent, Obstacle, Placement, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "constriction",
    title: "Speed through constrictions",
    source: "Wolf et al. 2013, J. Cell Biol. 201, 1069: cells migrate the slower the smaller the pores, down to a limit at \
             which they stop (there that of the nucleus, which these cells do not have)",
    words: "A cell of radius 11 crawls through a gap between two blocks, 8 units long; speed over 60 units against that in an \
            open room. What is published is the order, not the numbers: another cell has another stiffness.",
    run: measure,
    order: Order::None("no exact value is known. The section on refinement has more and shorter steps"),
};

const WAY: f32 = 60.0;
const LONGEST: f64 = 60.0;

/// Speed over 60 units through a gap of so many diameters, units/s; 0 if it has not got through in a minute.
pub(crate) fn speed(gap: f32) -> Result<f64, Error> {
    let room = Stepping::DEFAULT.room(Vec2::new(160.0, 60.0), 0.0);
    let mut world = World::new(WorldConfig { damping: 0.5, max_speed: 20.0, ..room })?;
    let spec = AmoeboidCellSpec::default();
    let half = gap * spec.radii.x;
    for side in [-1.0, 1.0] {
        let height = 0.5 * (30.0 - half);
        let block = SharedShape::round_cuboid(2.0, height - 2.0, 2.0);
        world.add_obstacle(Obstacle::new(block, Pose::translation(80.0, 30.0 + side * (half + height))))?;
    }
    let cell = world.spawn(&spec.into(), Placement::at(50.0, 30.0))?;
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(Vec2::new(159.0, 30.0))?);
    while world.time() < LONGEST {
        world.step(&inputs);
        if world.centroid(cell).is_some_and(|at| at.x > 50.0 + WAY) {
            return Ok(f64::from(WAY) / world.time());
        }
    }
    Ok(0.0)
}

fn measure() -> Result<Outcome, Error> {
    let open = speed(2.0)?;
    let mut rows = Vec::new();
    let mut points = Vec::new();
    for gap in [1.0, 0.8, 0.65, 0.5, 0.4, 0.3f32] {
        let ours = speed(gap)? / open;
        let before = points.last().map_or(1.0, |point: &[f64; 2]| point[1]);
        let what = format!("speed over that in the open, gap of {gap} diameters");
        rows.push(Row::between(what, "less than in the gap before", [0.0, before + 0.02], ours));
        points.push([f64::from(gap), ours]);
    }
    let axes = ["gap, diameters", "speed over that in the open"];
    Ok(Outcome {
        rows,
        plot: Some(Plot { axes, is_logarithmic: false, curves: vec![Curve::dots("ours", points)] }),
        ..Outcome::default()
    })
}
