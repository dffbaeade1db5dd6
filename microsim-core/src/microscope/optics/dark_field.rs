//! Dark field: the surround wave is stopped, and what the specimen scattered is all there is. `I = |E - S|^2`.

use super::{Mode, Shade, Sight, grey};
use crate::microscope::formula::Formula;

const GAIN: f32 = 2.2;
/// Light that gets past the stop.
const LEAK: f32 = 0.006;
const GAMMA: f32 = 1.0;

const FORMULA: Formula = Formula {
    source: include_str!("dark_field.glsl"),
    constants: &[("GAIN", &[GAIN]), ("LEAK", &[LEAK]), ("GAMMA", &[GAMMA])],
};

pub(super) const MODE: Mode =
    Mode { channels: 1, has_surround: true, blur: 0.10, grain: 0.6, shade: Shade::Light(shade, &FORMULA) };

fn shade(sight: &Sight<'_>, x: usize, y: usize) -> [f32; 3] {
    let (wave, surround) = sight.waves(x, y);
    let light = LEAK + GAIN * (wave - surround).length_squared();
    grey(libm::powf(light, GAMMA))
}
