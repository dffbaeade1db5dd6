//! Small functions that pictures are made of. Results have the same bits on every platform.

use super::glsl::Glsl;
use crate::bare_text::bare_text;

pub(super) const GLSL: Glsl = Glsl { source: bare_text!("maths.glsl", "//"), constants: &[] };

pub(super) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

pub(super) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

pub(super) fn mix(a: f32, b: f32, share: f32) -> f32 {
    a + (b - a) * share
}

/// 0 below `low`, 1 above `high`, with no corner in between.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A bell of height 1 and width 1: `exp(-x^2)`.
pub(super) fn bell(x: f32) -> f32 {
    libm::expf(-x * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_smooth_and_bounded() {
        assert_eq!([smoothstep(1.0, 3.0, 0.0), smoothstep(1.0, 3.0, 2.0), smoothstep(1.0, 3.0, 9.0)], [0.0, 0.5, 1.0]);
    }
}
