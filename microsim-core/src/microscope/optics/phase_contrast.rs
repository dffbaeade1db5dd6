//! Phase contrast: the surround wave is weakened and set back (or ahead) by a quarter of a wave before it meets the wave
//! that the specimen scattered (Zernike 1942). Halo and shade-off come by themselves: the phase plate cannot tell the
//! surround wave from light that the specimen scatters a little. The width of the halo is `HALO_WIDTH` in `surround_wave`.
//!
//! `I = |D + T (S_y, -S_x)|^2 / T^2` with the scattered wave `D = E - S`; `-T` for negative contrast. A share `LEAK` of
//! the background is added, and light brighter than the background is bent by `SHOULDER`, as a camera does.

use super::mode::{Mode, Optics, Shader, grey};
use super::sampler::Sampler;
use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::larger;
use crate::microscope::surround_wave::Surround;

/// Amplitude that the phase plate leaves of the surround wave.
const TRANSMISSION: f32 = 0.38;
/// Grey of a field without a specimen.
const BACKGROUND: f32 = 0.40;
const GAMMA: f32 = 0.95;
/// Share of the background that comes even where waves cancel: the condenser's ring is wide.
const LEAK: f32 = 0.12;
/// How a camera's tone curve bends light that is brighter than the background.
const SHOULDER: f32 = 0.10;

const SOURCE: &str = bare_text!("phase_contrast.glsl", "//");
const POSITIVE_GLSL: Glsl = Glsl {
    source: SOURCE,
    constants: &[
        ("TRANSMISSION", &[TRANSMISSION]),
        ("BACKGROUND", &[BACKGROUND]),
        ("GAMMA", &[GAMMA]),
        ("LEAK", &[LEAK]),
        ("SHOULDER", &[SHOULDER]),
    ],
};
const NEGATIVE_GLSL: Glsl = Glsl {
    source: SOURCE,
    constants: &[
        ("TRANSMISSION", &[-TRANSMISSION]),
        ("BACKGROUND", &[BACKGROUND]),
        ("GAMMA", &[GAMMA]),
        ("LEAK", &[LEAK]),
        ("SHOULDER", &[SHOULDER]),
    ],
};

impl Optics {
    /// Positive phase contrast (Zernike 1942): what delays light is dark, with a bright halo.
    pub const PHASE_CONTRAST: Self = Self(&POSITIVE);
    /// Negative phase contrast: what delays light is bright, with a dark halo.
    pub const NEGATIVE_PHASE_CONTRAST: Self = Self(&NEGATIVE);
}

const POSITIVE: Mode = Mode {
    name: "phase-contrast",
    is_bright: false,
    channels: 1,
    surround: Some(Surround::Wave),
    blur: 0.11,
    ground: [BACKGROUND; 3],
    grain: 0.56,
    shader: Shader::Light(|sampler, x, y| shade(sampler, x, y, TRANSMISSION), &POSITIVE_GLSL),
};

const NEGATIVE: Mode = Mode {
    name: "negative-phase-contrast",
    shader: Shader::Light(|sampler, x, y| shade(sampler, x, y, -TRANSMISSION), &NEGATIVE_GLSL),
    ..POSITIVE
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize, transmission: f32) -> [f32; 3] {
    let (wave, surround) = sampler.waves(x, y);
    let image = (wave - surround) - surround.perp() * transmission;
    let intensity = image.length_squared() / (transmission * transmission);
    let light = BACKGROUND * libm::powf(LEAK + (1.0 - LEAK) * intensity, GAMMA);
    grey(light / (1.0 + SHOULDER * larger(light - BACKGROUND, 0.0)))
}
