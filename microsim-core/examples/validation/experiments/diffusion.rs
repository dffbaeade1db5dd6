//! Brownian motion of bodies.

use super::plot::{Curve, Plot};
use super::scene::Stepping;
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, BrownianParams, CoccusSpec, Controller, Error, FieldKind, ForceField, Inputs, OrganismId, OrganismSpec,
    Placement, Region, World, WorldConfig,
};
use std::f64::consts::PI;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "diffusion",
    title: "Brownian motion (Stokes-Einstein)",
    source: "Einstein 1905, Ann. Phys. 322, 549: `D = k T / (6 pi eta a)`, mean squared displacement `4 D t` in the plane; viscosity of \
             water: Kestin, Sokolov and Wakeham 1978, J. Phys. Chem. Ref. Data 7, 941",
    words: "900 bodies in a world, far from each other: the mean squared displacement of bodies, not of their controllers. Cocci are \
            kicked by a controller that is given `D`, in windows of a second. Beads, of which a unit is a micrometre, are in a thermal \
            field of mobility `k T / (6 pi eta)`, as the table `[medium]` of a scenario makes it of a temperature and a viscosity; the \
            field's bodies diffuse by their own radius, in windows of 2 s, at a drag of 4 1/s.",
    run: measure,
    order: Order::None("statistical. Displacements of kicks are exact at their ends in any step"),
};

/// Boltzmann's constant, J/K.
const BOLTZMANN: f64 = 1.380_649e-23;

/// `k T / (6 pi eta)` at a temperature, degrees Celsius, and a viscosity, mPa s: cubic micrometres/s.
pub(crate) fn mobility(celsius: f64, viscosity: f64) -> f64 {
    BOLTZMANN * (celsius + 273.15) / (6.0 * PI * viscosity * 1e-3) * 1e18
}

/// A world for so many rows of bodies far from each other, with the places for them.
fn wide_room(side: u8, damping: f32, seed: u64) -> Result<(World, Vec<Placement>), Error> {
    const APART: f32 = 300.0;
    let size = Vec2::splat(APART * (f32::from(side) + 4.0));
    let config = WorldConfig { max_speed: 100.0, damping, seed, ..Stepping::DEFAULT.room(size, 0.0) };
    let places =
        (0..side).flat_map(|column| (0..side).map(move |row| [column, row].map(|k| (f32::from(k) + 2.5) * APART)));
    Ok((World::new(config)?, places.map(|[x, y]| Placement::at(x, y)).collect()))
}

/// Where each of some bodies is after every step of so many seconds.
fn follow(world: &mut World, bodies: &[OrganismId], seconds: f32) -> Vec<Vec<Vec2>> {
    let mut tracks = vec![Vec::new(); bodies.len()];
    for _ in 0..(seconds / world.config().dt) as u32 {
        world.step(&Inputs::new());
        for (track, &body) in tracks.iter_mut().zip(bodies) {
            track.extend(world.centroid(body));
        }
    }
    tracks
}

/// So many rows of bodies in a large room that a controller steers: where each was after every step.
pub(crate) fn tracks(
    spec: &OrganismSpec,
    controller: &Controller,
    seconds: f32,
    side: u8,
) -> Result<Vec<Vec<Vec2>>, Error> {
    let (mut world, places) = wide_room(side, 0.5, 0)?;
    let spawn = |place: Placement| world.spawn(spec, place.steered_by(controller.clone()));
    let bodies: Vec<OrganismId> = places.into_iter().map(spawn).collect::<Result<_, _>>()?;
    Ok(follow(&mut world, &bodies, seconds))
}

/// Diffusion coefficient of so many rows of beads in a thermal field, over windows of 2 s.
pub(crate) fn diffusion_of_beads(radius: f32, mobility: f64, seconds: f32, side: u8) -> Result<f64, Error> {
    const DAMPING: f32 = 4.0;
    let (mut world, places) = wide_room(side, DAMPING, (100.0 * mobility / f64::from(radius)) as u64)?;
    let bead = AgarSpec { radius, ..AgarSpec::default() }.into();
    let beads: Vec<OrganismId> = places.into_iter().map(|at| world.spawn(&bead, at)).collect::<Result<_, _>>()?;
    world.add_field(ForceField { region: Region::All, kind: FieldKind::Thermal { mobility: mobility as f32 } })?;
    let tracks = follow(&mut world, &beads, seconds);
    // Of a Langevin particle: 4 D (t - (1 - exp(-g t)) / g).
    let time = 2.0 - (1.0 - (-2.0 * f64::from(DAMPING)).exp()) / f64::from(DAMPING);
    Ok(mean_squared_displacement(&tracks, 1.0, 2.0) / (4.0 * time))
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
    let default = f64::from(BrownianParams::default().diffusion);
    let in_water = mobility(20.0, 1.002) / 0.47;
    rows.push(Row::near("default D, a coccus of 0.47 µm in water at 20 °C, µm²/s", in_water, 0.02, default));
    for diffusion in [0.46, 10.0, 50.0f32] {
        let brownian = Controller::brownian(BrownianParams { diffusion, ..BrownianParams::default() });
        let tracks = tracks(&CoccusSpec::default().into(), &brownian, 10.0, 30)?;
        let ours = mean_squared_displacement(&tracks, 1.0, 1.0) / 4.0;
        rows.push(Row::near(format!("D of cocci, {diffusion} µm²/s asked"), f64::from(diffusion), 0.05, ours));
    }
    let mut beads = Vec::new();
    for (radius, celsius, viscosity) in [
        (0.1, 25.0, 0.890),
        (0.25, 25.0, 0.890),
        (0.5, 5.0, 1.519),
        (0.5, 25.0, 0.890),
        (0.5, 37.0, 0.692),
        (1.0, 25.0, 0.890),
        (2.5, 25.0, 0.890f64),
    ] {
        let mobility = mobility(celsius, viscosity);
        let ours = diffusion_of_beads(radius, mobility, 13.1, 30)?;
        let what = format!("D of beads of {} µm in water of {celsius} °C ({viscosity} mPa s), µm²/s", 2.0 * radius);
        rows.push(Row::near(what, mobility / f64::from(radius), 0.05, ours));
        if celsius == 25.0 {
            beads.push([f64::from(radius), ours]);
        }
    }
    let law = (2..=60).map(|k| 0.05 * f64::from(k)).map(|a| [a, mobility(25.0, 0.890) / a]).collect();
    let curves = vec![Curve::line("k T / (6 pi eta a), water of 25 °C", law), Curve::dots("ours", beads)];
    let plot = Plot { axes: ["radius, µm", "D, µm²/s"], is_logarithmic: true, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
