//! How a deformed cell becomes round.

use super::plot::{Curve, Plot};
use super::scene::Stepping;
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{AmoeboidCellSpec, Error, Inputs, OrganismId, Placement, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "relaxation",
    title: "Relaxation of a deformed cell",
    source: "Tran-Son-Tay, Needham, Yeung and Hochmuth 1991, Biophys. J. 60, 856: passive neutrophils return to a sphere without \
             oscillation (there within a minute; a game's cell takes seconds)",
    words: "A cell that is 1.78 times as long as wide is left alone for 6 s. The aspect is that of an ellipse with the second moments of \
            its outline; its overshoot is the most by which it rises again.",
    run: measure,
    order: Order::None("a bound, not a value; the rows are of five steps"),
};

/// The name of a step, its length and its substeps.
const STEPS: [(&str, f32, u32); 5] = [
    ("1/30", 1.0 / 30.0, 6),
    ("1/60", 1.0 / 60.0, 4),
    ("1/60", 1.0 / 60.0, 8),
    ("1/60", 1.0 / 60.0, 64),
    ("1/1000", 0.001, 1),
];

/// Long over short axis.
fn aspect(world: &World, cell: OrganismId) -> f64 {
    let outline: Vec<Vec2> = world.view().organism(cell).map_or(Vec::new(), |cell| cell.outline().collect());
    let centre = outline.iter().sum::<Vec2>() / outline.len() as f32;
    let sum = |of: fn(Vec2) -> f32| outline.iter().map(|at| f64::from(of(*at - centre))).sum::<f64>();
    let (xx, yy, xy) = (sum(|a| a.x * a.x), sum(|a| a.y * a.y), sum(|a| a.x * a.y));
    let (mean, spread) = (0.5 * (xx + yy), (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt());
    ((mean + spread) / (mean - spread)).sqrt()
}

/// Time and aspect of a cell that is left alone.
pub(crate) fn relaxation(radius: f32, stepping: Stepping) -> Result<Vec<[f64; 2]>, Error> {
    let Stepping { dt, substeps } = stepping;
    let mut world = World::new(WorldConfig { dt, substeps, ..WorldConfig::default() })?;
    let spec = AmoeboidCellSpec { radii: Vec2::new(4.0 / 3.0, 0.75) * radius, ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(80.0, 45.0))?;
    let mut aspects = vec![[0.0, aspect(&world, cell)]];
    while world.time() < 6.0 {
        world.step(&Inputs::new());
        aspects.push([world.time(), aspect(&world, cell)]);
    }
    Ok(aspects)
}

/// The most by which a curve rises again.
pub(crate) fn overshoot(curve: &[[f64; 2]]) -> f64 {
    let rise = |(least, rise): (f64, f64), [_, aspect]: &[f64; 2]| (least.min(*aspect), rise.max(aspect - least));
    curve.iter().fold((f64::INFINITY, 0.0), rise).1
}

fn measure() -> Result<Outcome, Error> {
    let cause =
        "since the area limit is as strict in short substeps as in long ones; how the two are connected is not known.";
    let mut outcome = Outcome { cause, ..Outcome::default() };
    let mut curves = Vec::new();
    for radius in [7.0, 8.0, 11.0, 16.8, 25.0f32] {
        for (step, dt, substeps) in STEPS {
            let aspects = relaxation(radius, Stepping { dt, substeps })?;
            let name = format!("radius {radius}, {step} s, {substeps} substeps");
            outcome.rows.push(Row::between(format!("overshoot, {name}"), "0", [0.0, 0.03], overshoot(&aspects)));
            if substeps == 8 {
                let left = aspects[aspects.len() - 1][1];
                outcome.rows.push(Row::between(format!("aspect after 6 s, {name}"), "1", [1.0, 1.1], left));
                curves.push(Curve::line(format!("radius {radius}"), aspects.into_iter().step_by(6).collect()));
            }
        }
    }
    outcome.plot = Some(Plot { axes: ["time, s", "aspect"], is_logarithmic: false, curves });
    Ok(outcome)
}
