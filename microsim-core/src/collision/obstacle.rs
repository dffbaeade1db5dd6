//! Static geometry: any `parry2d` shape at any pose.

use crate::particle::{CollisionGroups, Material};
use glam::Vec2;
use parry2d::bounding_volume::Aabb;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;
use std::fmt;

/// Static geometry that nothing moves.
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
    /// An obstacle of this shape at this pose, with the default surface, colliding with everything.
    #[must_use]
    pub fn new(shape: SharedShape, pose: Pose) -> Self {
        Self { shape, pose, material: Material::default(), groups: CollisionGroups::ALL }
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
