//! Free fall.

use super::order::{Falling, Order};
use super::scene::{GRAVITY, Stepping, last_particle, run};
use super::{Experiment, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{AgarSpec, Error, Placement, World};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "free_fall",
    title: "Free fall",
    source: "Galilei 1638, Discorsi, third day: speed `g t`, way `g t² / 2`",
    words: "A disc falls for a second at 10 units/s² without drag. Its way is that of implicit Euler, `g t (t + h) / 2`.",
    run: measure,
    order: Order::Of(Falling::first("the way", |stepping| Ok(fall(stepping)?[1] / 5.0 - 1.0))),
};

/// Speed, units/s, and way, units, after a second.
pub(crate) fn fall(stepping: Stepping) -> Result<[f64; 2], Error> {
    let mut world = World::new(stepping.room(Vec2::new(160.0, 90.0), GRAVITY))?;
    let disc = world.spawn(&AgarSpec::default().into(), Placement::at(80.0, 60.0))?;
    run(&mut world, 1.0);
    let disc = last_particle(&world, disc);
    Ok([f64::from(-disc.velocity.y), f64::from(60.0 - disc.position.y)])
}

fn measure() -> Result<Outcome, Error> {
    let mut rows = Vec::new();
    for (dt, substeps) in [(1.0 / 30.0, 2), (1.0 / 60.0, 8), (1.0 / 60.0, 64), (0.001, 1), (0.001, 5)] {
        let stepping = Stepping { dt, substeps };
        let [speed, way] = fall(stepping)?;
        let name = format!("{dt:.4} s, {substeps} substeps");
        rows.push(Row::near(format!("speed, {name}"), 10.0, 0.001, speed));
        rows.push(Row::near(format!("way, {name}"), 5.0, 0.001 + stepping.substep(), way));
    }
    Ok(Outcome { rows, ..Outcome::default() })
}
