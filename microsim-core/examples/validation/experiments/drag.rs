//! Linear drag.

use super::order::{Falling, Order};
use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, last_particle, run, spawn_disc};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, Material, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "drag",
    title: "Drag",
    source: "Stokes 1851, Trans. Camb. Phil. Soc. 9: drag in proportion to speed, so `v = v0 exp(-c t)`; in free fall `g / c`",
    words: "`WorldConfig::damping` is `c`. Implicit, a substep keeps `1 / (1 + c h)`, after its motion; more than `c h = 0.05` is refused.",
    run: measure,
    order: Order::Of(Falling::first("the way in 2 s, c 2", |stepping| {
        Ok(speed_and_way(stepping, [2.0, 20.0, 0.0], 2.0)?[1] / (10.0 * (1.0 - (-4.0f64).exp())) - 1.0)
    })),
};

/// Speed of a disc after so many seconds of drag, from a speed at the start, with or without free fall, and its way.
fn speed_and_way(stepping: Stepping, [damping, start, gravity]: [f32; 3], seconds: f32) -> Result<[f64; 2], Error> {
    let room = stepping.room(Vec2::new(20.0, 500.0), gravity);
    let mut world = World::new(WorldConfig { damping, ..room })?;
    let disc = spawn_disc(&mut world, Vec2::new(10.0, 490.0), [1.0, 0.5], Material::default())?;
    world.push(disc, Vec2::new(0.0, -start))?;
    let from = last_particle(&world, disc).position.y;
    run(&mut world, seconds);
    let disc = last_particle(&world, disc);
    Ok([-disc.velocity.y, from - disc.position.y].map(f64::from))
}

fn measure() -> Result<Outcome, Error> {
    let mut rows = Vec::new();
    let speed_and_way = |of, seconds| speed_and_way(Stepping::DEFAULT, of, seconds);
    for (damping, share) in [(0.5, 0.03), (2.0, 0.03), (10.0, 0.03), (20.0f32, 0.05)] {
        let [speed, _] = speed_and_way([damping, 20.0, 0.0], 2.0 / damping)?;
        rows.push(Row::near(
            format!("speed of 20 units/s after 2 / c, c {damping}"),
            20.0 * (-2.0f64).exp(),
            share,
            speed,
        ));
        let [_, way] = speed_and_way([damping, 20.0, 0.0], 10.0 / damping)?;
        rows.push(Row::near(format!("way of 20 units/s, c {damping}"), f64::from(20.0 / damping), share, way));
        let [terminal, _] = speed_and_way([damping, 0.0, GRAVITY], 10.0 / damping)?;
        let expected = f64::from(GRAVITY / damping) * (1.0 - (-10.0f64).exp());
        rows.push(Row::near(format!("speed of fall after 10 / c, c {damping}"), expected, share, terminal));
    }
    let mut curves = Vec::new();
    for damping in [0.5, 2.0, 10.0f32] {
        let times = (1..=15).map(|k| 0.2 * k as f32);
        let speeds: Result<Vec<[f64; 2]>, Error> =
            times.map(|t| Ok([f64::from(t), speed_and_way([damping, 20.0, 0.0], t)?[0]])).collect();
        let law = (0..=60).map(|k| 0.05 * f64::from(k)).map(|t| [t, 20.0 * (-f64::from(damping) * t).exp()]).collect();
        curves.push(Curve::line(format!("20 exp(-c t), c {damping}"), law));
        curves.push(Curve::dots(format!("ours, c {damping}"), speeds?));
    }
    let plot = Plot { axes: ["time, s", "speed, units/s"], is_logarithmic: false, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
