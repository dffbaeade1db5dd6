//! Replays of short runs, and what becomes of damaged ones.

use super::meddle::meddle;
use super::*;
use crate::Rng;
use crate::actuation::Actuation;
use crate::capability::division::Order;
use crate::id::OrganismId;
use crate::inputs::{Inputs, Intent};
use crate::scenario::{Built, Scenario, builtin};
use crate::{AmoeboidCellSpec, Obstacle, Placement};
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;
use proptest::prelude::*;

const ROOM: &str = "
    schema = 1
    [world]
    size = [40.0, 30.0]
    [rigid_cell.swimmer]
    radii = [4.0, 2.5]
    [agar.pellet]
    radius = 1.0
    [wander.idle]
    interval = [0.1, 0.3]
    [[spawn]]
    of = \"swimmer\"
    at = [10.0, 15.0]
    name = \"one\"
    player = true
    [[spawn]]
    of = \"swimmer\"
    at = [30.0, 15.0]
    name = \"two\"
    controller = \"idle\"
    [[spawn]]
    of = \"pellet\"
    at = [36.0, 4.0]
    from = 0.6
    [[command]]
    of = \"two\"
    at = 0.3
    goal = [5.0, 5.0]
";

fn room() -> (Origin, Built) {
    let scenario = Scenario::parse(ROOM, &[("world.damping".to_owned(), "0.25".to_owned())]).unwrap();
    (scenario.origin(), scenario.build().unwrap())
}

fn every(steps: u32) -> NonZeroU32 {
    NonZeroU32::new(steps).unwrap()
}

/// Inputs that change now and then; now and then there are none.
fn wayward(rng: &mut Rng, told: &mut Inputs, organisms: &[OrganismId]) {
    for &organism in organisms {
        let goal = Vec2::new(rng.range(-50.0, 90.0), rng.range(-50.0, 90.0));
        match rng.next_u32() % 12 {
            0 => told.remove(organism),
            1 => told.set(organism, Intent::REST.digesting(rng.unit() < 0.5)),
            2..=4 => told.set(organism, Intent::toward(goal).unwrap().digesting(rng.unit() < 0.5)),
            5 => told.actuate(organism, Actuation { torque: goal.y, ..Actuation::force(goal) }).unwrap(),
            6 => told.actuate(organism, Actuation::default()).unwrap(),
            7 => told.actuate_node(organism, rng.next_u32() % 9, Actuation::impulse(0.1 * goal)).unwrap(),
            8 => told.activate(organism, rng.next_u32() % 2, rng.unit()).unwrap(),
            _ => {}
        }
    }
}

/// A run of so many steps: its replay and its last digest.
fn record(steps: u32, interval: u32) -> (Vec<u8>, u64) {
    let (origin, mut run) = room();
    let organisms: Vec<_> = run.world.organisms().collect();
    let (mut recorder, mut file) = Recorder::new(origin, every(interval));
    let (mut rng, mut told) = (Rng::new(3, 4), Inputs::new());
    for _ in 0..steps {
        wayward(&mut rng, &mut told, &organisms);
        run.step(&told);
        file.extend(recorder.step(&told, &run.world));
    }
    file.extend(recorder.finish(&run.world));
    (file, run.world.digest())
}

/// Where the chunks of a file end.
fn ends_of_chunks(file: &[u8]) -> Vec<usize> {
    let mut chunks = ChunkReader::open(file).unwrap();
    std::iter::from_fn(|| chunks.next().map(|chunk| chunk.map(|_| chunks.place() as usize).unwrap())).collect()
}

#[test]
fn a_run_is_played_to_the_bit() {
    for (steps, interval) in [(0, 60), (1, 60), (150, 1), (150, 7), (150, 1000)] {
        let (file, digest) = record(steps, interval);
        let replay = Replay::read(&file).unwrap();
        assert_eq!((replay.steps(), replay.ending()), (u64::from(steps), Ending::Complete), "{steps} {interval}");
        assert_eq!((replay.interval(), replay.origin()), (every(interval), &room().0));
        let mut player = Player::new(&replay).unwrap();
        assert_eq!(player.by_ref().filter(|step| step.is_ok()).count(), steps as usize);
        assert_eq!(player.world().digest(), digest);
    }
}

#[test]
fn what_was_told_is_played_as_it_was_told() {
    let (origin, mut run) = room();
    let organisms: Vec<_> = run.world.organisms().collect();
    let (mut recorder, mut file) = Recorder::new(origin, every(50));
    let (mut rng, mut told, mut all) = (Rng::new(5, 6), Inputs::new(), Vec::new());
    for _ in 0..100 {
        wayward(&mut rng, &mut told, &organisms);
        run.step(&told);
        file.extend(recorder.step(&told, &run.world));
        all.push(told.clone());
    }
    let replay = Replay::read(&file).unwrap();
    let mut player = Player::new(&replay).unwrap();
    for told in all {
        player.next().unwrap().unwrap();
        assert_eq!(player.told(), &told);
    }
}

#[test]
fn what_is_done_to_the_world_is_played() {
    for interval in [1, 7, 1000] {
        let (origin, mut run) = room();
        let (mut recorder, mut file) = Recorder::new(origin, every(interval));
        let (mut told, mut digests) = (Inputs::new(), Vec::new());
        for step in 0..90 {
            meddle(step, &mut run.world).unwrap();
            told.set(run.player.unwrap(), Intent::toward(Vec2::new(step as f32, 10.0)).unwrap());
            run.step(&told);
            file.extend(recorder.step(&told, &run.world));
            digests.push(run.world.digest());
        }
        // Too late for a step: not part of the record.
        run.world.set_gravity(Vec2::X).unwrap();
        file.extend(recorder.finish(&run.world));
        let replay = Replay::read(&file).unwrap();
        assert_eq!(replay.ending(), Ending::Complete);
        let mut player = Player::new(&replay).unwrap();
        for digest in digests {
            player.next().unwrap().unwrap();
            assert_eq!(player.world().digest(), digest);
        }
        assert!(player.next().is_none());
    }
}

#[test]
fn a_change_that_no_function_makes_is_refused() {
    let (_, mut run) = room();
    let cell = AmoeboidCellSpec { radii: Vec2::splat(4.0), ..AmoeboidCellSpec::default() };
    let cell = run.world.spawn(&cell.into(), Placement::at(20.0, 6.0)).unwrap();
    let before = run.world.digest();
    let divide = |axis| WorldChange::Order(cell, Order::Divide { axis: Some(axis) });
    let changes =
        [divide(Vec2::NAN), divide(Vec2::ZERO), WorldChange::Push(cell, Vec2::NAN), WorldChange::Unrecordable];
    assert!(changes.iter().all(|change| change.apply(&mut run.world).is_none()));
    assert_eq!(run.world.digest(), before);
    assert!(divide(Vec2::Y).apply(&mut run.world).is_some());
}

#[test]
fn a_change_without_a_record_ends_the_replay_before_it() {
    let (origin, mut run) = room();
    let (mut recorder, mut file) = Recorder::new(origin, every(60));
    let told = Inputs::new();
    for step in 0..30 {
        if step == 20 {
            let ramp = SharedShape::heightfield(vec![0.0, 1.0, 0.0], Vec2::new(10.0, 1.0));
            run.world.add_obstacle(Obstacle::new(ramp, Pose::translation(20.0, 1.0))).unwrap();
        }
        run.step(&told);
        file.extend(recorder.step(&told, &run.world));
    }
    file.extend(recorder.finish(&run.world));
    let replay = Replay::read(&file).unwrap();
    assert_eq!((replay.ending(), replay.steps()), (Ending::Unrecordable, 20));
    assert!(Player::new(&replay).unwrap().all(|step| step.is_ok()));
}

/// Bytes of 90 s of the game, of which a player says the next goal.
fn bytes_of_play(mut goal: impl FnMut(u32, &mut Rng) -> Option<Vec2>) -> usize {
    let (_, mut run) = room();
    let player = run.player.unwrap();
    let game = Scenario::parse(builtin("game").unwrap().text, &[]).unwrap();
    let (mut recorder, mut file) = Recorder::new(game.origin(), every(60));
    let (mut rng, mut told) = (Rng::new(1, 1), Inputs::new());
    for step in 0..5400 {
        let intent = goal(step, &mut rng).map_or(Intent::REST, |goal| Intent::toward(goal).unwrap());
        told.set(player, intent.digesting(step % 300 < 100));
        run.step(&told);
        file.extend(recorder.step(&told, &run.world));
    }
    file.extend(recorder.finish(&run.world));
    assert_eq!(Replay::read(&file).unwrap().steps(), 5400);
    file.len()
}

/// A hand that draws circles and now and then rests; it moves every so many steps.
fn hand(every: u32) -> impl FnMut(u32, &mut Rng) -> Option<Vec2> {
    let mut goal = Vec2::ZERO;
    move |step, rng| {
        if step.is_multiple_of(every) {
            let angle = step as f32 * 0.01;
            let tremor = Vec2::new(rng.range(-0.5, 0.5), rng.range(-0.5, 0.5));
            goal = Vec2::new(80.0, 45.0) + Vec2::new(angle.cos(), angle.sin()) * 30.0 + tremor;
        }
        (step % 600 >= 60).then_some(goal)
    }
}

#[test]
fn ninety_seconds_of_play_are_small() {
    let bytes = [6, 2, 1].map(|every| bytes_of_play(hand(every)));
    assert!(bytes[0] < 17_500 && bytes[1] < 29_000 && bytes[2] < 42_000, "{bytes:?}");
    // Nothing is known of the next goal: a new place anywhere in every step.
    let bytes = bytes_of_play(|_, rng| Some(Vec2::new(rng.range(0.0, 160.0), rng.range(0.0, 90.0))));
    assert!(bytes < 57_000, "{bytes}");
}

#[test]
fn a_file_that_is_cut_off_plays_up_to_its_last_whole_chunk() {
    let (file, _) = record(90, 20);
    let ends = ends_of_chunks(&file);
    for length in 0..file.len() {
        let whole = ends.iter().filter(|&&end| end <= length).count();
        match Replay::read(&file[..length]) {
            Ok(replay) => {
                assert_eq!(replay.records.len() + 1, whole, "{length}");
                assert_eq!(replay.ending(), Ending::CutOff, "{length}");
            }
            Err(error) => assert_eq!((error, whole), (ReplayError::NoHeader, 0), "{length}"),
        }
    }
    let cut = Replay::read(&file[..file.len() - 20]).unwrap();
    assert!(Player::new(&cut).unwrap().all(|step| step.is_ok()));
}

#[test]
fn a_flipped_bit_is_seen() {
    let (file, _) = record(60, 20);
    let begins = ends_of_chunks(&file)[0];
    for at in 0..file.len() {
        let mut damaged = file.clone();
        damaged[at] ^= 1 << (at % 8);
        match Replay::read(&damaged) {
            Err(error) => assert!(at < begins, "byte {at}: {error}"),
            Ok(replay) => assert_ne!(replay.ending(), Ending::Complete, "byte {at}"),
        }
    }
    let longer = [&file[..], b"x"].concat();
    assert!(matches!(Replay::read(&longer).unwrap().ending(), Ending::Damaged { .. }));
    assert_eq!(Replay::read(b"GIF89a"), Err(ReplayError::Foreign));
    let mut newer = file;
    newer[8] += 1;
    assert_eq!(Replay::read(&newer), Err(ReplayError::Version { found: VERSION + 1, accepted: VERSION }));
}

#[test]
fn another_world_is_noticed_at_the_next_digest() {
    let (file, _) = record(60, 20);
    let mut replay = Replay::read(&file).unwrap();
    replay.header.origin.seed += 1;
    let mismatch = Player::new(&replay).unwrap().find_map(Result::err).unwrap();
    assert_eq!(mismatch.step, 20);
}

proptest! {
    #[test]
    fn chunks_with_any_content_never_panic(chunks in prop::collection::vec((0u8..6, prop::collection::vec(any::<u8>(), 0..40)), 0..6)) {
        let (mut writer, mut file) = chunk::ChunkWriter::new();
        let header = Header { made_by: String::new(), interval: NonZeroU32::MIN, origin: room().0 };
        file.extend(writer.write(HEADER, &postcard::to_stdvec(&header).unwrap()));
        for (kind, content) in &chunks {
            file.extend(writer.write(*kind, content));
        }
        let replay = Replay::read(&file).unwrap();
        let _ = Player::new(&replay).unwrap().take(20).count();
    }
}
