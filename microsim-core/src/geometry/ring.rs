//! Rings of points and directions.
//!
//! Lengths are in world units, angles in radians, counter-clockwise from +x. This file holds the
//! only trigonometry of the crate: `libm` computes in software, so its results have the same bits
//! on every platform, which those of the standard library do not.

use core::f64::consts::FRAC_PI_2;
use glam::Vec2;

/// Steps of the arc length table of a quarter ellipse, before those for the number of points.
const MIN_ARC_STEPS: usize = 256;

/// Angle between successive points in turns of the golden ratio, radians: they never fall on one line (Vogel 1979, "A better way
/// to construct the sunflower head").
pub(crate) const GOLDEN_ANGLE: f32 = 2.399_963_2;

/// The unit vector at `angle` radians, counter-clockwise from +x.
///
/// Any finite angle is allowed; others give NaN coordinates.
pub fn unit_vector(angle: f32) -> Vec2 {
    Vec2::new(libm::cosf(angle), libm::sinf(angle))
}

/// `count` points on the ellipse around the origin with half axes `radii` (x, y), evenly spaced by arc length.
///
/// Counter-clockwise, starting at (radii.x, 0). The ring is its own mirror image in the x axis to
/// the last bit, and in the y axis too if `count` is even. On a circle the points have equal
/// angles. The signs of the radii are ignored; radii that are not finite give points that are not.
pub fn ellipse(radii: Vec2, count: usize) -> Vec<Vec2> {
    let radii = radii.abs();
    let lengths = arc_lengths(radii, count);
    (0..count)
        .map(|index| {
            // Every point is folded into the first quadrant and mirrored back, so symmetry is
            // exact. In units of a quarter arc / `count`, the position of the point is 4 index.
            let (quadrant, rest) = (4 * index / count, 4 * index % count);
            let part = if quadrant % 2 == 0 { rest } else { count - rest };
            mirrored(point_on_quarter(radii, lengths.as_deref(), part as f64 / count as f64), quadrant)
        })
        .collect()
}

/// Radius of a ring of `count` equal discs that touch their neighbours and together reach as far as 1, and radius of a disc.
///
/// With `s = sin(pi / count)` discs at the radius `R` have the radius `R s`, and `R + R s` is 1.
pub(crate) fn touching_ring(count: usize) -> [f32; 2] {
    let half_angle_sine = unit_vector(std::f32::consts::PI / count as f32).y;
    let ring_radius = 1.0 / (1.0 + half_angle_sine);
    [ring_radius, ring_radius * half_angle_sine]
}

/// The index of the point nearest to `target`; the lowest such index if several are.
///
/// `None` if there are no points. Points at a NaN distance are passed over.
pub fn nearest_index(points: &[Vec2], target: Vec2) -> Option<usize> {
    let mut best: Option<(usize, f32)> = None;
    for (index, point) in points.iter().enumerate() {
        let distance = point.distance_squared(target);
        if !distance.is_nan() && best.is_none_or(|(_, least)| distance < least) {
            best = Some((index, distance));
        }
    }
    best.map(|(index, _)| index)
}

/// `v` turned by the angle that turns +x into `direction`, a unit vector.
///
/// This is the product of complex numbers; a `direction` of another length scales the result.
pub fn rotate(v: Vec2, direction: Vec2) -> Vec2 {
    Vec2::new(v.x * direction.x - v.y * direction.y, v.x * direction.y + v.y * direction.x)
}

/// The unit vector along `v`, or `fallback` if `v` is zero or not finite.
pub fn direction_or(v: Vec2, fallback: Vec2) -> Vec2 {
    let size = if v.x.abs() > v.y.abs() { v.x.abs() } else { v.y.abs() };
    if size == 0.0 || !v.is_finite() {
        return fallback;
    }
    // Scaled to about 1 first: the square of a very long or short vector leaves the range of f32.
    let scaled = v / size;
    scaled / scaled.length()
}

/// Arc length of a quarter ellipse from (radii.x, 0) to each of equal steps of the parameter angle: sums of the speed
/// |d(rx cos t, ry sin t)/dt| at the middle of each step. `None` where equal angles are equal arcs anyway (a circle) or
/// there is no arc to measure.
fn arc_lengths(radii: Vec2, count: usize) -> Option<Vec<f64>> {
    if radii.x == radii.y || !radii.is_finite() {
        return None;
    }
    let steps = MIN_ARC_STEPS + count;
    let mut sum = 0.0;
    let mut lengths = vec![sum];
    for step in 0..steps {
        let middle = (step as f64 + 0.5) / steps as f64 * FRAC_PI_2;
        let (sine, cosine) = (libm::sin(middle), libm::cos(middle));
        let (dx, dy) = (f64::from(radii.x) * sine, f64::from(radii.y) * cosine);
        sum += (dx * dx + dy * dy).sqrt();
        lengths.push(sum);
    }
    Some(lengths)
}

/// The point at `fraction` of the arc of a quarter ellipse, 0 to 1.
fn point_on_quarter(radii: Vec2, lengths: Option<&[f64]>, fraction: f64) -> Vec2 {
    if fraction == 0.0 {
        return Vec2::new(radii.x, 0.0);
    }
    if fraction == 1.0 {
        return Vec2::new(0.0, radii.y);
    }
    let turn = lengths.map_or(fraction, |lengths| turn_at(lengths, fraction));
    radii * unit_vector((turn * FRAC_PI_2) as f32)
}

/// The fraction of the steps after which `fraction` of the total length has passed.
fn turn_at(lengths: &[f64], fraction: f64) -> f64 {
    let steps = lengths.len() - 1;
    let target = fraction * lengths[steps];
    let passed = lengths[..steps].partition_point(|length| *length <= target);
    let (before, after) = (lengths[passed - 1], lengths[passed]);
    let in_step = (target - before) / (after - before);
    ((passed - 1) as f64 + in_step) / steps as f64
}

/// A point of the first quadrant moved to `quadrant` 0..4 by reflection in the axes.
fn mirrored(point: Vec2, quadrant: usize) -> Vec2 {
    // `0.0 - x` rather than `-x`: it makes no negative zeros.
    let x = if quadrant == 1 || quadrant == 2 { 0.0 - point.x } else { point.x };
    let y = if quadrant >= 2 { 0.0 - point.y } else { point.y };
    Vec2::new(x, y)
}

#[cfg(test)]
mod tests {
    use super::super::{is_simple, signed_area};
    use super::*;

    #[test]
    fn discs_of_a_touching_ring_touch_and_reach_as_far_as_1() {
        for count in [3, 8, 28, 64] {
            let [ring_radius, disc_radius] = touching_ring(count);
            let points = ellipse(Vec2::splat(ring_radius), count);
            assert!((points[0].distance(points[1]) / (2.0 * disc_radius) - 1.0).abs() < 1e-5, "{count}");
            assert!((ring_radius + disc_radius - 1.0).abs() < 1e-6, "{count}");
        }
    }
    use core::f32::consts::{FRAC_PI_2, PI, TAU};
    use glam::vec2;
    use proptest::prelude::*;

    /// Length of the arc between parameter angles, in f64 and by other means than the table.
    fn arc_length(radii: Vec2, from: f64, to: f64) -> f64 {
        let at = |t: f64| (f64::from(radii.x) * libm::cos(t), f64::from(radii.y) * libm::sin(t));
        let steps = 2000;
        let chord = |step: usize| {
            let (x0, y0) = at(from + (to - from) * step as f64 / f64::from(steps));
            let (x1, y1) = at(from + (to - from) * (step + 1) as f64 / f64::from(steps));
            libm::hypot(x1 - x0, y1 - y0)
        };
        (0..steps as usize).map(chord).sum()
    }

    fn parameter(radii: Vec2, point: Vec2) -> f64 {
        libm::atan2(f64::from(point.y / radii.y), f64::from(point.x / radii.x))
    }

    #[test]
    fn unit_vectors_of_the_quarter_turns() {
        assert_eq!(unit_vector(0.0), Vec2::X);
        assert!(unit_vector(FRAC_PI_2).abs_diff_eq(Vec2::Y, 1.0e-6));
        assert!(unit_vector(PI).abs_diff_eq(-Vec2::X, 1.0e-6));
        assert!(unit_vector(f32::INFINITY).is_nan());
    }

    #[test]
    fn unit_vector_has_pinned_bits() {
        let bits = |angle: f32| unit_vector(angle).to_array().map(f32::to_bits);
        assert_eq!(bits(1.0), [0x3f0a_5140, 0x3f57_6aa4]);
        assert_eq!(bits(-1234.5), [0xbf7d_4796, 0xbe14_e299]);
    }

    #[test]
    fn four_points_of_an_ellipse_are_its_vertices() {
        let expected = [vec2(3.0, 0.0), vec2(0.0, 2.0), vec2(-3.0, 0.0), vec2(0.0, -2.0)];
        let ring = ellipse(vec2(3.0, 2.0), 4);
        assert_eq!(ring, expected);
        assert_eq!(ellipse(vec2(-3.0, -2.0), 4), expected);
        let zeros: Vec<_> = ring.iter().flat_map(|p| p.to_array()).filter(|c| *c == 0.0).collect();
        assert!(zeros.iter().all(|zero| zero.is_sign_positive()));
    }

    #[test]
    fn circle_points_have_equal_angles() {
        for (index, point) in ellipse(Vec2::splat(5.0), 7).into_iter().enumerate() {
            let expected = unit_vector(TAU * index as f32 / 7.0) * 5.0;
            assert!(point.abs_diff_eq(expected, 1.0e-5), "{index}: {point} {expected}");
        }
    }

    #[test]
    fn rings_without_extent_or_points() {
        assert!(ellipse(Vec2::ONE, 0).is_empty());
        assert_eq!(ellipse(Vec2::ONE, 1), [Vec2::X]);
        assert_eq!(ellipse(Vec2::ZERO, 9), [Vec2::ZERO; 9]);
        let flat = ellipse(vec2(4.0, 0.0), 8);
        for (index, point) in flat.iter().enumerate() {
            let expected = 2.0 * (index as f32 - 4.0).abs() - 4.0;
            assert!(point.abs_diff_eq(vec2(expected, 0.0), 1.0e-3), "{index}: {point}");
        }
    }

    #[test]
    fn extreme_radii_do_not_panic() {
        for bad in [f32::NAN, f32::INFINITY, f32::MAX, f32::MIN_POSITIVE, 1.0e-45] {
            for radii in [vec2(bad, 1.0), vec2(1.0, bad), Vec2::splat(bad), vec2(bad, 0.0)] {
                assert_eq!(ellipse(radii, 13).len(), 13);
            }
        }
    }

    #[test]
    fn nearest_index_prefers_the_lower_of_equals() {
        let points = [vec2(2.0, 0.0), vec2(1.0, 0.0), vec2(-1.0, 0.0), Vec2::NAN];
        assert_eq!(nearest_index(&points, Vec2::ZERO), Some(1));
        assert_eq!(nearest_index(&points, vec2(-5.0, 0.0)), Some(2));
        assert_eq!(nearest_index(&points[3..], Vec2::ZERO), None);
        assert_eq!(nearest_index(&[Vec2::NAN, Vec2::ONE], Vec2::ZERO), Some(1));
        assert_eq!(nearest_index(&[], Vec2::ZERO), None);
    }

    #[test]
    fn rotate_by_a_quarter_turn() {
        assert_eq!(rotate(vec2(3.0, 1.0), Vec2::Y), vec2(-1.0, 3.0));
        assert_eq!(rotate(vec2(3.0, 1.0), Vec2::X), vec2(3.0, 1.0));
    }

    #[test]
    fn direction_of_any_length() {
        assert_eq!(direction_or(vec2(0.0, -3.0), Vec2::X), -Vec2::Y);
        for size in [1.0e-45, 1.0e-30, 1.0, 1.0e30, f32::MAX] {
            let direction = direction_or(Vec2::splat(size), Vec2::X);
            assert!((direction.length() - 1.0).abs() < 1.0e-6, "{size}");
        }
        for bad in [Vec2::ZERO, -Vec2::ZERO, vec2(f32::NAN, 1.0), vec2(1.0, f32::INFINITY)] {
            assert_eq!(direction_or(bad, Vec2::Y), Vec2::Y);
        }
    }

    proptest! {
        #[test]
        fn ellipse_points_lie_on_it_at_even_arcs(rx in 0.1f32..100.0, ratio in 0.05f32..20.0, count in 3usize..80) {
            let radii = vec2(rx, rx * ratio);
            let ring = ellipse(radii, count);
            prop_assert_eq!(ring.len(), count);
            prop_assert_eq!(ring[0], vec2(rx, 0.0));
            let mean = arc_length(radii, 0.0, f64::from(TAU)) / count as f64;
            for index in 0..count {
                prop_assert!(((ring[index] / radii).length() - 1.0).abs() < 1.0e-6);
                let from = parameter(radii, ring[index]);
                let to = parameter(radii, ring[(index + 1) % count]);
                let to = if to > from { to } else { to + f64::from(TAU) };
                let arc = arc_length(radii, from, to);
                prop_assert!((arc / mean - 1.0).abs() < 1.0e-2, "{} {} {}", index, arc, mean);
            }
        }

        #[test]
        fn ellipse_is_simple_counter_clockwise_and_symmetric(
            rx in 0.1f32..100.0, ry in 0.1f32..100.0, count in 3usize..80,
        ) {
            let ring = ellipse(vec2(rx, ry), count);
            prop_assert!(is_simple(&ring));
            prop_assert!(signed_area(&ring) > 0.0);
            for index in 1..count {
                let mirror = ring[count - index];
                prop_assert_eq!(ring[index], vec2(mirror.x, 0.0 - mirror.y));
                if count % 2 == 0 {
                    let opposite = ring[(index + count / 2) % count];
                    prop_assert_eq!(ring[index], vec2(0.0 - opposite.x, 0.0 - opposite.y));
                }
            }
        }

        #[test]
        fn rotation_adds_angles(first in -9.0f32..9.0, second in -9.0f32..9.0) {
            let both = rotate(unit_vector(first), unit_vector(second));
            prop_assert!(both.abs_diff_eq(unit_vector(first + second), 2.0e-6));
        }

        #[test]
        fn nearest_index_is_no_farther_than_any(points in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 1..20)) {
            let points: Vec<Vec2> = points.into_iter().map(Vec2::from).collect();
            let nearest = nearest_index(&points, Vec2::ONE).map(|index| points[index]);
            let least = nearest.map(|point| point.distance_squared(Vec2::ONE));
            prop_assert!(points.iter().all(|p| least <= Some(p.distance_squared(Vec2::ONE))));
        }
    }
}
