//! Area of cells that nobody drives.

use super::plot::{Curve, Plot};
use super::scene::{self, Stepping};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::geometry::polygon::signed_area;
use microsim_core::glam::Vec2;
use microsim_core::{AmoeboidCellSpec, Error, OrganismId, Placement, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "cell_area",
    title: "Area of cells at rest",
    source: "The specification: a cell's `radii` are what one gets",
    words: "Cells are left alone for 20 s. The least and the largest difference of the polygon of the nodes from the ellipse on \
            which they are spawned, percent, over 1/60 s and 3, 4, 8 and 64 substeps and 1/1000 s and 1 and 5.",
    run: measure,
    order: Order::None("a bound, not a value; the rows are over all steps"),
};

const STEPS: [Stepping; 6] = [
    Stepping { dt: 1.0 / 60.0, substeps: 3 },
    Stepping { dt: 1.0 / 60.0, substeps: 4 },
    Stepping { dt: 1.0 / 60.0, substeps: 8 },
    Stepping { dt: 1.0 / 60.0, substeps: 64 },
    Stepping { dt: 0.001, substeps: 1 },
    Stepping { dt: 0.001, substeps: 5 },
];
const RADII: [[f32; 2]; 12] = [
    [5.0, 5.0],
    [5.5, 5.5],
    [6.0, 6.0],
    [7.0, 7.0],
    [8.0, 8.0],
    [9.0, 9.0],
    [10.0, 10.0],
    [11.0, 11.0],
    [13.0, 13.0],
    [16.8, 16.8],
    [25.0, 25.0],
    [16.0, 12.0],
];

/// Least and largest difference of a cell's area from that of its radii in so long, s, as shares.
pub(crate) fn extremes(radii: Vec2, stepping: Stepping, seconds: f32) -> Result<[f64; 2], Error> {
    let Stepping { dt, substeps } = stepping;
    let mut world = World::new(WorldConfig { dt, substeps, ..WorldConfig::default() })?;
    let spec = AmoeboidCellSpec { radii, ..AmoeboidCellSpec::default() };
    let nodes = radii - spec.node_radius;
    let cell = world.spawn(&spec.into(), Placement::at(80.0, 45.0))?;
    let wanted = std::f32::consts::PI * nodes.x * nodes.y;
    let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
    scene::run_observed(&mut world, seconds, |world| {
        let error = f64::from(area(world, cell) / wanted) - 1.0;
        (low, high) = (low.min(error), high.max(error));
    });
    Ok([low, high])
}

fn area(world: &World, cell: OrganismId) -> f32 {
    let outline: Vec<Vec2> = world.view().organism(cell).map_or(Vec::new(), |cell| cell.outline().collect());
    signed_area(&outline)
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut lows, mut highs) = (Vec::new(), Vec::new(), Vec::new());
    for radii in RADII {
        let mut all = Vec::new();
        for stepping in STEPS {
            all.extend(extremes(radii.into(), stepping, 20.0)?.map(|share| 100.0 * share));
        }
        let [low, high] = [all.iter().copied().fold(0.0, f64::min), all.iter().copied().fold(0.0, f64::max)];
        let [x, y] = radii;
        if x == y {
            lows.push([x.into(), low]);
            highs.push([x.into(), high]);
        }
        rows.push(Row::between(format!("least, radii {x} x {y}"), "0", [-2.0, 0.0], low));
        rows.push(Row::between(format!("largest, radii {x} x {y}"), "0", [0.0, 2.0], high));
    }
    let curves = vec![
        Curve::dots("least", lows),
        Curve::dots("largest", highs),
        Curve::line("accepted", vec![[5.0, 2.0], [25.0, 2.0]]),
        Curve::line("accepted", vec![[5.0, -2.0], [25.0, -2.0]]),
    ];
    let plot = Plot { axes: ["radius, units", "difference of the area, %"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
