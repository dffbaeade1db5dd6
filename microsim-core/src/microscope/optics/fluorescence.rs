//! Fluorescence: nucleic acid shines blue (DAPI), cytoplasm green, all else stays dark.

use super::{Mode, Shade, Sight};
use crate::microscope::formula::Formula;

/// Camera's offset and autofluorescence.
const DARK: [f32; 3] = [0.012, 0.014, 0.016];
const NUCLEUS: [f32; 3] = [0.10, 0.36, 1.10];
const CYTOPLASM: [f32; 3] = [0.02, 0.34, 0.05];

/// How soon the camera saturates.
const SATURATION: f32 = 1.15;

const FORMULA: Formula = Formula {
    source: include_str!("fluorescence.glsl"),
    constants: &[("DARK", &DARK), ("NUCLEUS", &NUCLEUS), ("CYTOPLASM", &CYTOPLASM), ("SATURATION", &[SATURATION])],
};

pub(super) const MODE: Mode =
    Mode { channels: 3, has_surround: false, blur: 0.17, grain: 0.5, shade: Shade::Light(shade, &FORMULA) };

fn shade(sight: &Sight<'_>, x: usize, y: usize) -> [f32; 3] {
    let matter = sight.matter(x, y);
    let shines = |amount: f32| if amount > 0.0 { amount } else { 0.0 };
    let (nucleus, cytoplasm) = (shines(matter.nucleus), shines(matter.cytoplasm));
    std::array::from_fn(|k| {
        let light = DARK[k] + NUCLEUS[k] * nucleus + CYTOPLASM[k] * cytoplasm;
        1.0 - libm::expf(-SATURATION * light)
    })
}
