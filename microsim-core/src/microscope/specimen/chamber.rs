//! The chamber: walls and obstacles, of a clear polymer that is a little denser than the medium.

use crate::collision::obstacle::Obstacle;
use crate::microscope::maths::{larger, smoothstep};
use crate::microscope::matter::{Matter, Plate};
use crate::microscope::noise::octaves;
use glam::Vec2;

/// Polymer from its rim on.
const POLYMER: Matter = Matter { phase: 1.3, haemoglobin: 0.10, cytoplasm: 0.12, nucleus: 0.0 };
/// Width of the rim in which it rises, micrometres.
const RIM: f32 = 1.2;

/// What nothing passes.
#[derive(Clone, Debug)]
pub(super) struct Chamber {
    /// Upper right corner of the room.
    pub size: Vec2,
    pub obstacles: Vec<Obstacle>,
    pub seed: u32,
}

impl Chamber {
    pub(super) fn draw(&self, plate: &mut Plate) {
        let (low, high) = plate.grid.bounds();
        if low.min_element() < 0.0 || high.x > self.size.x || high.y > self.size.y {
            plate.add(low, high, |p| self.polymer(p, (p - p.clamp(Vec2::ZERO, self.size)).length()));
        }
        for obstacle in &self.obstacles {
            let bounds = obstacle.bounds();
            // A compound's parts have edges inside it, which are no rim.
            let has_rim = obstacle.shape.as_compound().is_none();
            plate.add(bounds.mins, bounds.maxs, |p| match obstacle.nearest(p) {
                (nearest, true) => self.polymer(p, if has_rim { (nearest - p).length() } else { RIM }),
                (_, false) => Matter::NONE,
            });
        }
    }

    fn polymer(&self, place: Vec2, depth: f32) -> Matter {
        if depth <= 0.0 {
            return Matter::NONE;
        }
        let rim = larger(1.0 - depth / RIM, 0.0);
        let texture = 1.0 + 0.05 * octaves(place / 2.5, 3, self.seed);
        POLYMER * ((1.0 - rim * rim).sqrt() * smoothstep(0.0, 0.15, depth) * texture)
    }
}
