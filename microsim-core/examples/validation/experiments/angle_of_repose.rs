//! Slopes of heaps.

use super::granular_column::collapse;
use super::plot::{Curve, Plot};
use super::scene::fit;
use super::{Experiment, Order, Outcome, Row};
use microsim_core::Error;
use microsim_core::glam::Vec2;
use std::f64::consts::PI;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "angle_of_repose",
    title: "Angle of repose",
    source: "Coulomb 1776, Mém. math. phys. Acad. R. Sci. 7: a slope of dry grains stands up to the angle of their friction, \
             `atan mu`; after a collapse, which has inertia, it is flatter",
    words: "Columns of aspect 1, 40 spacings wide, collapse to heaps; they begin as a lattice, a crystal, of which other widths \
            slide otherwise ([limits](physics.md#limits)). The angle is that of the line through the surface between a fifth and four \
            fifths of the heap's length. Without friction nothing stands. The bounds, half to 1.1 `atan mu`, are ours.",
    run: measure,
    order: Order::None("where grains come to rest depends on every contact on the way"),
};

const WIDTH: f32 = 40.0;

/// Surface of a heap: the highest grain of each two spacings.
fn surface(grains: &[Vec2]) -> Vec<[f64; 2]> {
    let longest = grains.iter().fold(0.0, |far: f32, grain| far.max(grain.x));
    let columns = (longest / 2.0) as usize + 1;
    let mut tops = vec![0.0; columns];
    for grain in grains {
        let top: &mut f64 = &mut tops[(grain.x / 2.0) as usize];
        *top = top.max(f64::from(grain.y) + 0.5);
    }
    tops.iter().enumerate().map(|(k, top)| [2.0 * k as f64 + 1.0, *top]).collect()
}

/// Surface of the heap of a column that has collapsed, and its angle, degrees.
pub(crate) fn heap(width: f32, friction: f32, seconds: f32) -> Result<(Vec<[f64; 2]>, f64), Error> {
    let surface = surface(&collapse([width, 1.0], friction, seconds)?);
    let foot = surface.iter().rposition(|point| point[1] > 1.5).unwrap_or(0);
    let slope = fit(&surface[foot / 5..=(4 * foot / 5).max(foot / 5 + 2)])[0];
    Ok((surface, (-slope).atan() * 180.0 / PI))
}

fn measure() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    let mut curves = Vec::new();
    for friction in [0.0, 0.2, 0.5] {
        let (surface, angle) = heap(WIDTH, friction, 20.0)?;
        let internal = f64::from(friction).atan() * 180.0 / PI;
        let (published, accepted) = if friction > 0.0 {
            (format!("at most {internal:.0}"), [0.5 * internal, 1.1 * internal])
        } else {
            ("0".to_owned(), [-1.0, 1.0])
        };
        outcome.rows.push(Row::between(
            format!("angle after 20 s, friction {friction}, degrees"),
            &published,
            accepted,
            angle,
        ));
        if friction > 0.0 {
            let change = heap(WIDTH, friction, 40.0)?.1 - angle;
            let what = format!("change in the next 20 s, friction {friction}, degrees");
            outcome.rows.push(Row::between(what, "0", [-1.0, 1.0], change));
        }
        curves.push(Curve::line(format!("friction {friction}"), surface));
    }
    let axes = ["distance from the wall, spacings", "height, spacings"];
    outcome.plot = Some(Plot { axes, is_logarithmic: false, curves });
    Ok(outcome)
}
