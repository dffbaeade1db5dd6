//! Rollback: save, go on, restore, go on again with the same inputs, compare. What multiplayer with prediction needs.
//!
//! Three thousand steps: `cargo test --release -p microsim-core --features scenario,snapshot --test rollback -- --ignored`.
#![cfg(all(feature = "scenario", feature = "snapshot"))]

use ggrs::{Config, GgrsRequest, PredictRepeatLast, SessionBuilder};
use microsim_core::glam::Vec2;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Inputs, Intent, Kind, OrganismId, Rng, World};
use serde::{Deserialize, Serialize};
use std::panic::catch_unwind;

/// Steps that are taken back and repeated after each step.
const DISTANCE: usize = 8;
const PLAYERS: usize = 2;

/// What a player tells a cell in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Told {
    goal: Option<[f32; 2]>,
    digests: bool,
}

#[derive(Debug)]
struct Game;

impl Config for Game {
    type InputPredictor = PredictRepeatLast;
    type Input = Told;
    /// A snapshot.
    type State = Vec<u8>;
    type Address = u8;
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

/// Does what the session asks for: saves the world, restores it, or takes a step.
fn fulfil(request: GgrsRequest<Game>, world: &mut World, cells: &[OrganismId], alter: fn(&mut World)) {
    match request {
        GgrsRequest::SaveGameState { cell, frame } => {
            cell.save(frame, Some(world.to_snapshot().unwrap()), Some(world.digest().into()));
        }
        GgrsRequest::LoadGameState { cell, .. } => {
            *world = World::from_snapshot(&cell.load().unwrap()).unwrap();
            alter(world);
        }
        GgrsRequest::AdvanceFrame { inputs: given } => {
            let given: Vec<Told> = given.into_iter().map(|(told, _)| told).collect();
            world.step(&inputs(cells, &given));
        }
    }
}

/// Runs `demo`; the session compares the digest of every step with those of its repetitions.
fn synchronise(steps: u32, seed: u64) -> World {
    synchronise_through(steps, seed, |_| {})
}

/// The same with something done to every world that is restored.
fn synchronise_through(steps: u32, seed: u64, alter: fn(&mut World)) -> World {
    let mut world = Scenario::parse(builtin("demo").unwrap().text, &[]).unwrap().build().unwrap().world;
    let is_player = |id: &OrganismId| matches!(world.kind(*id), Some(Kind::AmoeboidCell | Kind::RigidCell));
    let cells: Vec<OrganismId> = world.organisms().filter(is_player).take(PLAYERS).collect();
    let builder = SessionBuilder::<Game>::new().with_num_players(PLAYERS).unwrap().with_input_delay(0);
    let builder = builder.with_max_prediction_window(DISTANCE + 1).with_check_distance(DISTANCE);
    let mut session = builder.start_synctest_session().unwrap();
    let (mut rng, mut told) = (Rng::new(seed, 0), [Told::default(); PLAYERS]);
    for step in 0..steps {
        for (player, told) in told.iter_mut().enumerate() {
            *told = decide(*told, &mut rng, world.config().size);
            session.add_local_input(player, *told).unwrap();
        }
        let requests = session.advance_frame().unwrap_or_else(|mismatch| panic!("step {step}: {mismatch}"));
        requests.into_iter().for_each(|request| fulfil(request, &mut world, &cells, alter));
    }
    world
}

/// A world that goes on otherwise after it was taken back is noticed: else the other tests could not fail.
#[test]
fn what_is_not_taken_back_is_noticed() {
    let push = |world: &mut World| {
        let first = world.organisms().next().unwrap();
        world.push(first, Vec2::X).unwrap();
    };
    let altered = catch_unwind(|| synchronise_through(60, 1, push)).map(|world| world.step_index()).unwrap_err();
    let said = altered.downcast_ref::<String>().map(String::as_str).unwrap_or_default();
    assert!(said.contains("step"), "{said}");
}

#[test]
fn sixty_steps_of_the_demonstration_can_be_taken_back() {
    assert_eq!(synchronise(60, 1).step_index(), 60);
}

#[test]
#[ignore = "takes minutes; run it in release"]
fn three_thousand_steps_of_the_demonstration_can_be_taken_back() {
    assert_eq!(synchronise(3000, 2).step_index(), 3000);
}
