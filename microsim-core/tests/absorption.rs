//! Phagocytosis over many seeds: prey in every direction, among platelets (thesis, 3.1.3).
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::chase::{Scene, WAYS, agar, begins, by, chase, ends, phase, small_rigid};
use common::outline;
use microsim_core::geometry::polygon::contains_point;
use microsim_core::geometry::ring::unit_vector;
use microsim_core::glam::Vec2;
use microsim_core::{
    AmoeboidCellSpec, IngestionWay, MealPhase, OrganismSpec, Placement, PlateletSpec, Rng, World, WorldConfig,
};

/// A cell that takes prey in by one way, prey in a random direction, and platelets around.
fn among_platelets(seed: u64, way: IngestionWay, prey: &OrganismSpec, distance: f32) -> Scene {
    let mut rng = Rng::new(seed, 9);
    let mut world = World::new(WorldConfig { size: Vec2::new(110.0, 90.0), ..WorldConfig::default() }).unwrap();
    let spec = AmoeboidCellSpec { phagocytosis: by(way), ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(55.0, 45.0)).unwrap();
    let at = Vec2::new(55.0, 45.0) + unit_vector(rng.range(0.0, std::f32::consts::TAU)) * distance;
    let prey = world.spawn(prey, Placement::at(at.x, at.y)).unwrap();
    for _ in 0..60 {
        let at = Placement::at(rng.range(3.0, 107.0), rng.range(3.0, 87.0));
        // Where there is no room there is no platelet.
        let _ = world.spawn(&PlateletSpec::default().into(), at);
    }
    (world, cell, prey)
}

/// Steps from the beginning of an ingestion to its end, and whether the prey is inside then.
fn absorb(seed: u64, way: IngestionWay, prey: &OrganismSpec, distance: f32) -> Option<(u32, bool)> {
    let (mut world, cell, prey) = among_platelets(seed, way, prey, distance);
    chase(&mut world, cell, prey, 900, begins)?;
    let took = chase(&mut world, cell, prey, 600, ends).expect("inside or released");
    let outline = outline(&world, cell);
    let mut discs = world.view().organism(prey).unwrap().particles().map(|p| contains_point(&outline, p.position));
    let is_inside = phase(&world, cell, prey) == Some(MealPhase::Ingested);
    assert!(discs.all(|part| part == is_inside), "seed {seed}: {way:?}, partly inside");
    assert!(world.quality().edge_stretch_max < 0.5, "seed {seed}: {:?}", world.quality());
    Some((took, is_inside))
}

/// Absorbs over seeds; all must end within the time limit (and the time to be put on a side), none partly inside.
fn absorb_over_seeds(seeds: u64, way: IngestionWay, prey: &OrganismSpec, distance: f32) {
    let ends: Vec<(u32, bool)> = (0..seeds).filter_map(|seed| absorb(seed, way, prey, distance)).collect();
    let inside = ends.iter().filter(|end| end.1).count() as u64;
    let longest = ends.iter().map(|end| end.0).max().unwrap();
    let mean = ends.iter().map(|end| end.0).sum::<u32>() / ends.len() as u32;
    let begun = ends.len() as u64;
    println!("{way:?}: {begun} of {seeds} begun, {inside} inside, steps: mean {mean}, longest {longest}");
    assert!(longest < 240, "{way:?}: {longest} steps");
    assert!(begun * 10 >= seeds * 9 && inside * 10 >= begun * 9, "{way:?}: {begun} begun, {inside} inside");
}

#[test]
fn agar_and_rigid_cells_among_platelets_are_absorbed_from_every_side() {
    for way in WAYS {
        absorb_over_seeds(6, way, &agar(), 16.0);
        absorb_over_seeds(6, way, &small_rigid(), 19.0);
    }
}

#[test]
#[ignore = "a soak: minutes in release"]
fn absorption_over_200_seeds() {
    for way in WAYS {
        absorb_over_seeds(200, way, &agar(), 16.0);
        absorb_over_seeds(200, way, &small_rigid(), 19.0);
    }
}
