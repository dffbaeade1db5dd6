//! Energy of grains.

use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, particles, run_observed};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, FluidBlockSpec, FluidMode, FluidParams, Placement, World};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "granular_energy",
    title: "Energy of grains",
    source: "Conservation of energy: inelastic grains lose it and never gain any (Haff 1983, J. Fluid Mech. 134, 401)",
    words: "A block of 40 x 300 spacings collapses for a minute at 10 units/s², without drag; kinetic and potential energy, \
            from the floor, over that of the start.",
    run: measure,
    order: Order::None("a bound, not a value"),
};

/// Energy over that of the start after each step.
pub(crate) fn energy(size: Vec2, friction: f32, seconds: f32) -> Result<Vec<[f64; 2]>, Error> {
    let room = Stepping::DEFAULT.room(Vec2::new(6.0 * size.x + 60.0, size.y + 10.0), GRAVITY);
    let mut world = World::new(room)?;
    let fluid = FluidParams { mode: FluidMode::Granular, friction, ..FluidParams::default() };
    let block = world.spawn(&FluidBlockSpec { size, fluid }.into(), Placement::at(0.5 * size.x, 0.5 * size.y))?;
    let now = |world: &World| {
        let of = |height: f32, v: Vec2| f64::from(GRAVITY * height) + 0.5 * f64::from(v.length_squared());
        particles(world, block).iter().map(|grain| of(grain.position.y, grain.velocity)).sum::<f64>()
    };
    let start = now(&world);
    let mut energies = vec![[0.0, 1.0]];
    run_observed(&mut world, seconds, |world| energies.push([world.time(), now(world) / start]));
    Ok(energies)
}

/// The largest rise over the least value before it.
pub(crate) fn largest_rise(energies: &[[f64; 2]]) -> f64 {
    let (mut least, mut rise) = (f64::INFINITY, 0.0f64);
    for [_, energy] in energies {
        least = least.min(*energy);
        rise = rise.max(energy - least);
    }
    rise
}

fn measure() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    let mut curves = Vec::new();
    for friction in [0.0, 0.5] {
        let energies = energy(Vec2::new(40.0, 300.0), friction, 60.0)?;
        let most = energies.iter().fold(0.0, |most: f64, point| most.max(point[1]));
        let name = format!("friction {friction}");
        outcome.rows.push(Row::between(format!("most energy in 60 s, {name}"), "at most 1", [0.0, 1.0], most));
        let rise = largest_rise(&energies);
        outcome.rows.push(Row::between(format!("largest rise, {name}"), "0", [0.0, 0.01], rise));
        curves.push(Curve::line(name, energies.into_iter().step_by(20).collect()));
    }
    outcome.plot = Some(Plot { axes: ["time, s", "energy over that of the start"], is_logarithmic: false, curves });
    Ok(outcome)
}
