//! Impacts.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, last_particle, run, run_observed, spawn_disc};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, Material, World};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "restitution",
    title: "Restitution and impacts",
    source: "Newton 1687, Principia, scholium to the laws of motion: a pair separates with `e` times the speed of its approach",
    words: "A disc dropped from 10 units rebounds to `e²` of the height. Two discs meet head-on: one moves at 10 units/s, the \
            other rests, and momentum is kept.",
    run: measure,
    order: Order::Of(Falling {
        accepted: [0.8, 1.2],
        ..Falling::first("the rebound, the mean of five heights", rebound_error)
    }),
};

fn bouncy(restitution: f32) -> Material {
    Material { friction: 0.0, restitution }
}

/// Height of the first rebound over the height of the fall.
pub(crate) fn rebound(stepping: Stepping, restitution: f32, height: f32) -> Result<f64, Error> {
    let mut world = World::new(stepping.room(Vec2::splat(30.0), GRAVITY))?;
    let disc = spawn_disc(&mut world, Vec2::new(15.0, height + 0.5), [1.0, 0.5], bouncy(restitution))?;
    let time = (2.0 * height / GRAVITY).sqrt();
    run(&mut world, 1.03 * time);
    let mut highest = 0.5f32;
    run_observed(&mut world, time, |world| highest = highest.max(last_particle(world, disc).position.y));
    Ok(f64::from((highest - 0.5) / height))
}

/// Mean difference of the rebound from `e²`, over that, for `e` 0.8.
fn rebound_error(stepping: Stepping) -> Result<f64, Error> {
    let error = |height| Ok((rebound(stepping, 0.8, height)? / 0.64 - 1.0).abs());
    Ok([6.0, 7.1, 8.3, 9.2, 10.0].map(error).into_iter().sum::<Result<f64, Error>>()? / 5.0)
}

/// Speeds of two discs after a heavy one has hit a light one of mass 1, or a light one a heavy one.
fn collide(masses: [f32; 2], restitution: f32) -> Result<[f64; 2], Error> {
    let mut world = World::new(Stepping::DEFAULT.room(Vec2::new(60.0, 20.0), 0.0))?;
    let mut place = |x: f32, mass: f32| spawn_disc(&mut world, Vec2::new(x, 10.0), [mass, 1.0], bouncy(restitution));
    let discs = [place(10.0, masses[0])?, place(16.0, masses[1])?];
    world.push(discs[0], Vec2::new(10.0, 0.0))?;
    run(&mut world, 1.0);
    Ok(discs.map(|disc| f64::from(last_particle(&world, disc).velocity.x)))
}

/// Momentum of two discs after an impact over that before.
pub(crate) fn momentum_kept(masses: [f32; 2], restitution: f32) -> Result<f64, Error> {
    let after = collide(masses, restitution)?;
    Ok((f64::from(masses[0]) * after[0] + f64::from(masses[1]) * after[1]) / (10.0 * f64::from(masses[0])))
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut rebounds) = (Vec::new(), Vec::new());
    for e in [0.2, 0.5, 0.8, 1.0f32] {
        let (height, ours) = (f64::from(e * e), rebound(Stepping::DEFAULT, e, 10.0)?);
        rebounds.push([f64::from(e), ours]);
        rows.push(Row::near(format!("rebound, e {e}, share of the height"), height, 0.05, ours));
    }
    for masses in [[1.0, 1.0], [1.0, 10.0], [10.0, 1.0], [100.0, 1.0], [1.0, 100.0f32]] {
        for e in [0.0, 0.5f32] {
            let [a, b] = masses.map(f64::from);
            let expected = 10.0 * a * (1.0 + f64::from(e)) / (a + b);
            let name = format!("masses {a} and {b}, e {e}");
            rows.push(Row::near(format!("speed of the second, {name}"), expected, 0.02, collide(masses, e)?[1]));
            rows.push(Row::near(format!("momentum kept, {name}"), 1.0, 0.02, momentum_kept(masses, e)?));
        }
    }
    let law = (0..=20).map(|k| 0.05 * f64::from(k)).map(|e| [e, e * e]).collect();
    let curves = vec![Curve::line("e²", law), Curve::dots("ours", rebounds)];
    let plot = Plot { axes: ["e", "rebound over the height of the fall"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
