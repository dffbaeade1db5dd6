//! Slopes of heaps.

use super::granular_column::collapse;
use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, fit, mean, run};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Drain, Emitter, Error, FluidBlockSpec, FluidMode, FluidParams, Material, Obstacle, OrganismSpec, Region, World,
    WorldConfig,
};
use std::f64::consts::PI;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "angle_of_repose",
    title: "Angle of repose",
    source: "Coulomb 1776, Mém. math. phys. Acad. R. Sci. 7: a slope of dry grains stands up to the angle of their friction, \
             `atan mu`; after a collapse, which has inertia, it is flatter. Discs that do not roll, put down gently, lie in the dimples \
             between others, whose sides rise by up to 30°: between `atan mu` and 30° more. Lee and Herrmann 1993, J. Phys. A 26, 373: \
             discs with friction that do not roll have finite angles",
    words: "Columns of aspect 1, as in the section on them, collapse to heaps; and grains fall one by one, ten a second from a little \
            above, on the middle of a shelf 80 spacings wide, from which what is too much falls. The angle is that of the line through \
            the surface between a fifth and four fifths of the heap's length; means of three seeds. Without friction nothing stands. The \
            bounds of columns, half to 1.1 `atan mu`, are ours.",
    run: measure,
    order: Order::None("where grains come to rest depends on every contact on the way"),
};

const SEEDS: std::ops::RangeInclusive<u64> = 1..=3;

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

/// Surface of a heap of grains whose top is at 0, and its angle, degrees.
fn slope(grains: &[Vec2]) -> (Vec<[f64; 2]>, f64) {
    let surface = surface(grains);
    let foot = surface.iter().rposition(|point| point[1] > 1.5).unwrap_or(0);
    let slope = fit(&surface[foot / 5..=(4 * foot / 5).max(foot / 5 + 2)])[0];
    (surface, (-slope).atan() * 180.0 / PI)
}

/// Surface of the heap of a column of this width that has collapsed, and its angle, degrees.
pub(crate) fn heap(width: f32, friction: f32, seconds: f32, seed: u64) -> Result<(Vec<[f64; 2]>, f64), Error> {
    Ok(slope(&collapse([width, 1.0], friction, seconds, seed)?))
}

/// Surface of both sides of the heap of so many grains that are poured on a shelf of this width, and its angle, degrees.
pub(crate) fn poured(width: f32, friction: f32, count: f32, seed: u64) -> Result<(Vec<[f64; 2]>, f64), Error> {
    const SHELF: f32 = 10.0;
    const RATE: f32 = 10.0;
    let size = Vec2::new(width + 40.0, SHELF + 0.5 * width + 20.0);
    let mut world = World::new(WorldConfig { seed, ..Stepping::DEFAULT.room(size, GRAVITY) })?;
    let middle = 0.5 * size.x;
    let shelf = Obstacle::new(SharedShape::cuboid(0.5 * width, 2.0), Pose::translation(middle, SHELF - 2.0));
    world.add_obstacle(Obstacle { material: Material { friction, restitution: 0.0 }, ..shelf })?;
    world.add_drain(Drain {
        region: Region::Box { low: Vec2::ZERO, high: Vec2::new(size.x, SHELF - 5.0) },
        kind: None,
    })?;
    let fluid = FluidParams { mode: FluidMode::Granular, viscosity: 0.0, friction, ..FluidParams::default() };
    let grain = OrganismSpec::from(FluidBlockSpec { size: Vec2::ONE, fluid });
    let spout = Vec2::new(middle, SHELF + 0.3 * width + 5.0);
    let region = Region::Box { low: spout - Vec2::X, high: spout + Vec2::X };
    let emitter = world.add_emitter(Emitter::new(region, grain.into(), RATE))?;
    run(&mut world, count / RATE);
    world.remove_emitter(emitter)?;
    run(&mut world, 10.0);
    let grains = world.view().organisms().flat_map(|organism| organism.particles());
    let places = grains.map(|grain| grain.position - Vec2::new(middle, SHELF)).filter(|at| at.y > 0.0);
    Ok(slope(&places.map(|at| Vec2::new(at.x.abs(), at.y)).collect::<Vec<_>>()))
}

/// Mean angle over the seeds, degrees, and the surface of the first.
fn mean_angle(heap: impl Fn(u64) -> Result<(Vec<[f64; 2]>, f64), Error>) -> Result<(Vec<[f64; 2]>, f64), Error> {
    let heaps: Vec<_> = SEEDS.map(heap).collect::<Result<_, _>>()?;
    Ok((heaps[0].0.clone(), mean(heaps.iter().map(|heap| heap.1))))
}

fn measure() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    let mut curves = Vec::new();
    let smooth = mean_angle(|seed| heap(40.0, 0.0, 20.0, seed))?.1;
    outcome.rows.push(Row::between("column 40 wide, friction 0: angle after 20 s, degrees", "0", [-1.0, 1.0], smooth));
    for friction in [0.2, 0.5] {
        let internal = f64::from(friction).atan() * 180.0 / PI;
        for width in [20.0, 40.0, 80.0] {
            let (surface, angle) = mean_angle(|seed| heap(width, friction, 20.0, seed))?;
            let what = format!("column {width} wide, friction {friction}: angle after 20 s, degrees");
            let bounds = [0.5 * internal, 1.1 * internal];
            outcome.rows.push(Row::between(what, &format!("at most {internal:.0}"), bounds, angle));
            if width == 40.0 {
                let change = mean_angle(|seed| heap(width, friction, 40.0, seed))?.1 - angle;
                let what = format!("column {width} wide, friction {friction}: change in the next 20 s, degrees");
                outcome.rows.push(Row::between(what, "0", [-1.0, 1.0], change));
                curves.push(Curve::line(format!("column, friction {friction}"), surface));
            }
        }
        let (surface, angle) = mean_angle(|seed| poured(80.0, friction, 1300.0, seed))?;
        let what = format!("poured, friction {friction}: angle, degrees");
        let published = format!("{internal:.0} to {:.0}", internal + 30.0);
        outcome.rows.push(Row::between(what, &published, [internal, internal + 30.0], angle));
        curves.push(Curve::line(format!("poured, friction {friction}"), surface));
    }
    let axes = ["distance from the wall or the middle, spacings", "height, spacings"];
    outcome.plot = Some(Plot { axes, is_logarithmic: false, curves });
    outcome.cause =
        "a heap of few grains is rough: its height is that of four, of which each lies in a dimple between others.";
    Ok(outcome)
}
