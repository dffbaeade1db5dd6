//! Casts of convex shapes.

use super::index::Disc;
use super::{Queries, QueryFilter, RayHit, may_meet, ray};
use crate::collider::Collider;
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::query::{Contact, ShapeCastOptions, cast_shapes, contact};
use parry2d::shape::{Ball, Shape, SharedShape};
use std::cell::Cell;

/// Gap of shapes that touch, units.
const CLOSE: f32 = 1e-3;
/// Largest gap that is looked at, units.
const FAR: f32 = 1e5;
/// Most looks on the way to a shape; what is not touched by then is grazed.
const LOOKS: u32 = 32;

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
    /// Where it first touches another shape. From where it is it goes as far as the gap allows along the gap's normal, and looks
    /// again: a convex shape is never passed (conservative advancement, Mirtich 1996, PhD thesis, Berkeley).
    fn meets(&self, shape: &dyn Shape, pose: &Pose) -> Option<Touch> {
        let is_convex = shape.as_support_map().is_some();
        let mut distance = if is_convex { 0.0 } else { self.time_of_impact(shape, pose)? };
        for _ in 0..LOOKS {
            let near = self.nearest(distance, shape, pose)?;
            let begins_inside = distance == 0.0 && near.dist <= 0.0;
            let normal = if begins_inside { Vec2::ZERO } else { near.normal2 };
            let touch = near.point2.is_finite().then_some(Touch { distance, point: near.point2, normal });
            let approach = near.normal1.dot(self.direction);
            if begins_inside || (near.dist.abs() <= CLOSE && approach > 0.0) {
                return touch;
            }
            if approach <= 0.0 {
                return touch.filter(|_| near.dist < 0.0 || !is_convex);
            }
            distance += near.dist / approach;
            if !(0.0..=self.length).contains(&distance) {
                return None;
            }
        }
        None
    }

    fn time_of_impact(&self, shape: &dyn Shape, pose: &Pose) -> Option<f32> {
        let options = ShapeCastOptions { max_time_of_impact: self.length, ..ShapeCastOptions::default() };
        let hit = cast_shapes(&self.pose, self.direction, self.shape, pose, Vec2::ZERO, shape, options);
        Some(hit.ok().flatten()?.time_of_impact)
    }

    /// The nearest points of both shapes when it has come so far; `None` if it cannot come so near.
    fn nearest(&self, distance: f32, shape: &dyn Shape, pose: &Pose) -> Option<Contact> {
        let moved = Pose::from_parts(self.pose.translation + self.direction * distance, self.pose.rotation);
        let farthest = if self.length < FAR { self.length } else { FAR };
        contact(&moved, self.shape, pose, shape, farthest + CLOSE).ok().flatten()
    }
}

impl Touch {
    fn of(self, collider: Collider, node: Option<u32>) -> RayHit {
        let Self { distance, point, normal } = self;
        RayHit { collider, node, distance, point, normal }
    }
}
