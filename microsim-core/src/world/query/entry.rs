//! What queries look at: discs of organisms, and boxes around organisms and obstacles.

use super::ray::Ray;
use glam::Vec2;
use parry2d::bounding_volume::Aabb;

/// Something with a place and a size.
pub(super) trait Entry: Copy {
    /// Which one it is.
    fn index(&self) -> u32;
    fn centre(&self) -> Vec2;
    /// Largest distance from its centre along an axis, units.
    fn extent(&self) -> f32;
    /// Where a ray first touches it; 0 if it begins there.
    fn first_touch(&self, ray: &Ray) -> Option<f32>;
}

/// A disc as queries see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub at: Vec2,
    pub radius: f32,
    /// Which particle it is.
    pub index: u32,
}

/// The box around something.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub aabb: Aabb,
    /// Slot of the organism, or index of the obstacle.
    pub index: u32,
}

impl Entry for Disc {
    fn index(&self) -> u32 {
        self.index
    }

    fn centre(&self) -> Vec2 {
        self.at
    }

    fn extent(&self) -> f32 {
        self.radius
    }

    fn first_touch(&self, ray: &Ray) -> Option<f32> {
        let to_centre = self.at - ray.origin;
        let (along, extent) = (to_centre.dot(ray.direction), self.radius + ray.radius);
        if to_centre.length_squared() <= extent * extent {
            return Some(0.0);
        }
        // The distance from the line, not the difference of two large squares: far discs are hit as exactly as near ones.
        let aside = (to_centre - ray.direction * along).length_squared();
        let half_chord = extent * extent - aside;
        let distance = along - if half_chord > 0.0 { half_chord.sqrt() } else { 0.0 };
        (along > 0.0 && half_chord >= 0.0 && distance <= ray.length).then_some(distance)
    }
}

impl Bounds {
    /// A box that is larger than `aabb` by what rounding may make of it.
    pub(super) fn new(aabb: Aabb, index: u32) -> Self {
        let slack = rounding(aabb.mins, aabb.maxs);
        Self { aabb: Aabb { mins: aabb.mins - slack, maxs: aabb.maxs + slack }, index }
    }
}

impl Entry for Bounds {
    fn index(&self) -> u32 {
        self.index
    }

    fn centre(&self) -> Vec2 {
        0.5 * self.aabb.mins + 0.5 * self.aabb.maxs
    }

    fn extent(&self) -> f32 {
        0.5 * (self.aabb.maxs - self.aabb.mins).max_element()
    }

    fn first_touch(&self, ray: &Ray) -> Option<f32> {
        let (start, _) = ray.within(self.aabb.mins - ray.radius, self.aabb.maxs + ray.radius)?;
        Some(start)
    }
}

/// How far rounding may move the corners of a box, units: some hundred times what one operation does.
pub(super) fn rounding(low: Vec2, high: Vec2) -> f32 {
    1e-5 * low.abs().max(high.abs()).max_element()
}
