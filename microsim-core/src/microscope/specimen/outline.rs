//! Outlines made smooth: a table of radii around a centre, and a map of distances from the edge.

use crate::geometry::{centroid, signed_area};
use crate::microscope::formula::Formula;
use crate::microscope::maths::{larger, mix, smaller};
use crate::microscope::recipe::Map;
use glam::Vec2;

pub(in crate::microscope) const FORMULA: Formula = Formula { source: include_str!("outline.glsl"), constants: &[] };

/// Cells along each side of the squares that a map is measured in, and of the smallest ones.
const SQUARE: usize = 32;
const BLOCK: usize = 8;
/// Directions in a table of radii.
const DIRECTIONS: usize = 128;
/// Points of a smooth outline per node.
const PER_NODE: usize = 4;

/// A closed cubic B-spline through the neighbourhood of the nodes: no corners where nodes are.
pub(super) fn smooth(nodes: &[Vec2]) -> Vec<Vec2> {
    let count = nodes.len();
    let point = |k: usize| {
        let (node, t) = (k / PER_NODE, (k % PER_NODE) as f32 / PER_NODE as f32);
        let p = |offset: usize| nodes[(node + count + offset - 1) % count];
        let (t2, t3) = (t * t, t * t * t);
        let weights =
            [1.0 - 3.0 * t + 3.0 * t2 - t3, 4.0 - 6.0 * t2 + 3.0 * t3, 1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3, t3];
        weights.iter().enumerate().map(|(offset, weight)| p(offset) * (weight / 6.0)).sum()
    };
    (0..count * PER_NODE).map(point).collect()
}

/// A body seen from its centre: how far it reaches in every direction.
#[derive(Clone, Debug)]
pub(super) struct Polar {
    pub centre: Vec2,
    /// Radius of the disc of equal area.
    pub mean: f32,
    pub farthest: f32,
    radii: Vec<f32>,
}

impl Polar {
    /// Around the centroid of an outline; nothing if it encloses no area.
    pub(super) fn around(outline: &[Vec2]) -> Option<Self> {
        let centre = centroid(outline)?;
        let mean = (signed_area(outline).abs() / std::f32::consts::PI).sqrt();
        Some(Self::new(centre, mean, reaches(outline, centre))).filter(|polar| mean > 0.0 && polar.farthest.is_finite())
    }

    pub(super) fn disc(centre: Vec2, radius: f32) -> Option<Self> {
        let is_sound = radius > 0.0 && radius.is_finite() && centre.is_finite();
        is_sound.then(|| Self::new(centre, radius, vec![radius; DIRECTIONS]))
    }

    fn new(centre: Vec2, mean: f32, radii: Vec<f32>) -> Self {
        let radii: Vec<f32> = radii.into_iter().map(|radius| larger(radius, 0.05 * mean)).collect();
        let farthest = radii.iter().copied().fold(0.0, larger);
        Self { centre, mean, farthest, radii }
    }

    /// Changes the radius in every direction.
    pub(super) fn reshape(&mut self, factor: impl Fn(Vec2) -> f32) {
        for (k, radius) in self.radii.iter_mut().enumerate() {
            *radius *= factor(direction(k).normalize());
        }
        self.farthest = self.radii.iter().copied().fold(0.0, larger);
    }

    /// Radius in the direction of `way`.
    pub(super) fn radius(&self, way: Vec2) -> f32 {
        let at = diamond_angle(way) * (DIRECTIONS as f32 / 4.0);
        let k = at as usize;
        let (a, b) = (self.radii[k % DIRECTIONS], self.radii[(k + 1) % DIRECTIONS]);
        a + (b - a) * (at - k as f32)
    }
}

/// Angle of a vector, 0 to 4 counter-clockwise from +x, growing evenly along a square instead of a circle.
fn diamond_angle(v: Vec2) -> f32 {
    let sum = v.x.abs() + v.y.abs();
    if sum <= 0.0 || !sum.is_finite() {
        return 0.0;
    }
    let share = v / sum;
    match (share.x >= 0.0, share.y >= 0.0) {
        (true, true) => share.y,
        (false, true) => 1.0 - share.x,
        (false, false) => 2.0 - share.y,
        (true, false) => 3.0 + share.x,
    }
}

/// The direction of entry `k` of a table.
fn direction(k: usize) -> Vec2 {
    let at = k as f32 * 4.0 / DIRECTIONS as f32;
    let share = at - at.floor();
    match k * 4 / DIRECTIONS {
        0 => Vec2::new(1.0 - share, share),
        1 => Vec2::new(-share, 1.0 - share),
        2 => Vec2::new(share - 1.0, -share),
        _ => Vec2::new(share, share - 1.0),
    }
}

/// How far an outline reaches from a point in each direction; 0 where it does not.
fn reaches(outline: &[Vec2], from: Vec2) -> Vec<f32> {
    let directions: Vec<Vec2> = (0..DIRECTIONS).map(|k| direction(k).normalize()).collect();
    let mut reaches = vec![0.0; DIRECTIONS];
    for (k, &corner) in outline.iter().enumerate() {
        let (a, b) = (corner - from, outline[(k + 1) % outline.len()] - from);
        for at in between(a, b) {
            reaches[at] = larger(reaches[at], crossing(a, b, directions[at]));
        }
    }
    reaches
}

/// Directions that may cross a side from `a` to `b`, seen from the origin: those between its ends, and one more each.
fn between(a: Vec2, b: Vec2) -> impl Iterator<Item = usize> {
    let [start, end] = [a, b].map(|end| diamond_angle(end) * (DIRECTIONS as f32 / 4.0));
    let turn = DIRECTIONS as f32;
    let way = end - start;
    // The shorter way round, but where the side passes so near that either may be.
    let way = if way > 0.5 * turn {
        way - turn
    } else if way < -0.5 * turn {
        way + turn
    } else {
        way
    };
    let (low, high) = (smaller(start, start + way).floor() as i32 - 1, larger(start, start + way).ceil() as i32 + 1);
    let all = way.abs() > 0.45 * turn || !way.is_finite();
    let (low, high) = if all { (0, DIRECTIONS as i32 - 1) } else { (low, high) };
    (low..=high).map(|at| at.rem_euclid(DIRECTIONS as i32) as usize)
}

/// How far from the origin a side from `a` to `b` is crossed in a direction; 0 if it is not.
fn crossing(a: Vec2, b: Vec2, direction: Vec2) -> f32 {
    let (side_a, side_b) = (direction.perp_dot(a), direction.perp_dot(b));
    if (side_a < 0.0) == (side_b < 0.0) {
        return 0.0;
    }
    (a + (b - a) * (side_a / (side_a - side_b))).dot(direction)
}

/// Signed distance from an outline, positive inside, on a grid.
#[derive(Clone, Debug)]
pub(in crate::microscope) struct DistanceMap {
    low: Vec2,
    step: f32,
    size: [usize; 2],
    values: Vec<f32>,
}

impl DistanceMap {
    /// Cells of the map along its longer side, at most.
    const MOST: f32 = 160.0;

    /// Of an outline and `margin` around it, with cells of about `step`.
    pub(super) fn of(outline: &[Vec2], step: f32, margin: f32) -> Self {
        let bounds = outline.iter().fold((outline[0], outline[0]), |(low, high), &p| (low.min(p), high.max(p)));
        let extent = bounds.1 - bounds.0;
        let step = larger(step, extent.max_element() / Self::MOST);
        let mut map = Self::sampled(bounds, step, margin, |_| 0.0);
        map.measure(outline);
        map.soften();
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
        let reach = nearest + 2.0 * half * std::f32::consts::SQRT_2;
        let near = edges.iter().zip(&squares).filter(|(_, square)| **square <= reach * reach);
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

    /// Takes the creases out: each value becomes a weighted mean of its neighbours.
    fn soften(&mut self) {
        let [columns, rows] = self.size;
        for line in self.values.chunks_exact_mut(columns) {
            let mut before = line[0];
            for x in 0..columns {
                let (here, after) = (line[x], line[(x + 1).min(columns - 1)]);
                line[x] = 0.25 * before + 0.5 * here + 0.25 * after;
                before = here;
            }
        }
        let old = self.values.clone();
        let row = |y: usize| &old[y * columns..][..columns];
        for (y, line) in self.values.chunks_exact_mut(columns).enumerate() {
            let neighbours = row(y.saturating_sub(1)).iter().zip(row((y + 1).min(rows - 1)));
            for (value, (before, after)) in line.iter_mut().zip(neighbours) {
                *value = 0.25 * before + 0.5 * *value + 0.25 * after;
            }
        }
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
    pub(super) fn crossing(&self, from: Vec2, way: Vec2, step: f32) -> Option<f32> {
        let depth = |k: u32| self.at(from + way * (k as f32 * step));
        let beyond = (1..60).find(|&k| depth(k) < 0.0)?;
        let (inside, outside) = (depth(beyond - 1), depth(beyond));
        Some(step * ((beyond - 1) as f32 + (inside / (inside - outside)).clamp(0.0, 1.0)))
    }

    /// As a texture, two bytes for each depth, and what [`FORMULA`] has to know of it.
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
    use super::*;
    use crate::geometry::ellipse;
    use crate::microscope::noise::Dice;

    #[test]
    fn a_table_of_radii_knows_its_outline() {
        let outline: Vec<Vec2> = ellipse(Vec2::new(6.0, 2.0), 200).iter().map(|p| *p + Vec2::new(5.0, -3.0)).collect();
        let polar = Polar::around(&outline).unwrap();
        assert!((polar.centre - Vec2::new(5.0, -3.0)).length() < 1e-3 && (polar.mean - 12_f32.sqrt()).abs() < 0.01);
        for (way, radius) in [(Vec2::X, 6.0), (Vec2::NEG_X, 6.0), (Vec2::Y, 2.0), (Vec2::NEG_Y, 2.0)] {
            assert!((polar.radius(way) - radius).abs() < 0.02, "{way}: {}", polar.radius(way));
        }
        assert!(
            outline.iter().all(|&p| (polar.radius(p - polar.centre) / (p - polar.centre).length() - 1.0).abs() < 0.02)
        );
        assert!(Polar::around(&[Vec2::ZERO, Vec2::ONE, Vec2::X * f32::NAN]).is_none() && Polar::around(&[]).is_none());
    }

    #[test]
    fn no_side_is_overlooked() {
        let mut dice = Dice::new(5);
        for _ in 0..50 {
            // Any shape, with the centre inside, outside and on its edge.
            let outline: Vec<Vec2> =
                (0..9).map(|_| Vec2::new(dice.range([-3.0, 3.0]), dice.range([-3.0, 3.0]))).collect();
            for from in [Vec2::ZERO, outline[0], 0.5 * (outline[0] + outline[1]), Vec2::splat(4.0)] {
                let of_all = |k: usize| {
                    let sides = (0..9).map(|side| (outline[side] - from, outline[(side + 1) % 9] - from));
                    sides.map(|(a, b)| crossing(a, b, direction(k).normalize())).fold(0.0, larger)
                };
                let expected: Vec<f32> = (0..DIRECTIONS).map(of_all).collect();
                assert_eq!(reaches(&outline, from), expected, "{outline:?} from {from}");
            }
        }
    }

    #[test]
    fn a_map_knows_how_far_the_edge_is() {
        let outline = smooth(&ellipse(Vec2::new(5.0, 5.0), 60));
        let map = DistanceMap::of(&outline, 0.25, 1.0);
        for (at, depth) in [(Vec2::new(3.0, 0.0), 2.0), (Vec2::new(0.0, -4.0), 1.0), (Vec2::new(5.5, 0.0), -0.5)] {
            assert!((map.at(at) - depth).abs() < 0.05, "{at}: {}", map.at(at));
        }
        let moved = map.pushed_inside(Vec2::new(4.8, 0.0), 1.5);
        assert!(map.at(moved) > 1.4, "{moved}");
    }
}
