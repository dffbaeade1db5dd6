//! Rollback: save, go on, restore, go on again with the same inputs, compare. What multiplayer with prediction needs: after
//! each step eight are taken back and repeated, as the sync test of rollback libraries does.
//!
//! Three thousand steps: `cargo test --release -p microsim-core --features scenario,snapshot --test rollback -- --ignored`.
#![cfg(all(feature = "scenario", feature = "snapshot"))]

use microsim_core::glam::Vec2;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Inputs, Intent, Kind, OrganismId, Rng, World};
use std::collections::VecDeque;

/// Steps that are taken back and repeated after each step.
const DISTANCE: usize = 8;
const PLAYERS: usize = 2;

/// What a player tells a cell in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Told {
    goal: Option<[f32; 2]>,
    digests: bool,
}

/// The world before a step, what is told in it, and the digest after it.
#[derive(Debug)]
struct Saved {
    snapshot: Vec<u8>,
    told: [Told; PLAYERS],
    digest: u64,
}

/// Something else now and then.
fn decide(told: Told, rng: &mut Rng, size: Vec2) -> Told {
    match rng.next_u32() % 20 {
        0 => Told { goal: None, ..told },
        1..=3 => Told { goal: Some([rng.range(0.0, size.x), rng.range(0.0, size.y)]), ..told },
        4 => Told { digests: !told.digests, ..told },
        _ => told,
    }
}

fn inputs(cells: &[OrganismId], told: &[Told]) -> Inputs {
    let mut inputs = Inputs::new();
    for (&cell, told) in cells.iter().zip(told) {
        let way = told.goal.map_or(Intent::REST, |goal| Intent::toward(Vec2::from(goal)).unwrap());
        inputs.set(cell, way.digesting(told.digests));
    }
    inputs
}

/// Runs `demo`. Fails at the first step whose repetition has another digest.
fn synchronise(steps: u32, seed: u64) -> Result<World, String> {
    synchronise_through(steps, seed, |_| {})
}

/// The same with something done to every world that is restored.
fn synchronise_through(steps: u32, seed: u64, alter: fn(&mut World)) -> Result<World, String> {
    let mut world = Scenario::parse(builtin("demo").unwrap().text, &[]).unwrap().build().unwrap().world;
    let is_player = |id: &OrganismId| matches!(world.kind(*id), Some(Kind::AmoeboidCell | Kind::RigidCell));
    let cells: Vec<OrganismId> = world.organisms().filter(is_player).take(PLAYERS).collect();
    let (mut rng, mut told) = (Rng::new(seed, 0), [Told::default(); PLAYERS]);
    let mut saved = VecDeque::new();
    for _ in 0..steps {
        told = told.map(|told| decide(told, &mut rng, world.config().size));
        let snapshot = world.to_snapshot().unwrap();
        world.step(&inputs(&cells, &told));
        saved.push_back(Saved { snapshot, told, digest: world.digest() });
        if saved.len() > DISTANCE {
            saved.pop_front();
        }
        world = World::from_snapshot(&saved[0].snapshot).unwrap();
        alter(&mut world);
        for Saved { snapshot, told, digest } in &mut saved {
            // What is repeated is what the next repetition starts from.
            *snapshot = world.to_snapshot().unwrap();
            world.step(&inputs(&cells, told));
            if world.digest() != *digest {
                return Err(format!("step {} is another when it is repeated", world.step_index()));
            }
        }
    }
    Ok(world)
}

/// A world that goes on otherwise after it was taken back is noticed: else the other tests could not fail.
#[test]
fn what_is_not_taken_back_is_noticed() {
    let push = |world: &mut World| {
        let first = world.organisms().next().unwrap();
        world.push(first, Vec2::X).unwrap();
    };
    assert_eq!(synchronise_through(60, 1, push).unwrap_err(), "step 1 is another when it is repeated");
}

#[test]
fn sixty_steps_of_the_demonstration_can_be_taken_back() {
    assert_eq!(synchronise(60, 1).unwrap().step_index(), 60);
}

#[test]
#[ignore = "takes minutes; run it in release"]
fn three_thousand_steps_of_the_demonstration_can_be_taken_back() {
    assert_eq!(synchronise(3000, 2).unwrap().step_index(), 3000);
}
