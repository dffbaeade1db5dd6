//! Time of engulfment.

use super::plot::{Curve, Plot};
use super::scene::Stepping;
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Error, Event, Inputs, Intent, OrganismSpec, Placement, RigidCellSpec, World,
    WorldConfig,
};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "engulfment",
    title: "Engulfment time against size",
    source: "Herant, Heinrich and Dembo 2006, J. Cell Sci. 119, 1903: a neutrophil takes the longer to engulf a bead, the larger \
             it is (beads of 3 to 11 µm, a minute to some minutes)",
    words: "A cell of radius 16.8 takes in agar by a cup; time from the moment in which it begins, mean of four directions. \
            What is published is the order: a game's cell eats in seconds what a neutrophil eats in minutes.",
    run: measure,
    order: Order::None("no exact value is known. The section on refinement has more and shorter steps"),
};

/// Time from the beginning of an ingestion to its end, s, for prey in a direction; infinite if it was not taken in.
pub(crate) fn time(prey: &OrganismSpec, direction: Vec2, stepping: Stepping) -> Result<f64, Error> {
    let room = stepping.room(Vec2::splat(120.0), 0.0);
    let mut world = World::new(WorldConfig { damping: 0.5, max_speed: 20.0, ..room })?;
    let hunter =
        AmoeboidCellSpec { radii: Vec2::splat(16.8), cytoplasm_spacing: 1.6, speed: 9.0, ..Default::default() };
    let cell = world.spawn(&hunter.into(), Placement::at(60.0, 60.0))?;
    let at = Vec2::splat(60.0) + direction * (22.0 + prey.extent()?);
    let prey = world.spawn(prey, Placement::at(at.x, at.y))?;
    let mut began = f64::INFINITY;
    let mut inputs = Inputs::new();
    while world.time() < 15.0 {
        inputs.set(cell, Intent::toward(world.centroid(prey).unwrap_or(at))?);
        world.step(&inputs);
        for event in world.events() {
            match event {
                Event::IngestionBegan { .. } => began = world.time(),
                Event::Ingested { .. } => return Ok(world.time() - began),
                _ => {}
            }
        }
    }
    Ok(f64::INFINITY)
}

fn mean_time(prey: &OrganismSpec) -> Result<f64, Error> {
    let times: Result<Vec<f64>, Error> = [Vec2::X, Vec2::Y, Vec2::new(0.8, 0.6), Vec2::new(-0.6, 0.8)]
        .into_iter()
        .map(|direction| time(prey, direction, Stepping::DEFAULT))
        .collect();
    Ok(times?.iter().sum::<f64>() / 4.0)
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut points) = (Vec::new(), Vec::new());
    let mut before = 0.0;
    for radius in [1.0, 1.5, 2.0, 3.0, 4.0f32] {
        let ours = mean_time(&AgarSpec { radius, ..AgarSpec::default() }.into())?;
        let published = if before == 0.0 { "more than 0" } else { "more than of the size before" };
        rows.push(Row::between(format!("time of agar of radius {radius}, s"), published, [before, 15.0], ours));
        points.push([f64::from(radius), ours]);
        before = ours;
    }
    let rigid = RigidCellSpec { radii: Vec2::new(5.0, 3.2), ..RigidCellSpec::default() };
    rows.push(Row::between(
        "time of a rigid cell of 5 x 3.2, s",
        "more than of small agar",
        [0.0, 15.0],
        mean_time(&rigid.into())?,
    ));
    let cause =
        "agar of radius 3 and of 4 takes about as long; which of the two takes longer depends on the four directions.";
    let curves = vec![Curve::dots("agar", points)];
    let plot = Plot { axes: ["radius of the prey, units", "time, s"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), cause })
}
