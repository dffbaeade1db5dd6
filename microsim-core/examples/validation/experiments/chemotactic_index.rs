//! Chemotaxis at several concentrations.

use super::plot::{Curve, Plot};
use super::scene::{Stepping, run, run_observed};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, ChemicalId, ChemicalSpec, ChemotaxisParams, Controller, Error, Exchange, Placement,
    World, WorldConfig,
};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "chemotactic_index",
    title: "Chemotactic index against K",
    source: "Zigmond 1977, J. Cell Biol. 75, 606: neutrophils orient best where the concentration is about the dissociation \
             constant K, and less well at both ends",
    words: "A cell in a gradient of about 3 % over its length, at a step of 1/30 s; the index is the way up the gradient over the length of the \
            path, a mean of six seeds of 20 s. The published curve has its peak near K; the bounds are ours.",
    run: measure,
};

/// Way up the gradient over length of the path, for a saturation relative to the concentration at the start.
fn index(saturation: f32, seed: u64) -> Result<f64, Error> {
    let size = Vec2::new(400.0, 60.0);
    let room = Stepping { dt: 1.0 / 30.0, substeps: 8 }.room(size, 0.0);
    let mut world = World::new(WorldConfig { damping: 0.5, seed, max_speed: 20.0, ..room })?;
    // The range is 300 units, about the way to the far wall.
    let chemical = world.add_chemical(ChemicalSpec { diffusion: 9000.0, decay: 0.1, spacing: 5.0, initial: 0.0 })?;
    let source = world.spawn(&AgarSpec::default().into(), Placement::at(2.0, 30.0))?;
    world.set_exchange(source, Exchange { chemical, secretion: 1000.0, uptake: 0.0 })?;
    run(&mut world, 40.0);
    let start = Vec2::new(250.0, 30.0);
    let concentration = concentration(&world, chemical, start);
    let params = ChemotaxisParams { saturation: saturation * concentration, ..ChemotaxisParams::towards(chemical) };
    let place = Placement::at(start.x, start.y).steered_by(Controller::chemotaxis(params));
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), place)?;
    let (mut at, mut path) = (start, 0.0);
    let mut count = 0;
    run_observed(&mut world, 20.0, |world| {
        count += 1;
        // Four places a second: the length of the path, not of what jitters on it.
        if count % 8 == 0 {
            let next = world.centroid(cell).unwrap_or(at);
            path += (next - at).length();
            at = next;
        }
    });
    Ok(f64::from((start.x - at.x) / path))
}

fn concentration(world: &World, id: ChemicalId, at: Vec2) -> f32 {
    world.view().chemicals().find(|(known, _)| *known == id).map_or(0.0, |(_, field)| field.concentration(at))
}

fn measure() -> Result<Outcome, Error> {
    let mut points = Vec::new();
    for relative in [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0f32] {
        let seeds: Result<Vec<f64>, Error> = (1..=6).map(|seed| index(1.0 / relative, seed)).collect();
        points.push([f64::from(relative), seeds?.iter().sum::<f64>() / 6.0]);
    }
    let at = |k: usize| points[k][1];
    let rows = vec![
        Row::between("index at c = K", "near the best", [0.5, 1.0], at(3)),
        Row::between("index at c = 1000 K", "poor", [-0.5, 0.5], at(6)),
        Row::between("index at c = 0.001 K", "poor", [-0.5, 0.5], at(0)),
    ];
    let decades = points.iter().map(|[c, index]| [c.log10(), *index]).collect();
    let axes = ["log10 of concentration over K", "chemotactic index"];
    Ok(Outcome {
        rows,
        plot: Some(Plot { axes, is_logarithmic: false, curves: vec![Curve::line("ours", decades)] }),
        ..Outcome::default()
    })
}
