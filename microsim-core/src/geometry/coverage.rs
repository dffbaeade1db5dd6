//! How much of a polygon is left free by what lies in it, on a raster.

use super::polygon::contains_point;
use super::segment::nearest_on_segment;
use glam::Vec2;

/// Most samples along one side of the raster.
const MOST: f32 = 2048.0;

/// Samples within a polygon, of which some are covered.
///
/// Samples lie on a square lattice fixed in the plane, so that equal shapes in equal places give equal counts.
#[derive(Clone, Debug)]
pub(crate) struct Coverage {
    /// Lattice constant, units.
    pitch: f32,
    /// Lattice coordinates of the first sample.
    low: [f32; 2],
    columns: usize,
    rows: usize,
    /// One per sample, row by row: within the polygon and not covered.
    is_free: Vec<bool>,
    /// Samples within the polygon.
    inside: usize,
}

impl Coverage {
    /// The samples of a polygon, `pitch` apart (farther, where it is too large for that). `None` where there is no sample
    /// or a coordinate is not finite.
    pub(crate) fn of(polygon: &[Vec2], pitch: f32) -> Option<Self> {
        let (low, high) = bounds(polygon)?;
        let size = high - low;
        let side = if size.x > size.y { size.x } else { size.y };
        let pitch = if side / MOST > pitch { side / MOST } else { pitch };
        let is_sound = polygon.iter().all(|p| p.is_finite()) && pitch > 0.0 && pitch.is_finite();
        if !is_sound {
            return None;
        }
        let (from, to) = ((low / pitch).ceil(), (high / pitch).floor());
        let [columns, rows] = [to.x - from.x, to.y - from.y].map(|last| (last + 1.0) as usize);
        let is_free = vec![false; columns * rows];
        let mut coverage = Self { pitch, low: from.to_array(), columns, rows, is_free, inside: 0 };
        coverage.fill(polygon);
        (coverage.inside > 0).then_some(coverage)
    }

    /// Covers a disc.
    pub(crate) fn cover_disc(&mut self, centre: Vec2, radius: f32) {
        let extent = Vec2::splat(radius);
        self.cover(centre - extent, centre + extent, |p| (p - centre).length_squared() <= radius * radius);
    }

    /// Covers a segment with round ends.
    pub(crate) fn cover_capsule(&mut self, a: Vec2, b: Vec2, radius: f32) {
        let extent = Vec2::splat(radius);
        let (low, high) = (Vec2::select(a.cmplt(b), a, b), Vec2::select(a.cmplt(b), b, a));
        self.cover(low - extent, high + extent, |p| {
            (p - nearest_on_segment(a, b, p)).length_squared() <= radius * radius
        });
    }

    /// Covers the area of a polygon.
    pub(crate) fn cover_polygon(&mut self, polygon: &[Vec2]) {
        if let Some((low, high)) = bounds(polygon) {
            self.cover(low, high, |p| contains_point(polygon, p));
        }
    }

    /// Share of the polygon that nothing has covered.
    pub(crate) fn free_share(&self) -> f32 {
        self.is_free.iter().filter(|&&is_free| is_free).count() as f32 / self.inside as f32
    }

    /// Frees all samples within the polygon: in each row those between an odd crossing and the next one.
    fn fill(&mut self, polygon: &[Vec2]) {
        let mut crossings = Vec::new();
        for row in 0..self.rows {
            let y = (self.low[1] + row as f32) * self.pitch;
            crossings.clear();
            crossings.extend((0..polygon.len()).filter_map(|k| {
                let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
                ((a.y <= y) != (b.y <= y)).then(|| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)))
            }));
            crossings.sort_by(f32::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let [from, to] = [pair[0], pair[1]].map(|x| self.index(x, 0, self.columns));
                self.is_free[row * self.columns..][from..to].fill(true);
                self.inside += to - from;
            }
        }
    }

    fn cover(&mut self, low: Vec2, high: Vec2, is_covered: impl Fn(Vec2) -> bool) {
        let [from_x, to_x] = [low.x, high.x].map(|x| self.index(x, 0, self.columns));
        let [from_y, to_y] = [low.y, high.y].map(|y| self.index(y, 1, self.rows));
        for row in from_y..to_y {
            for column in from_x..to_x {
                let at = Vec2::new(self.low[0] + column as f32, self.low[1] + row as f32) * self.pitch;
                let is_free = &mut self.is_free[row * self.columns + column];
                *is_free = *is_free && !is_covered(at);
            }
        }
    }

    /// The first column or row at or behind a coordinate; `count` if there is none.
    fn index(&self, coordinate: f32, axis: usize, count: usize) -> usize {
        (((coordinate / self.pitch).ceil() - self.low[axis]) as usize).min(count)
    }
}

/// Lower left and upper right corner of the box around a polygon.
fn bounds(polygon: &[Vec2]) -> Option<(Vec2, Vec2)> {
    let first = *polygon.first()?;
    Some(polygon.iter().fold((first, first), |(low, high), &p| {
        (Vec2::select(p.cmplt(low), p, low), Vec2::select(p.cmpgt(high), p, high))
    }))
}

#[cfg(test)]
mod tests {
    use super::super::ring::ellipse;
    use super::*;
    use core::f32::consts::PI;

    const SQUARE: [(f32, f32); 4] = [(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)];

    fn square() -> Coverage {
        Coverage::of(&SQUARE.map(Vec2::from), 0.05).unwrap()
    }

    fn assert_free(coverage: &Coverage, expected: f32) {
        assert!((coverage.free_share() - expected).abs() < 0.005, "{} free", coverage.free_share());
    }

    #[test]
    fn a_disc_in_a_square_leaves_the_corners() {
        let mut coverage = square();
        assert_free(&coverage, 1.0);
        coverage.cover_disc(Vec2::ZERO, 5.0);
        assert_free(&coverage, 1.0 - PI / 4.0);
        coverage.cover_disc(Vec2::ZERO, 4.0);
        coverage.cover_disc(Vec2::new(100.0, -100.0), 2.0);
        assert_free(&coverage, 1.0 - PI / 4.0);
    }

    #[test]
    fn a_half_is_a_half_and_capsules_have_round_ends() {
        let mut coverage = square();
        coverage.cover_polygon(&[(-9.0, -9.0), (0.0, -9.0), (0.0, 9.0), (-9.0, 9.0)].map(Vec2::from));
        assert_free(&coverage, 0.5);
        coverage.cover_capsule(Vec2::new(2.0, -1.0), Vec2::new(2.0, 1.0), 1.0);
        assert_free(&coverage, 0.5 - (4.0 + PI) / 100.0);
    }

    #[test]
    fn hollows_of_the_polygon_do_not_count() {
        let notched = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)].map(Vec2::from);
        let mut coverage = Coverage::of(&notched, 0.01).unwrap();
        coverage.cover_polygon(&[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)].map(Vec2::from));
        assert_free(&coverage, 1.0);
        coverage.cover_polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(Vec2::from));
        assert_free(&coverage, 2.0 / 3.0);
    }

    #[test]
    fn a_ring_that_is_covered_along_its_edge_leaves_its_middle() {
        let ring = ellipse(Vec2::splat(10.0), 100);
        let mut coverage = Coverage::of(&ring, 0.1).unwrap();
        (0..100).for_each(|k| coverage.cover_capsule(ring[k], ring[(k + 1) % 100], 1.0));
        assert_free(&coverage, 0.81);
    }

    #[test]
    fn shapes_without_area_have_no_samples_and_huge_ones_few() {
        assert!(Coverage::of(&[], 0.1).is_none());
        assert!(Coverage::of(&[Vec2::ZERO, Vec2::NAN, Vec2::X], 0.1).is_none());
        assert!(Coverage::of(&[Vec2::ZERO, Vec2::X, Vec2::Y], f32::NAN).is_none());
        let huge = Coverage::of(&SQUARE.map(|p| Vec2::from(p) * 1e6), 0.01).unwrap();
        assert!(huge.is_free.len() <= 2049 * 2049);
    }
}
