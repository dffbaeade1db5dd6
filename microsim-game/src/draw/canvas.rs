//! Collects triangles and hands them over in few draw calls: one texture, and never more vertices than a call holds.

use super::atlas::{self, Tile};
use crate::convert;
use crate::window;
use macroquad::camera::{pop_camera_state, push_camera_state};
use macroquad::color::Color;
use macroquad::models::{Mesh, draw_mesh};
use macroquad::texture::Texture2D;
use microsim_core::glam::Vec2;
use std::f32::consts::FRAC_PI_2;
use std::fmt;

/// Pieces of a whole ring.
const ARC_STEPS: f32 = 40.0;
/// Pieces of a round corner.
const CORNER_STEPS: usize = 4;
/// Least radius of a ring's hole, pixels.
const SMALLEST_HOLE: f32 = 1.0;
/// Points of an outline that share their vertices with the next ones.
const RUN: usize = 256;
/// What a mesh may hold: macroquad cuts off one that fills a draw call to the brim.
const MAX_VERTICES: usize = window::CALL_VERTICES - 1;
const MAX_INDICES: usize = window::CALL_INDICES - 3;

/// A drawing surface in picture pixels, x right, y down.
pub(crate) struct Canvas {
    mesh: Mesh,
}

impl fmt::Debug for Canvas {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Canvas").field("vertices", &self.mesh.vertices.len()).finish_non_exhaustive()
    }
}

/// One line of a band: how far out from the outline, and in what colour.
pub(crate) type Rim = (f32, Color);

impl Canvas {
    /// One with the pictures of the atlas. Needs an open window, as do all that can be drawn.
    pub(crate) fn new() -> Self {
        Self::of(Texture2D::from_rgba8(atlas::WIDTH, atlas::HEIGHT, &atlas::pixels()))
    }

    /// One with another texture, for [`Canvas::image`].
    pub(crate) fn of(texture: Texture2D) -> Self {
        Self { mesh: Mesh { texture: Some(texture), ..Self::bare().mesh } }
    }

    /// One that collects and cannot draw.
    pub(crate) fn bare() -> Self {
        let (vertices, indices) = (Vec::with_capacity(MAX_VERTICES), Vec::with_capacity(MAX_INDICES));
        Self { mesh: Mesh { vertices, indices, texture: None } }
    }

    /// How many corners have a colour.
    #[cfg(test)]
    pub(crate) fn count(&self, colour: Color) -> usize {
        self.corners().filter(|(_, _, drawn)| *drawn == <[u8; 4]>::from(colour)).count()
    }

    /// What has been collected: corners of triangles with their place in the texture and their colour.
    #[cfg(test)]
    pub(crate) fn corners(&self) -> impl Iterator<Item = (Vec2, Vec2, [u8; 4])> {
        let corner =
            |v: &macroquad::models::Vertex| (Vec2::new(v.position.x, v.position.y), Vec2::new(v.uv.x, v.uv.y), v.color);
        self.mesh.vertices.iter().map(corner)
    }

    /// Draws what has been collected.
    pub(crate) fn flush(&mut self) {
        if !self.mesh.indices.is_empty() {
            draw_mesh(&self.mesh);
        }
        self.mesh.vertices.clear();
        self.mesh.indices.clear();
    }

    /// A square with a picture of the atlas on it.
    pub(crate) fn sprite(&mut self, centre: Vec2, half: f32, tile: Tile, colour: Color) {
        let corners = [Vec2::NEG_ONE, Vec2::ONE];
        self.image(corners.map(|corner| centre + corner * half), corners.map(|corner| tile.at(corner)), colour);
    }

    /// A part of the texture, both by upper left and lower right corner: in picture pixels, in shares of the texture.
    pub(crate) fn image(&mut self, at: [Vec2; 2], part: [Vec2; 2], colour: Color) {
        self.reserve(4, 6);
        let corner = |[low, high]: [Vec2; 2], right: f32, down: f32| low + (high - low) * Vec2::new(right, down);
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let [a, b, c, d] = corners.map(|(x, y)| self.vertex(corner(at, x, y), corner(part, x, y), colour));
        self.mesh.indices.extend([a, b, c, a, c, d]);
    }

    /// A plain rectangle.
    pub(crate) fn rectangle(&mut self, low: Vec2, high: Vec2, colour: Color) {
        self.quad([low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)], [colour; 4]);
    }

    /// A plain rectangle with round corners.
    pub(crate) fn rounded(&mut self, low: Vec2, high: Vec2, radius: f32, colour: Color) {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let radius = radius.min(half.min_element());
        let point = |k: usize| {
            // The last point of each corner is followed by the first of the next one.
            let quarter = (k / (CORNER_STEPS + 1)) as f32 * FRAC_PI_2;
            let turn = (k % (CORNER_STEPS + 1)) as f32 / CORNER_STEPS as f32 * FRAC_PI_2;
            let side = Vec2::from_angle(quarter + 0.5 * FRAC_PI_2).signum();
            let at = side * (half - radius) + radius * Vec2::from_angle(quarter + turn);
            middle + Vec2::new(at.x, -at.y)
        };
        let outline: Vec<Vec2> = (0..4 * (CORNER_STEPS + 1)).map(point).collect();
        let fan: Vec<[u32; 3]> = (2..outline.len() as u32).map(|k| [0, k - 1, k]).collect();
        self.fill(&outline, &fan, colour);
    }

    /// A plain quadrangle.
    pub(crate) fn quad(&mut self, corners: [Vec2; 4], colours: [Color; 4]) {
        self.reserve(4, 6);
        let [a, b, c, d] = std::array::from_fn(|k| self.vertex(corners[k], atlas::plain(), colours[k]));
        self.mesh.indices.extend([a, b, c, a, c, d]);
    }

    /// A plain triangle.
    pub(crate) fn corner(&mut self, corners: [Vec2; 3], colour: Color) {
        self.reserve(3, 3);
        let [a, b, c] = corners.map(|corner| self.vertex(corner, atlas::plain(), colour));
        self.triangle(a, b, c);
    }

    /// A straight line.
    pub(crate) fn segment(&mut self, from: Vec2, to: Vec2, width: f32, colour: Color) {
        let half = (to - from).perp().normalize_or_zero() * (0.5 * width);
        self.quad([from - half, from + half, to + half, to - half], [colour; 4]);
    }

    /// A ring in as few pieces as look round, for many small ones; a disc where its hole would be lost in the pixels.
    pub(crate) fn circle(&mut self, centre: Vec2, radius: f32, width: f32, colour: Color) {
        if radius - 0.5 * width < SMALLEST_HOLE {
            return self.sprite(centre, radius + 0.5 * width, Tile::Disc, colour);
        }
        let pieces = (8.0 + 4.0 * radius.max(0.0).sqrt()).min(48.0) as u16;
        let count = 2 * pieces;
        self.reserve(count.into(), 3 * usize::from(count));
        let first = self.mesh.vertices.len() as u16;
        for k in 0..pieces {
            let way = Vec2::from_angle(f32::from(k) * std::f32::consts::TAU / f32::from(pieces));
            for reach in [radius - 0.5 * width, radius + 0.5 * width] {
                self.vertex(centre + way * reach, atlas::plain(), colour);
            }
        }
        for k in 0..count {
            self.triangle(first + k, first + (k + 1) % count, first + (k + 2) % count);
        }
    }

    /// A share of a ring, clockwise from its top.
    pub(crate) fn arc(&mut self, centre: Vec2, radius: f32, width: f32, share: f32, colour: Color) {
        let steps = (ARC_STEPS * share).ceil().max(1.0);
        let turn = |k: f32| share * k / steps * std::f32::consts::TAU - FRAC_PI_2;
        let points: Vec<Vec2> =
            (0..=steps as usize).map(|k| centre + Vec2::from_angle(turn(k as f32)) * radius).collect();
        let (clear, half) = (Color { a: 0.0, ..colour }, 0.5 * width);
        self.line(&points, &[(-half - 0.8, clear), (-half, colour), (half, colour), (half + 0.8, clear)]);
    }

    /// A polygon that was cut into triangles.
    pub(crate) fn fill(&mut self, points: &[Vec2], triangles: &[[u32; 3]], colour: Color) {
        for part in triangles.chunks(MAX_INDICES / 3) {
            if points.len() <= MAX_VERTICES {
                self.reserve(points.len(), part.len() * 3);
                let base = self.mesh.vertices.len() as u32;
                for &point in points {
                    self.vertex(point, atlas::plain(), colour);
                }
                self.mesh.indices.extend(part.as_flattened().iter().map(|index| (base + index) as u16));
            } else {
                part.iter().for_each(|triangle| self.corner(triangle.map(|index| points[index as usize]), colour));
            }
        }
    }

    /// A closed outline filled from a centre, with the disc that is inscribed in a tile stretched over it: point `k` of
    /// `n` shows the tile at the angle `k / n` of a turn.
    pub(crate) fn fan(&mut self, centre: Vec2, outline: &[Vec2], tile: Tile, colour: Color) {
        let count = outline.len();
        for start in (0..count).step_by(RUN) {
            let end = (start + RUN).min(count);
            self.reserve(end - start + 2, (end - start) * 3);
            let hub = self.vertex(centre, tile.at(Vec2::ZERO), colour);
            for k in start..=end {
                let angle = k as f32 / count as f32 * std::f32::consts::TAU;
                let on_tile = Vec2::new(angle.cos(), -angle.sin());
                let tip = self.vertex(outline[k % count], tile.at(on_tile), colour);
                if k > start {
                    self.triangle(hub, tip - 1, tip);
                }
            }
        }
    }

    /// A band along a closed outline, counter-clockwise in the room: colours run from each of `rims` to the next.
    pub(crate) fn band(&mut self, outline: &[Vec2], rims: &[Rim]) {
        self.strip(outline, outline.len(), rims);
    }

    /// A band along an open line; out is to the right when walking along it with y up.
    pub(crate) fn line(&mut self, points: &[Vec2], rims: &[Rim]) {
        self.strip(points, points.len().saturating_sub(1), rims);
    }

    fn strip(&mut self, points: &[Vec2], segments: usize, rims: &[Rim]) {
        let (count, across) = (points.len(), rims.len() as u16);
        if count < 2 || across < 2 {
            return;
        }
        for start in (0..segments).step_by(RUN) {
            let end = (start + RUN).min(segments);
            self.reserve((end - start + 1) * rims.len(), (end - start) * (rims.len() - 1) * 6);
            for k in start..=end {
                let out = outward(points, k, segments < count);
                let first = self.mesh.vertices.len() as u16;
                for &(offset, colour) in rims {
                    self.vertex(points[k % count] + out * offset, atlas::plain(), colour);
                }
                if k > start {
                    for j in first..first + across - 1 {
                        self.triangle(j, j + 1, j - across);
                        self.triangle(j + 1, j - across, j + 1 - across);
                    }
                }
            }
        }
    }

    fn reserve(&mut self, vertices: usize, indices: usize) {
        let is_full = self.mesh.vertices.len() + vertices > MAX_VERTICES;
        if is_full || self.mesh.indices.len() + indices > MAX_INDICES {
            self.flush();
            // When a camera comes back macroquad draws what it holds, so its buffers need not hold a whole frame.
            push_camera_state();
            pop_camera_state();
        }
    }

    fn vertex(&mut self, position: Vec2, uv: Vec2, colour: Color) -> u16 {
        self.mesh.vertices.push(convert::vertex(position, uv, colour));
        self.mesh.vertices.len() as u16 - 1
    }

    fn triangle(&mut self, a: u16, b: u16, c: u16) {
        self.mesh.indices.extend([a, b, c]);
    }
}

/// Unit normal at a point of a line, out of a counter-clockwise outline, in picture pixels.
fn outward(points: &[Vec2], k: usize, is_open: bool) -> Vec2 {
    let count = points.len();
    let (before, after) = if is_open {
        (k.saturating_sub(1), (k + 1).min(count - 1))
    } else {
        ((k + count - 1) % count, (k + 1) % count)
    };
    (points[after] - points[before]).perp().normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;
    use macroquad::color::WHITE;

    #[test]
    fn round_corners_stay_inside_the_rectangle_and_touch_its_sides() {
        let (low, high) = (Vec2::new(10.0, 20.0), Vec2::new(50.0, 32.0));
        for radius in [0.0, 4.0, 99.0] {
            let mut canvas = Canvas::bare();
            canvas.rounded(low, high, radius, WHITE);
            let corners: Vec<Vec2> = canvas.corners().map(|(at, ..)| at).collect();
            let edges = corners.iter().fold([high, low], |[a, b], at| [a.min(*at), b.max(*at)]);
            assert!(edges[0].abs_diff_eq(low, 1e-3) && edges[1].abs_diff_eq(high, 1e-3), "{edges:?}");
            let is_cut = corners.iter().all(|at| at.distance(low) >= 0.4 * radius.min(6.0) - 1e-3);
            assert!(is_cut, "{radius}: {corners:?}");
        }
    }

    #[test]
    fn rings_without_a_visible_hole_are_discs_of_the_same_reach() {
        let places = |radius| {
            let mut canvas = Canvas::bare();
            canvas.circle(Vec2::ZERO, radius, 1.0, WHITE);
            canvas.corners().map(|(at, ..)| at).collect::<Vec<_>>()
        };
        assert_eq!(places(1.25), [(-1.75, -1.75), (1.75, -1.75), (1.75, 1.75), (-1.75, 1.75)].map(Vec2::from));
        let ring = places(8.0);
        // Off a circle by less than a tenth of a pixel, not a heptagon.
        assert!(8.0 * (1.0 - (std::f32::consts::TAU / ring.len() as f32).cos()) < 0.25);
        assert!(ring.len() > 8 && ring.iter().all(|at| (7.49..8.51).contains(&at.length())));
    }
}
