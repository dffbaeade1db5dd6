//! Bots in rounds of the food chain: its rules, and how hard it is.

use super::*;
use crate::rules::food_chain::{Fate, NAME, TEXT, bites, change};
use microsim_core::replay::Replay;
use microsim_core::scenario::Scenario;

/// Longest round, s.
const LONGEST: f64 = 300.0;

fn round(seed: u64) -> Round {
    let mut scenario = Scenario::parse(TEXT, &[]).unwrap();
    scenario.set_seed(seed);
    Round::new(&scenario).unwrap()
}

/// A cell of this radius in a room, with what a text adds.
fn room(radius: f32, more: &str) -> Round {
    let text = format!(
        "schema = 1\nname = \"food-chain\"\n[game]\n[world]\nsize = [90.0, 60.0]\n\
         [amoeboid_cell.cell]\nradii = [{radius}, {radius}]\n[amoeboid_cell.cell.division]\nleast_particles = 12\n\
         [[spawn]]\nof = \"cell\"\nplayer = true\nat = [20.0, 30.0]\n{more}"
    );
    Round::new(&Scenario::parse(&text, &[]).unwrap()).unwrap()
}

/// Plays a round to its end, or for some time, s, without a leak. Returns all offers, with what was chosen.
fn play(skill: Skill, seed: u64, longest: f64) -> (Round, Vec<([Change; 3], Change)>) {
    let mut round = round(seed);
    let mut bot = ChainBot::new(skill, &round);
    let mut choices = Vec::new();
    while !round.is_over() && round.world().time() < longest {
        let offer = round.offer(0);
        choices.extend(offer.zip(bot.step(&mut round)));
        if round.world().step_index().is_multiple_of(60) {
            assert_eq!(round.world().census().leaks, 0, "{skill:?}, seed {seed}, {} s", round.world().time());
        }
    }
    (round, choices)
}

fn seeds() -> std::ops::RangeInclusive<u64> {
    1..=std::env::var("MICROSIM_SEEDS").map_or(5, |count| count.parse().unwrap())
}

#[test]
fn who_does_nothing_starves_within_half_a_minute() {
    let (round, _) = play(Skill::Idle, 1, 31.0);
    let life = round.result().life.unwrap();
    assert!(round.is_over() && life.time > 10.0 && life.time <= 30.0, "{life:?}");
}

#[test]
fn who_eats_lives_longer_and_changes_and_it_is_played_again_to_the_bit() {
    let (round, choices) = play(Skill::Survivor, 1, 30.0);
    let cell = round.world().view().organism(round.player()).expect("it lives");
    assert!(!choices.is_empty() && change::changes(cell) == choices.len() as u32, "{choices:?}");
    assert_eq!(round.result().life.unwrap().feats.changes, choices.len() as u32);
    let mut again = Round::again(&Replay::read(&round.record().unwrap()).unwrap()).unwrap();
    while !again.is_over() {
        again.step(Intent::REST);
    }
    assert_eq!((again.mismatch(), again.world().digest()), (None, round.world().digest()));
    assert_eq!((again.player(), again.offer(0), again.name()), (round.player(), None, NAME));
}

#[test]
fn a_sister_is_a_second_life() {
    let mut round = room(7.0, "");
    let first = round.player();
    round.divide(0);
    while !round.is_over() && round.player() == first && round.world().time() < 60.0 {
        round.step(Intent::REST);
    }
    assert!(round.player() != first && !round.is_over(), "the sister is played when the first is gone");
    assert!(round.world().view().organism(first).is_none());
    while !round.is_over() && round.world().time() < 60.0 {
        round.step(Intent::REST);
        assert_eq!(round.world().census().leaks, 0);
    }
    let life = round.result().life.unwrap();
    assert_eq!((life.fate, life.feats.divisions, life.feats.bites), (Some(Fate::Starved), 1, 0));
}

#[test]
fn a_division_does_not_still_hunger() {
    let own = |round: &Round| round.world().view().organisms().map(cytoplasm).sum::<u32>();
    let rest = |a: &mut Round, b: &mut Round| [a, b].into_iter().for_each(|round| round.step(Intent::REST));
    let (mut resting, mut dividing) = (room(7.0, ""), room(7.0, ""));
    dividing.divide(0);
    while dividing.world().organisms().count() == 1 && dividing.world().time() < 20.0 {
        rest(&mut resting, &mut dividing);
    }
    rest(&mut resting, &mut dividing);
    let time = resting.world().time();
    assert!(time > 0.7 && time < 20.0, "it takes some time to divide: {time}");
    assert!(own(&dividing).abs_diff(own(&resting)) <= 2, "{} and {}", own(&dividing), own(&resting));
}

#[test]
fn the_larger_bites_and_the_smaller_is_gone_in_the_end() {
    let mut round = room(
        5.0,
        "[amoeboid_cell.large]\nradii = [9.5, 9.5]\nspeed = 8.0\n[patrol.there]\nthrough = [[20.0, 30.0], [8.0, 30.0]]\n\
         [[spawn]]\nof = \"large\"\nat = [35.5, 30.0]\ncontroller = \"there\"\n",
    );
    let mut bitten = false;
    while !round.is_over() && round.world().time() < 20.0 {
        round.step(Intent::REST);
        bitten |= round.chain().unwrap().is_bitten(round.player());
        assert_eq!(round.world().census().leaks, 0);
    }
    let life = round.result().life.unwrap();
    assert!(bitten && round.is_over() && life.time < 12.0, "{life:?}");
    assert_eq!(life.fate, Some(Fate::Eaten));
    let large = round.world().view().organisms().next().unwrap();
    assert!(bites::cytoplasm(large) > 80, "who bites keeps what it has");
}

#[test]
fn each_bite_is_a_feat_of_the_one_who_bites() {
    let mut round = room(
        9.5,
        "[amoeboid_cell.small]\nradii = [5.0, 5.0]\nspeed = 8.0\n[patrol.there]\nthrough = [[32.5, 30.0], [20.0, 30.0]]\n\
         [[spawn]]\nof = \"small\"\nat = [35.5, 30.0]\ncontroller = \"there\"\n",
    );
    let prey = |round: &Round| {
        let view = round.world().view();
        view.organisms().find(|cell| cell.id() != round.player()).map(bites::cytoplasm)
    };
    let (first, mut left) = (prey(&round).unwrap(), 0);
    while round.world().time() < 4.0
        && let Some(now) = prey(&round)
    {
        left = now;
        round.step(Intent::REST);
    }
    let bites = round.result().life.unwrap().feats.bites;
    // The last one came after the last look.
    assert!(bites > 2 && (0..=1).contains(&(bites + left - first)), "{bites}, {first}, {left}");
}

#[test]
#[ignore = "for release builds"]
fn a_novice_meets_the_first_choice_in_most_rounds_and_lives_about_two_minutes() {
    let rounds = each_seed(|seed| {
        let (round, choices) = play(Skill::Novice, seed, LONGEST);
        (round.result().life.unwrap().time, !choices.is_empty())
    });
    let mut times: Vec<f32> = rounds.iter().map(|(time, _)| *time).collect();
    times.sort_by(f32::total_cmp);
    let met = rounds.iter().filter(|(_, has_chosen)| *has_chosen).count();
    println!("{met} of {} have chosen; {times:.0?}", rounds.len());
    assert!(4 * met >= 3 * rounds.len() && (90.0..150.0).contains(&times[times.len() / 2]), "{met}, {times:.0?}");
}

/// When a novice meets the first choice, s.
fn first_choice(seed: u64) -> f64 {
    let mut round = round(seed);
    let mut bot = ChainBot::new(Skill::Novice, &round);
    while !round.is_over() && round.offer(0).is_none() {
        bot.act(&mut round);
    }
    if round.is_over() { f64::INFINITY } else { round.world().time() }
}

#[test]
#[ignore = "for release builds"]
fn a_novice_meets_the_first_choice_within_the_first_minute() {
    let mut times = each_seed(first_choice);
    times.sort_by(f64::total_cmp);
    println!("{times:.0?}");
    assert!(times[times.len() / 2] <= 60.0, "{times:.0?}");
}

/// What is found with each seed, on all cores.
fn each_seed<T: Send>(find: impl Fn(u64) -> T + Sync) -> Vec<T> {
    let seeds: Vec<u64> = seeds().collect();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let part = &|seeds: &[u64]| seeds.iter().map(|&seed| find(seed)).collect::<Vec<_>>();
    std::thread::scope(|scope| {
        let parts = seeds.chunks(seeds.len().div_ceil(threads));
        let parts: Vec<_> = parts.map(|seeds| scope.spawn(move || part(seeds))).collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
    })
}

/// Rounds of a bot: how long its lives are, s, the shortest first, and of the times that each change was offered the share in which it
/// was taken.
fn lives(skill: Skill) -> (Vec<f32>, [f64; 6]) {
    let rounds = each_seed(|seed| {
        let (round, choices) = play(skill, seed, LONGEST);
        let life = round.result().life.unwrap();
        println!("{skill:?}, seed {seed}: {:.0} s, {:?}, {choices:?}", life.time, life.fate);
        (life, choices)
    });
    let mut times: Vec<f32> = rounds.iter().map(|(life, _)| life.time).collect();
    times.sort_by(f32::total_cmp);
    let eaten = rounds.iter().filter(|(life, _)| life.fate == Some(Fate::Eaten)).count();
    let choices: Vec<_> = rounds.iter().flat_map(|(_, choices)| choices).collect();
    let taken = Change::ALL.map(|change| {
        let offered = choices.iter().filter(|(offer, _)| offer.contains(&change)).count();
        choices.iter().filter(|(_, taken)| *taken == change).count() as f64 / offered as f64
    });
    let met = rounds.iter().filter(|(_, choices)| !choices.is_empty()).count();
    println!("{skill:?}: {times:.0?}, {eaten} eaten; {met} have chosen, {} times: {taken:.2?}", choices.len());
    (times, taken)
}

#[test]
#[ignore = "for release builds"]
fn whoever_does_nothing_starves_within_half_a_minute() {
    assert!(lives(Skill::Idle).0.iter().all(|time| *time <= 30.0));
}

#[test]
#[ignore = "for release builds"]
fn lives_are_in_the_order_of_skill_and_each_change_is_taken_now_and_then() {
    let found = Skill::ALL.map(lives);
    let medians = found.each_ref().map(|(times, _)| times[times.len() / 2]);
    assert!(medians.is_sorted(), "{medians:?}");
    let taken = found[Skill::ALL.len() - 1].1;
    assert!(taken.iter().all(|share| (0.2..=0.5).contains(share)), "{taken:.2?}");
}

/// What each change is worth at each offer of a survivor's round; it goes on with one that is offered, by chance.
fn worths(seed: u64) -> Vec<[(f64, u32); 6]> {
    let mut round = round(seed);
    let mut bot = ChainBot::new(Skill::Survivor, &round);
    let mut found = Vec::new();
    while !round.is_over() && round.world().time() < LONGEST {
        if let Some(offer) = round.offer(0) {
            let worths = Change::ALL.map(|change| bot.worth(&round, change));
            println!("seed {seed}, {:.0} s: {worths:.0?}", round.world().time());
            found.push(worths);
            round.choose(0, bot.any(offer));
        }
        bot.act(&mut round);
    }
    found
}

/// Of all offers with it, the share in which a change is worth more than the two others.
fn share_best(worths: &[[(f64, u32); 6]], change: usize) -> f64 {
    let others: Vec<usize> = (0..6).filter(|other| *other != change).collect();
    let pairs: Vec<[usize; 2]> =
        others.iter().flat_map(|&a| others.iter().map(move |&b| [a, b])).filter(|[a, b]| a < b).collect();
    let is_best = |worths: &[(f64, u32); 6], pair: &[usize; 2]| pair.iter().all(|&k| worths[change] > worths[k]);
    let best = worths.iter().map(|worths| pairs.iter().filter(|pair| is_best(worths, pair)).count()).sum::<usize>();
    best as f64 / (worths.len() * pairs.len()) as f64
}

#[test]
#[ignore = "for release builds"]
fn each_change_is_the_best_of_three_now_and_then() {
    let worths: Vec<_> = each_seed(worths).into_iter().flatten().collect();
    let shares: [f64; 6] = std::array::from_fn(|change| share_best(&worths, change));
    println!("{} offers, {:?}: {shares:.2?}", worths.len(), Change::ALL);
    assert!(shares.iter().all(|share| (0.2..=0.5).contains(share)), "{shares:.2?}");
}
