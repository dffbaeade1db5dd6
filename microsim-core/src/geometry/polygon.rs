//! Measures and predicates of closed polygons.
//!
//! A polygon is a slice of vertices in order, in world units of length; the edge from the last vertex to the first is
//! implied. Sums run in `f64`, because the products of large coordinates cancel badly in `f32`.

use super::segment::{folds_back, offset, segments_touch, turn};
use glam::{Vec2, Vec4};

/// Area below which [`centroid`] takes the vertex mean, as a part of the squared perimeter.
///
/// A circle has 1 / 4π ≈ 0.08; a rectangle this thin is two million times longer than wide.
const DEGENERATE_AREA: f64 = 1.0e-7;

/// Whether `point` lies inside `polygon`, of either winding, by the even-odd rule.
///
/// A horizontal ray is cast from the point towards +x and its crossings with the edges are counted: an odd count is
/// inside. An edge owns its lower end and not its upper one, so a ray through a vertex counts once where the boundary
/// passes and twice or never where it turns. Points on the boundary may fall on either side. Fewer than three vertices
/// contain nothing, and nothing contains a point with a NaN coordinate.
///
/// Source: M. Shimrat, "Algorithm 112: Position of point relative to polygon", CACM 5(8), 1962.
pub fn contains_point(polygon: &[Vec2], point: Vec2) -> bool {
    let Some(&(mut before)) = polygon.last() else { return false };
    let mut is_inside = false;
    for some in polygon.chunks(32) {
        // Most edges have both ends on one side of the ray's line; which of them do not is hard to foresee.
        let above =
            some.chunks(4).zip(0..).fold(0, |bits, (four, k)| bits | u64::from(above(four, point.y)) << (4 * k));
        let changes = above ^ (above << 1 | u64::from(before.y > point.y));
        let mut changes = changes & ((1 << some.len()) - 1);
        while changes != 0 {
            let k = changes.trailing_zeros() as usize;
            changes &= changes - 1;
            is_inside ^= crosses_ray(if k > 0 { some[k - 1] } else { before }, some[k], point);
        }
        before = some[some.len() - 1];
    }
    is_inside
}

/// Which of up to four vertices are above a height, one bit each.
fn above(vertices: &[Vec2], y: f32) -> u32 {
    match *vertices {
        [a, b, c, d] => Vec4::new(a.y, b.y, c.y, d.y).cmpgt(Vec4::splat(y)).bitmask(),
        _ => vertices.iter().zip(0..).fold(0, |bits, (vertex, k)| bits | u32::from(vertex.y > y) << k),
    }
}

/// The area that `polygon` encloses, in squared units of length, signed by the winding.
///
/// Positive for counter-clockwise polygons, negative for clockwise ones, 0 for fewer than three
/// vertices. Where the polygon crosses itself, each part counts with the sign of its own winding.
///
/// Source: the shoelace formula, P. Bourke, "Calculating the area and centroid of a polygon", 1988.
pub fn signed_area(polygon: &[Vec2]) -> f32 {
    (0.5 * doubled_area(polygon)) as f32
}

/// The centre of mass of the area of `polygon`, or `None` if it has no vertices.
///
/// Where the area vanishes beside the perimeter (points, lines, balanced figures of eight) the
/// formula has no meaning, and the mean of the vertices is returned. The result may lie outside of
/// a concave polygon. A vertex that is not finite gives a result that is not finite.
///
/// Source: P. Bourke, "Calculating the area and centroid of a polygon", 1988.
pub fn centroid(polygon: &[Vec2]) -> Option<Vec2> {
    let origin = *polygon.first()?;
    let doubled_area = doubled_area(polygon);
    let length = f64::from(perimeter(polygon));
    let has_area = doubled_area.abs() > 2.0 * DEGENERATE_AREA * length * length;
    Some(if has_area { area_centroid(polygon, origin, doubled_area) } else { vertex_mean(polygon, origin) })
}

/// Whether `polygon` has an interior in one piece: no two of its edges meet except where neighbours share a vertex.
///
/// Edges that cross, touch or fold back on each other and repeated vertices make it false, and so
/// do fewer than three vertices or a coordinate that is not finite. Takes O(n²) time.
///
/// Source: the orientation test of Cormen et al., "Introduction to Algorithms", section 33.1.
pub fn is_simple(polygon: &[Vec2]) -> bool {
    if polygon.len() < 3 || !polygon.iter().all(|vertex| vertex.is_finite()) {
        return false;
    }
    let edges: Vec<_> = edges(polygon).collect();
    (0..edges.len()).all(|index| is_clear_of_later(&edges, index))
}

/// The summed length of all edges, the closing one included, in units of length; 0 for one vertex.
pub fn perimeter(polygon: &[Vec2]) -> f32 {
    edges(polygon).fold(0.0, |sum, (a, b)| sum + a.distance(b))
}

/// The edges as pairs of end points, ending with the edge that closes the polygon.
fn edges(polygon: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// Whether the ray from `point` towards +x crosses the edge.
pub(crate) fn crosses_ray(a: Vec2, b: Vec2, point: Vec2) -> bool {
    if (a.y > point.y) == (b.y > point.y) {
        return false;
    }
    // Always asked from the lower end, so that two polygons that share the edge in opposite
    // directions get the same answer and no point falls between them.
    let (lower, upper) = if a.y < b.y { (a, b) } else { (b, a) };
    turn(lower, upper, point) > 0.0
}

/// Twice the signed area; taken from the first vertex, so that it does not lose digits far away from the origin.
fn doubled_area(polygon: &[Vec2]) -> f64 {
    let origin = polygon.first().copied().unwrap_or_default();
    edges(polygon).fold(0.0, |sum, (a, b)| sum + turn(origin, a, b))
}

/// The mean of the centroids of the triangles `origin a b`, weighted with their areas.
fn area_centroid(polygon: &[Vec2], origin: Vec2, doubled_area: f64) -> Vec2 {
    let (mut sum_x, mut sum_y) = (0.0, 0.0);
    for (a, b) in edges(polygon) {
        let weight = turn(origin, a, b);
        let (ax, ay) = offset(origin, a);
        let (bx, by) = offset(origin, b);
        sum_x += weight * (ax + bx);
        sum_y += weight * (ay + by);
    }
    shifted(origin, sum_x / (3.0 * doubled_area), sum_y / (3.0 * doubled_area))
}

fn vertex_mean(polygon: &[Vec2], origin: Vec2) -> Vec2 {
    let offsets = polygon.iter().map(|&vertex| offset(origin, vertex));
    let (x, y) = offsets.fold((0.0, 0.0), |sum, (x, y)| (sum.0 + x, sum.1 + y));
    let count = polygon.len() as f64;
    shifted(origin, x / count, y / count)
}

/// `origin + (x, y)`, rounded once.
fn shifted(origin: Vec2, x: f64, y: f64) -> Vec2 {
    Vec2::new((f64::from(origin.x) + x) as f32, (f64::from(origin.y) + y) as f32)
}

/// Whether the edge at `index` meets no edge after it, but for the vertices that neighbours share.
fn is_clear_of_later(edges: &[(Vec2, Vec2)], index: usize) -> bool {
    let last = edges.len() - 1;
    let (a, b) = edges[index];
    let (_, next_end) = edges[if index == last { 0 } else { index + 1 }];
    if folds_back(a, b, next_end) {
        return false;
    }
    let is_neighbour = |other: usize| other == index + 1 || (index == 0 && other == last);
    (index + 1..edges.len())
        .filter(|&other| !is_neighbour(other))
        .all(|other| !segments_touch(a, b, edges[other].0, edges[other].1))
}

#[cfg(test)]
mod tests {
    use super::super::arbitrary::{convex_polygon, star_polygon, tangled_polygon};
    use super::super::segment::nearest_on_segment;
    use super::*;
    use crate::rng::Rng;
    use glam::vec2;
    use parry2d::utils::point_in_poly2d;
    use proptest::prelude::*;

    fn unit_square() -> Vec<Vec2> {
        vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0)]
    }

    /// Counter-clockwise; the notch is the upper right quarter of a square with side 2.
    fn notched_square() -> Vec<Vec2> {
        vec![vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(2.0, 1.0), vec2(1.0, 1.0), vec2(1.0, 2.0), vec2(0.0, 2.0)]
    }

    fn bow_tie() -> Vec<Vec2> {
        vec![vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(1.0, 0.0), vec2(0.0, 1.0)]
    }

    fn reversed(polygon: &[Vec2]) -> Vec<Vec2> {
        polygon.iter().rev().copied().collect()
    }

    fn distance_to_boundary(polygon: &[Vec2], point: Vec2) -> f32 {
        edges(polygon)
            .map(|(a, b)| nearest_on_segment(a, b, point).distance(point))
            .fold(f32::INFINITY, |best, distance| if distance < best { distance } else { best })
    }

    #[test]
    fn notch_of_a_concave_polygon_is_outside() {
        for polygon in [notched_square(), reversed(&notched_square())] {
            assert!(contains_point(&polygon, vec2(0.5, 0.5)));
            assert!(contains_point(&polygon, vec2(1.5, 0.5)));
            assert!(contains_point(&polygon, vec2(0.5, 1.5)));
            assert!(!contains_point(&polygon, vec2(1.5, 1.5)));
            assert!(!contains_point(&polygon, vec2(-0.5, 0.5)));
        }
    }

    #[test]
    fn ray_through_vertices_counts_each_passage_once() {
        let diamond = [vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 0.0), vec2(0.0, -1.0)];
        assert!(contains_point(&diamond, vec2(0.0, 0.0)));
        for outside in [vec2(-2.0, 0.0), vec2(-1.0, 1.0), vec2(-1.0, -1.0)] {
            assert!(!contains_point(&diamond, outside), "{outside}");
        }
        // The ray runs along the horizontal edge of the notch.
        assert!(contains_point(&notched_square(), vec2(0.5, 1.0)));
        assert!(!contains_point(&notched_square(), vec2(-0.5, 1.0)));
    }

    #[test]
    fn many_vertices_at_a_time_give_what_one_edge_after_the_other_gives() {
        let (mut rng, mut inside) = (Rng::new(6, 4), 0);
        for count in (0..70).chain([127, 128, 129]) {
            let mut place = || vec2(rng.range(-3.0, 3.0).round(), rng.range(-3.0, 3.0));
            let polygon: Vec<Vec2> = (0..count).map(|_| place()).collect();
            for k in 0..50 {
                // Some are as high as a vertex.
                let height = polygon.get(k).map_or(0.1, |vertex| vertex.y);
                let point = vec2(place().x + 0.1, height);
                let expected = edges(&polygon).filter(|&(a, b)| crosses_ray(a, b, point)).count() % 2 == 1;
                assert_eq!(contains_point(&polygon, point), expected, "{point} in {count}");
                inside += u32::from(expected);
            }
        }
        assert!(inside > 1000, "{inside}");
    }

    #[test]
    fn ray_runs_towards_positive_x_only() {
        let (a, b) = (vec2(1.0, -1.0), vec2(1.0, 1.0));
        for (a, b) in [(a, b), (b, a)] {
            assert!(crosses_ray(a, b, vec2(0.0, 0.0)));
            assert!(!crosses_ray(a, b, vec2(2.0, 0.0)));
            assert!(crosses_ray(a, b, vec2(0.0, -1.0)), "an edge owns its lower end");
            assert!(!crosses_ray(a, b, vec2(0.0, 1.0)), "an edge does not own its upper end");
        }
    }

    #[test]
    fn points_on_a_shared_edge_belong_to_exactly_one_polygon() {
        let corners = [vec2(0.1, 0.0), vec2(0.7, 1.0), vec2(-3.0, 0.3), vec2(3.0, 0.4)];
        let left = [corners[0], corners[1], corners[2]];
        let right = [corners[1], corners[0], corners[3]];
        for step in 1..100 {
            let point = corners[0].lerp(corners[1], step as f32 / 100.0);
            assert_ne!(contains_point(&left, point), contains_point(&right, point), "{point}");
        }
    }

    #[test]
    fn area_perimeter_and_centroid_of_known_shapes() {
        assert_eq!(signed_area(&unit_square()), 1.0);
        assert_eq!(signed_area(&reversed(&unit_square())), -1.0);
        assert_eq!(signed_area(&notched_square()), 3.0);
        assert_eq!(signed_area(&bow_tie()), 0.0);
        assert_eq!(perimeter(&unit_square()), 4.0);
        assert_eq!(perimeter(&notched_square()), 8.0);
        assert_eq!(centroid(&unit_square()), Some(vec2(0.5, 0.5)));
        let expected = vec2(5.0 / 6.0, 5.0 / 6.0);
        assert_eq!(centroid(&notched_square()), Some(expected));
        assert_eq!(centroid(&reversed(&notched_square())), Some(expected));
    }

    #[test]
    fn area_far_from_the_origin_keeps_its_digits() {
        let far: Vec<_> = unit_square().iter().map(|v| *v + Vec2::splat(1.0e5)).collect();
        assert_eq!(signed_area(&far), 1.0);
        assert_eq!(centroid(&far), Some(Vec2::splat(1.0e5 + 0.5)));
    }

    #[test]
    fn centroid_without_area_is_the_vertex_mean() {
        assert_eq!(centroid(&[]), None);
        assert_eq!(centroid(&[vec2(3.0, 4.0)]), Some(vec2(3.0, 4.0)));
        assert_eq!(centroid(&[vec2(0.0, 0.0), vec2(2.0, 4.0)]), Some(vec2(1.0, 2.0)));
        let line = [vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(5.0, 5.0)];
        assert_eq!(centroid(&line), Some(vec2(2.0, 2.0)));
        assert_eq!(centroid(&bow_tie()), Some(vec2(0.5, 0.5)));
    }

    #[test]
    fn simple_polygons_neither_cross_nor_touch_themselves() {
        assert!(is_simple(&unit_square()));
        assert!(is_simple(&notched_square()));
        assert!(is_simple(&unit_square()[..3]));
        assert!(!is_simple(&bow_tie()));
        let pinched = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(2.0, 2.0), vec2(1.0, 0.0), vec2(0.0, 2.0)];
        assert!(!is_simple(&pinched));
        let flat_vertex = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(2.0, 0.0), vec2(1.0, 1.0)];
        assert!(is_simple(&flat_vertex));
        let spike = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0)];
        assert!(!is_simple(&spike));
        let repeated = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 0.0), vec2(0.0, 1.0)];
        assert!(!is_simple(&repeated));
        assert!(!is_simple(&[Vec2::ONE; 3]));
    }

    #[test]
    fn degenerate_input_is_answered() {
        for polygon in [&[][..], &[Vec2::ZERO], &[Vec2::ZERO, Vec2::ONE]] {
            assert!(!contains_point(polygon, vec2(0.5, 0.25)));
            assert_eq!(signed_area(polygon).to_bits(), 0.0f32.to_bits());
            assert!(!is_simple(polygon));
        }
        assert_eq!(perimeter(&[]), 0.0);
        assert_eq!(perimeter(&[Vec2::ONE]), 0.0);
    }

    #[test]
    fn non_finite_input_does_not_panic() {
        for bad in [Vec2::NAN, Vec2::INFINITY, vec2(f32::MAX, f32::NEG_INFINITY)] {
            let polygon = [Vec2::ZERO, bad, Vec2::ONE, vec2(0.0, 2.0)];
            contains_point(&polygon, Vec2::ONE);
            signed_area(&polygon);
            perimeter(&polygon);
            centroid(&polygon);
            nearest_on_segment(bad, Vec2::ZERO, bad);
            assert!(!is_simple(&polygon));
        }
        assert!(!contains_point(&unit_square(), Vec2::NAN));
    }

    proptest! {
        #[test]
        fn contains_point_agrees_with_parry(
            polygon in star_polygon(), x in -31.0f32..31.0, y in -31.0f32..31.0, near in -11.0f32..11.0,
        ) {
            // Uniform points mostly miss the polygon, so test others close to a vertex too.
            let around = polygon[0] + vec2(near, x * 0.3);
            for point in [vec2(x, y), around, vec2(x, polygon[1].y)] {
                if distance_to_boundary(&polygon, point) > 1.0e-3 {
                    prop_assert_eq!(contains_point(&polygon, point), point_in_poly2d(point, &polygon));
                }
            }
        }

        #[test]
        fn winding_changes_only_the_sign_of_the_area(polygon in tangled_polygon()) {
            let flipped = reversed(&polygon);
            let tolerance = 1.0e-5 * (1.0 + perimeter(&polygon));
            let sum = signed_area(&polygon) + signed_area(&flipped);
            prop_assert!(sum.abs() <= tolerance);
        }

        #[test]
        fn star_polygons_are_simple_and_positive(polygon in star_polygon()) {
            prop_assert!(is_simple(&polygon));
            prop_assert!(is_simple(&reversed(&polygon)));
            prop_assert!(signed_area(&polygon) > 0.0);
        }

        #[test]
        fn swapping_two_vertices_of_a_convex_polygon_makes_it_cross(polygon in convex_polygon()) {
            prop_assume!(polygon.len() > 3);
            let mut crossed = polygon;
            crossed.swap(0, 1);
            prop_assert!(!is_simple(&crossed));
        }

        #[test]
        fn centroid_moves_with_the_polygon(polygon in star_polygon(), x in -100.0f32..100.0, y in -100.0f32..100.0) {
            let shift = vec2(x, y);
            let moved: Vec<_> = polygon.iter().map(|vertex| *vertex + shift).collect();
            let expected = centroid(&polygon).map(|centre| centre + shift);
            let distance = centroid(&moved).zip(expected).map(|(a, b)| a.distance(b));
            prop_assert!(distance.is_some_and(|distance| distance < 1.0e-3));
        }

        #[test]
        fn centroid_lies_in_a_convex_polygon(polygon in convex_polygon()) {
            let inside = centroid(&polygon).is_some_and(|centre| contains_point(&polygon, centre));
            prop_assert!(inside);
        }
    }
}
