//! Fluorescence: nucleic acid shines blue (DAPI), cytoplasm green, all else stays dark.

use super::mode::{Mode, Optics, Shader};
use super::sampler::Sampler;
use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::noise::{octaves, shift_of};
use crate::microscope::surround_wave::Surround;

/// Camera's offset and autofluorescence.
const DARK: [f32; 3] = [0.030, 0.050, 0.050];
/// Share by which autofluorescence of the medium differs over a distance, micrometres.
const UNEVEN: f32 = 0.35;
const UNEVEN_SIZE: f32 = 28.0;
const UNEVEN_SEED: u32 = 0xa07;
/// Share of the light that is out of focus, and spreads around what shines.
const HAZE: f32 = 0.40;
const NUCLEUS: [f32; 3] = [0.05, 0.16, 0.95];
const CYTOPLASM: [f32; 3] = [0.03, 0.45, 0.03];

/// Condensed chromatin shines more than its amount, the more of it there is the less so: `n` shines as
/// `(1 + c) n^2 / (c + n^2)`.
const CONDENSED: f32 = 0.9;
/// How soon the camera saturates.
const SATURATION: f32 = 1.0;

const GLSL: Glsl = Glsl {
    source: bare_text!("fluorescence.glsl", "//"),
    constants: &[
        ("DARK", &DARK),
        ("HAZE", &[HAZE]),
        ("UNEVEN", &[UNEVEN]),
        ("UNEVEN_SIZE", &[UNEVEN_SIZE]),
        ("UNEVEN_SHIFT", &shift_of(UNEVEN_SEED)),
        ("NUCLEUS", &NUCLEUS),
        ("CYTOPLASM", &CYTOPLASM),
        ("CONDENSED", &[CONDENSED]),
        ("SATURATION", &[SATURATION]),
    ],
};

impl Optics {
    /// Fluorescence: nucleic acid in blue, cytoplasm in green.
    pub const FLUORESCENCE: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "fluorescence",
    is_bright: false,
    channels: 3,
    surround: Some(Surround::Emission),
    blur: 0.21,
    ground: [0.03, 0.05, 0.05],
    grain: 0.9,
    shader: Shader::Light(shade, &GLSL),
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize) -> [f32; 3] {
    let matter = sampler.matter(x, y);
    let shines = |amount: f32| if amount > 0.0 { amount } else { 0.0 };
    let haze = sampler.waves(x, y).1 * HAZE;
    let square = shines(matter.nucleus) * shines(matter.nucleus);
    let nucleus = (1.0 + CONDENSED) * square / (CONDENSED + square) + haze.x;
    let cytoplasm = shines(matter.cytoplasm) + haze.y;
    let place = sampler.raster.grid.place(x, y);
    let dark = 1.0 + UNEVEN * octaves(place / UNEVEN_SIZE, 2, UNEVEN_SEED);
    std::array::from_fn(|k| {
        let light = DARK[k] * dark + NUCLEUS[k] * nucleus + CYTOPLASM[k] * cytoplasm;
        1.0 - libm::expf(-SATURATION * light)
    })
}
