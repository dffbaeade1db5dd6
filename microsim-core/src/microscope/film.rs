//! What records the image: film with grain, weave and flicker, or a camera.

use super::glsl::Glsl;
use super::maths::{larger, mix};
use super::noise::{HashRng, grain, hash, shift, three_grains, wobble};
use super::optics::Mode;
use super::raster::gaussian;
use crate::bare_text::bare_text;
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
    /// Strength of blotches of colour relative to the grain, 0 to 4: a sensor sees one colour with each of its pixels.
    pub blotches: f32,
    /// Share of the light that comes from all of the field, because lenses scatter it, 0 to 0.5. By how much slides differ in
    /// stain, light and focus goes by it: 0 leaves that out, too.
    pub glare: f32,
    /// Share by which the light grows from the middle to half the picture's diagonal away, standard deviation along each axis,
    /// 0 to 0.5. Broad shadows are up to four times as deep.
    pub gradient: f32,
    /// Deepest shadow of dust near the sensor, as a share of the light, 0 to 1.
    pub dust: f32,
    /// Sharpening by an unsharp mask along rows and then along columns: share of the difference that is added each time, 0 to 2.
    pub sharpening: f32,
    /// Whether a pixel of the sensor sees one colour and the others are interpolated, in optics with colours. Pictures that a card
    /// draws leave it out.
    pub has_mosaic: bool,
    /// Quality of lossy coding ([`coding`](super::coding)), 1 to 100; 0: none. Pictures that a card draws leave it out.
    pub coding_quality: u8,
}

impl Film {
    /// 16 mm film, as of the 1950s.
    pub const CINE: Self = Self {
        grain: 0.024,
        weave: 0.25,
        flicker: 0.004,
        vignette: 0.16,
        levels: [0.06, 0.93],
        rate: 24.0,
        blotches: 0.4,
        glare: 0.04,
        gradient: 0.02,
        dust: 0.10,
        sharpening: 0.0,
        has_mosaic: false,
        coding_quality: 0,
    };
    /// A digital camera.
    pub const DIGITAL: Self = Self {
        grain: 0.019,
        weave: 0.0,
        flicker: 0.0,
        vignette: 0.06,
        levels: [0.0, 1.0],
        rate: 24.0,
        blotches: 1.0,
        glare: 0.035,
        gradient: 0.025,
        dust: 0.11,
        sharpening: 0.25,
        has_mosaic: false,
        coding_quality: 0,
    };
    /// A colour camera on a microscope, as its files are: grain is that of its sensor's pixels.
    pub const PHOTO: Self = Self {
        grain: 0.025,
        blotches: 0.58,
        dust: 0.22,
        sharpening: 0.45,
        has_mosaic: true,
        coding_quality: 75,
        ..Self::DIGITAL
    };

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
        in_range("rate", self.rate, 1.0, 1000.0)?;
        in_range("blotches", self.blotches, 0.0, 4.0)?;
        in_range("glare", self.glare, 0.0, 0.5)?;
        in_range("gradient", self.gradient, 0.0, 0.5)?;
        in_range("dust", self.dust, 0.0, 1.0)?;
        in_range("sharpening", self.sharpening, 0.0, 2.0)?;
        in_range("coding_quality", f32::from(self.coding_quality), 0.0, 100.0)
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
        let grain = GrainShifts { fine: part(), coarse: part(), blotches: part() };
        let level = 1.0 + self.flicker * rng.normal();
        let (camera, slide) = (Camera::of(self, seed), Slide::of(self, seed));
        FilmFrame { film: *self, grain, weave: (walk + shake) * self.weave, level, camera, slide }
    }
}

/// In what slides differ, and how they were taken: stain or contrast, light, and focus.
#[derive(Clone, Copy, Debug)]
struct Slide {
    /// Glare in each colour; where it is negative, a stain is strong.
    glare: [f32; 3],
    light: [f32; 3],
    /// Blur of the lens relative to that of its kind of optics.
    blur: f32,
}

impl Slide {
    /// Spreads go by the film's glare, so that a film without it shows the optics alone.
    fn of(film: &Film, seed: u32) -> Self {
        let mut rng = HashRng::new(seed ^ 0x511d);
        let (strong, bright, dull) = (rng.normal(), rng.normal(), rng.unit());
        let [glare, light] = [(STAINS, strong, STAINS), (LIGHTS[0], bright, LIGHTS[1])]
            .map(|(all, common, each)| [(); 3].map(|()| film.glare * (all * common + each * rng.normal())));
        let blur = 1.0 + film.glare * mix(DULL[0], DULL[1], dull * dull);
        Self { glare: glare.map(|part| film.glare + part), light: light.map(|part| 1.0 + part), blur }
    }
}

/// What stays from frame to frame: uneven light, and dust. Lengths are shares of half the picture's diagonal.
#[derive(Clone, Copy, Debug)]
struct Camera {
    /// By how much the light grows from the middle on.
    gradient: Vec2,
    shadows: [Shadow; SHADOWS],
}

/// A shadow of dust.
#[derive(Clone, Copy, Debug)]
struct Shadow {
    at: Vec2,
    radius: f32,
    depth: f32,
}

impl Camera {
    fn of(film: &Film, seed: u32) -> Self {
        let mut rng = HashRng::new(seed ^ 0xd057);
        let gradient = Vec2::new(rng.normal(), rng.normal()) * film.gradient;
        let mut shadow = |k: usize| {
            let at = Vec2::new(rng.range([-0.9, 0.9]), rng.range([-0.7, 0.7]));
            let (size, share) = (rng.unit(), rng.unit());
            if k < GRAINS_OF_DUST {
                // Most are hardly seen.
                Shadow { at, radius: mix(0.010, 0.040, size * size), depth: film.dust * share * share * share }
            } else {
                Shadow { at, radius: mix(0.4, 1.0, size), depth: UNEVEN * film.gradient * share }
            }
        };
        Self { gradient, shadows: std::array::from_fn(&mut shadow) }
    }

    /// Light at a place, 1 in the middle of an even field.
    fn light(&self, from_middle: Vec2) -> f32 {
        self.shadows.iter().enumerate().fold(1.0 + self.gradient.dot(from_middle), |light, (k, shadow)| {
            let apart = (from_middle - shadow.at).length_squared() / (shadow.radius * shadow.radius);
            let inside = larger(1.0 - apart, 0.0);
            // A grain bends light into its middle.
            let ring = if k < GRAINS_OF_DUST { RING * (1.0 - inside) } else { 1.0 };
            light * (1.0 - shadow.depth * ring * inside * inside)
        })
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
    camera: Camera,
    slide: Slide,
}

/// Which parts of the table of noise a frame's grain is.
#[derive(Clone, Copy, Debug)]
struct GrainShifts {
    fine: IVec2,
    coarse: IVec2,
    blotches: IVec2,
}

/// Spread of stains, spreads of the light of all colours and of each, and least and most blur beyond that of the optics,
/// each in the film's glare.
const STAINS: f32 = 2.6;
const LIGHTS: [f32; 2] = [1.3, 0.35];
const DULL: [f32; 2] = [-5.0, 18.0];
/// Shares of grain of a pixel's size and of larger grain.
const FINE: f32 = 0.95;
const COARSE: f32 = 0.12;
/// Grain of each colour's own, in blotches of some pixels: a sensor has least blue light, and its noise is smoothed most.
const BLOTCHES: [f32; 3] = [0.4, 0.2, 2.6];
const BLOTCH_SIZE: f32 = 6.0;
const DARK_BLOTCHES: f32 = 0.2;
/// Shadows of dust, and all shadows: the others are broad and shallow, where the condenser lights the field less.
const GRAINS_OF_DUST: usize = 6;
pub(super) const SHADOWS: usize = 8;
/// Strength of the rings that grains of dust are, in their depth.
const RING: f32 = 8.0;
/// Deepest of the broad ones, in the light's growth from the middle on.
const UNEVEN: f32 = 4.0;
/// Standard deviation of the unsharp mask, pixels of the picture.
pub(super) const MASK: f32 = 1.3;

pub(super) const GLSL: Glsl = Glsl {
    source: bare_text!("film.glsl", "//"),
    constants: &[
        ("FINE", &[FINE]),
        ("COARSE", &[COARSE]),
        ("BLOTCHES", &BLOTCHES),
        ("BLOTCH_SIZE", &[BLOTCH_SIZE]),
        ("GRAINS_OF_DUST", &[GRAINS_OF_DUST as f32]),
        ("RING", &[RING]),
    ],
};

impl FilmFrame {
    /// Records light at a pixel: 0 to 255 for each channel. `half` is half the picture's size.
    pub(super) fn record<const N: usize>(
        &self,
        light: [f32; N],
        x: usize,
        y: usize,
        mode: &Mode,
        half: Vec2,
    ) -> [u8; N] {
        let from_middle = (Vec2::new(x as f32, y as f32) + 0.5 - half) / larger(half.length(), 1.0);
        let falloff = 1.0 - self.film.vignette * from_middle.length_squared();
        let exposure = self.level * falloff * self.camera.light(from_middle);
        let [black, white] = self.film.levels;
        let strength = self.film.grain * mode.grain;
        let grain = if strength > 0.0 {
            self.grain::<N>(IVec2::new(x as i32, y as i32), self.blotches(mode))
        } else {
            [0.0; N]
        };
        std::array::from_fn(|channel| {
            let light = mix(light[channel], mode.ground[channel], self.slide.glare[channel]);
            let light = light * exposure * self.slide.light[channel];
            // Grain is strongest in the middle greys, and never quite gone.
            let middle = larger(light * (1.15 - light), 0.01).sqrt();
            let light = light + strength * middle * grain[channel];
            (mix(black, white, light) * 255.0 + 0.5).clamp(0.0, 255.0) as u8
        })
    }

    /// Strength of blotches; a camera that takes dark fields sees colours one after the other.
    fn blotches(&self, mode: &Mode) -> f32 {
        match (mode.channels, mode.is_bright) {
            (1, _) => 0.0,
            (_, true) => self.film.blotches,
            (_, false) => DARK_BLOTCHES * self.film.blotches,
        }
    }

    /// Grain of two sizes, standard deviation 1, and blotches of colour on it.
    fn grain<const N: usize>(&self, pixel: IVec2, blotches: f32) -> [f32; N] {
        let fine = grain(pixel.wrapping_add(self.grain.fine));
        // Two by two pixels of another part, so that it is correlated over about 1.6 pixels.
        let corners = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE];
        let coarse = |corner: IVec2| grain(pixel.wrapping_add(self.grain.coarse).wrapping_add(corner));
        let common = FINE * fine + COARSE * corners.map(coarse).iter().sum::<f32>();
        let own = if N > 1 { three_grains(pixel.as_vec2() / BLOTCH_SIZE, self.grain.blotches) } else { [0.0; 3] };
        std::array::from_fn(|channel| common + blotches * BLOTCHES[channel] * own[channel])
    }

    /// Blur of the lens on this slide, micrometres.
    pub(super) fn blur(&self, mode: &Mode) -> f32 {
        mode.blur * self.slide.blur
    }

    /// The blur of a lens of this standard deviation and the camera's sharpening, both in pixels of `pixel` of the picture's.
    pub(super) fn kernel(&self, sigma: f32, pixel: f32) -> Vec<f32> {
        let mask = MASK / pixel;
        let blurred = gaussian((sigma * sigma + mask * mask).sqrt());
        if self.film.sharpening == 0.0 {
            return gaussian(sigma);
        }
        let sharp = gaussian(sigma);
        let margin = (blurred.len() - sharp.len()) / 2;
        let sharp_at = |k: usize| k.checked_sub(margin).and_then(|k| sharp.get(k)).copied().unwrap_or(0.0);
        let amount = self.film.sharpening;
        blurred.iter().enumerate().map(|(k, blurred)| (1.0 + amount) * sharp_at(k) - amount * blurred).collect()
    }

    /// Uniforms of [`GLSL`] for a picture of this size.
    pub(super) fn uniforms(&self, mode: &Mode, [width, height]: [usize; 2]) -> Vec<f32> {
        let [black, white] = self.film.levels;
        let mut uniforms = vec![self.level, self.film.vignette, black, white];
        uniforms.extend([self.film.grain * mode.grain, self.blotches(mode), width as f32, height as f32]);
        let GrainShifts { fine, coarse, blotches } = self.grain;
        uniforms.extend([fine, coarse, blotches].iter().flat_map(|part| part.as_vec2().to_array()));
        // What is grey is recorded as its first channel is.
        let colours = |own: [f32; 3]| std::array::from_fn(|k| own[k.min(mode.channels - 1)]);
        uniforms.extend([mode.ground, colours(self.slide.glare), colours(self.slide.light)].concat());
        uniforms.extend(self.camera.gradient.to_array());
        let shadow = |shadow: &Shadow| [shadow.at.x, shadow.at.y, shadow.radius, shadow.depth];
        uniforms.extend(self.camera.shadows.iter().flat_map(shadow));
        uniforms
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sharpening_keeps_the_light() {
        let frame = Film::DIGITAL.frame(0.0, 7);
        for sigma in [0.0, 0.8, 4.0] {
            let kernel = frame.kernel(sigma, 0.5);
            assert!((kernel.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{sigma}");
            assert!(kernel.len() % 2 == 1 && kernel.iter().any(|weight| *weight < 0.0), "{sigma}");
        }
        let dull = Film { sharpening: 0.0, ..Film::DIGITAL }.frame(0.0, 7);
        assert_eq!(dull.kernel(2.0, 0.5), gaussian(2.0));
    }

    #[test]
    fn dust_and_uneven_light_stay_from_frame_to_frame() {
        let light = |time, seed| {
            let camera = Film::DIGITAL.frame(time, seed).camera;
            [Vec2::ZERO, Vec2::new(0.4, -0.3), camera.shadows[0].at + 0.7 * camera.shadows[0].radius]
                .map(|place| camera.light(place))
        };
        assert_eq!(light(0.0, 7), light(3.0, 7));
        assert_ne!(light(0.0, 7), light(0.0, 8));
        let clean = Film { dust: 0.0, gradient: 0.0, ..Film::DIGITAL }.frame(0.0, 7).camera;
        assert_eq!(clean.light(clean.shadows[0].at), 1.0);
        let dusty = Film { gradient: 0.0, ..Film::DIGITAL }.frame(0.0, 7).camera;
        let Shadow { at, radius, .. } = dusty.shadows[0];
        assert!(dusty.light(at + Vec2::X * (0.7 * radius)) < 1.0);
    }
}
