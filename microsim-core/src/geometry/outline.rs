//! Measures of an outline's shape: how far it is from convex, and how wide it is across a direction.

use super::segment::turn;
use glam::Vec2;

/// How much more `polygon` turns than a convex one, radians: the sum of the magnitudes of its exterior angles less 2 pi.
///
/// 0 for a convex polygon; twice the turning of its hollows otherwise, so wrinkles and teeth of any size count in full.
/// Vertices that repeat their predecessor turn nothing. Fewer than three vertices, or a coordinate that is not finite,
/// give 0.
pub fn excess_turning(polygon: &[Vec2]) -> f32 {
    let mut corners = polygon.to_vec();
    corners.dedup();
    if corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    let count = corners.len();
    if count < 3 || !corners.iter().all(|corner| corner.is_finite()) {
        return 0.0;
    }
    let total: f64 = (0..count)
        .map(|k| {
            let (a, b, c) = (corners[k], corners[(k + 1) % count], corners[(k + 2) % count]);
            libm::atan2(turn(a, b, c), f64::from((b - a).dot(c - b))).abs()
        })
        .sum();
    (total - core::f64::consts::TAU) as f32
}

/// Widths of `polygon` across `direction`, a quarter of its length from its front end and from its rear end.
///
/// The length is the extent along `direction`, which need not be of unit length; a width is the distance between the
/// outermost crossings. `None` for fewer than three vertices, a direction of no length or a coordinate that is not finite.
pub fn quarter_widths(polygon: &[Vec2], direction: Vec2) -> Option<[f32; 2]> {
    let along = direction.try_normalize()?;
    if polygon.len() < 3 || !polygon.iter().all(|corner| corner.is_finite()) {
        return None;
    }
    let (rear, front) = extent(polygon.iter().map(|corner| corner.dot(along)))?;
    let width_at = |place: f32| {
        let crossings = (0..polygon.len()).filter_map(|k| {
            let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            let (from, to) = (a.dot(along) - place, b.dot(along) - place);
            ((from < 0.0) != (to < 0.0)).then(|| a.lerp(b, from / (from - to)).dot(along.perp()))
        });
        extent(crossings).map(|(right, left)| left - right)
    };
    let quarter = 0.25 * (front - rear);
    Some([width_at(front - quarter)?, width_at(rear + quarter)?])
}

/// The smallest and the largest of some numbers.
fn extent(numbers: impl Iterator<Item = f32>) -> Option<(f32, f32)> {
    numbers.fold(None, |range, x| {
        let (low, high) = range.unwrap_or((x, x));
        Some((if x < low { x } else { low }, if x > high { x } else { high }))
    })
}

#[cfg(test)]
mod tests {
    use super::super::arbitrary::{convex_polygon, star_polygon, tangled_polygon};
    use super::super::ring::{ellipse, rotate, unit_vector};
    use super::*;
    use core::f32::consts::{FRAC_PI_2, PI};
    use proptest::prelude::*;

    #[test]
    fn a_notch_turns_twice_its_angles() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        assert!(excess_turning(&square).abs() < 1e-6);
        // An L has one hollow corner of a right angle, which the other corners have to make up for.
        let notched = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)].map(Vec2::from);
        assert!((excess_turning(&notched) - PI).abs() < 1e-6);
    }

    #[test]
    fn teeth_count_in_full() {
        // Every other node of a circle of 60 lies farther in: 30 hollows.
        let mut teeth = ellipse(Vec2::splat(10.0), 60);
        teeth.iter_mut().step_by(2).for_each(|node| *node *= 0.98);
        assert!(excess_turning(&teeth) > 10.0, "{}", excess_turning(&teeth));
    }

    #[test]
    fn widths_of_a_wedge_lie_a_quarter_from_its_ends() {
        // A triangle with its tip behind: a quarter and three quarters of the base's width.
        let wedge = [Vec2::ZERO, Vec2::new(8.0, -2.0), Vec2::new(8.0, 2.0)];
        assert_eq!(quarter_widths(&wedge, Vec2::X * 3.0), Some([3.0, 1.0]));
        assert_eq!(quarter_widths(&wedge, -Vec2::X), Some([1.0, 3.0]));
        let turned = wedge.map(|corner| rotate(corner, unit_vector(FRAC_PI_2)));
        let [front, rear] = quarter_widths(&turned, Vec2::Y).unwrap();
        assert!((front - 3.0).abs() < 1e-5 && (rear - 1.0).abs() < 1e-5);
    }

    #[test]
    fn degenerate_outlines_have_no_measures() {
        assert_eq!(excess_turning(&[Vec2::ZERO, Vec2::X, Vec2::X, Vec2::ZERO]), 0.0);
        assert_eq!(excess_turning(&[Vec2::ZERO, Vec2::X, Vec2::splat(f32::NAN)]), 0.0);
        assert_eq!(quarter_widths(&[Vec2::ZERO, Vec2::X], Vec2::X), None);
        assert_eq!(quarter_widths(&[Vec2::ZERO, Vec2::X, Vec2::Y], Vec2::ZERO), None);
    }

    proptest! {
        #[test]
        fn convex_polygons_turn_nothing_in_excess(polygon in convex_polygon()) {
            prop_assert!(excess_turning(&polygon).abs() < 1e-4);
        }

        #[test]
        fn stars_never_turn_less_than_once(polygon in star_polygon()) {
            prop_assert!(excess_turning(&polygon) > -1e-4);
        }

        #[test]
        fn nothing_panics(polygon in tangled_polygon(), x in -1.0f32..1.0) {
            excess_turning(&polygon);
            quarter_widths(&polygon, Vec2::new(x, 0.5));
        }
    }
}
