//! Crawling by pseudopods: cells stay whole, eat, divide and can be repeated.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]
#![cfg(feature = "scenario")]

mod common;

use common::{assert_sound, happens, room_with, run, toward};
use microsim_core::glam::Vec2;
use microsim_core::scenario::{Built, Scenario, builtin};
use microsim_core::{AmoeboidCellSpec, Crawl, Event, Inputs, Intent, OrganismId, Placement, PlateletSpec, Rng, World};

const TYPES: [Crawl; 4] = [Crawl::Keratocyte, Crawl::Neutrophil, Crawl::Dictyostelium, Crawl::AmoebaProteus];

fn cell(crawl: Crawl) -> AmoeboidCellSpec {
    AmoeboidCellSpec { radii: Vec2::splat(7.6), node_radius: 0.45, speed: 5.0, crawl, ..Default::default() }
}

fn protrusion(world: &World, cell: OrganismId) -> Vec<f32> {
    world.view().organism(cell).unwrap().protrusion().unwrap()
}

/// Area over that of a circle with the same perimeter.
fn roundness(world: &World, cell: OrganismId) -> f32 {
    let outline = common::outline(world, cell);
    let (area, perimeter) =
        (microsim_core::geometry::signed_area(&outline), microsim_core::geometry::perimeter(&outline));
    4.0 * std::f32::consts::PI * area / (perimeter * perimeter)
}

#[test]
fn every_type_crawls_to_its_goal_by_pseudopods_and_rests_round() {
    for crawl in TYPES {
        let (mut world, id) = room_with(cell(crawl), 30.0, 45.0);
        let (mut least, mut most) = (1.0f32, 0.0f32);
        for _ in 0..300 {
            run(&mut world, &toward(id, Vec2::new(1e4, 45.0)), 1);
            most = protrusion(&world, id).into_iter().fold(most, f32::max);
            least = least.min(roundness(&world, id));
        }
        let way = world.centroid(id).unwrap().x - 30.0;
        assert!(way > 15.0 && way < 35.0, "{crawl:?}: {way} units in 5 s at 5 units/s");
        assert!(most > 0.9 && least < 0.93, "{crawl:?}: protrusion {most}, roundness {least}");
        run(&mut world, &Inputs::new(), 300);
        assert_eq!(protrusion(&world, id), vec![0.0; protrusion(&world, id).len()], "{crawl:?}: withdrawn");
        assert!(roundness(&world, id) > 0.98, "{crawl:?}: {}", roundness(&world, id));
    }
}

#[test]
fn a_crawling_cell_spreads_with_its_pseudopods_and_rounds_up_to_its_area_at_rest() {
    for (crawl, variations) in [(Crawl::Neutrophil, 0.04..0.12), (Crawl::Keratocyte, 0.0..0.02)] {
        let (mut world, id) = room_with(cell(crawl), 30.0, 45.0);
        let area = |world: &World| microsim_core::geometry::signed_area(&common::outline(world, id));
        let at_rest = area(&world);
        run(&mut world, &toward(id, Vec2::new(1e4, 45.0)), 60);
        let areas: Vec<f32> =
            (0..400).map(|_| (run(&mut world, &toward(id, Vec2::new(1e4, 45.0)), 1), area(&world)).1).collect();
        let mean = areas.iter().sum::<f32>() / areas.len() as f32;
        let variance = areas.iter().map(|area| (area - mean).powi(2)).sum::<f32>() / areas.len() as f32;
        let variation = variance.sqrt() / mean;
        assert!(variations.contains(&variation), "{crawl:?}: {variation}");
        assert!((mean / at_rest - 1.0).abs() < 0.1, "{crawl:?}: {mean} of {at_rest}");
        let voids = world.membrane_quality(id).unwrap().voids;
        assert!(voids < 0.05, "{crawl:?}: {voids}");
        run(&mut world, &Inputs::new(), 300);
        assert!((area(&world) / at_rest - 1.0).abs() < 0.03, "{crawl:?}: {} of {at_rest}", area(&world));
    }
}

#[test]
fn nothing_leaks_between_platelets_and_walls_whatever_the_goal() {
    for (crawl, seed) in TYPES.into_iter().zip(1..) {
        let (mut world, id) = room_with(cell(crawl), 20.0, 45.0);
        for k in 0..24 {
            let at = Placement::at(40.0 + 6.0 * (k / 6) as f32, 25.0 + 7.0 * (k % 6) as f32);
            world.spawn(&PlateletSpec::default().into(), at).unwrap();
        }
        let mut rng = Rng::new(seed, 2);
        for _ in 0..30 {
            let goal = Vec2::new(rng.range(0.0, 80.0), rng.range(0.0, 90.0));
            for _ in 0..20 {
                run(&mut world, &toward(id, goal), 1);
                assert_sound(&world, &format!("{crawl:?}"));
            }
        }
        world.validate().unwrap();
    }
}

/// Runs a scenario whose cell crawls by pseudopods until it has taken prey in; returns the time.
fn first_meal(name: &str, seed: u64) -> f64 {
    let crawl = [("amoeboid_cell.hunter.crawl".to_owned(), "neutrophil".to_owned())];
    let mut scenario = Scenario::parse(builtin(name).unwrap().text, &crawl).unwrap();
    scenario.set_seed(seed);
    let Built { mut world, mut script, .. } = scenario.build().unwrap();
    while world.time() < 20.0 {
        let inputs = script.before_step(&mut world);
        world.step(inputs);
        assert_sound(&world, name);
        if happens(&world, |event| matches!(event, Event::Ingested { .. })) {
            return world.time();
        }
    }
    f64::INFINITY
}

#[test]
fn prey_is_taken_in_without_a_leak() {
    for name in ["absorb-agar", "absorb-rigid"] {
        for seed in 1..=3 {
            let time = first_meal(name, seed);
            assert!(time < 20.0, "{name}, seed {seed}: nothing within 20 s");
        }
    }
}

#[test]
fn daughters_crawl_on_with_activity_and_random_numbers_of_their_own() {
    let spec = AmoeboidCellSpec { crawl: Crawl::Dictyostelium, ..Default::default() };
    let (mut world, id) = room_with(spec, 80.0, 45.0);
    run(&mut world, &toward(id, Vec2::new(1e4, 45.0)), 60);
    world.divide(id).unwrap();
    let mut daughter = None;
    for _ in 0..1200 {
        run(&mut world, &Inputs::new(), 1);
        world.validate().unwrap();
        let divided = world.events().iter().find_map(|event| match event {
            Event::Divided { daughter, .. } => Some(*daughter),
            _ => None,
        });
        daughter = daughter.or(divided);
    }
    let daughter = daughter.expect("it divides");
    let mut inputs = toward(id, Vec2::new(-1e4, 45.0));
    inputs.set(daughter, Intent::toward(Vec2::new(1e4, 45.0)).unwrap());
    let mut protruded = [false; 2];
    for _ in 0..180 {
        run(&mut world, &inputs, 1);
        assert_sound(&world, "daughters");
        for (cell, protruded) in [id, daughter].into_iter().zip(&mut protruded) {
            let protrusion = protrusion(&world, cell);
            assert_eq!(protrusion.len(), common::outline(&world, cell).len());
            *protruded |= protrusion.iter().any(|&it| it > 0.9);
        }
    }
    world.validate().unwrap();
    assert_eq!(protruded, [true; 2]);
}

#[test]
fn growth_and_fusion_carry_the_activity_of_the_nodes_over() {
    let (mut world, id) = room_with(cell(Crawl::Neutrophil), 60.0, 45.0);
    let other = world.spawn(&cell(Crawl::Keratocyte).into(), Placement::at(76.0, 45.0)).unwrap();
    let mut inputs = toward(id, Vec2::new(1e4, 45.0));
    inputs.set(other, Intent::toward(Vec2::new(-1e4, 45.0)).unwrap());
    run(&mut world, &inputs, 60);
    let before = protrusion(&world, id);
    world.grow(id, 1, 0).unwrap();
    let after = protrusion(&world, id);
    let k = (0..before.len()).find(|&k| before[k] != after[k]).unwrap_or(before.len());
    assert_eq!((after.len(), &after[k + 1..]), (before.len() + 1, &before[k..]), "a node more, the others as before");
    let mut fused = false;
    for _ in 0..120 {
        if !fused {
            world.fuse(id, other).unwrap();
        }
        run(&mut world, &inputs, 1);
        fused |= happens(&world, |event| matches!(event, Event::Fused { .. }));
        world.validate().unwrap();
    }
    assert!(fused && world.view().organisms().count() == 1);
}

#[test]
fn a_clone_of_crawling_cells_has_the_same_future() {
    let scenario = Scenario::parse(builtin("crawl").unwrap().text, &[]).unwrap();
    let mut world = scenario.build().unwrap().world;
    (0..90).for_each(|_| world.step(&Inputs::new()));
    let mut clone = world.clone();
    for step in 0..90 {
        world.step(&Inputs::new());
        clone.step(&Inputs::new());
        assert_eq!(world.digest(), clone.digest(), "step {step}");
    }
}
