//! Bright field without a stain: absorption, and a little focusing by the specimen because it is never quite in focus.
//!
//! `I = exp(-OD) (1 - z Lap phi)`, the transport of intensity over a small defocus.

use super::mode::{Mode, Optics, Shader, grey};
use super::sampler::Sampler;
use crate::microscope::glsl::Glsl;
use crate::microscope::wave::transmitted;

/// Defocus over the wave number, square micrometres per radian.
const DEFOCUS: f32 = 0.026;
/// Distance over which the curvature of the delay is taken, micrometres.
const STEP: f32 = 0.21;
/// Grey of a field without a specimen.
const BACKGROUND: f32 = 0.60;

const GLSL: Glsl = Glsl {
    source: include_str!("bright_field.glsl"),
    constants: &[("DEFOCUS", &[DEFOCUS]), ("STEP", &[STEP]), ("BACKGROUND", &[BACKGROUND])],
};

impl Optics {
    /// Bright field without a stain: red cells, and whatever bends light a little out of focus.
    pub const BRIGHT_FIELD: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "bright-field",
    is_bright: true,
    channels: 1,
    surround: None,
    blur: 0.10,
    ground: [BACKGROUND; 3],
    grain: 0.7,
    shader: Shader::Light(shade, &GLSL),
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize) -> [f32; 3] {
    let matter = sampler.matter(x, y);
    let focused = (1.0 - DEFOCUS * sampler.curvature(x, y, STEP)).clamp(0.2, 2.0);
    grey(BACKGROUND * transmitted(matter) * focused)
}
