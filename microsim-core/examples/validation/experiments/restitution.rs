//! Impacts.

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
};

fn bouncy(restitution: f32) -> Material {
    Material { friction: 0.0, restitution }
}

/// Height of the first rebound over the height of the fall.
fn rebound(restitution: f32) -> Result<f64, Error> {
    let mut world = World::new(Stepping::DEFAULT.room(Vec2::splat(30.0), GRAVITY))?;
    let disc = spawn_disc(&mut world, Vec2::new(15.0, 10.5), [1.0, 0.5], bouncy(restitution))?;
    run(&mut world, 1.45);
    let mut highest = 0.5f32;
    run_observed(&mut world, 1.4, |world| highest = highest.max(last_particle(world, disc).position.y));
    Ok(f64::from(highest - 0.5) / 10.0)
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
    let mut rows = Vec::new();
    for e in [0.2, 0.5, 0.8, 1.0f32] {
        let height = f64::from(e * e);
        rows.push(Row::near(format!("rebound, e {e}, share of the height"), height, 0.05, rebound(e)?));
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
    Ok(Outcome { rows, ..Outcome::default() })
}
