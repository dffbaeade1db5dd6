//! Brownian motion of bodies.

use super::scene::Stepping;
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{
    BrownianParams, CoccusSpec, Controller, Error, Inputs, OrganismId, OrganismSpec, Placement, World, WorldConfig,
};
use std::f64::consts::PI;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "diffusion",
    title: "Brownian motion (Stokes-Einstein)",
    source: "Einstein 1905, Ann. Phys. 322, 549: `D = k T / (6 pi eta a)`, mean squared displacement `4 D t` in the plane",
    words: "900 cocci in a world, far from each other: the mean squared displacement of bodies, not of their controllers, in \
            windows of a second.",
    run: measure,
};

/// Bodies in a large room, far from each other, after so many seconds: where each was after every step.
pub(crate) fn tracks(spec: &OrganismSpec, controller: &Controller, seconds: f32) -> Result<Vec<Vec<Vec2>>, Error> {
    const SIDE: u8 = 30;
    const APART: f32 = 300.0;
    let size = Vec2::splat(APART * (f32::from(SIDE) + 4.0));
    let config = WorldConfig { max_speed: 100.0, damping: 0.5, ..Stepping::DEFAULT.room(size, 0.0) };
    let mut world = World::new(config)?;
    let places = (0..SIDE).flat_map(|column| (0..SIDE).map(move |row| [column, row]));
    let bodies: Vec<OrganismId> = places
        .map(|place| {
            let [x, y] = place.map(|k| (f32::from(k) + 2.5) * APART);
            world.spawn(spec, Placement::at(x, y).steered_by(controller.clone()))
        })
        .collect::<Result<_, _>>()?;
    let mut tracks = vec![Vec::new(); bodies.len()];
    for _ in 0..(seconds / world.config().dt) as u32 {
        world.step(&Inputs::new());
        for (track, &body) in tracks.iter_mut().zip(&bodies) {
            track.extend(world.centroid(body));
        }
    }
    Ok(tracks)
}

/// Mean squared displacement over a time, s, from `after` seconds on, over bodies and windows of that time.
pub(crate) fn mean_squared_displacement(tracks: &[Vec<Vec2>], after: f32, time: f32) -> f64 {
    let [start, window] = [after, time].map(|seconds| (seconds / Stepping::DEFAULT.dt).round() as usize);
    let squares = tracks.iter().flat_map(|track| {
        let ends: Vec<Vec2> = track.iter().skip(start).step_by(window).copied().collect();
        ends.windows(2).map(|pair| f64::from((pair[1] - pair[0]).length_squared())).collect::<Vec<_>>()
    });
    let squares: Vec<f64> = squares.collect();
    squares.iter().sum::<f64>() / squares.len() as f64
}

fn measure() -> Result<Outcome, Error> {
    let mut rows = Vec::new();
    // A coccus of 0.47 micrometres in water at 20 degrees Celsius, in SI units.
    let in_water = 1.381e-23 * 293.15 / (6.0 * PI * 1.002e-3 * 0.47e-6) * 1e12;
    let default = f64::from(BrownianParams::default().diffusion);
    rows.push(Row::near("D of a coccus of 0.47 µm in water at 20 °C, µm²/s", in_water, 0.02, default));
    for diffusion in [0.46, 10.0, 50.0f32] {
        let brownian = Controller::brownian(BrownianParams { diffusion, ..BrownianParams::default() });
        let tracks = tracks(&CoccusSpec::default().into(), &brownian, 10.0)?;
        let ours = mean_squared_displacement(&tracks, 1.0, 1.0) / 4.0;
        rows.push(Row::near(format!("D of bodies, {diffusion} µm²/s asked"), f64::from(diffusion), 0.05, ours));
    }
    Ok(Outcome { rows, ..Outcome::default() })
}
