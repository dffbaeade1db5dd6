//! Fusion of amoeboid cells, and division and fusion in turn (conformance T84), in whole worlds.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::chase::{agar_of, by, chase, ingests};
use common::lobes::{CENTRE, cell_in_room, count, divide, fuse, run_checked};
use common::{outline, run, toward};
use microsim_core::geometry::polygon::contains_point;
use microsim_core::geometry::ring::unit_vector;
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Event, IngestionWay, Inputs, OrganismId, Placement, PlateletSpec, Refusal, Rng, Role,
    World, WorldConfig,
};

/// Steps, s, and their numbers of substeps.
const STEPPINGS: [(f32, u32); 5] =
    [(1.0 / 30.0, 8), (1.0 / 60.0, 4), (1.0 / 60.0, 8), (1.0 / 60.0, 16), (1.0 / 120.0, 8)];

/// A cell of random size among platelets, on its way to somewhere.
fn cell_among_platelets(seed: u64) -> (World, OrganismId) {
    let mut rng = Rng::new(seed, 77);
    let radii = Vec2::new(rng.range(8.0, 15.0), rng.range(8.0, 13.0));
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec { radii, ..AmoeboidCellSpec::default() });
    for _ in 0..40 {
        // Where there is no room there is no platelet.
        let _ =
            world.spawn(&PlateletSpec::default().into(), Placement::at(rng.range(40.0, 120.0), rng.range(5.0, 85.0)));
    }
    let goal = CENTRE + unit_vector(rng.range(0.0, std::f32::consts::TAU)) * 60.0;
    run(&mut world, &toward(cell, goal), seed as u32 % 40);
    (world, cell)
}

/// Each half encloses its cytoplasm, with as many nodes as it needs of those of the whole.
fn check_halves(world: &World, halves: [OrganismId; 2], [nodes, fluid]: [usize; 2], what: &str) {
    for id in halves {
        let ring = outline(world, id);
        let held = world.view().organism(id).unwrap();
        assert!(held.particles().filter(|p| p.role == Role::Cytoplasm).all(|p| contains_point(&ring, p.position)));
        // Two circles of half the area: each has about 0.71 times the nodes of the whole.
        let share = (count(world, id, Role::Cytoplasm) as f32 / fluid as f32).sqrt();
        assert!((ring.len() as f32 - share * nodes as f32).abs() <= 1.0, "{what}: {} of {nodes}", ring.len());
    }
}

fn divide_and_fuse(seed: u64) {
    let what = format!("seed {seed}");
    let (mut world, cell) = cell_among_platelets(seed);
    let (nodes, fluid) = (count(&world, cell, Role::Membrane), count(&world, cell, Role::Cytoplasm));
    let others = world.census().particles - nodes - fluid;

    let halves = [cell, divide(&mut world, cell, &what)];
    let fluids = halves.map(|id| count(&world, id, Role::Cytoplasm));
    assert_eq!(fluids.iter().sum::<usize>(), fluid, "{what}");
    assert!(*fluids.iter().min().unwrap() * 3 > fluid, "{what}: {fluids:?} is not about even");
    run_checked(&mut world, &Inputs::new(), 120, &format!("{what}, divided"));
    check_halves(&world, halves, [nodes, fluid], &what);

    let left = fuse(&mut world, halves[0], halves[1], &what);
    run_checked(&mut world, &Inputs::new(), 300, &format!("{what}, fused"));
    assert_eq!((count(&world, left, Role::Membrane), count(&world, left, Role::Cytoplasm)), (nodes, fluid), "{what}");
    assert_eq!(world.census().particles, others + nodes + fluid, "{what}: nothing left over");
}

#[test]
fn t84_division_and_fusion_conserve_what_there_is() {
    (0..6).for_each(divide_and_fuse);
}

#[test]
#[ignore = "a soak: minutes in release"]
fn t84_division_and_fusion_of_100_seeds() {
    (0..100).for_each(divide_and_fuse);
}

#[test]
fn dividing_before_a_fusion_has_rounded_off_leaves_no_nodes_behind() {
    let (mut world, mut cell) = cell_in_room(AmoeboidCellSpec::default());
    let nodes = outline(&world, cell).len();
    for turn in 0..3 {
        let daughter = divide(&mut world, cell, &format!("turn {turn}"));
        cell = fuse(&mut world, cell, daughter, &format!("turn {turn}"));
        assert!(outline(&world, cell).len() > nodes + 5, "the next turn begins while the membrane is too long");
    }
    run(&mut world, &Inputs::new(), 600);
    assert_eq!(outline(&world, cell).len(), nodes);
}

/// Divides a cell of this radius, fuses the halves, and tells the whole to divide at once.
fn divide_right_after_a_fusion(radius: f32, dt: f32, substeps: u32) {
    let what = format!("radius {radius}, {substeps} substeps of {dt} s");
    let mut world = World::new(WorldConfig { dt, substeps, ..WorldConfig::default() }).unwrap();
    let spec = AmoeboidCellSpec { radii: Vec2::splat(radius), ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(CENTRE.x, CENTRE.y)).unwrap();
    run(&mut world, &Inputs::new(), 30);
    let daughter = divide(&mut world, cell, &what);
    let whole = fuse(&mut world, cell, daughter, &what);
    divide(&mut world, whole, &what);
}

#[test]
fn the_first_order_right_after_a_fusion_is_carried_out() {
    for (k, (dt, substeps)) in STEPPINGS.into_iter().enumerate() {
        (0..3).for_each(|j| divide_right_after_a_fusion(8.0 + 0.375 * (8 * j + k) as f32, dt, substeps));
    }
}

#[test]
#[ignore = "a soak: 120 cells"]
fn the_first_order_right_after_a_fusion_is_carried_out_for_24_radii() {
    for (dt, substeps) in STEPPINGS {
        (0..24).for_each(|k| divide_right_after_a_fusion(8.0 + 0.375 * k as f32, dt, substeps));
    }
}

#[test]
fn prey_that_another_cell_let_through_stays_inside_when_the_two_fuse() {
    let small =
        AmoeboidCellSpec { radii: Vec2::splat(9.0), phagocytosis: by(IngestionWay::Gate), ..Default::default() };
    let (mut world, small) = cell_in_room(small);
    let prey = world.spawn(&agar_of(1.5), Placement::at(CENTRE.x + 13.0, CENTRE.y)).unwrap();
    chase(&mut world, small, prey, 300, ingests).unwrap();
    let at = world.centroid(small).unwrap() - Vec2::new(26.0, 0.0);
    let large = AmoeboidCellSpec { radii: Vec2::splat(13.0), ..Default::default() };
    let large = world.spawn(&large.into(), Placement::at(at.x, at.y)).unwrap();
    world.set_exempt(large, prey, true).unwrap();
    assert_eq!(fuse(&mut world, small, large, "with prey"), large);
    run_checked(&mut world, &toward(large, Vec2::new(20.0, 20.0)), 300, "fused");
    assert_eq!(world.view().organism(prey).unwrap().held_by(), Some(large));
    assert!(contains_point(&outline(&world, large), world.centroid(prey).unwrap()));
}

#[test]
fn who_cannot_fuse_says_why() {
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
    let far = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(120.0, 45.0)).unwrap();
    let other = AmoeboidCellSpec { node_radius: 0.6, ..AmoeboidCellSpec::default() };
    let other = world.spawn(&other.into(), Placement::at(30.0, 45.0)).unwrap();
    let agar = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
    let reason = |world: &mut World, with| {
        world.fuse(cell, with).unwrap();
        run(world, &Inputs::new(), 1);
        world.events().iter().find_map(|event| match event {
            Event::FusionRefused { organism, with: w, reason } if (*organism, *w) == (cell, with) => Some(*reason),
            _ => None,
        })
    };
    assert_eq!(reason(&mut world, far), Some(Refusal::NotTouching));
    for with in [other, agar, cell] {
        assert_eq!(reason(&mut world, with), Some(Refusal::NoPartner));
    }
    world.divide(far).unwrap();
    run(&mut world, &Inputs::new(), 1);
    assert_eq!(reason(&mut world, far), Some(Refusal::Dividing));
}
