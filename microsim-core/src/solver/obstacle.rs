//! Contacts of discs with static geometry: any `parry2d` shape. The world's walls are the first user.

use super::contact::{Impact, combine, friction, moved, shift};
use crate::particle::{CollisionGroups, Material, Particles};
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
    pub(crate) fn bounds(&self) -> Aabb {
        self.shape.compute_aabb(&self.pose)
    }

    /// Nearest point of the surface, and whether `point` is inside.
    pub(crate) fn nearest(&self, point: Vec2) -> (Vec2, bool) {
        let local = self.pose.inverse_transform_point(point);
        let projection = self.shape.project_local_point(local, false);
        (self.pose.transform_point(projection.point), projection.is_inside)
    }
}

/// A disc and an obstacle that may touch during the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObstacleContact {
    pub particle: u32,
    pub obstacle: u32,
}

/// Moves discs out of obstacles.
pub(crate) fn project(
    contacts: &[ObstacleContact],
    obstacles: &[Obstacle],
    particles: &mut Particles,
    impacts: &mut Vec<Impact>,
) {
    for contact in contacts {
        let (i, obstacle) = (contact.particle as usize, &obstacles[contact.obstacle as usize]);
        let position = particles.position(i);
        let (surface, is_inside) = obstacle.nearest(position);
        let (away, distance) = direction(position - surface, is_inside);
        let depth = particles.radius[i] - distance;
        if depth > 0.0 {
            let (mu, restitution) = combine(particles.material[i], obstacle.material);
            impacts.extend(Impact::on_static(particles, contact.particle, -away, restitution));
            shift(particles, i, away * depth);
            let rub = friction(moved(particles, i), away, mu * depth);
            shift(particles, i, rub);
        }
    }
}

/// Unit vector out of the obstacle and signed distance to its surface (negative inside).
fn direction(from_surface: Vec2, is_inside: bool) -> (Vec2, f32) {
    let length = from_surface.length();
    let unit = if length > 1e-6 { from_surface / length } else { Vec2::Y };
    if is_inside { (-unit, -length) } else { (unit, length) }
}

#[cfg(test)]
mod tests {
    use super::super::testing::line;
    use super::*;

    fn out_of(shape: SharedShape, start: Vec2) -> f32 {
        let obstacle = Obstacle::new(shape, Pose::translation(10.0, 5.0));
        let mut p = line(100.0, [1.0, 1.0]);
        (p.x[0], p.y[0]) = (start.x, start.y);
        let contact = ObstacleContact { particle: 0, obstacle: 0 };
        project(&[contact], std::slice::from_ref(&obstacle), &mut p, &mut Vec::new());
        let (surface, is_inside) = obstacle.nearest(p.position(0));
        let distance = (p.position(0) - surface).length();
        if is_inside { -distance } else { distance }
    }

    #[test]
    fn discs_end_outside_every_kind_of_shape() {
        let shapes = [
            SharedShape::cuboid(2.0, 1.0),
            SharedShape::ball(1.5),
            SharedShape::capsule(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.5), 0.7),
            SharedShape::convex_hull(&[Vec2::new(-2.0, -1.0), Vec2::new(2.0, -1.0), Vec2::new(0.0, 2.0)]).unwrap(),
            SharedShape::compound(vec![
                (Pose::translation(-3.0, 0.0), SharedShape::ball(1.0)),
                (Pose::translation(0.5, 0.0), SharedShape::cuboid(1.0, 1.0)),
            ]),
        ];
        for shape in shapes {
            for start in [Vec2::new(10.3, 5.2), Vec2::new(9.0, 4.6), Vec2::new(10.2, 6.6)] {
                let gap = out_of(shape.clone(), start);
                assert!(gap > 0.49, "{:?} from {start}: gap {gap}", shape.shape_type());
            }
        }
    }

    #[test]
    fn discs_apart_are_left_alone() {
        assert!((out_of(SharedShape::ball(1.0), Vec2::new(10.0, 8.0)) - 2.0).abs() < 1e-5);
    }
}
