//! The wave behind the specimen, and the surround wave that phase contrast and dark field set against it.

use super::formula::Formula;
use super::maths::{gaussian, larger};
use super::matter::{Grid, Matter, Plate};
use super::specimen::Specimen;
use glam::Vec2;

/// Optical density of haemoglobin in green light where a red cell is thickest.
const GREEN_DENSITY: f32 = 0.42;

/// How far the surround wave reaches: two normal distributions, micrometres, and the share of the first. They stand for
/// the ring of the condenser and its image on the phase plate: the second sets the reach of the halo.
const NEAR: f32 = 0.67;
const FAR: f32 = 2.17;
const NEAR_SHARE: f32 = 0.52;

/// Pixel on which the surround is computed, micrometres: half of what it could show.
const PIXEL: f32 = 0.33;

pub(super) const FORMULA: Formula =
    Formula { source: include_str!("wave.glsl"), constants: &[("GREEN_DENSITY", &[GREEN_DENSITY])] };
pub(super) const SURROUND: Formula =
    Formula { source: include_str!("surround.glsl"), constants: &[("NEAR_SHARE", &[NEAR_SHARE])] };

/// The wave behind some matter, relative to the one behind nothing: amplitude and phase as a vector.
pub(super) fn behind(matter: Matter) -> Vec2 {
    let wave = Vec2::new(libm::cosf(matter.phase), libm::sinf(matter.phase));
    if matter.haemoglobin == 0.0 { wave } else { wave * libm::expf(-0.5 * GREEN_DENSITY * matter.haemoglobin) }
}

/// The share of green light that matter without stain lets through.
pub(super) fn transmitted(matter: Matter) -> f32 {
    if matter.haemoglobin == 0.0 { 1.0 } else { libm::expf(-GREEN_DENSITY * matter.haemoglobin) }
}

/// Pixels on which the surround wave of a picture is computed: coarse ones, of at least a side, and some beyond the picture.
pub(super) fn surround_grid(picture: &Grid, least: f32) -> Grid {
    let pixel = larger(PIXEL, least);
    let (low, high) = picture.bounds();
    let margin = Vec2::splat(3.0 * FAR + 2.0 * pixel);
    // On a lattice of the world's: what is between its points does not come and go as the camera moves.
    let (low, high) = (((low - margin) / pixel).floor(), ((high + margin) / pixel).ceil());
    let corner = Vec2::new(low.x, high.y) * pixel;
    Grid { corner, pixel, columns: (high.x - low.x) as usize, top: 0, rows: (high.y - low.y) as usize }
}

/// The weights of both distributions for a graphics card: those of the middle pixel and outwards, near and far in turn.
pub(super) fn surround_weights(pixel: f32) -> Vec<f32> {
    let (near, far) = (gaussian(NEAR / pixel), gaussian(FAR / pixel));
    let at = |weights: &[f32], k: usize| weights.get(weights.len() / 2 + k).copied().unwrap_or(0.0);
    (0..=far.len() / 2).flat_map(|k| [at(&near, k), at(&far, k)]).collect()
}

/// The surround wave over a whole picture.
#[derive(Clone, Debug)]
pub(super) struct Surround {
    grid: Grid,
    wave: Vec<Vec2>,
}

impl Surround {
    /// Of a specimen, on a [`surround_grid`].
    pub(super) fn of(specimen: &Specimen, grid: Grid) -> Self {
        let pixel = grid.pixel;
        let Plate { matter, .. } = specimen.plate(grid);
        let wave: Vec<Vec2> = matter.into_iter().map(behind).collect();
        let near = blurred(&wave, &grid, NEAR / pixel);
        let far = blurred(&wave, &grid, FAR / pixel);
        let mixed = near.iter().zip(&far).map(|(near, far)| *near * NEAR_SHARE + *far * (1.0 - NEAR_SHARE));
        Self { grid, wave: mixed.collect() }
    }

    /// At a place, from the four nearest pixels.
    pub(super) fn at(&self, place: Vec2) -> Vec2 {
        let Grid { columns, rows, .. } = self.grid;
        let at = self.grid.locate(place).clamp(Vec2::ZERO, Vec2::new((columns - 1) as f32, (rows - 1) as f32));
        let (x, y) = (at.x as usize, at.y as usize);
        let (right, below) = ((x + 1).min(columns - 1), (y + 1).min(rows - 1));
        let share = at - at.floor();
        let pick = |x: usize, y: usize| self.wave[y * columns + x];
        let upper = pick(x, y).lerp(pick(right, y), share.x);
        upper.lerp(pick(x, below).lerp(pick(right, below), share.x), share.y)
    }
}

/// Both parts of a wave blurred by a normal distribution of `sigma` pixels.
fn blurred(wave: &[Vec2], grid: &Grid, sigma: f32) -> Vec<Vec2> {
    let weights = gaussian(sigma);
    let reach = weights.len() / 2;
    let along = |k: usize, count: usize, step: usize, line: usize, from: &[Vec2]| {
        let mut sum = Vec2::ZERO;
        for (offset, weight) in weights.iter().enumerate() {
            let at = (k + offset).saturating_sub(reach).min(count - 1);
            sum += from[line + at * step] * *weight;
        }
        sum
    };
    let Grid { columns, rows, .. } = *grid;
    let across: Vec<Vec2> = (0..wave.len()).map(|k| along(k % columns, columns, 1, k - k % columns, wave)).collect();
    (0..wave.len()).map(|k| along(k / columns, rows, columns, k % columns, &across)).collect()
}
