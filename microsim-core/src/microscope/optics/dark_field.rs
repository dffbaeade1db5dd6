//! Dark field: the surround wave is stopped, and what the specimen scattered is all there is. `I = |E - S|^2`.

use super::mode::{Mode, Optics, Shader, grey};
use super::sampler::Sampler;
use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::surround_wave::Surround;

const GAIN: f32 = 2.2;
/// Light that gets past the stop.
const LEAK: f32 = 0.006;
const GAMMA: f32 = 1.0;

const GLSL: Glsl = Glsl {
    source: bare_text!("dark_field.glsl", "//"),
    constants: &[("GAIN", &[GAIN]), ("LEAK", &[LEAK]), ("GAMMA", &[GAMMA])],
};

impl Optics {
    /// Dark field: only light that the specimen turns aside.
    pub const DARK_FIELD: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "dark-field",
    is_bright: false,
    channels: 1,
    surround: Some(Surround::Wave),
    blur: 0.10,
    ground: [0.05; 3],
    grain: 0.6,
    shader: Shader::Light(shade, &GLSL),
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize) -> [f32; 3] {
    let (wave, surround) = sampler.waves(x, y);
    let light = LEAK + GAIN * (wave - surround).length_squared();
    grey(libm::powf(light, GAMMA))
}
