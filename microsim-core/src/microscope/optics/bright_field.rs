//! Bright field without a stain: absorption, and focusing by the specimen because it is never quite in focus.
//!
//! `I = [|E + i f (E - S)|^2 (1 - z f Lap phi)]^1.5`: details of the wave are set back by defocus, coarse ones by the first
//! factor and fine ones, as the transport of intensity, by the second. The slide is not quite level: `f` goes by place.

use super::mode::{Mode, Optics, Shader, grey};
use super::sampler::Sampler;
use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::noise::{octaves, shift_of};
use crate::microscope::surround_wave::Surround;

/// Defocus over the wave number for each unit of `f`, square micrometres per radian.
const DEFOCUS: f32 = 0.022;
/// Distance over which the curvature of the delay is taken, micrometres.
const STEP: f32 = 0.24;
/// Largest `f`, the noise at which it is half of that, and the distance over which it changes, micrometres.
const FOCUS: [f32; 3] = [1.1, 0.18, 110.0];
const FOCUS_SEED: u32 = 0xf0c5;
/// Mottling of the light by what lies far above and below the specimen, as a share, and its size, micrometres.
const MOTTLE: [f32; 2] = [0.024, 0.9];
/// Grey of a field without a specimen.
const BACKGROUND: f32 = 0.60;

const GLSL: Glsl = Glsl {
    source: bare_text!("bright_field.glsl", "//"),
    constants: &[
        ("DEFOCUS", &[DEFOCUS]),
        ("STEP", &[STEP]),
        ("FOCUS", &FOCUS),
        ("FOCUS_SHIFT", &shift_of(FOCUS_SEED)),
        ("MOTTLE", &MOTTLE),
        ("BACKGROUND", &[BACKGROUND]),
    ],
};

impl Optics {
    /// Bright field without a stain: red cells, and whatever bends light a little out of focus.
    pub const BRIGHT_FIELD: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "bright-field",
    is_bright: true,
    channels: 1,
    surround: Some(Surround::Wave),
    blur: 0.21,
    ground: [BACKGROUND; 3],
    grain: 0.75,
    shader: Shader::Light(shade, &GLSL),
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize) -> [f32; 3] {
    let (wave, surround) = sampler.waves(x, y);
    let [largest, half, size] = FOCUS;
    let place = sampler.raster.grid.place(x, y);
    let noise = octaves(place / size, 1, FOCUS_SEED);
    let mottle = 1.0 + MOTTLE[0] * octaves(place / MOTTLE[1], 2, FOCUS_SEED);
    let focus = largest * noise / (noise.abs() + half);
    let focused = (1.0 - DEFOCUS * focus * sampler.curvature(x, y, STEP)).clamp(0.2, 2.0);
    // A camera's contrast.
    let light = (wave + (wave - surround).perp() * focus).length_squared() * focused;
    grey(BACKGROUND * mottle * light * light.sqrt())
}
