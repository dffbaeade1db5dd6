//! Chemotaxis at several concentrations.

use super::plot::{Curve, Plot};
use super::scene::{Stepping, run, run_observed};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, ChemicalId, ChemicalSpec, ChemotaxisParams, Controller, Error, Exchange, Placement,
    World, WorldConfig,
};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "chemotactic_index",
    title: "Chemotactic index against K",
    source: "Herzmark et al. 2007, Proc. Natl. Acad. Sci. 104, 13349: neutrophil-like cells in gradients of 5, 9 and 13 % over their \
             diameter; the index (way up the gradient over length of the path) is largest where the concentration is about the dissociation \
             constant K, and falls to both sides, at each of the gradients; before, Zigmond 1977, J. Cell Biol. 75, 606",
    words: "A cell with default parameters in a gradient of so many percent over its diameter, at a step of 1/30 s; the mean index of ten \
            cells of 20 s each. By what share of the receptors front and rear differ is the gradient times `c K / (c + K)²`, so both ends \
            look the same to a cell that counts receptors; below K their number is small as well. Without any signal the mean of ten \
            walks is within 0.2 of 0. *Half* of the largest index, and a decade around K, are our bounds.",
    run: measure,
    order: Order::None("statistical"),
};

/// Steps as long as this do, for chemotaxis.
const STEPPING: Stepping = Stepping { dt: 1.0 / 30.0, substeps: 8 };
/// Where cells begin, and the length of the room, units.
const START: Vec2 = Vec2::new(250.0, 30.0);
const LENGTH: f32 = 400.0;

/// A room with a source at its left end, and its chemical in the steady state, for a range that it falls off over.
pub(crate) fn gradient(range: f32) -> Result<(World, ChemicalId), Error> {
    let room = STEPPING.room(Vec2::new(LENGTH, 60.0), 0.0);
    let mut world = World::new(WorldConfig { damping: 0.5, max_speed: 20.0, ..room })?;
    let decay = 0.1;
    let chemical =
        world.add_chemical(ChemicalSpec { diffusion: range * range * decay, decay, spacing: 5.0, initial: 0.0 })?;
    let source = world.spawn(&AgarSpec::default().into(), Placement::at(2.0, 30.0))?;
    world.set_exchange(source, Exchange { chemical, secretion: 1000.0, uptake: 0.0 })?;
    run(&mut world, 40.0);
    Ok((world, chemical))
}

/// Way up the gradient over length of the path, for a concentration at the start relative to K.
pub(crate) fn index((world, chemical): &(World, ChemicalId), relative: f32, cell: u32) -> Result<f64, Error> {
    let (mut world, chemical) = (world.clone(), *chemical);
    // Each has random numbers of its own: those of its handle.
    for _ in 0..cell {
        let other = world.spawn(&AgarSpec::default().into(), Placement::at(390.0, 30.0))?;
        world.remove(other)?;
    }
    let saturation = concentration(&world, chemical, START) / relative;
    let params = ChemotaxisParams { saturation, ..ChemotaxisParams::towards(chemical) };
    let place = Placement::at(START.x, START.y).steered_by(Controller::chemotaxis(params));
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), place)?;
    let (mut at, mut path, mut count) = (START, 0.0, 0);
    run_observed(&mut world, 20.0, |world| {
        count += 1;
        // Four places a second: the length of the path, not of what jitters on it.
        if count % 8 == 0 {
            let next = world.centroid(cell).unwrap_or(at);
            path += (next - at).length();
            at = next;
        }
    });
    Ok(f64::from((START.x - at.x) / path))
}

/// Mean index of ten cells, over concentrations relative to K.
fn curve(world: &(World, ChemicalId)) -> Result<Vec<[f64; 2]>, Error> {
    let mean = |relative: f32| {
        let indices: Result<Vec<f64>, Error> = (0..10).map(|cell| index(world, relative, cell)).collect();
        Ok([f64::from(relative), indices?.iter().sum::<f64>() / 10.0])
    };
    [1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0f32].into_iter().map(mean).collect()
}

fn concentration(world: &World, id: ChemicalId, at: Vec2) -> f32 {
    world.view().chemicals().find(|(known, _)| *known == id).map_or(0.0, |(_, field)| field.concentration(at))
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut curves) = (Vec::new(), Vec::new());
    // The gradient at the start is tanh(150 / range) / range.
    for (percent, range) in [(5, 240.0), (9, 172.0), (13, 135.0f32)] {
        let points = curve(&gradient(range)?)?;
        let best = points.iter().copied().fold([1.0, f64::NEG_INFINITY], |a, b| if b[1] > a[1] { b } else { a });
        let what = |what: &str| format!("{what}, {percent} % over the diameter");
        rows.push(Row::between(what("concentration of the largest index, over K"), "about 1", [0.1, 10.0], best[0]));
        rows.push(Row::between(what("index at c = K"), "near the largest", [0.9 * best[1], 1.0], points[4][1]));
        let [lowest, low, highest] = [0, 1, 7].map(|k: usize| points[k][1]);
        let half = [-0.3, 0.5 * best[1]];
        rows.push(Row::between(what("index at c = 0.0001 K"), "less than half", half, lowest));
        rows.push(Row::between(what("index at c = 0.001 K"), "less than at K", [-0.3, 0.9 * best[1]], low));
        rows.push(Row::between(what("index at c = 1000 K"), "less than half", half, highest));
        curves.push(Curve::line(format!("{percent} % over the diameter"), decades(points)));
    }
    let axes = ["log10 of concentration over K", "chemotactic index"];
    Ok(Outcome { rows, plot: Some(Plot { axes, is_logarithmic: false, curves }), ..Outcome::default() })
}

fn decades(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.into_iter().map(|[c, index]| [c.log10(), index]).collect()
}
