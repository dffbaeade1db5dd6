//! How a world is seen: through the microscope, on the graphics card, or drawn, where that is too slow.

use crate::draw::{Painter, SceneFrame};
use crate::microscope::{RenderQuality, Renderer};
use crate::platform;
use crate::viewer::Pace;
use crate::words::{self, Key};
use macroquad::window::screen_dpi_scale;
use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Frame times above which frames are slow, and far too slow, s.
const SLOW_FRAME: f32 = 0.04;
const VERY_SLOW_FRAME: f32 = 0.2;
/// Time of slow frames, less that of fluent ones, after which quality falls, s.
const SLOW_TIME_LIMIT: f32 = 1.2;

/// How a world is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// Through the microscope.
    Microscope(Optics),
    /// Drawn: the same at any speed of the graphics card.
    Drawn,
}

impl Sight {
    /// All of them, in the order in which a key goes through them.
    pub fn all() -> impl DoubleEndedIterator<Item = Self> + Clone {
        Optics::ALL.into_iter().map(Self::Microscope).chain([Self::Drawn])
    }

    /// Its name in the settings.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Microscope(optics) => optics.name(),
            Self::Drawn => "drawn",
        }
    }

    /// What the player reads.
    #[must_use]
    pub fn title(self) -> &'static str {
        words::text(match self.name() {
            "bright-field" => Key::SightBrightField,
            "classic" => Key::SightClassic,
            "dark-field" => Key::SightDarkField,
            "dic" => Key::SightDic,
            "drawn" => Key::SightDrawn,
            "fluorescence" => Key::SightFluorescence,
            "negative-phase-contrast" => Key::SightNegativePhaseContrast,
            "stained" => Key::SightStained,
            _ => Key::SightPhaseContrast,
        })
    }

    /// The one of this name, or the first.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self::all().find(|sight| sight.name() == name).unwrap_or(Self::Microscope(Optics::ALL[0]))
    }

    /// The next one, or the one before.
    #[must_use]
    pub fn next(self, is_back: bool) -> Self {
        let all: Vec<Self> = Self::all().collect();
        let at = all.iter().position(|&sight| sight == self).unwrap_or(0);
        all[(at + if is_back { all.len() - 1 } else { 1 }) % all.len()]
    }
}

/// How much of the machine pictures may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", from = "String")]
pub enum Effort {
    /// As much as leaves the picture fluent.
    #[default]
    Automatic,
    /// All that there is.
    High,
    /// Half of the pixels.
    Medium,
    /// A quarter of the pixels.
    Low,
}

/// An unknown name, such as another version's, is the default.
impl From<String> for Effort {
    fn from(name: String) -> Self {
        Self::named(&name).unwrap_or_default()
    }
}

impl Effort {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Automatic, Self::High, Self::Medium, Self::Low];

    /// What it is called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Automatic => "automatic",
            Self::High => "high",
            Self::Medium => "medium",
            Self::Low => "low",
        }
    }

    /// What the player reads.
    #[must_use]
    pub fn title(self) -> &'static str {
        words::text(match self {
            Self::Automatic => Key::EffortAutomatic,
            Self::High => Key::EffortHigh,
            Self::Medium => Key::EffortMedium,
            Self::Low => Key::EffortLow,
        })
    }

    /// The one of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effort| effort.name() == name)
    }

    /// The next one, or the one before.
    #[must_use]
    pub fn next(self, is_back: bool) -> Self {
        let (at, count) = (Self::ALL.iter().position(|&effort| effort == self).unwrap_or(0), Self::ALL.len());
        Self::ALL[(at + if is_back { count - 1 } else { 1 }) % count]
    }
}

/// Shows worlds.
#[derive(Debug)]
pub struct Scenery {
    painter: Painter,
    /// None if the driver refuses its programs.
    renderer: Option<Renderer>,
    /// Index into [`QUALITY_STEPS`] for automatic effort.
    step: usize,
    /// Time of slow frames, less that of fluent ones, s.
    slow_time: f32,
    /// Time spent on commands to the graphics card since it was last asked for.
    submitting: Duration,
}

/// What automatic effort goes through while frames are slow.
const QUALITY_STEPS: [(Key, Option<RenderQuality>); 4] = [
    (Key::EffortHigh, Some(RenderQuality::High)),
    (Key::EffortMedium, Some(RenderQuality::Medium)),
    (Key::EffortLow, Some(RenderQuality::Low)),
    (Key::QualityDrawn, None),
];

impl Scenery {
    /// Makes textures and programs. Needs an open window.
    #[must_use]
    pub fn new() -> Self {
        let (painter, renderer) = (Painter::new(), Renderer::new().ok());
        Self { painter, renderer, step: 0, slow_time: 0.0, submitting: Duration::ZERO }
    }

    /// Lowers automatic effort while frames are slow; returns the notice to show.
    pub fn pass(&mut self, pace: Pace, effort: Effort, sight: Sight) -> Option<String> {
        let elapsed = pace.elapsed.min(0.5);
        let is_slow = !pace.is_exact && elapsed > SLOW_FRAME;
        self.slow_time = if is_slow { self.slow_time + elapsed } else { (self.slow_time - elapsed).max(0.0) };
        if self.slow_time <= SLOW_TIME_LIMIT {
            return None;
        }
        self.slow_time = 0.0;
        let steps = if elapsed > VERY_SLOW_FRAME { QUALITY_STEPS.len() } else { 1 };
        let lower = (self.step + steps).min(QUALITY_STEPS.len() - 1);
        let is_lower = std::mem::replace(&mut self.step, lower) != lower;
        let is_seen = effort == Effort::Automatic && sight != Sight::Drawn && self.renderer.is_some();
        (is_lower && is_seen)
            .then(|| words::text_with(Key::QualityLowered, &[("quality", words::text(QUALITY_STEPS[lower].0).into())]))
    }

    /// Whether this way of looking is drawn for now, because the machine is too slow for it or refuses it.
    #[must_use]
    pub fn stands_in(&self, effort: Effort, sight: Sight) -> bool {
        let is_slow = effort == Effort::Automatic && QUALITY_STEPS[self.step].1.is_none();
        sight != Sight::Drawn && (is_slow || self.renderer.is_none())
    }

    /// Puts automatic effort back to the best quality.
    pub fn take_heart(&mut self) {
        (self.step, self.slow_time) = (0, 0.0);
    }

    /// Time spent on commands to the graphics card since the last call.
    pub fn take_submitting(&mut self) -> Duration {
        std::mem::take(&mut self.submitting)
    }

    /// Draws a frame.
    pub fn paint(&mut self, frame: &SceneFrame<'_>, sight: Sight, effort: Effort) {
        let quality = match effort {
            Effort::Automatic => QUALITY_STEPS[self.step].1,
            Effort::High => Some(RenderQuality::High),
            Effort::Medium => Some(RenderQuality::Medium),
            Effort::Low => Some(RenderQuality::Low),
        };
        let is_done = match (sight, quality) {
            (Sight::Microscope(optics), Some(quality)) => self.photograph(frame, optics, quality),
            _ => false,
        };
        if !is_done {
            self.sketch(frame);
        }
    }

    /// Draws a frame in the drawn view.
    pub fn sketch(&mut self, frame: &SceneFrame<'_>) {
        self.painter.paint(frame);
    }

    fn photograph(&mut self, frame: &SceneFrame<'_>, optics: Optics, quality: RenderQuality) -> bool {
        let Some(renderer) = &mut self.renderer else { return false };
        let screen = frame.camera.screen();
        let pixels = (screen * screen_dpi_scale()).max(Vec2::ONE);
        let width = screen.x / frame.camera.scale();
        let field = Field { centre: frame.camera.centre(), width, pixels: [pixels.x as u32, pixels.y as u32] };
        let microscope = Microscope { optics, film: Film::DIGITAL };
        let Ok(recipe) = renderer.recipe(frame.view, field, microscope, quality) else { return false };
        let began = platform::now();
        let picture = renderer.draw(&recipe);
        self.submitting += platform::now() - began;
        renderer.show(&picture, 0.0, 0.0, screen.x, screen.y);
        true
    }
}

impl Default for Scenery {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_key_goes_through_all_sights_and_back() {
        let first = Sight::named("nonsense");
        let mut sight = first;
        for expected in Sight::all().skip(1).chain([first]) {
            assert_eq!(sight, expected.next(true));
            sight = sight.next(false);
            assert_eq!(sight, expected);
            assert_eq!(Sight::named(sight.name()), sight);
        }
    }
}
