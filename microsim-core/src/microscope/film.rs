//! What records the image: film with grain, weave and flicker, or a camera.

use super::maths::{larger, mix};
use super::noise::{hash, wobble};
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
    pub(super) fn frame(&self, time: f64, seed: u32) -> Frame {
        let number = (time * f64::from(self.rate)).floor() as i64 as i32;
        let seed = hash(IVec2::new(number, 0), seed);
        Frame { film: *self, seed, weave: self.weave_at(number, seed), level: 1.0 + self.flicker * normal(seed ^ 5) }
    }

    /// A slow walk of the gate and a little shake on it, pixels.
    fn weave_at(&self, number: i32, seed: u32) -> Vec2 {
        let slow = number as f32 / 17.0;
        let walk = Vec2::new(wobble(slow, 101), wobble(slow, 102)) * 1.5;
        (walk + Vec2::new(normal(seed ^ 1), normal(seed ^ 2)) * 0.3) * self.weave
    }
}

/// A frame of film.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    film: Film,
    seed: u32,
    /// By how much the picture is shifted, pixels.
    pub weave: Vec2,
    level: f32,
}

impl Frame {
    /// Records light at a pixel: 0 to 255 for each channel. `half` is half the picture's size.
    pub(super) fn record<const N: usize>(
        &self,
        light: [f32; N],
        x: usize,
        y: usize,
        grain: f32,
        half: Vec2,
    ) -> [u8; N] {
        let from_middle = (Vec2::new(x as f32, y as f32) + 0.5 - half) / larger(half.length(), 1.0);
        let exposure = self.level * (1.0 - self.film.vignette * from_middle.length_squared());
        let [black, white] = self.film.levels;
        let strength = self.film.grain * grain;
        let common = if strength > 0.0 { self.grain(x as i32, y as i32) } else { 0.0 };
        let mut channel = 0;
        light.map(|light| {
            channel += 1;
            let light = light * exposure;
            let own = if N > 1 && strength > 0.0 {
                normal(hash(IVec2::new(x as i32, y as i32), self.seed ^ (channel << 8)))
            } else {
                0.0
            };
            // Grain is strongest in the middle greys, and never quite gone.
            let middle = larger(light * (1.15 - light), 0.01).sqrt();
            let light = light + strength * middle * (common + 0.4 * own);
            (mix(black, white, light) * 255.0 + 0.5).clamp(0.0, 255.0) as u8
        })
    }

    /// Grain of two sizes, standard deviation 1.
    fn grain(&self, x: i32, y: i32) -> f32 {
        let at = |x: i32, y: i32, salt: u32| normal(hash(IVec2::new(x, y), self.seed ^ salt));
        let fine = at(x, y, 3);
        // Coarse grain: 2 x 2 pixels of another lattice, so that it is correlated over about 1.6 pixels.
        let coarse = at(x, y, 4) + at(x + 1, y, 4) + at(x, y + 1, 4) + at(x + 1, y + 1, 4);
        0.6 * fine + 0.4 * coarse
    }
}

/// Nearly normal, mean 0 and standard deviation 1, from 32 bits.
fn normal(bits: u32) -> f32 {
    let [a, b, c, d] = bits.to_le_bytes().map(f32::from);
    ((a + b + c + d) / 255.0 - 2.0) * 1.732
}
