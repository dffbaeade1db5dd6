//! Linear drag.

use super::scene::{GRAVITY, Stepping, last_particle, run, spawn_disc};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, Material, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "drag",
    title: "Drag",
    source: "Stokes 1851, Trans. Camb. Phil. Soc. 9: drag in proportion to speed, so `v = v0 exp(-c t)`; in free fall `g / c`",
    words: "`WorldConfig::damping` is `c`. Implicit, a substep keeps `1 / (1 + c h)`.",
    run: measure,
};

/// Speed of a disc after so many seconds of drag, with or without free fall.
pub(crate) fn speed(damping: f32, start: f32, gravity: f32, seconds: f32) -> Result<f64, Error> {
    let room = Stepping::DEFAULT.room(Vec2::new(20.0, 500.0), gravity);
    let mut world = World::new(WorldConfig { damping, ..room })?;
    let disc = spawn_disc(&mut world, Vec2::new(10.0, 490.0), [1.0, 0.5], Material::default())?;
    world.push(disc, Vec2::new(0.0, -start))?;
    run(&mut world, seconds);
    Ok(f64::from(-last_particle(&world, disc).velocity.y))
}

fn measure() -> Result<Outcome, Error> {
    let mut rows = Vec::new();
    for damping in [0.5, 2.0, 10.0f32] {
        let seconds = 2.0 / damping;
        let expected = 20.0 * (-2.0f64).exp();
        let ours = speed(damping, 20.0, 0.0, seconds)?;
        rows.push(Row::near(format!("speed of 20 units/s after 2 / c, c {damping}"), expected, 0.03, ours));
        let terminal = speed(damping, 0.0, GRAVITY, 10.0 / damping)?;
        let expected = f64::from(GRAVITY / damping) * (1.0 - (-10.0f64).exp());
        rows.push(Row::near(format!("speed of fall after 10 / c, c {damping}"), expected, 0.03, terminal));
    }
    Ok(Outcome { rows, ..Outcome::default() })
}
