//! Triangulation of polygons by ear clipping.

use super::polygon::signed_area;
use super::segment::turn;
use glam::Vec2;

/// Splits `polygon`, of either winding, into triangles of indices into it.
///
/// n vertices give n - 2 triangles, none if n < 3. For a simple polygon, convex or not, they cover it without overlap,
/// and all are counter-clockwise with a positive area. A polygon that crosses or touches itself is cut up too, by force
/// where no ear is left: its triangles may overlap, have no area or turn clockwise, and only the sum of their signed
/// areas is sure to be that of the polygon (as its absolute value). Takes O(n²) time as a rule and O(n³) at worst.
///
/// An ear is a triangle of three successive vertices that lies inside; every simple polygon with
/// more than three vertices has two, and clipping one leaves a simple polygon.
///
/// Sources: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82(6), 1975;
/// D. Eberly, "Triangulation by Ear Clipping", Geometric Tools.
pub fn triangulate(polygon: &[Vec2]) -> Vec<[u32; 3]> {
    let mut ring = counter_clockwise_indices(polygon);
    let mut triangles = Vec::with_capacity(ring.len().saturating_sub(2));
    let mut start = 0;
    while ring.len() >= 3 {
        let tip = find_ear(polygon, &ring, start).unwrap_or_else(|| flattest_tip(polygon, &ring));
        triangles.push(triangle_at(&ring, tip));
        ring.remove(tip);
        // The search goes on past the next vertex: cutting at one spot would make a fan of slivers.
        start = tip + 1;
    }
    triangles
}

fn counter_clockwise_indices(polygon: &[Vec2]) -> Vec<u32> {
    let indices = 0..polygon.len() as u32;
    if signed_area(polygon) < 0.0 { indices.rev().collect() } else { indices.collect() }
}

/// The position in `ring` of the tip of the first ear at or after `start`, going round.
fn find_ear(polygon: &[Vec2], ring: &[u32], start: usize) -> Option<usize> {
    (0..ring.len()).map(|step| (start + step) % ring.len()).find(|&tip| is_ear(polygon, ring, tip))
}

/// Whether the triangle at `tip` turns left and no other vertex lies in it or on its boundary.
fn is_ear(polygon: &[Vec2], ring: &[u32], tip: usize) -> bool {
    let corners = corners_at(polygon, ring, tip);
    // Vertices at the place of a corner are no obstacle: they are where a boundary touches itself.
    let blocks = |vertex: Vec2| !corners.contains(&vertex) && is_in_triangle(corners, vertex);
    turn(corners[0], corners[1], corners[2]) > 0.0 && !ring.iter().any(|&index| blocks(polygon[index as usize]))
}

/// The tip of the triangle with the least area: the least wrong one to force.
fn flattest_tip(polygon: &[Vec2], ring: &[u32]) -> usize {
    let mut best = (0, f64::INFINITY);
    for tip in 0..ring.len() {
        let [a, b, c] = corners_at(polygon, ring, tip);
        let size = turn(a, b, c).abs();
        if size < best.1 {
            best = (tip, size);
        }
    }
    best.0
}

/// The indices of the vertex at position `tip` and its neighbours, in order.
fn triangle_at(ring: &[u32], tip: usize) -> [u32; 3] {
    let count = ring.len();
    [ring[(tip + count - 1) % count], ring[tip], ring[(tip + 1) % count]]
}

fn corners_at(polygon: &[Vec2], ring: &[u32], tip: usize) -> [Vec2; 3] {
    triangle_at(ring, tip).map(|index| polygon[index as usize])
}

/// Whether `point` lies in a counter-clockwise triangle or on its boundary.
fn is_in_triangle([a, b, c]: [Vec2; 3], point: Vec2) -> bool {
    turn(a, b, point) >= 0.0 && turn(b, c, point) >= 0.0 && turn(c, a, point) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::super::arbitrary::{star_polygon, tangled_polygon};
    use super::super::{contains_point, perimeter};
    use super::*;
    use glam::vec2;
    use proptest::prelude::*;

    fn triangle_areas(polygon: &[Vec2], triangles: &[[u32; 3]]) -> Vec<f32> {
        let area = |triangle: &[u32; 3]| signed_area(&triangle.map(|i| polygon[i as usize]));
        triangles.iter().map(area).collect()
    }

    /// Checks what must hold for every simple polygon.
    fn assert_covers(polygon: &[Vec2]) {
        let triangles = triangulate(polygon);
        assert_eq!(triangles.len(), polygon.len() - 2);
        let mut used = vec![false; polygon.len()];
        for index in triangles.iter().flatten() {
            used[*index as usize] = true;
        }
        assert!(used.iter().all(|used| *used), "{triangles:?}");
        let areas = triangle_areas(polygon, &triangles);
        assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
        let (sum, expected) = (areas.iter().sum::<f32>(), signed_area(polygon).abs());
        assert!((sum - expected).abs() <= 1.0e-5 * (1.0 + expected), "{sum} {expected}");
        for triangle in triangles {
            let [a, b, c] = triangle.map(|index| polygon[index as usize]);
            let outside = !contains_point(polygon, (a + b + c) / 3.0);
            // The rounded centre of a sliver may fall beside it.
            assert!(!outside || turn(a, b, c) < 1.0e-3, "{triangle:?}");
        }
    }

    fn assert_covers_both_windings(polygon: &[Vec2]) {
        assert_covers(polygon);
        assert_covers(&polygon.iter().rev().copied().collect::<Vec<_>>());
    }

    #[test]
    fn triangle_is_itself_counter_clockwise() {
        let triangle = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(0.0, 1.0)];
        assert_eq!(triangulate(&triangle).len(), 1);
        assert_covers_both_windings(&triangle);
    }

    #[test]
    fn concave_shapes_are_covered() {
        let arrow = [vec2(0.0, 0.0), vec2(2.0, -1.0), vec2(0.5, 0.0), vec2(2.0, 1.0)];
        assert_covers_both_windings(&arrow);
        let comb: Vec<_> = (0..20)
            .map(|i| vec2(i as f32, if i % 2 == 0 { 1.0 } else { 5.0 }))
            .chain([vec2(19.0, 0.0), vec2(0.0, 0.0)])
            .collect();
        assert_covers_both_windings(&comb);
        let spiral: Vec<_> = [(0, 0), (5, 0), (5, 5), (1, 5), (1, 2), (3, 2), (3, 3), (2, 3)]
            .into_iter()
            .chain([(2, 4), (4, 4), (4, 1), (0, 1)])
            .map(|(x, y)| vec2(x as f32, y as f32))
            .collect();
        assert_covers_both_windings(&spiral);
    }

    #[test]
    fn flat_vertices_make_no_flat_triangles() {
        let side = |from: Vec2, to: Vec2| (0..4).map(move |i| from.lerp(to, i as f32 / 4.0));
        let corners = [vec2(0.0, 0.0), vec2(4.0, 0.0), vec2(4.0, 4.0), vec2(0.0, 4.0)];
        let square: Vec<_> = (0..4).flat_map(|i| side(corners[i], corners[(i + 1) % 4])).collect();
        assert_covers_both_windings(&square);
        let triangle: Vec<_> = side(corners[0], corners[1])
            .chain(side(corners[1], corners[2]))
            .chain(side(corners[2], corners[0]))
            .collect();
        assert_covers_both_windings(&triangle);
    }

    #[test]
    fn degenerate_input_is_answered() {
        assert!(triangulate(&[]).is_empty());
        assert!(triangulate(&[Vec2::ZERO]).is_empty());
        assert!(triangulate(&[Vec2::ZERO, Vec2::ONE]).is_empty());
        assert_eq!(triangulate(&[Vec2::ONE; 6]).len(), 4);
        assert_eq!(triangulate(&[Vec2::NAN; 6]).len(), 4);
        assert_eq!(triangulate(&[Vec2::INFINITY; 6]).len(), 4);
        let mixed = [Vec2::ZERO, Vec2::NAN, Vec2::ONE, Vec2::MAX, vec2(-1.0, f32::NEG_INFINITY)];
        assert_eq!(triangulate(&mixed).len(), 3);
    }

    #[test]
    fn bow_tie_is_cut_by_force() {
        let bow_tie = [vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(1.0, 0.0), vec2(0.0, 1.0)];
        assert_eq!(triangulate(&bow_tie).len(), 2);
    }

    proptest! {
        #[test]
        fn star_polygons_are_covered(polygon in star_polygon()) {
            assert_covers_both_windings(&polygon);
        }

        #[test]
        fn signed_areas_add_up_for_any_polygon(polygon in tangled_polygon()) {
            let triangles = triangulate(&polygon);
            prop_assert_eq!(triangles.len(), polygon.len().saturating_sub(2));
            prop_assert!(triangles.iter().flatten().all(|i| (*i as usize) < polygon.len()));
            let sum: f32 = triangle_areas(&polygon, &triangles).iter().sum();
            let tolerance = 1.0e-5 * (1.0 + perimeter(&polygon)) * 20.0;
            prop_assert!((sum - signed_area(&polygon).abs()).abs() <= tolerance);
        }
    }
}
