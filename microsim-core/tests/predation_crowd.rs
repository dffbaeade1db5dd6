//! Crowds of amoeboid cells of which some take in the others, with all that may come in between: nothing leaks.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::chase::{by, cell_of};
use common::step_soundly;
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Controller, Event, FleeParams, IngestionWay, Inputs, Intent, Kind, Obstacle,
    OrganismId, PhagocytosisParams, Placement, Rng, World, WorldConfig, parry2d::math::Pose,
    parry2d::shape::SharedShape,
};
use std::ops::Range;

/// A room with a wall that has a gap, two engulfers of random properties and up to six smaller cells that wander or flee, among agar.
fn crowd(seed: u64, rng: &mut Rng) -> World {
    let substeps = if rng.range(0.0, 1.0) < 0.5 { 8 } else { 4 };
    let size = Vec2::new(110.0, 80.0);
    let mut world = World::new(WorldConfig { size, substeps, seed, ..WorldConfig::default() }).unwrap();
    for y in [17.0, 63.0].into_iter().filter(|_| seed.is_multiple_of(2)) {
        let wall = Obstacle::new(SharedShape::cuboid(2.0, 17.0), Pose::translation(55.0, y));
        world.add_obstacle(wall).unwrap();
    }
    for k in 0..8 {
        let (radius, way) = match k {
            0 | 1 => (rng.range(9.0, 14.0), IngestionWay::WideGate),
            _ => (rng.range(3.2, 8.0), IngestionWay::Cup),
        };
        let phagocytosis = PhagocytosisParams {
            size_ratio: rng.range(1.0, 2.0),
            time_limit: if rng.range(0.0, 1.0) < 0.7 { 3.0 } else { 0.5 },
            pull_speed: rng.range(3.0, 12.0),
            digestion_time: [0.6, 0.6, rng.range(0.2, 3.0)],
            ..by(way)
        };
        let spec = AmoeboidCellSpec {
            node_radius: if rng.range(0.0, 1.0) < 0.5 { 0.5 } else { 0.78 },
            speed: rng.range(4.0, 12.0),
            ..cell_of(radius, phagocytosis)
        };
        let flees = rng.range(0.0, 1.0) < 0.5;
        let otherwise = Controller::wander([1.0, 3.0], 0.2);
        let steering = if flees { Controller::flee(FleeParams::default(), otherwise) } else { otherwise };
        for _ in 0..40 {
            let (x, y) = (rng.range(radius, size.x - radius), rng.range(radius, size.y - radius));
            if world.spawn(&spec.clone().into(), Placement::at(x, y).steered_by(steering.clone())).is_ok() {
                break;
            }
        }
    }
    for _ in 0..6 {
        let agar = AgarSpec { radius: rng.range(0.8, 2.0), ..AgarSpec::default() };
        let _ = world.spawn(&agar.into(), Placement::at(rng.range(5.0, 105.0), rng.range(5.0, 75.0)));
    }
    world
}

/// Each engulfer with a wide gate heads for the nearest cell that is no such engulfer.
fn hunting(world: &World, digests: bool) -> Inputs {
    let (view, mut inputs) = (world.view(), Inputs::new());
    let is_hunter = |id: OrganismId| {
        let params = view.organism(id).and_then(|organism| organism.phagocytosis());
        params.is_some_and(|params| params.way == IngestionWay::WideGate)
    };
    let cells = || view.organisms().filter(|organism| organism.kind() == Kind::AmoeboidCell);
    for hunter in cells().filter(|cell| is_hunter(cell.id())) {
        let prey = cells().filter(|cell| !is_hunter(cell.id()) && cell.held_by().is_none());
        let distance = |at: &Vec2| (*at - hunter.centroid()).length();
        let nearest = prey.map(|cell| cell.centroid()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let goal = nearest.unwrap_or(Vec2::new(20.0, 20.0));
        inputs.set(hunter.id(), Intent::toward(goal).unwrap().digesting(digests));
    }
    inputs
}

/// Tells some cell to do what may come in between.
fn disturb(world: &mut World, rng: &mut Rng) {
    let cells: Vec<OrganismId> = world.organisms().filter(|&id| world.kind(id) == Some(Kind::AmoeboidCell)).collect();
    let mut pick = || cells[rng.range(0.0, cells.len() as f32 - 0.01) as usize];
    let (one, other) = (pick(), pick());
    // What cannot be is refused, and changes nothing.
    match rng.range(0.0, 10.0) as u32 {
        0..4 => world.divide(one).unwrap(),
        4..6 => world.fuse(one, other).unwrap(),
        6..8 => drop(world.grow(one, 2, 10)),
        8 => drop(world.shrink(one, 10)),
        _ => world.remove(one).unwrap(),
    }
}

/// Cells that were taken in, eaten and let go in 20 s of a crowd, in which nothing may leak.
fn soak(seed: u64) -> [u32; 3] {
    let mut rng = Rng::new(seed, 7);
    let mut world = crowd(seed, &mut rng);
    let (mut digests, mut counts) = (false, [0; 3]);
    for step in 0..1200 {
        if step % 60 == 0 {
            digests = rng.range(0.0, 1.0) < 0.35;
        }
        if step % 150 == 149 {
            disturb(&mut world, &mut rng);
        }
        let inputs = hunting(&world, digests);
        step_soundly(&mut world, &inputs, &format!("seed {seed}, step {step}"));
        for event in world.events() {
            let is_cell = |prey: &OrganismId| world.kind(*prey) == Some(Kind::AmoeboidCell);
            counts[0] += u32::from(matches!(event, Event::Ingested { prey, .. } if is_cell(prey)));
            counts[1] += u32::from(matches!(event, Event::Consumed { kind: Kind::AmoeboidCell, .. }));
            counts[2] += u32::from(matches!(event, Event::Released { prey, .. } if is_cell(prey)));
        }
    }
    counts
}

#[test]
fn nothing_leaks_in_twenty_seeds_of_crowds() {
    let soak_all =
        |seeds: Range<u64>| seeds.map(soak).fold([0; 3], |sum, more| std::array::from_fn(|k| sum[k] + more[k]));
    let [taken_in, eaten, let_go] = std::thread::scope(|scope| {
        let others = scope.spawn(|| soak_all(10..20));
        let (some, others) = (soak_all(0..10), others.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        std::array::from_fn(|k| some[k] + others[k])
    });
    assert!(taken_in >= 30 && eaten >= 20 && let_go >= 5, "{taken_in} taken in, {eaten} eaten, {let_go} let go");
}

#[cfg(feature = "parallel")]
#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let digest = || {
        let mut rng = Rng::new(7, 7);
        let mut world = crowd(7, &mut rng);
        let mut began = false;
        for _ in 0..300 {
            let inputs = hunting(&world, true);
            world.step(&inputs);
            began |= common::chase::begins(&world);
        }
        assert!(began);
        world.digest()
    };
    let within = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(digest);
    assert_eq!([1, 2, 8].map(within), [digest(); 3]);
}
