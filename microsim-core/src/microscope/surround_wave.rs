//! The surround wave: what the wave behind the specimen is without its details. Phase contrast and dark field set it
//! against the wave itself; how far it reaches is the width of the halo. The haze of fluorescence reaches as far.

use super::glsl::Glsl;
use super::maths::larger;
use super::matter::MatterRaster;
use super::raster::{PixelGrid, bilinear, blur, gaussian};
use super::wave;
use crate::bare_text::bare_text;
use glam::Vec2;

/// Standard deviations of the two normal distributions by which the wave is blurred, micrometres, and the share of the
/// first. They stand for the ring of the condenser and its image on the phase plate.
const CORE_WIDTH: f32 = 0.67;
const HALO_WIDTH: f32 = 2.17;
const NEAR_SHARE: f32 = 0.52;

/// Pixel on which the surround wave is computed, micrometres: half of what it could show.
const PIXEL: f32 = 0.33;

pub(super) const GLSL: Glsl =
    Glsl { source: bare_text!("surround_wave.glsl", "//"), constants: &[("NEAR_SHARE", &[NEAR_SHARE])] };

/// Pixels on which the surround wave of a picture is computed: coarse ones, of at least a side, and some beyond the picture.
pub(super) fn grid_around(picture: &PixelGrid, least: f32) -> PixelGrid {
    let pixel = larger(PIXEL, least);
    let (low, high) = picture.bounds();
    let margin = Vec2::splat(3.0 * HALO_WIDTH + 2.0 * pixel);
    // On a lattice of the world's: what is between its points does not come and go as the camera moves.
    let (low, high) = (((low - margin) / pixel).floor(), ((high + margin) / pixel).ceil());
    let corner = Vec2::new(low.x, high.y) * pixel;
    PixelGrid { corner, pixel, columns: (high.x - low.x) as usize, top: 0, rows: (high.y - low.y) as usize }
}

/// The weights of both distributions for a graphics card: those of the middle pixel and outwards, near and far in turn.
pub(super) fn weights(pixel: f32) -> Vec<f32> {
    let (near, far) = (gaussian(CORE_WIDTH / pixel), gaussian(HALO_WIDTH / pixel));
    let at = |weights: &[f32], k: usize| weights.get(weights.len() / 2 + k).copied().unwrap_or(0.0);
    (0..=far.len() / 2).flat_map(|k| [at(&near, k), at(&far, k)]).collect()
}

/// What is blurred widely.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Surround {
    /// The wave behind the specimen.
    Wave,
    /// What shines: nucleic acid and cytoplasm.
    Emission,
}

/// The surround wave over a whole picture.
#[derive(Clone, Debug)]
pub(super) struct SurroundWave {
    grid: PixelGrid,
    wave: Vec<Vec2>,
}

impl SurroundWave {
    /// Of matter on the grid of [`grid_around`].
    pub(super) fn of(MatterRaster { grid, matter }: MatterRaster, kind: Surround) -> Self {
        let wave = match kind {
            Surround::Wave => wave::behind,
            Surround::Emission => wave::emitted,
        };
        let wave: Vec<[f32; 2]> = matter.into_iter().map(|matter| wave(matter).to_array()).collect();
        let (mut near, mut far) = (wave.clone(), wave);
        blur(&mut near, grid.columns, &gaussian(CORE_WIDTH / grid.pixel));
        blur(&mut far, grid.columns, &gaussian(HALO_WIDTH / grid.pixel));
        let mixed = near.into_iter().zip(far);
        let mixed = mixed.map(|(near, far)| Vec2::from(near) * NEAR_SHARE + Vec2::from(far) * (1.0 - NEAR_SHARE));
        Self { grid, wave: mixed.collect() }
    }

    /// At a place.
    pub(super) fn at(&self, place: Vec2) -> Vec2 {
        let PixelGrid { columns, rows, .. } = self.grid;
        let at = self.grid.locate(place).clamp(Vec2::ZERO, Vec2::new((columns - 1) as f32, (rows - 1) as f32));
        bilinear([columns, rows], at.as_ivec2(), at - at.floor(), |k| self.wave[k], Vec2::lerp)
    }
}
