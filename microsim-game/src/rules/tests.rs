//! The rules over whole rounds.

use super::bot::{Bot, Policy};
use super::hint::{Hints, MealState, Readiness};
use super::round::Round;
use crate::sound::Cue;
use microsim_core::glam::Vec2;
use microsim_core::replay::Replay;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Event, Inputs, Intent, Kind, OrganismView, Role};
use std::path::{Path, PathBuf};

fn scenario(seed: u64, time: f32) -> Scenario {
    let text = builtin("game").unwrap().text;
    let mut scenario = Scenario::parse(text, &[("game.time".to_owned(), time.to_string())]).unwrap();
    scenario.set_seed(seed);
    scenario
}

/// Plays a whole round; `seen` is shown every step.
fn play(policy: Policy, seed: u64, time: f32, mut seen: impl FnMut(&Round)) -> Round {
    let mut round = Round::new(&scenario(seed, time)).unwrap();
    let mut bot = Bot::new(policy, seed);
    while !round.referee().is_over() {
        let intent = bot.intent(round.world(), round.player());
        round.step(intent);
        seen(&round);
    }
    round
}

/// A cell between something small and something soft, both within its reach.
fn table(text: &str) -> Round {
    let text = format!(
        "schema = 1\nname = \"table\"\n[world]\nsize = [90.0, 50.0]\n[amoeboid_cell.cell]\nradii = [9.0, 9.0]\n\
         [agar.pellet]\nradius = 1.0\n[rigid_cell.prey]\nradii = [4.0, 3.0]\n[rigid_cell.giant]\nradii = [12.0, 8.0]\n\
         [[spawn]]\nof = \"cell\"\nplayer = true\nat = [30.0, 25.0]\n[game]\ntime = 60.0\n\
         [game.points.agar]\neach = 10\n[game.points.rigid_cell]\neach = 50\nper_area = 1.0\n{text}"
    );
    Round::new(&Scenario::parse(&text, &[]).unwrap()).unwrap()
}

const PELLET: &str = "[[spawn]]\nof = \"pellet\"\nat = [42.0, 25.0]\n";
const PREY: &str = "[[spawn]]\nof = \"prey\"\nat = [46.0, 25.0]\n";

/// Steers the player to the first other organism until something holds, with or without digesting.
fn hunt(round: &mut Round, digests: bool, done: impl Fn(&Round) -> bool) {
    for _ in 0..1200 {
        if done(round) {
            return;
        }
        let prey = round.world().organisms().find(|&id| id != round.player());
        let goal = prey.and_then(|id| round.world().centroid(id)).and_then(|at| Intent::toward(at).ok());
        round.step(goal.unwrap_or(Intent::REST).digesting(digests));
    }
    panic!("the condition never held");
}

fn cell(round: &Round) -> OrganismView<'_> {
    round.world().view().organism(round.player()).unwrap()
}

fn hints(round: &Round) -> Hints {
    Hints::of(round.world().view(), round.player())
}

fn inside(round: &Round) -> usize {
    hints(round).held.iter().filter(|held| matches!(held.state, MealState::Inside(_))).count()
}

#[test]
fn t64_a_round_starts_at_zero_and_ends_with_its_time() {
    assert_eq!(Scenario::parse(builtin("game").unwrap().text, &[]).unwrap().game().unwrap().time, 90.0);
    let mut round = Round::new(&scenario(1, 2.0)).unwrap();
    assert_eq!((round.referee().score(), round.referee().time_left()), (0, 2.0));
    (0..119).for_each(|_| round.step(Intent::REST));
    assert!(!round.referee().is_over() && round.referee().time_left() > 0.0);
    round.step(Intent::REST);
    assert!(round.referee().is_over() && round.referee().time_left() == 0.0);
    round.step(Intent::REST);
    assert_eq!(round.world().step_index(), 120, "nothing happens after the end");
}

#[test]
fn t61_t62_t65_only_what_is_digested_counts() {
    let mut round = table(PELLET);
    hunt(&mut round, false, |round| inside(round) == 1);
    let before = cell(&round).cytoplasm_area();
    (0..120).for_each(|_| round.step(Intent::REST));
    assert_eq!(
        (round.referee().score(), cell(&round).cytoplasm_area()),
        (0, before),
        "taking in alone earns and changes nothing"
    );
    while inside(&round) == 1 {
        round.step(Intent::REST.digesting(true));
    }
    assert_eq!(round.referee().score(), 10);
    (0..30).for_each(|_| round.step(Intent::REST));
    assert!(cell(&round).cytoplasm_area() > before);
}

#[test]
fn t72_what_a_meal_adds_is_told_apart_from_what_was_there() {
    let mut round = table(PELLET);
    let grown =
        |round: &Round| cell(round).particles().filter(|particle| particle.role == Role::GrownCytoplasm).count();
    assert_eq!(grown(&round), 0);
    hunt(&mut round, true, |round| round.referee().score() > 0);
    (0..120).for_each(|_| round.step(Intent::REST));
    assert!(grown(&round) > 0);
}

#[test]
fn t65_t70_rigid_cells_earn_more_and_every_gain_is_shown_once() {
    let mut round = table(PREY);
    hunt(&mut round, true, |round| round.referee().score() > 0);
    let gains = round.referee().gains().to_vec();
    assert_eq!(gains.len(), 1);
    assert_eq!(gains[0].kind, Kind::RigidCell);
    assert_eq!(gains[0].points, (50.0 + std::f32::consts::PI * 12.0_f32).round() as u32);
    let cell = round.world().centroid(round.player()).unwrap();
    assert!((gains[0].at - cell).length() < 9.0, "shown where it was");
    round.step(Intent::REST);
    assert!(round.referee().gains().is_empty());
}

#[test]
fn t67_t69_growth_enables_larger_prey() {
    let mut round = table("[[spawn]]\nof = \"giant\"\nat = [66.0, 25.0]\n");
    let readiness = |round: &Round| hints(round).targets[0].readiness;
    let Readiness::TooLarge(share) = readiness(&round) else { panic!("{:?}", readiness(&round)) };
    assert!(share > 0.1 && share < 1.0);
    let player = round.player();
    let mut world = round.world().clone();
    for _ in 0..8 {
        world.grow(player, 8, 50).unwrap();
        (0..30).for_each(|_| world.step(&Inputs::new()));
    }
    assert_eq!(Hints::of(world.view(), player).targets[0].readiness, Readiness::Ready);
    round.step(Intent::REST);
    assert!(matches!(readiness(&round), Readiness::TooLarge(_)));
}

#[test]
fn t75_one_rigid_cell_inside_leaves_no_room_for_another() {
    let mut round = table(&format!("{PREY}[[spawn]]\nof = \"prey\"\nat = [60.0, 40.0]\n"));
    assert!(hints(&round).targets.iter().all(|target| target.readiness == Readiness::Ready));
    hunt(&mut round, false, |round| inside(round) == 1);
    let left = hints(&round).targets;
    assert_eq!((left.len(), left[0].readiness), (1, Readiness::NoRoom));
    hunt(&mut round, true, |round| round.referee().score() > 0);
    assert_eq!(hints(&round).targets[0].readiness, Readiness::Ready);
}

#[test]
fn t29_t71_hints_follow_a_meal_from_touch_to_digestion() {
    let mut round = table(PELLET);
    let mut seen = [false; 4];
    for _ in 0..1200 {
        let hints = hints(&round);
        match hints.held.first().map(|held| held.state) {
            Some(MealState::Touching(share)) => seen[0] |= share > 0.3 && !hints.can_digest(),
            Some(MealState::Entering) => seen[1] |= !hints.can_digest(),
            Some(MealState::Inside(0.0)) => seen[2] |= hints.can_digest(),
            Some(MealState::Inside(share)) => seen[3] |= share < 1.0 && hints.can_digest(),
            None => {}
        }
        let goal = round.world().organisms().nth(1).and_then(|id| round.world().centroid(id));
        let Some(goal) = goal else { break };
        let digests = seen[2];
        round.step(Intent::toward(goal).unwrap().digesting(digests));
    }
    assert_eq!(seen, [true; 4]);
}

#[test]
fn the_score_is_the_sum_of_its_gains_and_no_more_than_was_eaten() {
    let (mut gained, mut eaten) = (0, 0);
    let round = play(Policy::AgarOnly, 3, 12.0, |round| {
        gained += round.referee().gains().iter().map(|gain| gain.points).sum::<u32>();
        let by_player =
            |event: &&Event| matches!(event, Event::Consumed { engulfer, .. } if *engulfer == round.player());
        eaten += round.world().events().iter().filter(by_player).count() as u32;
    });
    let kinds = round.referee().kinds();
    assert_eq!(gained, round.referee().score());
    assert_eq!(eaten, kinds.iter().map(|(_, entry)| entry.count).sum::<u32>());
    assert!(eaten > 0);
}

#[test]
fn the_same_seed_and_intents_are_the_same_round_to_the_bit() {
    let outcome = |round: &Round| (round.world().digest(), round.referee().score());
    let round = play(Policy::Greedy, 5, 12.0, |_| {});
    assert_eq!(outcome(&play(Policy::Greedy, 5, 12.0, |_| {})), outcome(&round));
    assert_ne!(outcome(&play(Policy::Greedy, 6, 12.0, |_| {})), outcome(&round));
}

#[test]
fn a_round_is_played_again_to_the_bit_from_its_record() {
    let round = play(Policy::Random, 5, 8.0, |_| {});
    let record = round.record().unwrap();
    let mut again = Round::again(&Replay::read(&record).unwrap()).unwrap();
    while !again.is_over() {
        again.step(Intent::REST);
    }
    assert_eq!(again.world().digest(), round.world().digest());
    assert_eq!(again.referee().score(), round.referee().score());
    assert_eq!((again.name(), again.mismatch()), ("game", None));
    assert!(again.is_replay() && again.record().is_none());
}

#[test]
fn a_record_that_was_cut_off_is_played_as_far_as_it_goes() {
    let record = play(Policy::Random, 5, 4.0, |_| {}).record().unwrap();
    let mut again = Round::again(&Replay::read(&record[..record.len() - 40]).unwrap()).unwrap();
    (0..240).for_each(|_| again.step(Intent::REST));
    assert!(again.is_over() && !again.referee().is_over());
}

/// Scores of all policies over seeds, one list each, and the most of what there was, in points, that anybody ate.
fn scores(seeds: std::ops::RangeInclusive<u64>, time: f32) -> ([Vec<u32>; 5], f64) {
    let mut most: f64 = 0.0;
    let mut score = |policy, seed| {
        let round = play(policy, seed, time, |_| {});
        let eaten = round.referee().score();
        most = most.max(f64::from(eaten) / f64::from(eaten + left(&round)));
        eaten
    };
    let all = Policy::ALL.map(|policy| seeds.clone().map(|seed| score(policy, seed)).collect());
    (all, most)
}

/// Seeds for which the second list is greater than the first.
fn wins(worse: &[u32], better: &[u32]) -> usize {
    worse.iter().zip(better).filter(|(worse, better)| better > worse).count()
}

#[test]
fn bots_score_in_the_order_of_their_skill() {
    let score = |policy| play(policy, 1, 30.0, |_| {}).referee().score();
    assert_eq!(play(Policy::Idle, 1, 5.0, |_| {}).referee().score(), 0);
    assert_eq!(play(Policy::NeverConsume, 1, 15.0, |_| {}).referee().score(), 0);
    let [random, agar, greedy] = [Policy::Random, Policy::AgarOnly, Policy::Greedy].map(score);
    assert!(0 < random && random < agar && agar < greedy, "{random} {agar} {greedy}");
}

#[test]
#[ignore = "100 rounds of 90 s"]
fn bots_score_in_the_order_of_their_skill_over_twenty_seeds() {
    let (all, most) = scores(1..=20, 90.0);
    println!("{all:?}, at most {most:.2} of what there was");
    assert!(most < 0.9, "{most} of the map's maximum");
    let [idle, never, random, agar, greedy] = all;
    assert!(idle.iter().chain(&never).all(|score| *score == 0));
    // A sign test: 15 of 20 has a probability of 2 % by chance.
    for (worse, better) in [(&idle, &random), (&random, &agar), (&agar, &greedy)] {
        assert!(wins(worse, better) >= 15, "{worse:?} {better:?}");
    }
}

#[test]
fn every_seed_finds_room_for_everything() {
    for seed in (1..=40).chain([u64::MAX, 1_700_000_000]) {
        assert!(Round::new(&scenario(seed, 90.0)).is_ok(), "seed {seed}");
    }
}

/// Points of what nobody has eaten.
fn left(round: &Round) -> u32 {
    let view = round.world().view();
    let free = view.organisms().filter(|organism| organism.held_by().is_none());
    free.map(|organism| round.referee().game().points(organism.kind(), organism.spawn_area())).sum()
}

/// Mean velocity of a cell.
fn velocity(round: &Round) -> Vec2 {
    let (sum, count) =
        cell(round).particles().fold((Vec2::ZERO, 0.0), |(sum, count), p| (sum + p.velocity, count + 1.0));
    sum / count
}

#[test]
fn a_command_moves_the_cell_at_once_and_turns_it_soon() {
    let ways = [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::new(0.7, -0.7)];
    for before in [None, Some(Vec2::X), Some(Vec2::Y)] {
        for way in ways {
            let mut round = Round::new(&scenario(1, 60.0)).unwrap();
            let intent = |round: &Round, way: Vec2| {
                let at = round.world().centroid(round.player()).unwrap();
                Intent::toward(at + way * 40.0).unwrap()
            };
            for _ in 0..40 {
                let earlier = before.map_or(Intent::REST, |way| intent(&round, way));
                round.step(earlier);
            }
            let start = velocity(&round);
            let command = intent(&round, way);
            (0..2).for_each(|_| round.step(command));
            let gained = (velocity(&round) - start).dot(way);
            let turns = before.is_none_or(|before| before != way);
            assert!(gained > 0.05 || !turns, "{before:?} -> {way}: gained {gained} units/s in two steps");
            (0..16).for_each(|_| round.step(command));
            let cosine = velocity(&round).normalize_or_zero().dot(way.normalize());
            assert!(cosine > 0.707, "{before:?} -> {way}: cosine {cosine} after 0.3 s");
        }
    }
}

/// All files in a folder and those below it.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

#[test]
fn the_rules_know_no_window() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/rules");
    for path in files(&folder) {
        let text = std::fs::read_to_string(&path).unwrap();
        let forbidden = concat!("macro", "quad");
        assert!(!text.contains(forbidden), "{}", path.display());
    }
}

#[test]
fn the_player_hears_what_its_cell_does_the_last_nine_seconds_and_the_end() {
    let mut heard = Vec::new();
    let round = play(Policy::Greedy, 3, 30.0, |round| heard.extend(round.heard()));
    let count = |cue: Cue| heard.iter().filter(|&&other| other == cue).count();
    assert_eq!((count(Cue::Second), count(Cue::End)), (9, 1));
    let eaten: u32 = round.referee().kinds().iter().map(|(_, entry)| entry.count).sum();
    assert!(eaten > 0 && count(Cue::Digest) == eaten as usize, "{eaten} eaten: {heard:?}");
    assert!(count(Cue::Engulf) >= count(Cue::Ingest) && count(Cue::Ingest) >= count(Cue::Digest));
}
