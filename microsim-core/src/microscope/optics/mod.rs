//! Ways to make an image of a specimen: one file each, and a row in [`Optics`].

mod bright_field;
mod classic;
mod dark_field;
mod dic;
mod fluorescence;
mod phase_contrast;
mod stained;

use super::formula::Formula;
use super::matter::{Matter, Plate};
use super::wave::{self, Surround};
use glam::Vec2;

/// A way to make an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Optics {
    /// Positive phase contrast (Zernike 1942): what delays light is dark, with a bright halo.
    PhaseContrast,
    /// Negative phase contrast: what delays light is bright, with a dark halo.
    NegativePhaseContrast,
    /// Differential interference contrast (Nomarski): slopes of the delay, as if lit from the side.
    Dic,
    /// Dark field: only light that the specimen turns aside.
    DarkField,
    /// Bright field without a stain: red cells, and whatever bends light a little out of focus.
    BrightField,
    /// Bright field of a smear in a Romanowsky stain, such as Wright's.
    Stained,
    /// Fluorescence: nucleic acid in blue, cytoplasm in green.
    Fluorescence,
    /// The illustrated look of the seed (3.2): textured meshes, blurred particles, drifting things in the background.
    Classic,
}

impl Optics {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::PhaseContrast,
        Self::NegativePhaseContrast,
        Self::Dic,
        Self::DarkField,
        Self::BrightField,
        Self::Stained,
        Self::Fluorescence,
        Self::Classic,
    ];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PhaseContrast => "phase-contrast",
            Self::NegativePhaseContrast => "negative-phase-contrast",
            Self::Dic => "dic",
            Self::DarkField => "dark-field",
            Self::BrightField => "bright-field",
            Self::Stained => "stained",
            Self::Fluorescence => "fluorescence",
            Self::Classic => "classic",
        }
    }

    /// The one of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|optics| optics.name() == name)
    }

    /// How it makes its image.
    pub(super) fn mode(self) -> &'static Mode {
        match self {
            Self::PhaseContrast => &phase_contrast::POSITIVE,
            Self::NegativePhaseContrast => &phase_contrast::NEGATIVE,
            Self::Dic => &dic::MODE,
            Self::DarkField => &dark_field::MODE,
            Self::BrightField => &bright_field::MODE,
            Self::Stained => &stained::MODE,
            Self::Fluorescence => &fluorescence::MODE,
            Self::Classic => &classic::MODE,
        }
    }
}

pub(super) const SIGHT: Formula = Formula { source: include_str!("sight.glsl"), constants: &[] };

/// How light becomes an image.
#[derive(Debug)]
pub(super) struct Mode {
    /// 1 for grey, 3 for colour.
    pub channels: usize,
    pub has_surround: bool,
    /// Blur of the image by diffraction and what else is less than perfect, standard deviation, micrometres.
    pub blur: f32,
    /// Strength of the film's grain in this light, relative to phase contrast.
    pub grain: f32,
    pub shade: Shade,
}

/// Where an image comes from.
#[derive(Debug)]
pub(super) enum Shade {
    /// Light at a pixel, 0 to about 1 as the eye sees it; one channel or three. The formula is the same.
    Light(fn(&Sight<'_>, usize, usize) -> [f32; 3], &'static Formula),
    /// There is no light: it is painted.
    Painted,
}

impl Mode {
    /// Farthest that an image looks to the side, micrometres.
    pub(super) const SIDE: f32 = 0.16;
}

/// What there is to make an image of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'a> {
    pub plate: &'a Plate,
    pub surround: Option<&'a Surround>,
}

impl Sight<'_> {
    pub(super) fn matter(&self, x: usize, y: usize) -> Matter {
        self.plate.matter[y * self.plate.grid.columns + x]
    }

    /// The wave at a pixel, and the surround wave there.
    pub(super) fn waves(&self, x: usize, y: usize) -> (Vec2, Vec2) {
        let wave = wave::behind(self.matter(x, y));
        let surround = self.surround.map_or(Vec2::X, |surround| surround.at(self.plate.grid.place(x, y)));
        (wave, surround)
    }

    /// Curvature (Laplacian) of the delay over a step, radians per square micrometre.
    fn curvature(&self, x: usize, y: usize, step: f32) -> f32 {
        let sides = [Vec2::X, Vec2::NEG_X, Vec2::Y, Vec2::NEG_Y];
        let around: f32 = sides.iter().map(|side| self.phase_beside(x, y, *side * step)).sum();
        (around - 4.0 * self.matter(x, y).phase) / (step * step)
    }

    /// Delay `offset` micrometres beside a pixel, radians.
    pub(super) fn phase_beside(&self, x: usize, y: usize, offset: Vec2) -> f32 {
        let grid = &self.plate.grid;
        let offset = Vec2::new(offset.x, -offset.y) / grid.pixel;
        let (whole, share) = (offset.floor(), offset - offset.floor());
        let beside = |k: usize, by: f32, count: usize| (k as isize + by as isize).clamp(0, count as isize - 1) as usize;
        let (left, upper) = (beside(x, whole.x, grid.columns), beside(y, whole.y, grid.rows));
        let (right, lower) = ((left + 1).min(grid.columns - 1), (upper + 1).min(grid.rows - 1));
        let phase = |x: usize, y: usize| self.matter(x, y).phase;
        let above = phase(left, upper) + (phase(right, upper) - phase(left, upper)) * share.x;
        let below = phase(left, lower) + (phase(right, lower) - phase(left, lower)) * share.x;
        above + (below - above) * share.y
    }
}

/// A grey value in the first channel.
fn grey(value: f32) -> [f32; 3] {
    [value, 0.0, 0.0]
}
