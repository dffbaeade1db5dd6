//! Bright field of a Romanowsky stain: each dye takes its colours out of white light (Beer and Lambert).
//!
//! `I_rgb = background exp(-(haemoglobin eps_1 + cytoplasm eps_2 + nucleus eps_3)) (1 - z_rgb Lap phi)`. The colours are
//! measured ones of stained smears. `z_rgb` is the defocus that remains: a simple objective does not focus all colours in
//! one plane, which puts a faint coloured line along every edge.

use super::{Mode, Shade, Sight};
use crate::microscope::noise::octaves;

/// A field without a specimen: 198, 198, 193 of 255.
const BACKGROUND: [f32; 3] = [0.776, 0.780, 0.757];
/// Optical densities in red, green and blue: red cells, eosin and its like in cytoplasm, azure and methylene blue.
const HAEMOGLOBIN: [f32; 3] = [0.100, 0.245, 0.195];
const CYTOPLASM: [f32; 3] = [0.112, 0.251, 0.020];
const NUCLEUS: [f32; 3] = [0.26, 0.46, -0.10];
/// What dries on the glass between the cells: plasma with a little of each dye, and none where it was washed off.
const PLASMA: [f32; 3] = [0.030, 0.014, 0.055];
/// Defocus over the wave number in red, green and blue, square micrometres per radian.
const DEFOCUS: [f32; 3] = [0.0030, 0.0055, -0.0015];
/// Distance over which the curvature of the delay is taken, micrometres.
const STEP: f32 = 0.15;

pub(super) const MODE: Mode =
    Mode { channels: 3, has_surround: false, blur: 0.15, grain: 0.25, shade: Shade::Light(shade) };

fn shade(sight: &Sight<'_>, x: usize, y: usize) -> [f32; 3] {
    let matter = sight.matter(x, y);
    // A dry smear is not thicker where a living cell is: thick places saturate, and the middle of a red cell sinks in.
    let cytoplasm = matter.cytoplasm / (0.45 + 0.55 * matter.cytoplasm.abs());
    let haemoglobin = matter.haemoglobin * matter.haemoglobin.abs().sqrt();
    let plasma = octaves(sight.plate.grid.place(x, y) / 9.0, 3, 0x57a1);
    let curvature = sight.curvature(x, y, STEP).clamp(-20.0, 20.0);
    std::array::from_fn(|k| {
        let dyes = HAEMOGLOBIN[k] * haemoglobin + CYTOPLASM[k] * cytoplasm + NUCLEUS[k] * matter.nucleus;
        BACKGROUND[k] * libm::expf(-dyes - PLASMA[k] * plasma) * (1.0 - DEFOCUS[k] * curvature)
    })
}
