//! What an image is made of: matter, waves and slopes at a pixel.

use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::mix;
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::raster::bilinear;
use crate::microscope::surround_wave::SurroundWave;
use crate::microscope::wave;
use glam::{IVec2, Vec2};

pub(in crate::microscope) const GLSL: Glsl = Glsl { source: bare_text!("sampler.glsl", "//"), constants: &[] };

/// Farthest that an image looks to the side, micrometres.
pub(in crate::microscope) const REACH: f32 = 0.36;

/// The specimen on a grid of pixels, and the surround wave.
#[derive(Clone, Copy, Debug)]
pub(in crate::microscope) struct Sampler<'a> {
    pub raster: &'a MatterRaster,
    pub surround: Option<&'a SurroundWave>,
}

impl Sampler<'_> {
    pub(super) fn matter(&self, x: usize, y: usize) -> Matter {
        self.raster.matter[y * self.raster.grid.columns + x]
    }

    /// The wave at a pixel, and the surround wave there.
    pub(super) fn waves(&self, x: usize, y: usize) -> (Vec2, Vec2) {
        let wave = wave::behind(self.matter(x, y));
        let surround = self.surround.map_or(Vec2::X, |surround| surround.at(self.raster.grid.place(x, y)));
        (wave, surround)
    }

    /// Curvature (Laplacian) of the delay over a step, radians per square micrometre.
    pub(super) fn curvature(&self, x: usize, y: usize, step: f32) -> f32 {
        let sides = [Vec2::X, Vec2::NEG_X, Vec2::Y, Vec2::NEG_Y];
        let around: f32 = sides.iter().map(|side| self.phase_beside(x, y, *side * step)).sum();
        (around - 4.0 * self.matter(x, y).phase) / (step * step)
    }

    /// Matter `offset` micrometres beside a pixel.
    pub(super) fn matter_beside(&self, x: usize, y: usize, offset: Vec2) -> Matter {
        self.beside(
            x,
            y,
            offset,
            |matter| matter,
            |a, b, share| {
                let mut mixed = a * (1.0 - share);
                mixed += b * share;
                mixed
            },
        )
    }

    /// Delay `offset` micrometres beside a pixel, radians.
    pub(super) fn phase_beside(&self, x: usize, y: usize, offset: Vec2) -> f32 {
        self.beside(x, y, offset, |matter| matter.phase, mix)
    }

    fn beside<T>(
        &self,
        x: usize,
        y: usize,
        offset: Vec2,
        value: impl Fn(Matter) -> T,
        mix: impl Fn(T, T, f32) -> T,
    ) -> T {
        let grid = &self.raster.grid;
        let offset = Vec2::new(offset.x, -offset.y) / grid.pixel;
        let pixel = IVec2::new(x as i32, y as i32) + offset.floor().as_ivec2();
        bilinear([grid.columns, grid.rows], pixel, offset - offset.floor(), |k| value(self.raster.matter[k]), mix)
    }
}
