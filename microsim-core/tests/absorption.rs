//! Phagocytosis over many seeds: prey in every direction, among platelets (thesis, 3.1.3).
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::chase::{Scene, WAYS, agar, agar_of, begins, by, chase, ends, ingests, phase, small_rigid};
use common::outline;
use microsim_core::geometry::polygon::contains_point;
use microsim_core::geometry::ring::unit_vector;
use microsim_core::glam::Vec2;
use microsim_core::{
    AmoeboidCellSpec, BacillusSpec, CoccusSpec, IngestionWay, MealPhase, OrganismSpec, PhagocytosisParams, Placement,
    PlateletSpec, Rng, World, WorldConfig,
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

/// Takes prey in that was begun with, in the open; returns whether it was not released before, and the longest link in rest lengths.
fn take_in(config: &WorldConfig, spec: &AmoeboidCellSpec, prey: &OrganismSpec, distance: f32) -> (bool, f32) {
    let centre = 0.5 * config.size;
    let at = centre + unit_vector(2.1 * config.seed as f32) * distance;
    let mut world = World::new(config.clone()).unwrap();
    let cell = world.spawn(&spec.clone().into(), Placement::at(centre.x, centre.y)).unwrap();
    let prey = world.spawn(prey, Placement::at(at.x, at.y).turned(config.seed as f32)).unwrap();
    let mut longest = 0.0_f32;
    let steps = (12.0 / config.dt) as u32;
    chase(&mut world, cell, prey, steps, begins).expect("begins");
    let ended = (0..steps).any(|_| {
        let is_over = chase(&mut world, cell, prey, 1, ends).is_some();
        let ring = outline(&world, cell);
        let links = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| (*b - *a).length());
        longest = links.fold(longest, |longest, link| longest.max(link / (2.0 * spec.node_radius)));
        is_over
    });
    assert!(ended, "it ends");
    (ingests(&world), longest)
}

#[test]
fn prey_of_any_size_is_taken_in_at_the_first_try_in_steps_of_any_length() {
    let of = |radius: f32| (agar_of(radius), radius);
    let preys = [of(0.2), of(0.5), of(1.0), of(4.0), of(6.0)];
    let bacteria = [(CoccusSpec::default().into(), 0.5), (BacillusSpec::default().into(), 1.0), (small_rigid(), 5.0)];
    for (dt, substeps) in [(1.0 / 60.0, 6), (1.0 / 60.0, 16), (1.0 / 60.0, 32), (1.0 / 240.0, 4)] {
        for (seed, (prey, size)) in (0..2).flat_map(|seed| preys.iter().chain(&bacteria).map(move |prey| (seed, prey)))
        {
            let config = WorldConfig { size: Vec2::splat(200.0), dt, substeps, seed, ..WorldConfig::default() };
            let (is_in, _) = take_in(&config, &AmoeboidCellSpec::default(), prey, 12.0 + size);
            assert!(is_in, "seed {seed}: released in substeps of {dt} s / {substeps}, {prey:?}");
        }
    }
}

#[test]
fn a_large_cell_takes_in_large_prey_at_the_first_try() {
    for (substeps, radius, seed) in [(8, 8.0, 1), (16, 8.0, 0), (8, 10.0, 0), (32, 10.0, 1)] {
        let config = WorldConfig { size: Vec2::splat(300.0), substeps, seed, ..WorldConfig::default() };
        let spec = AmoeboidCellSpec { radii: Vec2::splat(20.0), ..AmoeboidCellSpec::default() };
        let (is_in, _) = take_in(&config, &spec, &agar_of(radius), 21.0 + radius);
        assert!(is_in, "{substeps} substeps, radius {radius}, seed {seed}");
    }
}

#[test]
fn a_membrane_round_the_largest_prey_gets_nodes_for_it() {
    for (radius, size_ratio) in [(7.0, 1.5), (8.0, 1.0)] {
        let phagocytosis = PhagocytosisParams { size_ratio, ..by(IngestionWay::Gate) };
        let spec = AmoeboidCellSpec { phagocytosis, ..AmoeboidCellSpec::default() };
        let config = WorldConfig { size: Vec2::splat(200.0), ..WorldConfig::default() };
        let (is_in, longest) = take_in(&config, &spec, &agar_of(radius), 12.0 + radius);
        assert!(is_in && longest <= 1.25, "radius {radius}: links of {longest} rest lengths");
    }
}
