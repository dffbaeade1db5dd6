//! Bright field without a stain: absorption, and a little focusing by the specimen because it is never quite in focus.
//!
//! `I = exp(-OD) (1 - z Lap phi)`, the transport of intensity over a small defocus.

use super::{Mode, Shade, Sight, grey};
use crate::microscope::formula::Formula;
use crate::microscope::wave::transmitted;

/// Defocus over the wave number, square micrometres per radian.
const DEFOCUS: f32 = 0.016;
/// Distance over which the curvature of the delay is taken, micrometres.
const STEP: f32 = 0.13;
/// Grey of a field without a specimen.
const BACKGROUND: f32 = 0.60;

const FORMULA: Formula = Formula {
    source: include_str!("bright_field.glsl"),
    constants: &[("DEFOCUS", &[DEFOCUS]), ("STEP", &[STEP]), ("BACKGROUND", &[BACKGROUND])],
};

pub(super) const MODE: Mode =
    Mode { channels: 1, has_surround: false, blur: 0.10, grain: 0.7, shade: Shade::Light(shade, &FORMULA) };

fn shade(sight: &Sight<'_>, x: usize, y: usize) -> [f32; 3] {
    let matter = sight.matter(x, y);
    let focused = (1.0 - DEFOCUS * sight.curvature(x, y, STEP)).clamp(0.2, 2.0);
    grey(BACKGROUND * transmitted(matter) * focused)
}
