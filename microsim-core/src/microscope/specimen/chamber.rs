//! The chamber: walls and obstacles, of a clear polymer that is a little denser than the medium.

use super::distance_field::DistanceField;
use crate::collision::obstacle::Obstacle;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{larger, smaller, smoothstep};
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::noise::{octaves, shift_of};
use crate::microscope::recipe::{DrawList, Program, QUAD, box_corners};
use glam::Vec2;

/// Polymer from its rim on.
const POLYMER: Matter = Matter { phase: 1.3, haemoglobin: 0.10, cytoplasm: 0.03, nucleus: 0.0 };
/// Width of the rim in which it rises, micrometres.
const RIM: f32 = 1.2;
/// Width over which its edge fades, micrometres.
const EDGE: f32 = 0.4;
/// How far moulding leaves its edge rough, and over which size, micrometres.
const ROUGH: f32 = 0.5;
const ROUGH_SIZE: f32 = 5.0;
/// Most cells of an obstacle's map of depths, apart from its margin.
const MOST_CELLS: f32 = 8192.0;
/// Strength and size of its unevenness.
const TEXTURE: f32 = 0.012;
const TEXTURE_SIZE: f32 = 4.0;

pub(in crate::microscope) const GLSL: Glsl = Glsl {
    source: include_str!("chamber.glsl"),
    constants: &[
        ("POLYMER", &[POLYMER.phase, POLYMER.haemoglobin, POLYMER.cytoplasm, POLYMER.nucleus]),
        ("RIM", &[RIM]),
        ("EDGE", &[EDGE]),
        ("ROUGH", &[ROUGH]),
        ("ROUGH_SIZE", &[ROUGH_SIZE]),
        ("TEXTURE", &[TEXTURE]),
        ("TEXTURE_SIZE", &[TEXTURE_SIZE]),
    ],
};

/// What nothing passes.
#[derive(Clone, Debug)]
pub(super) struct Chamber {
    /// Upper right corner of the room.
    pub size: Vec2,
    pub obstacles: Vec<Obstacle>,
    pub seed: u32,
}

impl Chamber {
    pub(super) fn draw(&self, raster: &mut MatterRaster) {
        let (low, high) = raster.grid.bounds();
        if low.min_element() < 0.0 || high.x > self.size.x || high.y > self.size.y {
            raster.add(low, high, |p| self.polymer(p, (p - p.clamp(Vec2::ZERO, self.size)).length()));
        }
        for obstacle in &self.obstacles {
            let bounds = obstacle.aabb();
            raster.add(bounds.mins, bounds.maxs, |p| self.polymer(p, depth_in(obstacle, p)));
        }
    }

    /// Walls and obstacles for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList) {
        let [x, y] = shift_of(self.seed);
        let room = vec![self.size.x, self.size.y, x, y];
        let (low, high) = draws.bounds();
        if low.min_element() < 0.0 || high.x > self.size.x || high.y > self.size.y {
            draws.add_apart(Program::Walls, &box_corners(low, high), QUAD.to_vec(), room.clone(), None);
        }
        for obstacle in &self.obstacles {
            if let Some((corners, map)) = obstacle_map(obstacle, draws) {
                draws.add_apart(Program::Obstacle, &corners, QUAD.to_vec(), room.clone(), Some(map.texture()));
            }
        }
    }

    fn polymer(&self, place: Vec2, depth: f32) -> Matter {
        if depth <= 0.0 {
            return Matter::NONE;
        }
        let lacking = 0.5 + 0.5 * octaves(place / ROUGH_SIZE, 3, self.seed);
        let depth = larger(depth - ROUGH * lacking, 0.0);
        let rim = larger(1.0 - depth / RIM, 0.0);
        let texture = 1.0 + TEXTURE * octaves(place / TEXTURE_SIZE, 3, self.seed);
        POLYMER * ((1.0 - rim * rim).sqrt() * smoothstep(0.0, EDGE, depth) * texture)
    }
}

/// How deep a place lies in an obstacle, negative outside.
fn depth_in(obstacle: &Obstacle, place: Vec2) -> f32 {
    let distance = (obstacle.nearest(place).0 - place).length();
    match (obstacle.contains(place), obstacle.shape.as_compound()) {
        (false, _) => -distance,
        (true, None) => distance,
        // A compound's parts have edges inside it, which are no rim.
        (true, Some(_)) => RIM,
    }
}

/// The corners of an obstacle that can be seen, and a map of depths in all of it. Straight edges come out exactly however
/// coarse the map is, and it may be coarse, because it is made for every picture.
pub(in crate::microscope) fn obstacle_map(obstacle: &Obstacle, draws: &DrawList) -> Option<(Vec<f32>, DistanceField)> {
    let bounds = obstacle.aabb();
    let (low, high) = (bounds.mins, bounds.maxs);
    let extent = high - low;
    let finest = (extent.x * extent.y / MOST_CELLS).sqrt();
    let step = larger(finest, smaller(extent.min_element() / 10.0, extent.max_element() / 64.0));
    let map = || DistanceField::sampled((low, high), step, 2.0 * step, |place| depth_in(obstacle, place));
    let is_seen = draws.sees(0.5 * (low + high), 0.5 * extent.length()) && step > 0.0;
    is_seen.then(|| (box_corners(low, high), map()))
}
