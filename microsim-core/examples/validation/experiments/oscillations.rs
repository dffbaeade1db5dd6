//! Oscillations that last.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, last_particle, run_observed, spawn_disc};
use super::{Experiment, Outcome, Row, pendulum, spring};
use microsim_core::glam::Vec2;
use microsim_core::{
    ConservativeDistance, Constraint, Distance, Error, JointEnd, JointKind, JointSpec, Material, World,
};
use std::f64::consts::{PI, TAU};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "oscillations",
    title: "Oscillations that last",
    source: "Ryckaert, Ciccotti and Berendsen 1977, J. Comput. Phys. 23, 327 (SHAKE); Hairer, Lubich and Wanner 2003, Acta Numerica 12, \
             399: neither has damping of its own",
    words: "The pendulum and the spring of both sections before on a conservative distance, and the same on joints, which are \
            conservative too. A damped spring keeps `exp(-z omega t)`. What is released from rest is half a substep ahead, an error of \
            order 1 that does not grow; the rest is of order 2.",
    run: measure,
    order: Order::Of(Falling {
        // In shorter substeps the error is that of rounding.
        substeps: &[1, 2, 4, 8],
        steps: &[10, 15, 20, 30],
        accepted: [1.8, 2.2],
        theory: "2",
        ..Falling::first("the spring, the largest in 5 s, but for the half substep that it is ahead", largest_error)
    }),
};

fn conservative(distance: Distance) -> Constraint {
    let Distance { a, b, rest_length, compliance, damping } = distance;
    ConservativeDistance { a, b, rest_length, compliance, damping }.into()
}

/// Largest difference of a spring from `cos(omega t)` in five periods, over its amplitude. Released from rest, it is half a substep
/// ahead: positions of a substep follow velocities of its middle.
fn largest_error(stepping: Stepping) -> Result<f64, Error> {
    let stretches = spring::oscillation(conservative, stepping, 5.0)?;
    let errors =
        stretches.iter().map(|[t, stretch]| (stretch / 0.5 - (TAU * (t + 0.5 * stepping.substep())).cos()).abs());
    Ok(errors.fold(0.0, f64::max))
}

/// Share of a stretch that a disc on a joint of 1 Hz has in the tenth period.
fn spring_joint(damping_ratio: f32, stepping: Stepping) -> Result<f64, Error> {
    let mut world = World::new(stepping.room(Vec2::splat(20.0), 0.0))?;
    let disc = spawn_disc(&mut world, Vec2::new(15.5, 10.0), [1.0, 0.5], Material::default())?;
    let kind = JointKind::Spring { length: 5.0, frequency: 1.0, damping_ratio };
    world.add_joint(JointSpec::new(JointEnd::Point(Vec2::splat(10.0)), JointEnd::Centre(disc), kind))?;
    let mut most = 0.0f32;
    run_observed(&mut world, 10.0, |world| {
        let stretch = last_particle(world, disc).position.x - 15.0;
        most = if world.time() > 9.0 { most.max(stretch) } else { 0.0 };
    });
    Ok(f64::from(most) / 0.5)
}

/// Share of 10 degrees that a disc on a rigid joint has in the twentieth period.
fn pendulum_joint(stepping: Stepping) -> Result<f64, Error> {
    let mut world = World::new(stepping.room(Vec2::splat(20.0), GRAVITY))?;
    let (pivot, amplitude) = (Vec2::splat(10.0), PI / 18.0);
    let arm = Vec2::new(amplitude.sin() as f32, -amplitude.cos() as f32) * 2.5;
    let disc = spawn_disc(&mut world, pivot + arm, [1.0, 0.5], Material::default())?;
    let kind = JointKind::Distance { length: 2.5 };
    world.add_joint(JointSpec::new(JointEnd::Point(pivot), JointEnd::Centre(disc), kind))?;
    let mut angles = vec![[0.0, amplitude]];
    run_observed(&mut world, (20.0 * TAU / pendulum::frequency()) as f32, |world| {
        let arm = last_particle(world, disc).position - pivot;
        angles.push([world.time(), f64::from(arm.x).atan2(f64::from(-arm.y))]);
    });
    Ok(pendulum::amplitude_kept(&angles))
}

fn measure() -> Result<Outcome, Error> {
    let mut rows = Vec::new();
    for substeps in [2, 8, 64] {
        let stepping = Stepping::of_substeps(substeps);
        let mut row = |what: &str, expected, ours| {
            rows.push(Row::near(format!("{what}, {substeps} substeps"), expected, 0.01, ours));
        };
        let angles =
            pendulum::swing_on(conservative, stepping, PI / 18.0, (20.0 * TAU / pendulum::frequency()) as f32)?;
        row("pendulum, share of 10° kept after 20 periods", 1.0, pendulum::amplitude_kept(&angles));
        row("spring, share kept after 10 periods", 1.0, spring::amplitude_kept(conservative, stepping, 10.0)?);
        row("spring, period, s", 1.0, pendulum::period(&spring::oscillation(conservative, stepping, 3.0)?));
        row("joint, pendulum, share of 10° kept", 1.0, pendulum_joint(stepping)?);
        row("joint, spring, damping ratio 0, share kept", 1.0, spring_joint(0.0, stepping)?);
        row("joint, spring, damping ratio 0.01, share kept", (-0.01 * 9.0 * TAU).exp(), spring_joint(0.01, stepping)?);
    }
    let far = pendulum::swing_on(conservative, Stepping::DEFAULT, 2.0 * PI / 3.0, 12.0)?;
    rows.push(Row::near("pendulum, period from 120°, 8 substeps, s", 4.313, 0.001, pendulum::period(&far)));
    let curve = |name: &str, holds| -> Result<Curve, Error> {
        Ok(Curve::line(name, spring::oscillation(holds, Stepping::DEFAULT, 5.0)?))
    };
    let curves = vec![curve("conservative distance", conservative)?, curve("distance", Constraint::from)?];
    let plot = Plot { axes: ["time, s", "stretch of the spring, units"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
