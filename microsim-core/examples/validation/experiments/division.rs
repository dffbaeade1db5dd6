//! Symmetry of division.

use super::plot::{Curve, Plot};
use super::scene::Stepping;
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{AmoeboidCellSpec, Error, Event, Inputs, OrganismId, Placement, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "division",
    title: "Symmetry of division",
    source: "Rappaport 1996, Cytokinesis in Animal Cells: the furrow of a symmetric division cuts the cell in two equal \
             halves; the bound of 10 % is ours",
    words: "Cells of five sizes divide alone in a room; the share of the cytoplasm in the larger daughter, which conserves \
            all of it.",
    run: measure,
    order: Order::None("the cytoplasm is divided by topology, particle by particle"),
};

/// Cytoplasm of a cell before its division, and of both daughters after, square units.
pub(crate) fn divide(radius: f32) -> Result<(f64, [f64; 2]), Error> {
    let room = Stepping::DEFAULT.room(Vec2::splat(120.0), 0.0);
    let mut world = World::new(WorldConfig { damping: 0.5, max_speed: 20.0, ..room })?;
    let spec = AmoeboidCellSpec { radii: Vec2::splat(radius), ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(60.0, 60.0))?;
    let area =
        |world: &World, id: OrganismId| world.view().organism(id).map_or(0.0, |cell| f64::from(cell.cytoplasm_area()));
    let before = area(&world, cell);
    world.divide(cell)?;
    while world.time() < 40.0 {
        world.step(&Inputs::new());
        let divided = world.events().iter().find_map(|event| match event {
            Event::Divided { daughter, .. } => Some(*daughter),
            _ => None,
        });
        if let Some(daughter) = divided {
            return Ok((before, [cell, daughter].map(|id| area(&world, id))));
        }
    }
    Ok((before, [before, 0.0]))
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut shares) = (Vec::new(), Vec::new());
    for radius in [9.0, 11.0, 13.0, 16.0, 20.0f32] {
        let (before, [a, b]) = divide(radius)?;
        let larger = a.max(b) / (a + b);
        shares.extend([[radius.into(), larger], [radius.into(), 1.0 - larger]]);
        rows.push(Row::near(format!("share of the larger daughter, radius {radius}"), 0.5, 0.1, larger));
        rows.push(Row::near(format!("cytoplasm kept, radius {radius}"), 1.0, 1e-5, (a + b) / before));
    }
    let curves = vec![
        Curve::dots("daughters", shares),
        Curve::line("half", vec![[9.0, 0.5], [20.0, 0.5]]),
        Curve::line("accepted", vec![[9.0, 0.55], [20.0, 0.55]]),
        Curve::line("accepted", vec![[9.0, 0.45], [20.0, 0.45]]),
    ];
    let plot = Plot { axes: ["radius, units", "share of the cytoplasm"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
