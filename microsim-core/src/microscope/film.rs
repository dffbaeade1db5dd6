//! What records the image: film with grain, weave and flicker, or a camera.

use super::glsl::Glsl;
use super::maths::{larger, mix};
use super::noise::{HashRng, grain, hash, shift, wobble};
use crate::error::{Error, in_range};
use glam::{IVec2, Vec2};

/// How the image is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Standard deviation of the grain at middle grey, as a share of white, 0 to 0.5.
    pub grain: f32,
    /// Standard deviation of the frame's place in the gate, pixels, 0 to 10.
    pub weave: f32,
    /// Standard deviation of the brightness from frame to frame, as a share, 0 to 0.5.
    pub flicker: f32,
    /// Share of the light that the corners lack, 0 to 1.
    pub vignette: f32,
    /// Level of black and of white, 0 to 1.
    pub levels: [f32; 2],
    /// Frames per second, 1 to 1000: grain, weave and flicker are new in each.
    pub rate: f32,
}

impl Film {
    /// 16 mm film, as of the 1950s.
    pub const CINE: Self =
        Self { grain: 0.024, weave: 0.25, flicker: 0.004, vignette: 0.16, levels: [0.06, 0.93], rate: 24.0 };
    /// A digital camera.
    pub const DIGITAL: Self =
        Self { grain: 0.012, weave: 0.0, flicker: 0.0, vignette: 0.06, levels: [0.0, 1.0], rate: 24.0 };

    /// Checks every number.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        in_range("grain", self.grain, 0.0, 0.5)?;
        in_range("weave", self.weave, 0.0, 10.0)?;
        in_range("flicker", self.flicker, 0.0, 0.5)?;
        in_range("vignette", self.vignette, 0.0, 1.0)?;
        in_range("levels[0]", self.levels[0], 0.0, 1.0)?;
        in_range("levels[1]", self.levels[1], 0.0, 1.0)?;
        in_range("rate", self.rate, 1.0, 1000.0)
    }

    /// One frame of it, at a time in seconds.
    pub(super) fn frame(&self, time: f64, seed: u32) -> FilmFrame {
        let number = (time * f64::from(self.rate)).floor() as i64 as i32;
        let mut rng = HashRng::new(hash(IVec2::new(number, 0), seed));
        // A slow walk of the gate and a little shake on it.
        let slow = number as f32 / 17.0;
        let walk = Vec2::new(wobble(slow, 101), wobble(slow, 102)) * 1.5;
        let shake = Vec2::new(rng.normal(), rng.normal()) * 0.3;
        let mut part = || shift(rng.bits());
        let grain = GrainShifts { fine: part(), coarse: part(), colours: [part(), part(), part()] };
        let level = 1.0 + self.flicker * rng.normal();
        FilmFrame { film: *self, grain, weave: (walk + shake) * self.weave, level }
    }
}

/// A frame of film.
#[derive(Clone, Copy, Debug)]
pub(super) struct FilmFrame {
    film: Film,
    grain: GrainShifts,
    /// By how much the picture is shifted, pixels.
    pub weave: Vec2,
    level: f32,
}

/// Which parts of the table of noise a frame's grain is.
#[derive(Clone, Copy, Debug)]
struct GrainShifts {
    fine: IVec2,
    coarse: IVec2,
    colours: [IVec2; 3],
}

/// Shares of grain of a pixel's size and of larger grain; of the grain that all colours share, and each one's own.
const FINE: f32 = 0.6;
const COARSE: f32 = 0.4;
const OWN: f32 = 0.4;

pub(super) const GLSL: Glsl =
    Glsl { source: include_str!("film.glsl"), constants: &[("FINE", &[FINE]), ("COARSE", &[COARSE])] };

impl FilmFrame {
    /// Records light at a pixel: 0 to 255 for each channel. `half` is half the picture's size.
    pub(super) fn record<const N: usize>(
        &self,
        light: [f32; N],
        x: usize,
        y: usize,
        strength: f32,
        half: Vec2,
    ) -> [u8; N] {
        let from_middle = (Vec2::new(x as f32, y as f32) + 0.5 - half) / larger(half.length(), 1.0);
        let exposure = self.level * (1.0 - self.film.vignette * from_middle.length_squared());
        let [black, white] = self.film.levels;
        let strength = self.film.grain * strength;
        let pixel = IVec2::new(x as i32, y as i32);
        let common = if strength > 0.0 { self.common_grain(pixel) } else { 0.0 };
        std::array::from_fn(|channel| {
            let light = light[channel] * exposure;
            let has_own = N > 1 && strength > 0.0;
            let own = if has_own { grain(pixel.wrapping_add(self.grain.colours[channel])) } else { 0.0 };
            // Grain is strongest in the middle greys, and never quite gone.
            let middle = larger(light * (1.15 - light), 0.01).sqrt();
            let light = light + strength * middle * (common + OWN * own);
            (mix(black, white, light) * 255.0 + 0.5).clamp(0.0, 255.0) as u8
        })
    }

    /// Grain of two sizes, standard deviation 1.
    fn common_grain(&self, pixel: IVec2) -> f32 {
        let fine = grain(pixel.wrapping_add(self.grain.fine));
        // Two by two pixels of another part, so that it is correlated over about 1.6 pixels.
        let corners = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE];
        let coarse = |corner: IVec2| grain(pixel.wrapping_add(self.grain.coarse).wrapping_add(corner));
        FINE * fine + COARSE * corners.map(coarse).iter().sum::<f32>()
    }

    /// Uniforms of [`GLSL`] for a picture of this size.
    pub(super) fn uniforms(&self, strength: f32, is_grey: bool, [width, height]: [usize; 2]) -> Vec<f32> {
        let [black, white] = self.film.levels;
        let own = if is_grey { 0.0 } else { OWN };
        let mut uniforms = vec![self.level, self.film.vignette, black, white];
        uniforms.extend([self.film.grain * strength, own, width as f32, height as f32]);
        let [red, green, blue] = self.grain.colours;
        uniforms.extend(
            [self.grain.fine, self.grain.coarse, red, green, blue].iter().flat_map(|part| part.as_vec2().to_array()),
        );
        uniforms
    }
}
