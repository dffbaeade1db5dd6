//! Casts of convex shapes.

use super::index::Disc;
use super::{Queries, QueryFilter, RayHit, may_meet, ray};
use crate::collider::Collider;
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::query::{Contact, ShapeCastOptions, cast_shapes, contact};
use parry2d::shape::{Ball, Shape, SharedShape};
use std::cell::Cell;

/// Farthest that a first guess of a distance may be off, units.
const GUESS: f32 = 1.0;

/// A shape on its way.
struct Cast<'s> {
    shape: &'s dyn Shape,
    pose: Pose,
    /// Of length 1.
    direction: Vec2,
    length: f32,
}

/// Where it touches something.
struct Touch {
    distance: f32,
    point: Vec2,
    normal: Vec2,
}

impl Queries<'_> {
    /// The first thing that a convex shape touches on its way from a pose along a direction, without turning. `None` also for a
    /// shape that is not convex. For a disc [`Queries::cast_disc`] is faster.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Collider, Placement, QueryFilter, World, WorldConfig, glam::Vec2};
    /// # use microsim_core::parry2d::{math::Pose, shape::SharedShape};
    /// let mut world = World::new(WorldConfig::default())?;
    /// let disc = world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 45.0))?;
    /// let (plank, start) = (SharedShape::cuboid(1.0, 5.0), Pose::translation(10.0, 41.0));
    /// let hit = world.queries().cast_shape(&plank, &start, Vec2::X, 500.0, &QueryFilter::default()).unwrap();
    /// assert_eq!(hit.collider, Collider::Organism(disc));
    /// assert!((hit.distance - 38.0).abs() < 1e-3 && (hit.normal + Vec2::X).length() < 1e-3);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    #[must_use]
    pub fn cast_shape(
        &self,
        shape: &SharedShape,
        pose: &Pose,
        direction: Vec2,
        length: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<RayHit> {
        shape.as_support_map()?;
        let around = shape.compute_bounding_sphere(pose);
        let mut around = ray(around.center(), direction, length, around.radius())?;
        let cast = Cast { shape: shape.as_ref(), pose: *pose, direction: around.direction, length };
        let surfaces = self.surfaces(filter).filter(|(.., aabb)| may_meet(&around, aabb));
        let hits = surfaces.filter_map(|(collider, obstacle, _)| {
            let touch = cast.meets(obstacle.shape.0.as_ref(), &obstacle.pose)?;
            Some(touch.of(collider, None))
        });
        let first = hits.reduce(|a, b| if b.distance < a.distance { b } else { a });
        around.length = first.map_or(length, |first| first.distance);
        let best = Cell::new(first.map_or(f32::INFINITY, |first| first.distance));
        let mut nearest = first;
        let visit = |disc: &Disc, _| {
            let Some(collider) = self.organism_of(disc, filter) else { return };
            let touch = cast.meets(&Ball::new(disc.radius), &Pose::from_translation(disc.at));
            if let Some(touch) = touch.filter(|touch| touch.distance < best.get()) {
                best.set(touch.distance);
                nearest = Some(touch.of(collider, Some(disc.index)));
            }
        };
        self.sorted.discs.along(&around, visit, |done| best.get() <= done);
        nearest
    }
}

impl Cast<'_> {
    /// Where it first touches another shape.
    fn meets(&self, shape: &dyn Shape, pose: &Pose) -> Option<Touch> {
        let options = ShapeCastOptions { max_time_of_impact: self.length, ..ShapeCastOptions::default() };
        let hit = cast_shapes(&self.pose, self.direction, self.shape, pose, Vec2::ZERO, shape, options);
        let mut distance = hit.ok().flatten()?.time_of_impact;
        let begins_inside = distance == 0.0;
        let mut nearest = self.nearest(distance, shape, pose)?;
        // Newton's method: where large shapes touch is off by a hundredth of a unit at first.
        for _ in 0..4 {
            let approach = nearest.normal1.dot(self.direction);
            if begins_inside || approach <= 0.01 {
                break;
            }
            distance = (distance + nearest.dist / approach).clamp(0.0, self.length);
            nearest = self.nearest(distance, shape, pose)?;
        }
        let normal = if begins_inside { Vec2::ZERO } else { nearest.normal2 };
        nearest.point2.is_finite().then_some(Touch { distance, point: nearest.point2, normal })
    }

    /// The nearest points of both shapes when it has come so far.
    fn nearest(&self, distance: f32, shape: &dyn Shape, pose: &Pose) -> Option<Contact> {
        let moved = Pose::from_parts(self.pose.translation + self.direction * distance, self.pose.rotation);
        contact(&moved, self.shape, pose, shape, GUESS).ok().flatten()
    }
}

impl Touch {
    fn of(self, collider: Collider, node: Option<u32>) -> RayHit {
        let Self { distance, point, normal } = self;
        RayHit { collider, node, distance, point, normal }
    }
}
