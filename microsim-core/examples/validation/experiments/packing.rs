//! Packing of discs.

use super::plot::{Curve, Plot};
use super::scene::{GRAVITY, Stepping, run};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::glam::Vec2;
use microsim_core::{Error, Material, Node, Placement, Rng, Template, World, WorldConfig};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "packing",
    title: "Packing of discs",
    source: "Hexagonal: Thue 1892, Fejes Tóth 1940, `pi / sqrt(12)`, the densest; bidisperse 1 : 1.4, half of each, jammed at \
             random: O'Hern, Langer, Liu and Nagel 2002, Phys. Rev. Lett. 88, 075507, 0.84",
    words: "Smooth discs settle under gravity, from a hexagonal lattice and from loose random rows. The density is that of \
            covered area in the lower half of the heap, a radius away from walls and more.",
    run: measure,
    order: Order::None("where discs come to rest depends on every contact on the way"),
};

/// Spawns smooth discs, given by place and radius, in a room of this width, lets them settle, and returns the covered share of
/// the window between two corners, and the deepest overlap in radii, with the world.
pub(crate) fn settle(
    width: f32,
    discs: &[(Vec2, f32)],
    window: [Vec2; 2],
    seconds: f32,
) -> Result<(World, [f64; 2]), Error> {
    let room = Stepping::of_substeps(16).room(Vec2::new(width, 150.0), GRAVITY);
    let mut world = World::new(WorldConfig { damping: 0.5, ..room })?;
    let mut builder = Template::builder();
    let material = Material { friction: 0.0, restitution: 0.0 };
    builder.node(Node { material, ..Node::disc(Vec2::ZERO, 1.0, 1.0) });
    let template = world.add_template(builder.build()?);
    for (at, radius) in discs {
        world.spawn_template(template, Placement::at(at.x, at.y).scaled(*radius))?;
    }
    run(&mut world, seconds);
    let measured = [covered(&world, window), f64::from(world.quality().penetration_max)];
    Ok((world, measured))
}

/// Share of a window that discs cover.
fn covered(world: &World, [low, high]: [Vec2; 2]) -> f64 {
    const POINTS: u16 = 400;
    let discs: Vec<(Vec2, f32)> =
        world.view().organisms().flat_map(|organism| organism.particles()).map(|p| (p.position, p.radius)).collect();
    let points = (0..POINTS).flat_map(|i| (0..POINTS).map(move |j| Vec2::new(f32::from(i) + 0.5, f32::from(j) + 0.5)));
    let places = points.map(|point| low + (high - low) * point / f32::from(POINTS));
    let is_covered = |at: Vec2| discs.iter().any(|(centre, radius)| (at - *centre).length_squared() < radius * radius);
    places.filter(|at| is_covered(*at)).count() as f64 / f64::from(POINTS).powi(2)
}

/// Of a lattice of so many rows of 20.
pub(crate) fn hexagonal(rows: u8, seconds: f32) -> Result<[f64; 2], Error> {
    let (columns, rise) = (20u8, 3f32.sqrt());
    let place = |row: u8, column: u8| {
        Vec2::new(1.0 + f32::from(row % 2) + 2.0 * f32::from(column), 1.0 + rise * f32::from(row))
    };
    let discs: Vec<(Vec2, f32)> =
        (0..rows).flat_map(|row| (0..columns).map(move |column| (place(row, column), 1.0))).collect();
    // A window of whole cells of the lattice.
    let low = Vec2::new(10.0, 1.0 + 4.0 * rise);
    let high = low + Vec2::new(20.0, f32::from(rows / 2) * rise);
    Ok(settle(41.0, &discs, [low, high], seconds)?.1)
}

fn bidisperse() -> Result<(World, [f64; 2]), Error> {
    let mut rng = Rng::new(1, 1);
    let disc = |k: u16, rng: &mut Rng| {
        let at = Vec2::new(2.0 + 3.0 * f32::from(k % 13), 2.0 + 3.0 * f32::from(k / 13));
        let radius = if rng.unit() < 0.5 { 1.0 } else { 1.4 };
        (at + Vec2::new(rng.range(-0.1, 0.1), rng.range(-0.1, 0.1)), radius)
    };
    let discs: Vec<(Vec2, f32)> = (0..13 * 48).map(|k| disc(k, &mut rng)).collect();
    settle(40.0, &discs, [Vec2::new(4.0, 4.0), Vec2::new(36.0, 50.0)], 40.0)
}

fn measure() -> Result<Outcome, Error> {
    let densest = std::f64::consts::PI / 12f64.sqrt();
    let ([hexagonal, overlap], (world, [bidisperse, other])) = (hexagonal(24, 10.0)?, bidisperse()?);
    let at = |is_large: bool| {
        let discs = world.view().organisms().flat_map(|organism| organism.particles());
        let asked = discs.filter(|disc| (disc.radius > 1.2) == is_large);
        asked.map(|disc| [disc.position.x, disc.position.y].map(f64::from)).collect()
    };
    let curves = vec![Curve::dots("centres, radius 1", at(false)), Curve::dots("centres, radius 1.4", at(true))];
    Ok(Outcome {
        rows: vec![
            Row::near("hexagonal, share covered", densest, 0.01, hexagonal),
            Row::near("bidisperse, share covered", 0.84, 0.02, bidisperse),
            Row::between("deepest overlap, radii", "0", [0.0, 0.05], overlap.max(other)),
        ],
        plot: Some(Plot { axes: ["x, units", "y, units"], is_logarithmic: false, curves }),
        ..Outcome::default()
    })
}
