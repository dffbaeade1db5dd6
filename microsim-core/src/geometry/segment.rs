//! Measures and predicates of segments and of the turn between two of them.

use glam::Vec2;

/// The point of the segment from `a` to `b` that is nearest to `point`.
///
/// A segment of no length, or a NaN coordinate, gives `a`.
///
/// Source: C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.2.
pub fn nearest_on_segment(a: Vec2, b: Vec2, point: Vec2) -> Vec2 {
    let along = b - a;
    let fraction = (point - a).dot(along) / along.length_squared();
    // The order of the tests sends NaN (0 / 0) to `a`.
    if fraction >= 1.0 {
        b
    } else if fraction > 0.0 {
        a + along * fraction
    } else {
        a
    }
}

/// Twice the signed area of the triangle `a b c`: positive when it turns counter-clockwise.
///
/// Differences and products of `f32` fit into `f64`, so for coordinates of similar size the sign is exact.
pub(super) fn turn(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let (bx, by) = offset(a, b);
    let (cx, cy) = offset(a, c);
    bx * cy - by * cx
}

/// `to - from`, in `f64`.
pub(super) fn offset(from: Vec2, to: Vec2) -> (f64, f64) {
    (f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y))
}

/// Whether the edge `b c` runs back over the edge `a b`, or one of them has no length.
pub(crate) fn folds_back(a: Vec2, b: Vec2, c: Vec2) -> bool {
    let (ux, uy) = offset(a, b);
    let (vx, vy) = offset(b, c);
    turn(a, b, c) == 0.0 && ux * vx + uy * vy <= 0.0
}

/// Whether the closed segments `a b` and `c d` share a point: their boxes overlap, and each has
/// its ends on different sides of the other or on it.
pub(crate) fn segments_touch(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> bool {
    ranges_overlap(a.x, b.x, c.x, d.x)
        && ranges_overlap(a.y, b.y, c.y, d.y)
        && turn(a, b, c) * turn(a, b, d) <= 0.0
        && turn(c, d, a) * turn(c, d, b) <= 0.0
}

/// Whether the closed ranges between `a` and `b` and between `c` and `d` share a value.
fn ranges_overlap(a: f32, b: f32, c: f32, d: f32) -> bool {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    !((c < low && d < low) || (c > high && d > high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;
    use proptest::prelude::*;

    #[test]
    fn nearest_on_segment_stops_at_the_ends() {
        let (a, b) = (vec2(0.0, 0.0), vec2(2.0, 0.0));
        assert_eq!(nearest_on_segment(a, b, vec2(-1.0, 3.0)), a);
        assert_eq!(nearest_on_segment(a, b, vec2(1.5, 3.0)), vec2(1.5, 0.0));
        assert_eq!(nearest_on_segment(a, b, vec2(7.0, -3.0)), b);
        assert_eq!(nearest_on_segment(a, a, vec2(7.0, -3.0)), a);
    }

    proptest! {
        #[test]
        fn nearest_on_segment_beats_samples(
            points in prop::array::uniform3((-9.0f32..9.0, -9.0f32..9.0)), fraction in 0.0f32..1.0,
        ) {
            let [a, b, p] = points.map(Vec2::from);
            let nearest = nearest_on_segment(a, b, p).distance(p);
            prop_assert!(nearest <= a.lerp(b, fraction).distance(p) + 1.0e-5);
        }
    }
}
