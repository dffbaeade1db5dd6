//! The slides that come with the game, for one and for more: a file in `slides/` and a line here for each, in the order of play.

use crate::rules::seating::{OBSTACLES, seat};
use crate::words;
use microsim_core::scenario::{Scenario, Slide};

/// A slide that comes with the game.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltinSlide {
    /// Name of its scenario, which no built-in scenario has.
    pub name: &'static str,
    /// The file.
    pub text: &'static str,
}

/// Those for one, in the order of play.
pub static SLIDES: &[BuiltinSlide] = &[
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
    slide("predator", include_str!("../slides/predator.toml")),
];

/// A slide that two to four play together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedSlide {
    /// The slide, with two cells.
    pub slide: BuiltinSlide,
    /// Where a third cell and a fourth are.
    more: [[f32; 2]; 2],
}

/// All of them; messages of a network name one by its place here.
pub static SHARED: &[SharedSlide] = &[
    shared(slide("both-poles", include_str!("../slides/both-poles.toml")), [[40.0, 14.0], [100.0, 66.0]]),
    shared(slide("sieve", include_str!("../slides/sieve.toml")), [[16.0, 16.0], [124.0, 64.0]]),
    shared(slide("swarm", include_str!("../slides/swarm.toml")), [[37.0, 38.0], [113.0, 38.0]]),
];

const fn slide(name: &'static str, text: &'static str) -> BuiltinSlide {
    BuiltinSlide { name, text }
}

const fn shared(slide: BuiltinSlide, more: [[f32; 2]; 2]) -> SharedSlide {
    SharedSlide { slide, more }
}

impl SharedSlide {
    /// The scenario for so many players, 2 to 4.
    #[must_use]
    pub fn text(&self, players: usize) -> String {
        let [third, fourth] = self.more;
        seat(self.slide.text, OBSTACLES, players, "of = \"cell\"", &[(3, third), (4, fourth)])
    }
}

impl BuiltinSlide {
    /// What the file says of it; `None` if it is broken, which a test excludes.
    #[must_use]
    pub fn read(&self) -> Option<Slide> {
        Scenario::parse(self.text, &[]).ok()?.slide().cloned()
    }

    /// Its title in the language of the player.
    #[must_use]
    pub fn title(&self) -> String {
        self.told().map_or_else(String::new, |slide| slide.title)
    }

    /// All of it in the language of the player; the source of the fact stays as it is.
    #[must_use]
    pub fn told(&self) -> Option<Slide> {
        let mut slide = self.read()?;
        for (part, text) in [("title", &mut slide.title), ("task", &mut slide.task), ("fact", &mut slide.fact)] {
            if let Some(own) = words::of_scene(self.name, part) {
                own.clone_into(text);
            }
        }
        Some(slide)
    }
}

/// A slide as it is told in the language of the player, if it is one of these.
#[must_use]
pub fn told(slide: &Slide) -> Slide {
    let known = all().find(|builtin| builtin.read().as_ref() == Some(slide));
    known.and_then(BuiltinSlide::told).unwrap_or_else(|| slide.clone())
}

/// The slide of a name, for one or for more.
#[must_use]
pub fn find(name: &str) -> Option<&'static BuiltinSlide> {
    all().find(|slide| slide.name == name)
}

/// Slides for one and for more.
pub fn all() -> impl Iterator<Item = &'static BuiltinSlide> {
    SLIDES.iter().chain(SHARED.iter().map(|shared| &shared.slide))
}

#[cfg(test)]
#[path = "slides_tests.rs"]
mod tests;
