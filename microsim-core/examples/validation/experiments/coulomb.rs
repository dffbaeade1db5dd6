//! Sliding friction.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, add_floor, last_particle, run, spawn_disc};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, Material, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "coulomb",
    title: "Coulomb friction",
    source: "Coulomb 1785, Théorie des machines simples: friction is at most `mu` times the load",
    words: "A disc, which cannot roll, is pushed along a floor with the same surface, and lies on slopes of `0.95 mu` and \
            `1.05 mu`.",
    run: measure,
    order: Order::Of(Falling::first("the way on the floor, mu 0.5", |stepping| {
        Ok(slide(stepping, [0.5, 10.0, 0.0], 4.0)? / 10.0 - 1.0)
    })),
};

/// Where a disc with this friction is after so many seconds that starts with this speed, on a floor that is tilted to this slope.
fn slide(stepping: Stepping, [mu, speed, slope]: [f32; 3], seconds: f32) -> Result<f64, Error> {
    let down = Vec2::new(slope, -1.0).normalize() * GRAVITY;
    let room = stepping.room(Vec2::new(200.0, 20.0), GRAVITY);
    let mut world = World::new(WorldConfig { gravity: down, ..room })?;
    let material = Material { friction: mu, restitution: 0.0 };
    add_floor(&mut world, 2.0, material)?;
    let disc = spawn_disc(&mut world, Vec2::new(10.0, 2.5), [1.0, 0.5], material)?;
    run(&mut world, 0.5);
    let start = last_particle(&world, disc).position.x;
    world.push(disc, Vec2::new(speed, 0.0))?;
    run(&mut world, seconds);
    Ok(f64::from(last_particle(&world, disc).position.x - start))
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut ways) = (Vec::new(), Vec::new());
    let slide = |of, seconds| slide(Stepping::DEFAULT, of, seconds);
    for mu in [0.1, 0.2, 0.5, 0.8f32] {
        let stop = 100.0 / (2.0 * f64::from(mu * GRAVITY));
        let way = slide([mu, 10.0, 0.0], 12.0)?;
        ways.push([f64::from(mu), way]);
        rows.push(Row::near(format!("way from 10 units/s, mu {mu}"), stop, 0.01, way));
        let still = slide([mu, 0.0, 0.95 * mu], 5.0)?;
        rows.push(Row::between(format!("way in 5 s on a slope of 0.95 mu, mu {mu}"), "0", [-0.01, 0.01], still));
        let (slope, cosine) = (1.05 * mu, 1.0 / (1.0 + 1.05 * 1.05 * mu * mu).sqrt());
        let acceleration = GRAVITY * cosine * (slope - mu);
        // It has slid for half a second when the clock starts.
        let way = 0.5 * f64::from(acceleration) * (5.5 * 5.5 - 0.5 * 0.5);
        rows.push(Row::near(
            format!("way in 5 s on a slope of 1.05 mu, mu {mu}"),
            way,
            0.02,
            slide([mu, 0.0, slope], 5.0)?,
        ));
    }
    let law = (2..=18).map(|k| 0.05 * f64::from(k)).map(|mu| [mu, 5.0 / mu]).collect();
    let curves = vec![Curve::line("v² / (2 mu g)", law), Curve::dots("ours", ways)];
    let plot = Plot { axes: ["mu", "way from 10 units/s, units"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
