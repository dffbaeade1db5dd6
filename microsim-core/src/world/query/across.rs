//! Queries in a room with periodic sides: what is asked for is displaced by whole periods, so that it meets what lies near an
//! opposite side. In other rooms it is asked for once.

use super::area::QueryArea;
use super::ray::Ray;
use super::{NearestPoint, Queries, RayHit};
use crate::collider::Collider;
use crate::id::OrganismId;
use crate::world::World;
use glam::Vec2;
use parry2d::bounding_volume::Aabb;

/// Longest ray along an axis, in periods.
const LONGEST_RAY: f32 = 32.0;

impl World {
    /// Organisms that are found at each displacement of a box at which it lies over something, by index.
    pub(super) fn find_images<I: Iterator<Item = OrganismId>>(
        &self,
        aabb: [Vec2; 2],
        find: impl Fn(Vec2) -> I,
    ) -> impl Iterator<Item = OrganismId> {
        let mut found: Vec<OrganismId> = self.query_shifts(aabb).into_iter().flat_map(find).collect();
        if !self.period().is_none() {
            found.sort_unstable();
            found.dedup();
        }
        found.into_iter()
    }

    /// The displacements of a box by which it comes to lie over anything that queries know.
    fn query_shifts(&self, aabb: [Vec2; 2]) -> Vec<Vec2> {
        let period = self.period();
        if period.is_none() {
            return vec![Vec2::ZERO];
        }
        let mut all = [Vec2::ZERO, self.config.size];
        let boxes = [self.sorted_discs().bounds(), self.sorted_organisms().bounds(), self.sorted_obstacles().bounds()];
        for [low, high] in boxes {
            all = [all[0].min(low), all[1].max(high)];
        }
        period.shifts(aabb, all).collect()
    }
}

impl Queries<'_> {
    /// A ray, and images of it.
    pub(super) fn images_of_ray(&self, mut ray: Ray) -> Vec<Ray> {
        let period = self.world.period();
        if period.is_none() {
            return vec![ray];
        }
        let mut end = ray.origin;
        for axis in (0..2).filter(|&axis| ray.direction[axis] != 0.0) {
            let longest = LONGEST_RAY * period.0[axis] / ray.direction[axis].abs();
            ray.length = if longest > 0.0 && longest < ray.length { longest } else { ray.length };
        }
        for axis in (0..2).filter(|&axis| ray.direction[axis] != 0.0) {
            end[axis] += ray.direction[axis] * ray.length;
        }
        let around = [ray.origin.min(end) - ray.radius, ray.origin.max(end) + ray.radius];
        self.world.query_shifts(around).into_iter().map(|shift| ray.moved(shift)).collect()
    }

    /// The nearest hit of a ray and its images.
    pub(super) fn first_of_images(&self, ray: Ray, cast: impl Fn(Ray) -> Option<RayHit>) -> Option<RayHit> {
        if self.world.period().is_none() {
            return cast(ray);
        }
        let mut first: Option<RayHit> = None;
        for mut image in self.images_of_ray(ray) {
            image.length = first.map_or(image.length, |hit| hit.distance);
            let hit = cast(image);
            first = hit.filter(|hit| first.is_none_or(|first| hit.distance < first.distance)).or(first);
        }
        first
    }

    /// The nearest of what is found from a point and its images.
    pub(super) fn nearest_of_images(
        &self,
        point: Vec2,
        mut distance: f32,
        find: impl Fn(Vec2, f32) -> Option<NearestPoint>,
    ) -> Option<NearestPoint> {
        let period = self.world.period();
        if period.is_none() {
            return find(point, distance);
        }
        // An image of whatever is nearest is no farther than a period along an axis.
        let along = |length: f32| if length > 0.0 && length < distance { length } else { distance };
        let around = Vec2::new(along(period.0.x), along(period.0.y));
        let mut nearest = None;
        for shift in self.world.query_shifts([point - around, point + around]) {
            if let Some(found) = find(point + shift, distance).filter(|_| nearest.is_none() || distance > 0.0) {
                distance = found.distance;
                nearest = Some(found);
            }
        }
        nearest
    }

    /// What is found in an area and its images, each thing once.
    pub(super) fn found_by_images(
        &self,
        area: &QueryArea<'_>,
        bounds: &Aabb,
        find: impl Fn(&QueryArea<'_>, &Aabb) -> Vec<Collider>,
    ) -> Vec<Collider> {
        if self.world.period().is_none() {
            return find(area, bounds);
        }
        let mut all = Vec::new();
        for shift in self.world.query_shifts([bounds.mins, bounds.maxs]) {
            let bounds = Aabb { mins: bounds.mins + shift, maxs: bounds.maxs + shift };
            match *area {
                QueryArea::Disc(centre, radius) => all.extend(find(&QueryArea::Disc(centre + shift, radius), &bounds)),
                QueryArea::Polygon(corners) => {
                    let corners: Vec<Vec2> = corners.iter().map(|&corner| corner + shift).collect();
                    all.extend(find(&QueryArea::Polygon(&corners), &bounds));
                }
            }
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}
