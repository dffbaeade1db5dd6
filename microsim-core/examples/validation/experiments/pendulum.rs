//! A rigid pendulum.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, last_particle, run_observed};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Constraint, Distance, Error, Node, Placement, Template, World};
use std::f64::consts::{PI, TAU};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "pendulum",
    title: "Pendulum",
    source: "Huygens 1673; any amplitude: `T = 2 pi sqrt(l / g) / agm(1, cos(amplitude / 2))` (Gauss's mean of Legendre's integral)",
    words: "A disc on a rigid link of 2.5 units, without drag. Nothing damps it but the integrator: implicit Euler keeps \
            `exp(-omega² h t / 2)` of a small amplitude. Shorter substeps damp less, in proportion. For less, see the section of \
            oscillations that last.",
    run: measure,
    order: Order::Of(Falling::first("the logarithm of the amplitude after 30 s", |stepping| {
        Ok(amplitude_kept(&swing(stepping, 0.1, 30.0)?).ln())
    })),
};

const LENGTH: f32 = 2.5;

/// Small-amplitude angular frequency, 1/s.
pub(crate) fn frequency() -> f64 {
    f64::from(GRAVITY / LENGTH).sqrt()
}

/// Time and angle after each step, radians, of a bob that is held by a distance.
pub(crate) fn swing(stepping: Stepping, amplitude: f64, seconds: f32) -> Result<Vec<[f64; 2]>, Error> {
    swing_on(Constraint::from, stepping, amplitude, seconds)
}

/// The same, held by what is made of that distance.
pub(crate) fn swing_on(
    holds: fn(Distance) -> Constraint,
    stepping: Stepping,
    amplitude: f64,
    seconds: f32,
) -> Result<Vec<[f64; 2]>, Error> {
    let pivot = Vec2::splat(10.0);
    let mut world = World::new(stepping.room(2.0 * pivot, GRAVITY))?;
    let mut builder = Template::builder();
    let fixed = builder.node(Node::fixed(Vec2::ZERO));
    let bob = builder.node(Node::disc(Vec2::new(0.0, -LENGTH), 1.0, 0.5));
    let link = Distance { a: fixed, b: bob, rest_length: LENGTH, compliance: 0.0, damping: 0.0 };
    builder.constraint(holds(link));
    let template = world.add_template(builder.build()?);
    let pendulum = world.spawn_template(template, Placement::at(pivot.x, pivot.y).turned(amplitude as f32))?;
    let mut angles = vec![[0.0, amplitude]];
    run_observed(&mut world, seconds, |world| {
        let arm = last_particle(world, pendulum).position - pivot;
        angles.push([world.time(), f64::from(arm.x).atan2(f64::from(-arm.y))]);
    });
    Ok(angles)
}

/// First full period of an oscillation, s.
pub(crate) fn period(angles: &[[f64; 2]]) -> f64 {
    let crossings: Vec<f64> = angles
        .windows(2)
        .filter(|pair| pair[0][1] < 0.0 && pair[1][1] >= 0.0)
        .map(|pair| pair[0][0] - pair[0][1] * (pair[1][0] - pair[0][0]) / (pair[1][1] - pair[0][1]))
        .collect();
    crossings[1] - crossings[0]
}

/// Time and angle of the turns on one side, degrees.
fn turns(angles: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let is_turn = |three: &&[[f64; 2]]| three[1][1] > 0.0 && three[1][1] > three[0][1] && three[1][1] >= three[2][1];
    angles.windows(3).filter(is_turn).map(|three| [three[1][0], three[1][1] * 180.0 / PI]).collect()
}

/// Share of the first amplitude that a swing has in its last period.
pub(crate) fn amplitude_kept(angles: &[[f64; 2]]) -> f64 {
    let end = angles[angles.len() - 1][0];
    let last = angles.iter().filter(|angle| angle[0] > end - TAU / frequency());
    last.fold(0.0, |most: f64, angle| most.max(angle[1].abs())) / angles[0][1]
}

/// Arithmetic-geometric mean of 1 and another number.
fn mean_with_one(mut b: f64) -> f64 {
    let mut a = 1.0;
    for _ in 0..10 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

fn measure() -> Result<Outcome, Error> {
    let small = TAU / frequency();
    let mut rows = Vec::new();
    for degrees in [10.0, 60.0, 120.0] {
        let amplitude = degrees * PI / 180.0;
        let expected = small / mean_with_one((0.5 * amplitude).cos());
        let ours = period(&swing(Stepping::of_substeps(64), amplitude, 12.0)?);
        rows.push(Row::near(format!("period from {degrees}°, s"), expected, 0.01, ours));
    }
    let mut curves = Vec::new();
    for substeps in [8, 64] {
        let stepping = Stepping::of_substeps(substeps);
        let time = 20.0 * small;
        let angles = swing(stepping, 10.0 * PI / 180.0, time as f32)?;
        let law = |t: f64| (-frequency() * frequency() * stepping.substep() * t / 2.0).exp();
        let what = format!("share of 10° kept after 20 periods, {substeps} substeps");
        rows.push(Row::near(what, law(time), 0.02, amplitude_kept(&angles)));
        let envelope = (0..=60).map(|k| [f64::from(k), 10.0 * law(f64::from(k))]).collect();
        curves.push(Curve::dots(format!("turns, {substeps} substeps"), turns(&angles)));
        curves.push(Curve::line(format!("implicit Euler, {substeps} substeps"), envelope));
    }
    Ok(Outcome {
        rows,
        plot: Some(Plot { axes: ["time, s", "amplitude, degrees"], is_logarithmic: false, curves }),
        ..Outcome::default()
    })
}
