//! Obstacles: the four walls, and static geometry that is added.

use super::World;
use super::state::digest::Digest;
use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_record::ObstacleRecord;
use crate::config::WorldConfig;
use crate::error::{Error, ErrorKind, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::ObstacleId;
use crate::particle::Material;
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;

/// Obstacles that every world has: its four walls.
pub(super) const WALLS: usize = 4;

impl World {
    /// Adds static geometry: any `parry2d` shape.
    ///
    /// # Errors
    /// When the pose is not finite, the shape's box is not finite, a material number is out of range, or the obstacle would
    /// overlap an organism. Nothing is changed then.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<ObstacleId, Error> {
        with_default_float_environment(|| self.insert_obstacle(obstacle))
    }

    fn insert_obstacle(&mut self, obstacle: Obstacle) -> Result<ObstacleId, Error> {
        let Material { friction, restitution } = obstacle.material;
        in_range("material.friction", friction, 0.0, 10.0)?;
        in_range("material.restitution", restitution, 0.0, 1.0)?;
        in_range("pose.translation.x", obstacle.pose.translation.x, -1e5, 1e5)?;
        in_range("pose.translation.y", obstacle.pose.translation.y, -1e5, 1e5)?;
        let bounds = obstacle.aabb();
        if !(bounds.mins.is_finite() && bounds.maxs.is_finite()) {
            return Err(Error::unsupported("shape", "a shape with a finite bounding box"));
        }
        if let Some(with) = self.overlapped_by(&obstacle) {
            return Err(Error::new(ErrorKind::Overlap { with }, "pose"));
        }
        self.obstacle_digests.push(digest(&obstacle));
        for chemical in &mut self.chemicals {
            chemical.close(|at| obstacle.nearest(at).1);
        }
        self.obstacles.push(obstacle);
        Ok(ObstacleId(self.obstacles.len() as u32 - 1))
    }

    /// The obstacles that were added, without the walls.
    pub fn obstacles(&self) -> impl Iterator<Item = &Obstacle> {
        self.obstacles.iter().skip(WALLS)
    }
}

/// Thick slabs around the room, overlapping at the corners: so thick that nothing gets past their middle in a step.
pub(super) fn walls(config: &WorldConfig) -> Vec<Obstacle> {
    let size = config.size;
    let thickness = size.x + size.y + 4.0 * config.max_displacement();
    let half = size * 0.5;
    let slab = |half_extents: Vec2, centre: Vec2| {
        Obstacle::new(SharedShape::cuboid(half_extents.x, half_extents.y), Pose::translation(centre.x, centre.y))
    };
    let (across, along) =
        (Vec2::new(half.x + thickness, 0.5 * thickness), Vec2::new(0.5 * thickness, half.y + thickness));
    vec![
        slab(across, Vec2::new(half.x, -0.5 * thickness)),
        slab(across, Vec2::new(half.x, size.y + 0.5 * thickness)),
        slab(along, Vec2::new(-0.5 * thickness, half.y)),
        slab(along, Vec2::new(size.x + 0.5 * thickness, half.y)),
    ]
}

/// Digest of an obstacle: the numbers that it is made from, or for shapes without such a record what the step sees of it,
/// its surface from a grid of points around it.
fn digest(obstacle: &Obstacle) -> u64 {
    const POINTS: u8 = 8;
    if let Some(record) = ObstacleRecord::of(obstacle) {
        return Digest::of(&record);
    }
    let bounds = obstacle.aabb();
    let extent = bounds.maxs - bounds.mins;
    let nearest = |k: u8| {
        let share = Vec2::new(f32::from(k % POINTS), f32::from(k / POINTS)) / f32::from(POINTS - 1);
        obstacle.nearest(bounds.mins + extent * share)
    };
    let surface: Vec<(Vec2, bool)> = (0..POINTS * POINTS).map(nearest).collect();
    Digest::of(&(surface, obstacle.material, obstacle.groups))
}
