//! Queries: organisms at a point, in a circle, in a box, and the first disc along a ray. Results are in the order of the
//! organisms.

use super::World;
use crate::geometry::polygon::contains_point;
use crate::geometry::segment::nearest_on_segment;
use crate::id::OrganismId;
use glam::Vec2;

/// The first disc that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// Whose disc it is.
    pub organism: OrganismId,
    /// Distance from the origin, units.
    pub distance: f32,
    /// Where the ray meets the disc.
    pub point: Vec2,
    /// Unit normal of the disc there; zero if the origin is inside it.
    pub normal: Vec2,
}

impl World {
    /// Organisms at a point: one of their discs, or the area within their outline, contains it.
    pub fn organisms_at(&self, point: Vec2) -> impl Iterator<Item = OrganismId> + '_ {
        self.organisms_in_circle(point, 0.0)
    }

    /// Organisms that a circle touches: one of their discs, or the area within their outline, reaches into it.
    pub fn organisms_in_circle(&self, centre: Vec2, radius: f32) -> impl Iterator<Item = OrganismId> + '_ {
        self.find(move |disc, r| (disc - centre).length() <= r + radius, Some((centre, radius)))
    }

    /// Organisms with a disc that reaches into the box from `low` to `high`.
    pub fn organisms_in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = OrganismId> + '_ {
        self.find(move |disc, r| (disc - disc.clamp(low, high.max(low))).length() <= r, None)
    }

    /// The first disc along a ray of at most `length` units. `None` also for a direction of no length.
    #[must_use]
    pub fn cast_ray(&self, origin: Vec2, direction: Vec2, length: f32) -> Option<RayHit> {
        let direction = direction.try_normalize()?;
        let hits = self.organisms.iter().flat_map(|(id, organism)| organism.particles().map(move |i| (id, i as usize)));
        let mut nearest: Option<(OrganismId, f32, Vec2)> = None;
        for (id, i) in hits.filter(|&(_, i)| self.particles.groups[i].memberships != 0) {
            let centre = self.particles.position(i);
            let distance = ray_to_circle(origin, direction, centre, self.particles.radius[i]);
            let is_first = |&d: &f32| d <= length && nearest.is_none_or(|(_, best, _)| d < best);
            if let Some(distance) = distance.filter(is_first) {
                nearest = Some((id, distance, centre));
            }
        }
        nearest.map(|(organism, distance, centre)| {
            let point = origin + direction * distance;
            let normal = if distance > 0.0 { (point - centre).normalize_or_zero() } else { Vec2::ZERO };
            RayHit { organism, distance, point, normal }
        })
    }

    fn find<'a>(
        &'a self,
        meets: impl Fn(Vec2, f32) -> bool + 'a,
        inside: Option<(Vec2, f32)>,
    ) -> impl Iterator<Item = OrganismId> + 'a {
        let found = self.organisms.iter().filter(move |(_, organism)| {
            let discs = organism.particles().map(|i| i as usize);
            let mut solid = discs.filter(|&i| self.particles.groups[i].memberships != 0);
            solid.any(|i| meets(self.particles.position(i), self.particles.radius[i]))
                || inside.is_some_and(|(centre, radius)| reaches_into(&self.outline_of(organism), centre, radius))
        });
        found.map(|(id, _)| id)
    }
}

/// Whether a circle reaches into the area of a polygon.
fn reaches_into(outline: &[Vec2], centre: Vec2, radius: f32) -> bool {
    let edge = |k: usize| nearest_on_segment(outline[k], outline[(k + 1) % outline.len()], centre);
    contains_point(outline, centre) || (0..outline.len()).any(|k| (edge(k) - centre).length() <= radius)
}

/// Distance along the ray to the circle; 0 from inside it.
fn ray_to_circle(origin: Vec2, direction: Vec2, centre: Vec2, radius: f32) -> Option<f32> {
    let to_centre = centre - origin;
    let along = to_centre.dot(direction);
    let outside = to_centre.length_squared() - radius * radius;
    if outside <= 0.0 {
        return Some(0.0);
    }
    let discriminant = along * along - outside;
    (along > 0.0 && discriminant >= 0.0).then(|| along - discriminant.sqrt())
}
