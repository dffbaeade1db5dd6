//! The chamber: walls and obstacles, of a clear polymer that is a little denser than the medium.

use super::background::strewn;
use super::distance_field::DistanceField;
use super::spot::Spot;
use crate::bare_text::bare_text;
use crate::collision::obstacle::Obstacle;
use crate::look::SpotShape;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{bell, larger, smaller, smoothstep};
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::noise::{octaves, shift_of};
use crate::microscope::recipe::{DrawList, Program, QUAD, box_corners};
use glam::Vec2;

/// Polymer from its rim on.
const POLYMER: Matter = Matter { phase: 0.60, haemoglobin: 0.12, cytoplasm: 0.05, nucleus: 0.0 };
/// Width over which it rises, micrometres, and the share by which that differs along a wall: its side is not upright.
const RIM: f32 = 4.6;
const LEANING: f32 = 0.7;
/// Size of what differs along a wall, micrometres.
const ALONG: f32 = 21.0;
/// Radius of the room's corners, micrometres.
const CORNER: f32 = 1.5;
/// Fringes of an edge above the plane of focus: strength as a share, chirp, and how far they reach, micrometres. They only
/// add, because a target of bytes holds nothing that is less than nothing.
const FRINGES: f32 = 0.02;
const CHIRP: f32 = 1.6;
/// Share by which the chirp differs along a wall.
const SPREAD: f32 = 0.45;
const REACH: f32 = 2.6;
/// How far moulding leaves its edge rough, and over which size, micrometres.
const ROUGH: f32 = 1.0;
const ROUGH_SIZE: f32 = 8.0;
/// Most cells of an obstacle's map of depths, apart from its margin.
const MOST_CELLS: f32 = 8192.0;
/// Strength and size of its unevenness.
const TEXTURE: f32 = 0.03;
const TEXTURE_SIZE: f32 = 4.0;

pub(in crate::microscope) const GLSL: Glsl = Glsl {
    source: bare_text!("chamber.glsl", "//"),
    constants: &[
        ("POLYMER", &[POLYMER.phase, POLYMER.haemoglobin, POLYMER.cytoplasm, POLYMER.nucleus]),
        ("RIM", &[RIM]),
        ("LEANING", &[LEANING]),
        ("ALONG", &[ALONG]),
        ("CORNER", &[CORNER]),
        ("FRINGES", &[FRINGES]),
        ("CHIRP", &[CHIRP]),
        ("SPREAD", &[SPREAD]),
        ("REACH", &[REACH]),
        ("ROUGH", &[ROUGH]),
        ("ROUGH_SIZE", &[ROUGH_SIZE]),
        ("TEXTURE", &[TEXTURE]),
        ("TEXTURE_SIZE", &[TEXTURE_SIZE]),
    ],
};

/// Side of the cells in which dirt is strewn that lies at walls, micrometres, and heaps in each on average; how deep in a wall,
/// and how far from it, it lies, micrometres.
const DIRT_CELL: f32 = 3.0;
const DIRT: f32 = 1.5;
const DIRT_DEPTH: f32 = 1.6;

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
        if self.has_walls_in(low, high) {
            raster.add(low, high, |p| self.polymer(p, self.depth_in_wall(p)));
        }
        for obstacle in &self.obstacles {
            let bounds = obstacle.aabb();
            raster.add(bounds.mins - REACH, bounds.maxs + REACH, |p| self.polymer(p, depth_in(obstacle, p)));
        }
        self.dirt((low, high), raster.grid.pixel).iter().for_each(|spot| spot.draw(raster));
    }

    /// What gathers at walls and obstacles: heaps of grains, in focus or out of it.
    fn dirt(&self, bounds: (Vec2, Vec2), pixel: f32) -> Vec<Spot> {
        let strength = smoothstep(1.0, 0.5, pixel);
        let mut spots = Vec::new();
        if strength == 0.0 {
            return spots;
        }
        strewn(bounds, Vec2::ZERO, [DIRT_CELL, DIRT], self.seed ^ 31, |at, rng| {
            let walls = self.depth_in_wall(at).abs();
            let near = self.obstacles.iter().map(|obstacle| depth_in(obstacle, at).abs()).fold(walls, smaller);
            // Dirty here, clean there.
            let dirty = smoothstep(-0.4, 0.8, octaves(at / ALONG, 2, self.seed ^ 32));
            let (count, size) = (1 + rng.bits() % 5, 0.11 * libm::expf(0.5 * rng.normal()));
            if near > DIRT_DEPTH * rng.unit() || rng.unit() > dirty {
                return;
            }
            let dense = strength * 0.16 * libm::expf(0.5 * rng.normal());
            let matter = Matter { haemoglobin: 0.3 * dense, nucleus: 0.2 * dense, ..Matter::phase(dense) };
            let chirp = if rng.unit() < 0.4 { rng.range([2.5, 6.0]) } else { 0.0 };
            let mut at = at;
            for _ in 0..count {
                let spot = Spot { at, radius: size * rng.range([0.7, 1.6]), matter, shape: SpotShape::Bump };
                spots.push(if chirp > 0.0 { spot.out_of_focus(chirp) } else { spot });
                at += rng.direction() * (1.5 * size);
            }
        });
        spots
    }

    /// Walls and obstacles for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList) {
        let [x, y] = shift_of(self.seed);
        let room = vec![self.size.x, self.size.y, x, y];
        let (low, high) = draws.bounds();
        if self.has_walls_in(low, high) {
            draws.add_apart(Program::Walls, &box_corners(low, high), QUAD.to_vec(), room.clone(), None);
        }
        for obstacle in &self.obstacles {
            if let Some((corners, map)) = obstacle_map(obstacle, draws, REACH) {
                draws.add_apart(Program::Obstacle, &corners, QUAD.to_vec(), room.clone(), Some(map.texture()));
            }
        }
        self.dirt((low, high), draws.pixel()).iter().for_each(|spot| spot.draw_on(draws));
    }

    fn has_walls_in(&self, low: Vec2, high: Vec2) -> bool {
        low.min_element() < REACH || (high + REACH).cmpgt(self.size).any()
    }

    /// How deep a place lies in a wall, negative in the room.
    fn depth_in_wall(&self, place: Vec2) -> f32 {
        let half = 0.5 * self.size;
        let beyond = (place - half).abs() - half + CORNER;
        beyond.max(Vec2::ZERO).length() + smaller(beyond.max_element(), 0.0) - CORNER
    }

    fn polymer(&self, place: Vec2, depth: f32) -> Matter {
        if depth <= -REACH {
            return Matter::NONE;
        }
        let along = octaves(place / ALONG, 2, self.seed);
        let depth = depth - ROUGH * (0.5 + 0.5 * octaves(place / ROUGH_SIZE, 3, self.seed));
        let ring = 1.0 + libm::cosf(CHIRP * (1.0 + SPREAD * along) * depth * depth);
        let fringes = FRINGES * larger(1.0 - along, 0.0) * bell(1.6 * depth / REACH) * ring;
        let rise = smoothstep(0.0, RIM * larger(1.0 + LEANING * along, 0.2), depth);
        let texture = 1.0 + TEXTURE * octaves(place / TEXTURE_SIZE, 3, self.seed);
        POLYMER * (rise * texture + fringes)
    }
}

/// How deep a place lies in an obstacle, negative outside.
fn depth_in(obstacle: &Obstacle, place: Vec2) -> f32 {
    let distance = (obstacle.nearest(place).0 - place).length();
    match (obstacle.contains(place), obstacle.shape.as_compound()) {
        (false, _) => -distance,
        (true, None) => distance,
        // A compound's parts have edges inside it, which are no rim.
        (true, Some(_)) => 2.0 * RIM,
    }
}

/// The corners of an obstacle that can be seen, and a map of depths in it and `beyond`. Straight edges come out exactly
/// however coarse the map is, and it may be coarse, because it is made for every picture.
pub(in crate::microscope) fn obstacle_map(
    obstacle: &Obstacle,
    draws: &DrawList,
    beyond: f32,
) -> Option<(Vec<f32>, DistanceField)> {
    let bounds = obstacle.aabb();
    let (low, high) = (bounds.mins - beyond, bounds.maxs + beyond);
    let extent = high - low;
    let finest = (extent.x * extent.y / MOST_CELLS).sqrt();
    let step = larger(finest, smaller(extent.min_element() / 10.0, extent.max_element() / 64.0));
    let map = || DistanceField::sampled((low, high), step, 2.0 * step, |place| depth_in(obstacle, place));
    let is_seen = draws.sees(0.5 * (low + high), 0.5 * extent.length()) && step > 0.0;
    is_seen.then(|| (box_corners(low, high), map()))
}
