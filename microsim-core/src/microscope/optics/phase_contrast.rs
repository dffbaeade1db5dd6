//! Phase contrast: the surround wave is weakened and set back (or ahead) by a quarter of a wave before it meets the wave
//! that the specimen scattered (Zernike 1942). Halo and shade-off come by themselves: the phase plate cannot tell the
//! surround wave from light that the specimen scatters a little.
//!
//! `I = |D + T (S_y, -S_x)|^2 / T^2` with the scattered wave `D = E - S`; `-T` for negative contrast.

use super::{Mode, Shade, Sight, grey};
use crate::microscope::formula::Formula;

/// Amplitude that the phase plate leaves of the surround wave.
const TRANSMISSION: f32 = 0.46;
/// Grey of a field without a specimen.
const BACKGROUND: f32 = 0.40;
const GAMMA: f32 = 0.85;

const SOURCE: &str = include_str!("phase_contrast.glsl");
const POSITIVE_FORMULA: Formula = Formula {
    source: SOURCE,
    constants: &[("TRANSMISSION", &[TRANSMISSION]), ("BACKGROUND", &[BACKGROUND]), ("GAMMA", &[GAMMA])],
};
const NEGATIVE_FORMULA: Formula = Formula {
    source: SOURCE,
    constants: &[("TRANSMISSION", &[-TRANSMISSION]), ("BACKGROUND", &[BACKGROUND]), ("GAMMA", &[GAMMA])],
};

pub(super) const POSITIVE: Mode = Mode {
    channels: 1,
    has_surround: true,
    blur: 0.09,
    grain: 1.0,
    shade: Shade::Light(|sight, x, y| shade(sight, x, y, TRANSMISSION), &POSITIVE_FORMULA),
};

pub(super) const NEGATIVE: Mode =
    Mode { shade: Shade::Light(|sight, x, y| shade(sight, x, y, -TRANSMISSION), &NEGATIVE_FORMULA), ..POSITIVE };

fn shade(sight: &Sight<'_>, x: usize, y: usize, transmission: f32) -> [f32; 3] {
    let (wave, surround) = sight.waves(x, y);
    let image = (wave - surround) - surround.perp() * transmission;
    let intensity = image.length_squared() / (transmission * transmission);
    grey(BACKGROUND * libm::powf(intensity, GAMMA))
}
