//! Bright field of a Romanowsky stain: each dye takes its colours out of white light (Beer and Lambert).
//!
//! `I_rgb = background exp(-(haemoglobin eps_1 + cytoplasm eps_2 + nucleus eps_3))`. The colours are measured ones of
//! stained smears.

use super::{Mode, Sight};

/// A field without a specimen: 198, 198, 193 of 255.
const BACKGROUND: [f32; 3] = [0.776, 0.776, 0.757];
/// Optical densities in red, green and blue: red cells, eosin and its like in cytoplasm, azure and methylene blue.
const HAEMOGLOBIN: [f32; 3] = [0.112, 0.285, 0.215];
const CYTOPLASM: [f32; 3] = [0.112, 0.251, 0.030];
const NUCLEUS: [f32; 3] = [0.36, 0.64, -0.07];

pub(super) const MODE: Mode = Mode { channels: 3, has_surround: false, blur: 0.15, grain: 0.22, shade };

fn shade(sight: &Sight<'_>, x: usize, y: usize) -> [f32; 3] {
    let matter = sight.matter(x, y);
    // A dry smear is not thicker where a living cell is: thick places saturate.
    let cytoplasm = matter.cytoplasm / (0.45 + 0.55 * matter.cytoplasm.abs());
    // The film of plasma between the cells takes a little stain, and is uneven like the glass.
    let film = 0.25 * (matter.phase - 0.9 * matter.haemoglobin - 0.85 * matter.cytoplasm).clamp(-0.2, 0.2);
    std::array::from_fn(|k| {
        let density = HAEMOGLOBIN[k] * matter.haemoglobin + CYTOPLASM[k] * cytoplasm + NUCLEUS[k] * matter.nucleus;
        BACKGROUND[k] * libm::expf(-density - 0.3 * film)
    })
}
