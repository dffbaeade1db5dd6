//! Small functions that pictures are made of. Results have the same bits on every platform.

use super::formula::Formula;

pub(super) const FORMULA: Formula = Formula { source: include_str!("maths.glsl"), constants: &[] };

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

/// Weights of a normal distribution of this standard deviation in samples, up to three of them on either side; they add
/// up to 1.
pub(super) fn gaussian(sigma: f32) -> Vec<f32> {
    let reach = (3.0 * sigma).ceil() as i32;
    let weight = |k: i32| if k == 0 { 1.0 } else { libm::expf(-0.5 * (k as f32 / sigma) * (k as f32 / sigma)) };
    let weights: Vec<f32> = (-reach..=reach).map(weight).collect();
    let sum: f32 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_smooth_and_bounded() {
        assert_eq!([smoothstep(1.0, 3.0, 0.0), smoothstep(1.0, 3.0, 2.0), smoothstep(1.0, 3.0, 9.0)], [0.0, 0.5, 1.0]);
    }

    #[test]
    fn weights_add_up_to_one() {
        for sigma in [0.0, 0.3, 2.0, 9.0] {
            let sum: f32 = gaussian(sigma).iter().sum();
            assert!((sum - 1.0).abs() < 1e-5, "{sigma}: {sum}");
        }
    }
}
