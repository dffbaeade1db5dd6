//! Preparations that no built-in scenario is: bacteria on agarose, and cells that grew side by side.

use crate::pick;
use microsim_core::bodies::CollisionGroups;
use microsim_core::glam::Vec2;
use microsim_core::{AmoeboidCellSpec, BacillusSpec, CoccusSpec, Inputs, OrganismSpec, Placement};
use microsim_core::{Rng, World, WorldConfig};
use std::f32::consts::TAU;

/// Rods in packs of files, as they grow, single ones, and cocci in twos and fours, in their real sizes.
pub(crate) fn bacteria(rng: &mut Rng) -> Result<World, microsim_core::Error> {
    let side = 50.0;
    let mut world = room(side, rng)?;
    let radius = rng.range(0.38, 0.5);
    let rod: OrganismSpec = BacillusSpec { radius, ..BacillusSpec::default() }.into();
    let ball: OrganismSpec = CoccusSpec { radius: rng.range(0.4, 0.6), ..CoccusSpec::default() }.into();
    let has_rods = rng.unit() < 0.7;
    // Some are long enough to divide soon: two of them in a row.
    let long = 1 + pick(rng, 2);
    for _ in 0..2 + pick(rng, 4) {
        let middle = Vec2::new(rng.unit(), rng.unit()) * side;
        let (turn, bend) = (TAU * rng.unit(), 0.12 * rng.normal());
        let files = if has_rods { 1 + pick(rng, 8) } else { 0 };
        for file in 0..files {
            for place in 0..pick(rng, files + 3) {
                // Files bend together, as the pack does.
                let from_middle = Vec2::new(place as f32 - 0.5 * files as f32, file as f32 - 0.5 * files as f32);
                let apart = Vec2::new(1.6 + 3.2 * long as f32, 1.8) * radius;
                let angle = turn + bend * from_middle.x;
                let at = middle + Vec2::from_angle(angle).rotate(apart * from_middle);
                grow(&mut world, &rod, (at, angle + 0.04 * rng.normal()), (long, 3.2 * radius));
            }
        }
    }
    for _ in 0..8 + pick(rng, 30) {
        let at = Vec2::new(rng.unit(), rng.unit()) * side;
        if has_rods {
            grow(&mut world, &rod, (at, TAU * rng.unit()), (long, 3.2 * radius));
            continue;
        }
        let mut at = at;
        for _ in 0..2 + pick(rng, 5) {
            let _ = world.spawn(&ball, Placement::at(at.x, at.y));
            at += Vec2::from_angle(TAU * rng.unit()) * 1.2;
        }
    }
    Ok(world)
}

/// A rod of so many parts in a row; it does not grow where there is no room.
fn grow(world: &mut World, rod: &OrganismSpec, (at, angle): (Vec2, f32), (parts, apart): (usize, f32)) {
    let whole = Placement::at(at.x, at.y).turned(angle).overlapping(0.5);
    if world.spawn(rod, whole).is_err() {
        return;
    }
    for part in 1..parts {
        let at = at + Vec2::from_angle(angle) * (apart * part as f32);
        // It is one with the first.
        let _ = world.spawn(rod, Placement::at(at.x, at.y).turned(angle).in_groups(CollisionGroups::NONE));
    }
}

/// Cells that crawl side by side over glass, few or many: angular, drawn out between the places where they hold on.
pub(crate) fn cells(rng: &mut Rng) -> Result<World, microsim_core::Error> {
    let mut world = room(150.0, rng)?;
    let (radius, crowd) = (rng.range(8.0, 11.0), 8 + pick(rng, 160));
    let along = TAU * rng.unit();
    for _ in 0..crowd {
        let radius = radius * (0.18 * rng.normal()).exp();
        let cell = AmoeboidCellSpec {
            radii: Vec2::splat(radius),
            outline: corners(radius, rng),
            ..AmoeboidCellSpec::default()
        };
        let at = Vec2::new(rng.unit(), rng.unit()) * 150.0;
        let _ = world.spawn(&cell.into(), Placement::at(at.x, at.y).turned(along + 0.5 * rng.normal()));
    }
    (0..6).for_each(|_| world.step(&Inputs::new()));
    Ok(world)
}

/// The outline of a spread cell: long, and with up to four corners between which its edge is hollow.
fn corners(radius: f32, rng: &mut Rng) -> Vec<Vec2> {
    let stretch = 1.0 + 0.7 * rng.unit() * rng.unit();
    let waves: [(f32, f32); 3] = std::array::from_fn(|k| (TAU * rng.unit(), [0.30, 0.26, 0.14][k] * rng.unit()));
    (0..48)
        .map(|k| {
            let angle = TAU * k as f32 / 48.0;
            let wave =
                |(order, (phase, height)): (usize, &(f32, f32))| height * ((order + 2) as f32 * angle + phase).cos();
            let reach = radius * (1.0 + waves.iter().enumerate().map(wave).sum::<f32>());
            Vec2::from_angle(angle) * reach * Vec2::new(stretch, 1.0 / stretch)
        })
        .collect()
}

fn room(side: f32, rng: &mut Rng) -> Result<World, microsim_core::Error> {
    let config = WorldConfig { size: Vec2::splat(side), seed: u64::from(rng.next_u32()), ..WorldConfig::default() };
    World::new(config)
}
