//! Bright field of a Romanowsky stain: each dye takes its colours out of white light (Beer and Lambert).
//!
//! `I_rgb = background exp(-(haemoglobin eps_1 + cytoplasm eps_2 + nucleus eps_3)) (1 - z_rgb Lap phi)`. The colours are
//! measured ones of stained smears. `z_rgb` is the defocus that remains: a simple objective does not focus all colours in
//! one plane, which puts a faint coloured line along every edge.

use super::mode::{Mode, Optics, Shader};
use super::sampler::Sampler;
use crate::microscope::glsl::Glsl;
use crate::microscope::noise::{octaves, shift_of};

/// A field without a specimen: 198, 198, 193 of 255.
const BACKGROUND: [f32; 3] = [0.776, 0.780, 0.757];
/// Optical densities in red, green and blue: red cells, eosin and its like in cytoplasm, azure and methylene blue.
const HAEMOGLOBIN: [f32; 3] = [0.100, 0.258, 0.205];
const CYTOPLASM: [f32; 3] = [0.112, 0.251, 0.020];
const NUCLEUS: [f32; 3] = [0.29, 0.52, -0.10];
/// What dries on the glass between the cells: plasma with a little of each dye, and none where it was washed off.
const PLASMA: [f32; 3] = [0.052, 0.020, 0.112];
/// Defocus over the wave number in red, green and blue, square micrometres per radian.
const DEFOCUS: [f32; 3] = [0.0030, 0.0055, -0.0015];
/// Distance over which the curvature of the delay is taken, micrometres.
const STEP: f32 = 0.15;

/// Size of its blotches, micrometres, and the noise that they are.
const PLASMA_SIZE: f32 = 9.0;
const PLASMA_SEED: u32 = 0x57a1;
/// A dry smear is not thicker where a living cell is: cytoplasm counts as `c / (DRY[0] + DRY[1] c)`.
const DRY: [f32; 2] = [0.45, 0.55];

const GLSL: Glsl = Glsl {
    source: include_str!("stained.glsl"),
    constants: &[
        ("BACKGROUND", &BACKGROUND),
        ("HAEMOGLOBIN", &HAEMOGLOBIN),
        ("CYTOPLASM", &CYTOPLASM),
        ("NUCLEUS", &NUCLEUS),
        ("PLASMA", &PLASMA),
        ("DEFOCUS", &DEFOCUS),
        ("STEP", &[STEP]),
        ("DRY", &DRY),
        ("PLASMA_SIZE", &[PLASMA_SIZE]),
        ("PLASMA_SHIFT", &shift_of(PLASMA_SEED)),
    ],
};

impl Optics {
    /// Bright field of a smear in a Romanowsky stain, such as Wright's.
    pub const STAINED: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "stained",
    is_bright: true,
    channels: 3,
    has_surround: false,
    blur: 0.12,
    grain: 0.25,
    shader: Shader::Light(shade, &GLSL),
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize) -> [f32; 3] {
    let matter = sampler.matter(x, y);
    let cytoplasm = matter.cytoplasm / (DRY[0] + DRY[1] * matter.cytoplasm.abs());
    // The middle of a dry red cell sinks in.
    let haemoglobin = matter.haemoglobin * matter.haemoglobin.abs().sqrt();
    let plasma = octaves(sampler.raster.grid.place(x, y) / PLASMA_SIZE, 3, PLASMA_SEED);
    let curvature = sampler.curvature(x, y, STEP).clamp(-20.0, 20.0);
    std::array::from_fn(|k| {
        let dyes = HAEMOGLOBIN[k] * haemoglobin + CYTOPLASM[k] * cytoplasm + NUCLEUS[k] * matter.nucleus;
        BACKGROUND[k] * libm::expf(-dyes - PLASMA[k] * plasma) * (1.0 - DEFOCUS[k] * curvature)
    })
}
