//! A ray, and where it meets an obstacle.

use crate::collision::obstacle::Obstacle;
use glam::Vec2;
use parry2d::bounding_volume::BoundingVolume;
use parry2d::math::Pose;
use parry2d::query::{ShapeCastOptions, cast_shapes};
use parry2d::shape::Ball;

/// A ray, thick as a disc that moves along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub origin: Vec2,
    /// Of length 1.
    pub direction: Vec2,
    pub length: f32,
    pub radius: f32,
}

impl Ray {
    /// A ray, if these numbers make one.
    pub(super) fn new(origin: Vec2, direction: Vec2, length: f32, radius: f32) -> Option<Self> {
        let direction = direction.try_normalize()?;
        let is_sound = origin.is_finite() && length >= 0.0 && (0.0..f32::INFINITY).contains(&radius);
        is_sound.then_some(Self { origin, direction, length, radius })
    }

    /// The same ray elsewhere.
    pub(super) fn moved(self, by: Vec2) -> Self {
        Self { origin: self.origin + by, ..self }
    }

    pub(super) fn point_at(&self, distance: f32) -> Vec2 {
        self.origin + self.direction * distance
    }

    /// Where it enters and leaves a box, as distances; `None` if it misses.
    pub(super) fn within(&self, low: Vec2, high: Vec2) -> Option<(f32, f32)> {
        let (mut start, mut end) = (0.0, self.length);
        for axis in 0..2 {
            let (origin, direction) = (self.origin[axis], self.direction[axis]);
            let (a, b) = ((low[axis] - origin) / direction, (high[axis] - origin) / direction);
            if direction == 0.0 {
                if origin < low[axis] || origin > high[axis] {
                    return None;
                }
            } else {
                let (near, far) = if a < b { (a, b) } else { (b, a) };
                start = if near > start { near } else { start };
                end = if far < end { far } else { end };
            }
        }
        (start <= end).then_some((start, end))
    }

    /// How far along it an obstacle is met, and for a line the normal of its surface there.
    pub(super) fn meets(&self, obstacle: &Obstacle) -> Option<(f32, Option<Vec2>)> {
        let aabb = obstacle.aabb();
        let (at_start, on_the_way) = (aabb.loosened(self.radius), aabb.loosened(self.radius + self.length));
        let line = parry2d::query::Ray::new(self.origin, self.direction);
        if !on_the_way.contains_local_point(self.origin) || at_start.clip_ray_parameters(&line).is_none() {
            return None;
        }
        if self.radius == 0.0 {
            let hit = obstacle.shape.cast_ray_and_get_normal(&obstacle.pose, &line, self.length, true)?;
            return Some((hit.time_of_impact, Some(hit.normal)));
        }
        let (surface, is_inside) = obstacle.nearest(self.origin);
        if is_inside || (self.origin - surface).length() <= self.radius {
            return Some((0.0, None));
        }
        let options = ShapeCastOptions { max_time_of_impact: self.length, ..ShapeCastOptions::default() };
        let (at, ball) = (Pose::from_translation(self.origin), Ball::new(self.radius));
        let shape = obstacle.shape.0.as_ref();
        let hit = cast_shapes(&at, self.direction, &ball, &obstacle.pose, Vec2::ZERO, shape, options);
        hit.ok().flatten().map(|hit| (self.refined(obstacle, hit.time_of_impact), None))
    }

    /// A distance at which it nearly touches an obstacle, corrected along the surface's normal (Newton's method): that of a large
    /// shape is off by a hundredth of a unit.
    fn refined(&self, obstacle: &Obstacle, mut distance: f32) -> f32 {
        for _ in 0..4 {
            let centre = self.point_at(distance);
            let (surface, is_inside) = obstacle.nearest(centre);
            let gap = (centre - surface).length();
            let approach = -(centre - surface).dot(self.direction);
            if is_inside || approach <= 0.01 * gap {
                break;
            }
            distance = (distance + (gap - self.radius) * gap / approach).clamp(0.0, self.length);
        }
        distance
    }
}
