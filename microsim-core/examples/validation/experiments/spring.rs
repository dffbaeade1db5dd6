//! A spring of 1 Hz.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{Stepping, last_particle, run_observed};
use super::{Experiment, Outcome, Row, pendulum};
use microsim_core::glam::Vec2;
use microsim_core::{Constraint, Distance, Error, Node, Placement, Template, World};
use std::f64::consts::TAU;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "spring",
    title: "Spring of 1 Hz",
    source: "Hooke 1678; damping of implicit Euler: Hairer and Wanner 1996, Solving Ordinary Differential Equations II, IV.3",
    words: "A mass on an undamped spring, stretched by a tenth, for ten periods. The integrator keeps `exp(-omega² h t / 2)` \
            of the amplitude.",
    run: measure,
    order: Order::Of(Falling::first("the logarithm of the amplitude after 3 s", |stepping| {
        Ok(amplitude_kept(Constraint::from, stepping, 3.0)?.ln())
    })),
};

/// Angular frequency, 1/s.
pub(crate) const FREQUENCY: f64 = TAU;
const LENGTH: f32 = 5.0;
const STRETCH: f32 = 0.5;

/// Time and stretch of a spring made of a distance after each step, for so many periods.
pub(crate) fn oscillation(
    holds: fn(Distance) -> Constraint,
    stepping: Stepping,
    periods: f32,
) -> Result<Vec<[f64; 2]>, Error> {
    let mut world = World::new(stepping.room(Vec2::splat(20.0), 0.0))?;
    let mut builder = Template::builder();
    let fixed = builder.node(Node::fixed(Vec2::ZERO));
    let mass = builder.node(Node::disc(Vec2::new(LENGTH + STRETCH, 0.0), 1.0, 0.5));
    let compliance = (1.0 / (FREQUENCY * FREQUENCY)) as f32;
    builder.constraint(holds(Distance { a: fixed, b: mass, rest_length: LENGTH, compliance, damping: 0.0 }));
    let template = world.add_template(builder.build()?);
    let spring = world.spawn_template(template, Placement::at(10.0, 10.0))?;
    let mut stretches = Vec::new();
    run_observed(&mut world, periods, |world| {
        let stretch = last_particle(world, spring).position.x - 10.0 - LENGTH;
        stretches.push([world.time(), f64::from(stretch)]);
    });
    Ok(stretches)
}

/// Share of the amplitude in the last of so many periods.
pub(crate) fn amplitude_kept(
    holds: fn(Distance) -> Constraint,
    stepping: Stepping,
    periods: f32,
) -> Result<f64, Error> {
    let stretches = oscillation(holds, stepping, periods)?;
    let last = stretches.iter().filter(|[t, _]| *t > f64::from(periods) - 1.0);
    Ok(last.fold(0.0, |most: f64, [_, stretch]| most.max(*stretch)) / f64::from(STRETCH))
}

/// What implicit Euler keeps of an amplitude until the last period's turn, which it is read from.
pub(crate) fn law(stepping: Stepping, periods: f64) -> f64 {
    (-FREQUENCY * FREQUENCY * stepping.substep() * (periods - 1.0) / 2.0).exp()
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut curves) = (Vec::new(), Vec::new());
    for substeps in [8, 16, 64] {
        let stepping = Stepping::of_substeps(substeps);
        let what = format!("share of the amplitude kept, {substeps} substeps");
        let period = pendulum::period(&oscillation(Constraint::from, stepping, 3.0)?);
        rows.push(Row::near(format!("period, {substeps} substeps, s"), 1.0, 0.005, period));
        rows.push(Row::near(what, law(stepping, 10.0), 0.02, amplitude_kept(Constraint::from, stepping, 10.0)?));
        curves.push(Curve::line(format!("{substeps} substeps"), oscillation(Constraint::from, stepping, 5.0)?));
    }
    let plot = Plot { axes: ["time, s", "stretch, units"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
