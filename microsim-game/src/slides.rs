//! The slides that come with the game: a file in `slides/` and a line here for each, in the order of play.

use microsim_core::scenario::{Scenario, Slide};

/// A slide that comes with the game.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltinSlide {
    /// Name of its scenario, which no built-in scenario has.
    pub name: &'static str,
    /// The file.
    pub text: &'static str,
}

/// All of them.
pub const SLIDES: &[BuiltinSlide] = &[
    slide("first-steps", include_str!("../slides/first-steps.toml")),
    slide("first-meal", include_str!("../slides/first-meal.toml")),
    slide("narrow-gap", include_str!("../slides/narrow-gap.toml")),
    slide("maze", include_str!("../slides/maze.toml")),
    slide("scent", include_str!("../slides/scent.toml")),
    slide("shy-prey", include_str!("../slides/shy-prey.toml")),
    slide("thrombus", include_str!("../slides/thrombus.toml")),
    slide("big-game", include_str!("../slides/big-game.toml")),
    slide("red-cells", include_str!("../slides/red-cells.toml")),
    slide("two-shapes", include_str!("../slides/two-shapes.toml")),
    slide("flood", include_str!("../slides/flood.toml")),
    slide("little-animals", include_str!("../slides/little-animals.toml")),
];

const fn slide(name: &'static str, text: &'static str) -> BuiltinSlide {
    BuiltinSlide { name, text }
}

impl BuiltinSlide {
    /// What the file says of it; `None` if it is broken, which a test excludes.
    #[must_use]
    pub fn read(&self) -> Option<Slide> {
        Scenario::parse(self.text, &[]).ok()?.slide().cloned()
    }
}

/// The slide of a name.
#[must_use]
pub fn find(name: &str) -> Option<&'static BuiltinSlide> {
    SLIDES.iter().find(|slide| slide.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::bot::{Bot, Policy};
    use crate::rules::round::Round;
    use crate::rules::slide_bot::SlideBot;
    use microsim_core::Intent;

    fn round(slide: &BuiltinSlide, seed: u64) -> Round {
        let mut scenario = Scenario::parse(
            &std::fs::read_to_string(format!("{}/slides/{}.toml", env!("CARGO_MANIFEST_DIR"), slide.name)).unwrap(),
            &[],
        )
        .unwrap_or_else(|found| panic!("{}: {found}", slide.name));
        scenario.set_seed(seed);
        Round::new(&scenario).unwrap_or_else(|problem| panic!("{}, seed {seed}: {problem}", slide.name))
    }

    /// Plays a slide to its end.
    fn play(mut round: Round, mut intent: impl FnMut(&Round) -> Intent) -> Round {
        while !round.is_over() {
            let intent = intent(&round);
            round.step(intent);
        }
        round
    }

    /// The attempts of the bots that know most and least.
    fn skilled(slide: &BuiltinSlide, seed: u64) -> Round {
        let round = round(slide, seed);
        let mut bot = SlideBot::new(round.world());
        play(round, |round| bot.intent(round))
    }

    fn random(slide: &BuiltinSlide, seed: u64) -> Round {
        let mut bot = Bot::new(Policy::Random, seed);
        play(round(slide, seed), |round| bot.intent(round.world(), round.player()).digesting(true))
    }

    fn idle(slide: &BuiltinSlide, seed: u64) -> Round {
        play(round(slide, seed), |_| Intent::REST.digesting(true))
    }

    fn stars(round: &Round) -> u32 {
        round.attempt().unwrap().stars()
    }

    /// How the bots do on each slide over many seeds, as a table.
    #[test]
    #[ignore = "12 slides, 20 seeds, 3 bots"]
    fn bots_do_as_well_as_their_skill_over_twenty_seeds() {
        let only = std::env::var("SLIDE").unwrap_or_default();
        let seeds = std::env::var("SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(20_u64);
        for slide in SLIDES.iter().filter(|slide| slide.name.contains(&only)) {
            let played =
                [idle, random, skilled].map(|play| (1..=seeds).map(|seed| play(slide, seed)).collect::<Vec<_>>());
            let all = played.each_ref().map(|rounds| rounds.iter().map(stars).collect::<Vec<_>>());
            let times: Vec<String> = played[2]
                .iter()
                .map(|r| r.attempt().unwrap().time().map_or("-".into(), |t| format!("{t:.0}")))
                .collect();
            let rt: Vec<String> = played[1]
                .iter()
                .map(|r| r.attempt().unwrap().time().map_or("-".into(), |t| format!("{t:.0}")))
                .collect();
            println!(
                "{:15} idle {:?} random {:?} skilled {:?} times {} random {}",
                slide.name,
                all[0],
                all[1],
                all[2],
                times.join(" "),
                rt.join(" ")
            );
        }
    }
}
