//! Obstacles: any `parry2d` shape at any pose, fixed or moved from outside.

use crate::particle::{CollisionGroups, Material};
use glam::Vec2;
use parry2d::bounding_volume::Aabb;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Geometry that no organism moves.
#[derive(Clone)]
pub struct Obstacle {
    /// Its shape, in its own frame.
    pub shape: SharedShape,
    /// Where its frame lies in the world.
    pub pose: Pose,
    /// Its surface.
    pub material: Material,
    /// What it collides with.
    pub groups: CollisionGroups,
    /// Whether and how it moves.
    pub motion: ObstacleMotion,
    /// Makes it a platform that is solid from one side only: the direction out of that side, in its own frame, of any length but
    /// zero. A disc that was not wholly on that side when the substep began passes.
    pub one_way: Option<Vec2>,
    /// Whether it is a zone without contacts, which reports what enters and leaves it, see
    /// [`Event::SensorEntered`](crate::Event::SensorEntered).
    pub is_sensor: bool,
    /// Without it, it is as if it were not there.
    pub is_enabled: bool,
}

/// How an obstacle moves, and what it does when a body is caught between it and something that does not give way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ObstacleMotion {
    /// It stays where it is put. Chemicals do not pass it.
    #[default]
    Fixed,
    /// Kinematic: it goes to its target. From a body that is caught it moves back, and goes on as soon as it can.
    Push,
    /// Kinematic: it goes to its target. From a body that is caught it moves back, stops and forgets the target.
    Stop,
}

impl fmt::Debug for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Obstacle")
            .field("shape", &self.shape.shape_type())
            .field("pose", &self.pose)
            .finish_non_exhaustive()
    }
}

impl Obstacle {
    /// A fixed obstacle of this shape at this pose, with the default surface, colliding with everything.
    #[must_use]
    pub fn new(shape: SharedShape, pose: Pose) -> Self {
        Self {
            shape,
            pose,
            material: Material::default(),
            groups: CollisionGroups::ALL,
            motion: ObstacleMotion::Fixed,
            one_way: None,
            is_sensor: false,
            is_enabled: true,
        }
    }

    /// Whether anything can touch it.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        self.is_enabled && !self.is_sensor
    }

    /// Whether chemicals stop at it.
    pub(crate) fn stops_chemicals(&self) -> bool {
        self.is_solid() && self.motion == ObstacleMotion::Fixed
    }

    /// Axis-aligned box around it in the world.
    pub(crate) fn aabb(&self) -> Aabb {
        self.shape.compute_aabb(&self.pose)
    }

    /// Whether `point` is inside. Unlike [`Obstacle::nearest`] it is right on the edges that a compound's parts share.
    #[cfg(feature = "microscope")]
    pub(crate) fn contains(&self, point: Vec2) -> bool {
        self.shape.contains_local_point(self.pose.inverse_transform_point(point))
    }

    /// Nearest point of the surface, and whether `point` is inside.
    pub(crate) fn nearest(&self, point: Vec2) -> (Vec2, bool) {
        let local = self.pose.inverse_transform_point(point);
        let projection = self.shape.project_local_point(local, false);
        (self.pose.transform_point(projection.point), projection.is_inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chemicals_stop_at_what_is_solid_and_stays() {
        let wall = Obstacle { motion: ObstacleMotion::Fixed, ..Obstacle::new(SharedShape::ball(1.0), Pose::IDENTITY) };
        assert!(wall.stops_chemicals());
        assert!(!Obstacle { is_sensor: true, ..wall.clone() }.stops_chemicals());
        assert!(!Obstacle { is_enabled: false, ..wall.clone() }.stops_chemicals());
        assert!(!Obstacle { motion: ObstacleMotion::Push, ..wall }.stops_chemicals());
    }
}
