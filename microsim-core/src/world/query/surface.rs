//! Queries of what no organism moves: obstacles and walls.

use super::area::QueryArea;
use super::entry::Bounds;
use super::ray::Ray;
use super::{NearestPoint, Queries, QueryFilter, RayHit};
use crate::collider::Collider;
use crate::collision::obstacle::Obstacle;
use crate::world::obstacle::WALLS;
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};
use std::cell::Cell;

impl<'w> Queries<'w> {
    /// The first surface along a ray.
    pub(super) fn first_surface(&self, ray: &Ray, filter: &QueryFilter<'_>) -> Option<RayHit> {
        let first: Cell<Option<(f32, u32, RayHit)>> = Cell::new(None);
        let visit = |k: u32, hit: RayHit| {
            if first.get().is_none_or(|(distance, index, _)| (hit.distance, k) < (distance, index)) {
                first.set(Some((hit.distance, k, hit)));
            }
        };
        self.visit_surfaces(ray, filter, visit, |done| first.get().is_some_and(|(distance, ..)| distance < done));
        first.get().map(|(.., hit)| hit)
    }

    /// Calls `visit` with the index of each surface that a ray meets and where, walls first, then obstacles near the ray's origin
    /// before those farther on, until `is_enough` of the distance up to which all have been visited.
    pub(super) fn visit_surfaces(
        &self,
        ray: &Ray,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(u32, RayHit),
        is_enough: impl Fn(f32) -> bool + Copy,
    ) {
        let mut look_at = |k: u32| {
            if let Some(hit) = self.surface(k, filter).and_then(|(collider, obstacle)| meeting(ray, collider, obstacle))
            {
                visit(k, hit);
            }
        };
        if filter.walls {
            (0..WALLS as u32).for_each(&mut look_at);
        }
        if filter.obstacles {
            self.world.sorted_obstacles().along(ray, |bounds, _| look_at(bounds.index), is_enough);
        }
    }

    /// The nearest point of the nearest surface.
    pub(super) fn nearest_surface(
        &self,
        point: Vec2,
        max_distance: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<NearestPoint> {
        let found = |k: u32, within: f32| {
            let (collider, obstacle) = self.surface(k, filter)?;
            let (surface, is_inside) = obstacle.nearest(point);
            let on = if is_inside { point } else { surface };
            let distance = (on - point).length();
            // Not where a number overflows far outside.
            let is_near = distance <= within && distance.is_finite();
            is_near.then_some(NearestPoint { collider, node: None, point: on, distance })
        };
        let walls = (0..WALLS as u32).filter(|_| filter.walls).filter_map(|k| found(k, max_distance));
        let wall = walls.reduce(|a, b| if b.distance < a.distance { b } else { a });
        if !filter.obstacles {
            return wall;
        }
        let within = wall.map_or(max_distance, |wall| wall.distance);
        let distance = |bounds: &Bounds, within: f32| found(bounds.index, within).map(|found| found.distance);
        let index = self.world.sorted_obstacles();
        let obstacle = index.nearest(point, within, distance);
        let obstacle = obstacle.and_then(|(distance, bounds)| found(bounds.index, distance));
        obstacle.filter(|obstacle| wall.is_none_or(|wall| obstacle.distance < wall.distance)).or(wall)
    }

    /// The surfaces that an area in this box overlaps.
    pub(super) fn surfaces_in(&self, area: &QueryArea<'_>, bounds: &Aabb, filter: &QueryFilter<'_>) -> Vec<Collider> {
        let index = filter.obstacles.then(|| self.world.sorted_obstacles());
        let obstacles = index.iter().flat_map(|index| index.in_box(bounds.mins, bounds.maxs));
        let obstacles = obstacles.filter(|other| other.aabb.intersects(bounds)).map(|other| other.index);
        let asked_for = (0..WALLS as u32).chain(obstacles).filter_map(|k| self.surface(k, filter));
        let near = asked_for.filter(|(_, obstacle)| obstacle.aabb().intersects(bounds));
        near.filter(|(_, obstacle)| area.touches_obstacle(obstacle)).map(|(collider, _)| collider).collect()
    }

    /// A wall or an obstacle, if a filter lets it through.
    fn surface(&self, k: u32, filter: &QueryFilter<'_>) -> Option<(Collider, &'w Obstacle)> {
        let (collider, obstacle) = (self.world.collider_at(k)?, &self.world.obstacles[k as usize]);
        let is_of_kind = if let Collider::Wall(_) = collider { filter.walls } else { filter.obstacles };
        let is_asked_for = is_of_kind
            && obstacle.is_enabled
            && (filter.sensors || !obstacle.is_sensor)
            && obstacle.groups.meets(filter.groups)
            && filter.accepts(collider);
        is_asked_for.then_some((collider, obstacle))
    }
}

/// Where a ray meets a surface.
fn meeting(ray: &Ray, collider: Collider, obstacle: &Obstacle) -> Option<RayHit> {
    let (distance, along) = ray.meets(obstacle)?;
    let centre = ray.point_at(distance);
    let (surface, is_inside) = obstacle.nearest(centre);
    let begins_inside = distance == 0.0 && (is_inside || (centre - surface).length() < ray.radius);
    let away = along.unwrap_or(if is_inside { surface - centre } else { centre - surface });
    // On the surface itself the way out is the way back.
    let away = away.try_normalize().filter(|away| away.dot(ray.direction) < 0.0).unwrap_or(-ray.direction);
    let normal = if begins_inside { Vec2::ZERO } else { away };
    // The centre of a ball has no nearest point.
    let surface = if is_inside && !surface.is_finite() { centre } else { surface };
    // Not where a number overflows far outside.
    surface.is_finite().then_some(RayHit { collider, node: None, distance, point: surface, normal })
}
