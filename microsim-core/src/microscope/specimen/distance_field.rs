//! Signed distances from an outline.

use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{larger, mix, smaller};
use crate::microscope::raster::blur;
use crate::microscope::recipe::Map;
use glam::Vec2;

pub(in crate::microscope) const GLSL: Glsl = Glsl { source: bare_text!("distance_field.glsl", "//"), constants: &[] };

/// Cells along each side of the squares that distances are measured in, and of the smallest ones.
const SQUARE: usize = 32;
const BLOCK: usize = 8;

/// Signed distance from an outline, positive inside, on a grid.
#[derive(Clone, Debug)]
pub(in crate::microscope) struct DistanceField {
    low: Vec2,
    step: f32,
    size: [usize; 2],
    values: Vec<f32>,
}

impl DistanceField {
    /// Cells of the map along its longer side, at most.
    const MOST: f32 = 160.0;

    /// Of an outline and `margin` around it, with cells of about `step`.
    pub(super) fn of(outline: &[Vec2], step: f32, margin: f32) -> Self {
        let bounds = outline.iter().fold((outline[0], outline[0]), |(low, high), &p| (low.min(p), high.max(p)));
        let extent = bounds.1 - bounds.0;
        let step = larger(step, extent.max_element() / Self::MOST);
        let mut map = Self::sampled(bounds, step, margin, |_| 0.0);
        map.measure(outline);
        // Without creases.
        blur(map.values.as_chunks_mut::<1>().0, map.size[0], &[0.25, 0.5, 0.25]);
        map
    }

    /// Distances from an outline.
    fn measure(&mut self, outline: &[Vec2]) {
        let [columns, rows] = self.size;
        let edges: Vec<Edge> = (0..outline.len()).map(|k| [outline[k], outline[(k + 1) % outline.len()]]).collect();
        for corner in (0..rows).step_by(SQUARE).flat_map(|y| (0..columns).step_by(SQUARE).map(move |x| [x, y])) {
            self.measure_square(corner, SQUARE, &edges);
        }
        for y in 0..rows {
            let crossings = crossings(&edges, self.low.y + y as f32 * self.step);
            for x in 0..columns {
                let at = self.low.x + x as f32 * self.step;
                let is_inside = crossings.iter().filter(|&&crossing| at < crossing).count() % 2 == 1;
                self.values[y * columns + x] *= if is_inside { 1.0 } else { -1.0 };
            }
        }
    }

    /// Distances from edges in a square of cells, of which only a few can be the nearest to any of a smaller one.
    fn measure_square(&mut self, [left, top]: [usize; 2], side: usize, edges: &[Edge]) {
        let [columns, rows] = self.size;
        if left >= columns || top >= rows {
            return;
        }
        let half = 0.5 * (side - 1) as f32 * self.step;
        let middle = self.low + Vec2::new(left as f32, top as f32) * self.step + Vec2::splat(half);
        let squares: Vec<f32> = edges.iter().map(|edge| distance_squared(edge, middle)).collect();
        let nearest = squares.iter().copied().fold(f32::INFINITY, smaller).sqrt();
        let farthest = nearest + 2.0 * half * std::f32::consts::SQRT_2;
        let near = edges.iter().zip(&squares).filter(|(_, square)| **square <= farthest * farthest);
        let near: Vec<Edge> = near.map(|(edge, _)| *edge).collect();
        if side > BLOCK {
            let part = side / 2;
            for corner in [[left, top], [left + part, top], [left, top + part], [left + part, top + part]] {
                self.measure_square(corner, part, &near);
            }
            return;
        }
        for y in top..rows.min(top + BLOCK) {
            let place = |x: usize| self.low + Vec2::new((left + x) as f32, y as f32) * self.step;
            let places: [Vec2; BLOCK] = std::array::from_fn(place);
            let mut squares = [f32::INFINITY; BLOCK];
            for edge in &near {
                for (square, place) in squares.iter_mut().zip(places) {
                    *square = smaller(*square, distance_squared(edge, place));
                }
            }
            let row = &mut self.values[y * columns..][left..columns.min(left + BLOCK)];
            row.iter_mut().zip(squares).for_each(|(value, square)| *value = square.sqrt());
        }
    }

    /// Of any distance, in a box and `margin` around it.
    pub(super) fn sampled((low, high): (Vec2, Vec2), step: f32, margin: f32, distance: impl Fn(Vec2) -> f32) -> Self {
        let extent = high - low;
        let low = low - Vec2::splat(margin);
        let size = ((extent + 2.0 * margin) / step).ceil().to_array().map(|cells| cells as usize + 1);
        let mut map = Self { low, step, size, values: Vec::with_capacity(size[0] * size[1]) };
        for y in 0..size[1] {
            for x in 0..size[0] {
                let at = low + Vec2::new(x as f32, y as f32) * step;
                map.values.push(distance(at));
            }
        }
        map
    }

    /// Makes a disc part of the inside; over `neck` the two edges run into each other.
    pub(super) fn unite(&mut self, centre: Vec2, radius: f32, neck: f32) {
        for k in 0..self.values.len() {
            let cell = Vec2::new((k % self.size[0]) as f32, (k / self.size[0]) as f32);
            let depth = radius - (self.low + cell * self.step - centre).length();
            self.values[k] = united(self.values[k], depth, neck);
        }
    }

    /// Distance from a place inside to the edge, in steps along a direction.
    pub(super) fn crossing(&self, from: Vec2, direction: Vec2, step: f32) -> Option<f32> {
        let depth = |k: u32| self.at(from + direction * (k as f32 * step));
        let beyond = (1..60).find(|&k| depth(k) < 0.0)?;
        let (inside, outside) = (depth(beyond - 1), depth(beyond));
        Some(step * ((beyond - 1) as f32 + (inside / (inside - outside)).clamp(0.0, 1.0)))
    }

    /// As a texture, two bytes for each depth, and the uniforms of [`GLSL`].
    pub(in crate::microscope) fn texture(&self) -> (Map, [f32; 7]) {
        let [columns, rows] = self.size;
        let least = self.values.iter().copied().fold(f32::INFINITY, smaller);
        let most = self.values.iter().copied().fold(f32::NEG_INFINITY, larger);
        let share = |depth: f32| ((depth - least) / larger(most - least, 1e-6) * 65535.0) as u16;
        let mut texels = Vec::with_capacity(4 * self.values.len());
        for &depth in &self.values {
            let [high, low] = share(depth).to_be_bytes();
            texels.extend([high, low, 0, 255]);
        }
        let map = Map { size: [columns as u16, rows as u16], texels };
        (map, [self.low.x, self.low.y, 1.0 / self.step, most, columns as f32, rows as f32, least])
    }

    /// Box that the map covers.
    pub(super) fn bounds(&self) -> (Vec2, Vec2) {
        let [columns, rows] = self.size;
        (self.low, self.low + Vec2::new((columns - 1) as f32, (rows - 1) as f32) * self.step)
    }

    /// Distance at a place, by a quadratic B-spline: smooth, and smooth in its slope.
    pub(super) fn at(&self, place: Vec2) -> f32 {
        let at = (place - self.low) / self.step;
        let [columns, rows] = self.size;
        let nearest = (at + 0.5).floor();
        let t = at - nearest;
        let weights = |t: f32| [0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)];
        let (wx, wy) = (weights(t.x), weights(t.y));
        let index =
            |k: f32, offset: usize, count: usize| ((k as isize + offset as isize - 1).max(0) as usize).min(count - 1);
        let mut sum = 0.0;
        for (j, wy) in wy.iter().enumerate() {
            let row = index(nearest.y, j, rows) * columns;
            for (i, wx) in wx.iter().enumerate() {
                sum += wx * wy * self.values[row + index(nearest.x, i, columns)];
            }
        }
        sum
    }

    /// Moves a place inwards until it is `depth` inside, as far as a few steps take it.
    pub(super) fn pushed_inside(&self, place: Vec2, depth: f32) -> Vec2 {
        let mut place = place;
        for _ in 0..4 {
            let lacking = depth - self.at(place);
            if lacking <= 0.0 {
                break;
            }
            let h = self.step;
            let slope = Vec2::new(
                self.at(place + Vec2::new(h, 0.0)) - self.at(place - Vec2::new(h, 0.0)),
                self.at(place + Vec2::new(0.0, h)) - self.at(place - Vec2::new(0.0, h)),
            );
            place += slope.normalize_or_zero() * smaller(lacking, 4.0 * h);
        }
        place
    }
}

/// Depth in the union of two things, given the depths in each; over `neck` their edges run into each other.
pub(super) fn united(a: f32, b: f32, neck: f32) -> f32 {
    let share = (0.5 + 0.5 * (a - b) / neck).clamp(0.0, 1.0);
    mix(b, a, share) + neck * share * (1.0 - share)
}

/// A side of an outline, from one corner to the next.
type Edge = [Vec2; 2];

fn distance_squared([a, b]: &Edge, at: Vec2) -> f32 {
    let (edge, to) = (*b - *a, at - *a);
    let share = (to.dot(edge) / larger(edge.length_squared(), 1e-12)).clamp(0.0, 1.0);
    (to - edge * share).length_squared()
}

/// Where the edges of an outline cross a height: what has an odd number of them on its right is inside.
fn crossings(edges: &[Edge], y: f32) -> Vec<f32> {
    let crosses = edges.iter().filter(|[a, b]| (a.y > y) != (b.y > y));
    crosses.map(|[a, b]| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::spline::smooth;
    use super::*;
    use crate::geometry::ellipse;

    #[test]
    fn a_map_knows_how_far_the_edge_is() {
        let outline = smooth(&ellipse(Vec2::new(5.0, 5.0), 60));
        let map = DistanceField::of(&outline, 0.25, 1.0);
        for (at, depth) in [(Vec2::new(3.0, 0.0), 2.0), (Vec2::new(0.0, -4.0), 1.0), (Vec2::new(5.5, 0.0), -0.5)] {
            assert!((map.at(at) - depth).abs() < 0.05, "{at}: {}", map.at(at));
        }
        let moved = map.pushed_inside(Vec2::new(4.8, 0.0), 1.5);
        assert!(map.at(moved) > 1.4, "{moved}");
    }
}
