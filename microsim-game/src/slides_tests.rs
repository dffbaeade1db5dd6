use super::*;
use crate::rules::attempt::Attempt;
use crate::rules::bot::{Bot, Policy};
use crate::rules::round::Round;
use crate::rules::slide_bot::SlideBot;
use crate::sound::Cue;
use microsim_core::Intent;
use microsim_core::replay::Replay;
use microsim_core::scenario::builtin;
use std::collections::BTreeSet;

fn round(slide: &BuiltinSlide, seed: u64) -> Round {
    let mut scenario = Scenario::parse(slide.text, &[]).unwrap_or_else(|found| panic!("{}: {found}", slide.name));
    scenario.set_seed(seed);
    Round::new(&scenario).unwrap_or_else(|problem| panic!("{}, seed {seed}: {problem}", slide.name))
}

/// Plays a slide to its end, or for some time, s.
fn play(mut round: Round, longest: f32, mut intent: impl FnMut(&Round) -> Intent) -> Round {
    while !round.is_over() && round.world().time() < f64::from(longest) {
        let intent = intent(&round);
        round.step(intent);
    }
    round
}

/// Plays a slide with a seed to its end, or for some time, s.
type PlaySlide = fn(&BuiltinSlide, u64, f32) -> Round;

fn idle(slide: &BuiltinSlide, seed: u64, longest: f32) -> Round {
    play(round(slide, seed), longest, |_| Intent::REST.digesting(true))
}

fn random(slide: &BuiltinSlide, seed: u64, longest: f32) -> Round {
    let mut bot = Bot::new(Policy::Random, seed);
    play(round(slide, seed), longest, |round| bot.intent(round.world(), round.player()).digesting(true))
}

fn skilled(slide: &BuiltinSlide, seed: u64, longest: f32) -> Round {
    let round = round(slide, seed);
    let mut bot = SlideBot::new(round.world());
    play(round, longest, |round| bot.intent(round))
}

/// Whether a bot gets an accepted number of stars, and prints how many; `MICROSIM_SEEDS` is how many seeds it plays.
fn judge(name: &str, bot: PlaySlide, longest: fn(&Slide) -> f32, is_accepted: fn(u32) -> bool) {
    let seeds = std::env::var("MICROSIM_SEEDS").map_or(3, |count| count.parse().unwrap());
    for (slide, rules) in all() {
        let rounds: Vec<Round> = (1..=seeds).map(|seed| bot(slide, seed, longest(&rules))).collect();
        let counts = [0, 1, 2, 3].map(|wanted| rounds.iter().filter(|round| stars(round) == wanted).count());
        let times: Vec<f32> = rounds.iter().filter_map(|round| round.attempt()?.time()).collect();
        println!("{}, {name}: 0 to 3 stars {counts:?}, times {times:.0?}", slide.name);
        let accepted = rounds.iter().filter(|round| is_accepted(stars(round))).count();
        assert!(10 * accepted >= 9 * rounds.len(), "{}, {name}: {counts:?}", slide.name);
    }
}

fn stars(round: &Round) -> u32 {
    round.attempt().map_or(0, Attempt::stars)
}

fn all() -> impl Iterator<Item = (&'static BuiltinSlide, Slide)> {
    SLIDES.iter().map(|slide| (slide, slide.read().unwrap_or_else(|| panic!("{} is broken", slide.name))))
}

#[test]
fn t87_every_slide_has_a_name_of_its_own_that_its_file_says() {
    let names: BTreeSet<&str> = all().map(|(slide, _)| slide.name).collect();
    let titles: BTreeSet<String> = all().map(|(_, slide)| slide.title).collect();
    assert_eq!((names.len(), titles.len()), (SLIDES.len(), SLIDES.len()));
    for (slide, _) in all() {
        assert_eq!(Scenario::parse(slide.text, &[]).unwrap().name(), slide.name);
        assert!(builtin(slide.name).is_none() && find(slide.name) == Some(slide), "{}", slide.name);
    }
}

#[test]
fn t87_a_bot_that_sees_walls_gets_two_stars_on_every_slide() {
    for (slide, rules) in all() {
        let round = skilled(slide, 1, rules.time);
        assert!(stars(&round) >= 2, "{}: {:?}", slide.name, round.attempt().map(Attempt::summary));
    }
}

#[test]
#[ignore = "for release builds"]
fn t87_skill_earns_two_stars_with_any_seed() {
    judge("skilled", skilled, |rules| rules.time, |stars| stars >= 2);
}

#[test]
#[ignore = "for release builds"]
fn t87_chance_earns_at_most_one_star_with_any_seed() {
    judge("random", random, |rules| rules.stars[1] + 0.1, |stars| stars <= 1);
}

#[test]
#[ignore = "for release builds"]
fn t87_nobody_wins_by_doing_nothing_with_any_seed() {
    judge("idle", idle, |rules| rules.time, |stars| stars == 0);
}

#[test]
fn t87_a_slide_that_is_not_done_in_time_is_lost() {
    let text =
        SLIDES[0].text.replace("time = 60.0", "time = 2.0").replace("stars = [15.0, 24.0]", "stars = [1.0, 2.0]");
    let mut round = Round::new(&Scenario::parse(&text, &[]).unwrap()).unwrap();
    (0..119).for_each(|_| round.step(Intent::REST));
    assert!(!round.is_over());
    round.step(Intent::REST);
    let attempt = round.result().attempt.unwrap();
    assert!(round.is_over() && attempt.time().is_none() && attempt.stars() == 0);
}

#[test]
fn t87_a_slide_is_played_again_to_the_bit_from_its_record() {
    let round = skilled(&SLIDES[0], 1, 60.0);
    let replay = Replay::read(&round.record().unwrap()).unwrap();
    let again = play(Round::again(&replay).unwrap(), 60.0, |_| Intent::REST);
    assert_eq!(again.attempt(), round.attempt());
    assert!(again.mismatch().is_none() && stars(&again) == 3);
    assert!(again.heard().any(|cue| cue == Cue::End), "the end is heard");
}
