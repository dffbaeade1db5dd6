//! Steady field of a point source.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{Stepping, run};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{AgarSpec, ChemicalSpec, Error, Exchange, Placement, World};
use std::f64::consts::TAU;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "point_source",
    title: "Point source of a chemical",
    source: "Carslaw and Jaeger 1959, Conduction of Heat in Solids, chapter 10; with decay, in the plane: `K0(r / sqrt(D / k)) q / (2 pi D)`",
    words: "A disc in the middle of a room of ten ranges secretes for ten lifetimes. Cells of the grid are 2 units wide. Chemicals are stepped \
            once a step, in as many rounds as diffusion needs; substeps make no difference.",
    run: measure,
    order: Order::Of(Falling {
        substeps: &[],
        accepted: [0.9, 1.25],
        ..Falling::first("the amount after 4 s", |stepping| {
            let (world, _) = steady(stepping, 4.0)?;
            let amount: f64 = world.view().chemicals().map(|(_, field)| field.amount()).sum();
            Ok(amount / (4000.0 * (1.0 - (-1.0f64).exp())) - 1.0)
        })
    }),
};

const SPEC: ChemicalSpec = ChemicalSpec { diffusion: 100.0, decay: 0.25, spacing: 2.0, initial: 0.0 };

/// Modified Bessel function of the second kind and order 0: the integral of `exp(-x cosh t)` over t from 0 on.
fn bessel_k0(x: f64) -> f64 {
    const STEP: f64 = 1e-3;
    let values = (1..10_000).map(|k| (-x * (f64::from(k) * STEP).cosh()).exp());
    STEP * (0.5 * (-x).exp() + values.sum::<f64>())
}

/// A room in which a disc has secreted for so many seconds, and where it is.
fn steady(stepping: Stepping, seconds: f32) -> Result<(World, Vec2), Error> {
    let centre = Vec2::splat(101.0);
    let mut world = World::new(stepping.room(2.0 * centre, 0.0))?;
    let chemical = world.add_chemical(SPEC)?;
    let source = world.spawn(&AgarSpec::default().into(), Placement::at(centre.x, centre.y))?;
    world.set_exchange(source, Exchange { chemical, secretion: 1000.0, uptake: 0.0 })?;
    run(&mut world, seconds);
    Ok((world, centre))
}

fn measure() -> Result<Outcome, Error> {
    let (spec, (world, centre)) = (SPEC, steady(Stepping::DEFAULT, 40.0)?);
    let steady = |r: f64| bessel_k0(r / f64::from(spec.range())) * 1000.0 / (TAU * f64::from(spec.diffusion));
    let (mut rows, mut ours) = (Vec::new(), Vec::new());
    for (_, field) in world.view().chemicals() {
        rows.push(Row::near("amount, secreted over decay", 4000.0, 0.01, field.amount()));
        for r in [6.0, 12.0, 20.0, 40.0, 60.0f32] {
            let at_r = f64::from(field.concentration(centre + Vec2::new(r, 0.0)));
            rows.push(Row::near(format!("concentration at {r} units"), steady(r.into()), 0.03, at_r));
        }
        let places = (2..=30).map(|k| 2.0 * k as f32);
        ours.extend(places.map(|r| [r, field.concentration(centre + Vec2::new(r, 0.0))].map(f64::from)));
    }
    let law = (4..=80).map(f64::from).map(|r| [r, steady(r)]).collect();
    let curves = vec![Curve::line("K0", law), Curve::dots("ours", ours)];
    let plot = Plot { axes: ["distance, units", "concentration, 1/units²"], is_logarithmic: true, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
