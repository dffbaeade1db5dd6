//! What there is besides organisms: uneven glass, dust, and things far out of focus. It fills the plane; nothing of it
//! is stored.

use super::spot::Spot;
use crate::look::SpotShape;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::smoothstep;
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::noise::{HashRng, hash, octaves, shift_of, wobble};
use crate::microscope::recipe::{DrawList, Program, QUAD};
use glam::{IVec2, Vec2};

/// Side of the cells in which dust is strewn, micrometres, and specks in each on average.
const DUST_CELL: f32 = 5.0;
const DUST: f32 = 1.0;
/// The same for what is out of focus.
const FAR_CELL: f32 = 26.0;
const FAR: f32 = 0.75;
/// Share of the camera's movement that things out of focus seem to make.
const PARALLAX: f32 = 0.15;
/// Pixels from and to which dust fades because it is too small to be seen, and those where the other things are,
/// micrometres.
const DUST_FADES: [f32; 2] = [0.3, 0.6];
const FAR_ENDS: f32 = 2.0;
/// Strength and size of the glass's unevenness, radians and micrometres.
const FINE: f32 = 0.018;
const FINE_SIZE: f32 = 1.2;
const COARSE: f32 = 0.05;
const COARSE_SIZE: f32 = 15.0;

pub(in crate::microscope) const GLSL: Glsl = Glsl {
    source: include_str!("background.glsl"),
    constants: &[
        ("FINE", &[FINE]),
        ("FINE_SIZE", &[FINE_SIZE]),
        ("COARSE", &[COARSE]),
        ("COARSE_SIZE", &[COARSE_SIZE]),
    ],
};

/// The background of one picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct BackgroundMatter {
    pub seed: u32,
    pub time: f32,
    /// What the camera looks at.
    pub camera: Vec2,
}

impl BackgroundMatter {
    pub(super) fn draw(&self, raster: &mut MatterRaster) {
        let grid = raster.grid;
        // Features below a pixel would alias.
        let fine = FINE * smoothstep(1.2, 0.3, grid.pixel);
        let coarse = COARSE * smoothstep(15.0, 4.0, grid.pixel);
        for y in 0..grid.rows {
            for x in 0..grid.columns {
                let place = grid.place(x, y);
                let slow = if coarse > 0.0 { coarse * octaves(place / COARSE_SIZE, 3, self.seed) } else { 0.0 };
                let quick = if fine > 0.0 { fine * octaves(place / FINE_SIZE, 3, self.seed ^ 9) } else { 0.0 };
                raster.matter[y * grid.columns + x].phase += slow + quick;
            }
        }
        self.each_spot(grid.bounds(), grid.pixel, |spot| spot.draw(raster));
    }

    /// Its triangles, for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList, bias: [f32; 4]) {
        let mut uniforms = bias.to_vec();
        uniforms.extend([shift_of(self.seed), shift_of(self.seed ^ 9)].concat());
        let corners = [-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0];
        draws.add_apart(Program::Background, &corners, QUAD.to_vec(), uniforms, None);
        self.each_spot(draws.bounds(), draws.pixel(), |spot| spot.draw_on(draws));
    }

    /// Dust, and what is out of focus, in a box.
    fn each_spot(&self, bounds: (Vec2, Vec2), pixel: f32, mut visit: impl FnMut(Spot)) {
        let strength = smoothstep(DUST_FADES[1], DUST_FADES[0], pixel);
        if strength > 0.0 {
            let speck = |at, rng: &mut HashRng| self.speck(at, strength, rng);
            strewn(bounds, Vec2::ZERO, DUST_CELL, DUST, self.seed ^ 21, speck, &mut visit);
        }
        if pixel < FAR_ENDS {
            let shift = self.camera * PARALLAX;
            strewn(bounds, shift, FAR_CELL, FAR, self.seed ^ 22, |at, rng| self.far(at, rng), &mut visit);
        }
    }

    /// Dust: mostly tiny, some denser than the medium and some less.
    fn speck(&self, at: Vec2, strength: f32, rng: &mut HashRng) -> Spot {
        let size = rng.unit();
        let radius = 0.06 + 0.34 * size * size * size * size;
        let sign = if rng.unit() < 0.65 { strength } else { -strength };
        let matter = Matter { nucleus: 0.04 * sign, ..Matter::phase(sign * rng.range([0.08, 0.32])) };
        Spot { at, radius, matter, shape: SpotShape::Bump }
    }

    /// A cell or a clump above or below the plane of focus: a soft shadow that drifts slowly.
    fn far(&self, at: Vec2, rng: &mut HashRng) -> Spot {
        let seed = rng.bits();
        let drift = Vec2::new(wobble(self.time / 25.0, seed), wobble(self.time / 25.0, seed ^ 1)) * 3.0;
        let radius = rng.range([3.0, 5.0]);
        let matter = Matter { haemoglobin: 0.05, ..Matter::phase(rng.range([0.12, 0.34])) };
        Spot { at: at + drift, radius, matter, shape: SpotShape::Bump }
    }
}

/// Visits what lies in the cells of an endless square grid that a box touches; `shift` moves the grid.
fn strewn(
    (low, high): (Vec2, Vec2),
    shift: Vec2,
    cell: f32,
    expected: f32,
    seed: u32,
    spot: impl Fn(Vec2, &mut HashRng) -> Spot,
    visit: &mut impl FnMut(Spot),
) {
    let [first, last] = [low, high].map(|corner| ((corner - shift) / cell).floor().as_ivec2());
    for j in first.y - 1..=last.y + 1 {
        for i in first.x - 1..=last.x + 1 {
            let mut rng = HashRng::new(hash(IVec2::new(i, j), seed));
            let count = (2.0 * expected * rng.unit() + 0.5) as u32;
            for _ in 0..count {
                let at = (Vec2::new(i as f32, j as f32) + Vec2::new(rng.unit(), rng.unit())) * cell + shift;
                visit(spot(at, &mut rng));
            }
        }
    }
}
