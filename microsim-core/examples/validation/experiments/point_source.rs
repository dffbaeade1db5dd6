//! Steady field of a point source.

use super::scene::{Stepping, run};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{AgarSpec, ChemicalSpec, Error, Exchange, Placement, World};
use std::f64::consts::TAU;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "point_source",
    title: "Point source of a chemical",
    source: "Carslaw and Jaeger 1959, Conduction of Heat in Solids, chapter 10; with decay, in the plane: `K0(r / sqrt(D / k)) q / (2 pi D)`",
    words: "A disc in the middle of a room of ten ranges secretes for ten lifetimes. Cells of the grid are 2 units wide.",
    run: measure,
};

/// Modified Bessel function of the second kind and order 0: the integral of `exp(-x cosh t)` over t from 0 on.
fn bessel_k0(x: f64) -> f64 {
    const STEP: f64 = 1e-3;
    let values = (1..10_000).map(|k| (-x * (f64::from(k) * STEP).cosh()).exp());
    STEP * (0.5 * (-x).exp() + values.sum::<f64>())
}

fn measure() -> Result<Outcome, Error> {
    let spec = ChemicalSpec { diffusion: 100.0, decay: 0.25, spacing: 2.0, initial: 0.0 };
    let centre = Vec2::splat(101.0);
    let mut world = World::new(Stepping::DEFAULT.room(2.0 * centre, 0.0))?;
    let chemical = world.add_chemical(spec)?;
    let source = world.spawn(&AgarSpec::default().into(), Placement::at(centre.x, centre.y))?;
    world.set_exchange(source, Exchange { chemical, secretion: 1000.0, uptake: 0.0 })?;
    run(&mut world, 40.0);
    let mut rows = Vec::new();
    for (_, field) in world.view().chemicals() {
        rows.push(Row::near("amount, secreted over decay", 4000.0, 0.01, field.amount()));
        for r in [6.0, 12.0, 20.0, 40.0, 60.0f32] {
            let expected = bessel_k0(f64::from(r / spec.range())) * 1000.0 / (TAU * f64::from(spec.diffusion));
            let ours = f64::from(field.concentration(centre + Vec2::new(r, 0.0)));
            rows.push(Row::near(format!("concentration at {r} units"), expected, 0.03, ours));
        }
    }
    Ok(Outcome { rows, ..Outcome::default() })
}
