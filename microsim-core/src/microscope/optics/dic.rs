//! Differential interference contrast: two waves a little apart are set against each other, so that slopes of the delay
//! become light and shade.
//!
//! `I = [sin((phi(x + d) - phi(x - d) + b) / 2) / sin(b / 2)]^2` with shear `d` and bias `b`.

use super::mode::{Mode, Optics, Shader, grey};
use super::sampler::Sampler;
use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use glam::Vec2;

/// Half the shear, micrometres: towards the upper left, where the light seems to come from.
const SHEAR: Vec2 = Vec2::new(-0.094, 0.094);
/// Bias, radians.
const BIAS: f32 = 0.72;
/// Grey of a field without a specimen.
const BACKGROUND: f32 = 0.43;

const GLSL: Glsl = Glsl {
    source: bare_text!("dic.glsl", "//"),
    constants: &[("SHEAR", &[SHEAR.x, SHEAR.y]), ("BIAS", &[BIAS]), ("BACKGROUND", &[BACKGROUND])],
};

impl Optics {
    /// Differential interference contrast (Nomarski): slopes of the delay, as if lit from the side.
    pub const DIC: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "dic",
    is_bright: false,
    channels: 1,
    surround: None,
    blur: 0.13,
    ground: [BACKGROUND; 3],
    grain: 1.2,
    shader: Shader::Light(shade, &GLSL),
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize) -> [f32; 3] {
    let difference = sampler.phase_beside(x, y, -SHEAR) - sampler.phase_beside(x, y, SHEAR);
    let ratio = libm::sinf(0.5 * (difference + BIAS)) / libm::sinf(0.5 * BIAS);
    grey(BACKGROUND * ratio * ratio)
}
