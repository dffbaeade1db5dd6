//! Queries: organisms at a point, in a circle, in a box; and [`Queries`], for which the world is sorted once after each change: rays, casts
//! of discs, nearest points and overlaps with organisms, obstacles and walls.

mod area;
mod filter;
mod index;
mod sorted;

use super::World;
use crate::collider::Collider;
use crate::collision::obstacle::Obstacle;
use crate::id::OrganismId;
use area::{QueryArea, reaches_into};
pub use filter::QueryFilter;
use glam::Vec2;
use index::{Disc, Ray};
use parry2d::bounding_volume::{Aabb, BoundingVolume};
use parry2d::math::Pose;
use parry2d::query::{ShapeCastOptions, cast_shapes};
use parry2d::shape::Ball;
pub(crate) use sorted::QueryIndex;
use sorted::Sorted;
use std::sync::Arc;

/// What a ray, or a disc that is cast, meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// What it meets.
    pub collider: Collider,
    /// Of an organism: which particle, see [`crate::ParticleView::index`].
    pub node: Option<u32>,
    /// Distance from the origin, units.
    pub distance: f32,
    /// Where it meets the surface.
    pub point: Vec2,
    /// Unit normal of the surface there; zero if it begins inside.
    pub normal: Vec2,
}

/// The point of something that is nearest to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint {
    /// What it is of.
    pub collider: Collider,
    /// Of an organism: of which particle, see [`crate::ParticleView::index`].
    pub node: Option<u32>,
    /// On the surface; the point that was asked for if that is inside.
    pub point: Vec2,
    /// Distance of the two, units; 0 inside.
    pub distance: f32,
}

/// A world sorted for queries. That costs about as much as a look at every particle, once after a step or another change; each
/// query then looks at what is near. It borrows the world, so it always tells of the present state.
///
/// Numbers that are not finite find nothing. A sensor is found if the filter says so, a disabled obstacle never.
///
/// ```
/// # use microsim_core::{AgarSpec, Collider, Placement, QueryFilter, Wall, World, WorldConfig, glam::Vec2};
/// let mut world = World::new(WorldConfig::default())?;
/// let disc = world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 45.0))?;
/// let queries = world.queries();
/// let hit = queries.cast_ray(Vec2::new(10.0, 45.0), Vec2::X, 500.0, &QueryFilter::default()).unwrap();
/// assert_eq!((hit.collider, hit.distance), (Collider::Organism(disc), 39.0));
/// let all = queries.cast_ray_all(Vec2::new(10.0, 45.0), Vec2::X, 500.0, &QueryFilter::default());
/// assert_eq!(all.last().unwrap().collider, Collider::Wall(Wall::Right));
/// # Ok::<(), microsim_core::Error>(())
/// ```
#[derive(Debug)]
pub struct Queries<'w> {
    world: &'w World,
    sorted: Arc<Sorted>,
}

impl World {
    /// Queries of the present state. The first since the last step, or since another change, sorts the world.
    #[must_use]
    pub fn queries(&self) -> Queries<'_> {
        Queries { world: self, sorted: self.scratch.query_index.of(self) }
    }

    /// Organisms at a point: one of their discs, or the area within their outline, contains it.
    pub fn organisms_at(&self, point: Vec2) -> impl Iterator<Item = OrganismId> + '_ {
        self.organisms_in_circle(point, 0.0)
    }

    /// Organisms that a circle touches: one of their discs, or the area within their outline, reaches into it. Looks at every
    /// organism; for many such questions see [`World::queries`].
    pub fn organisms_in_circle(&self, centre: Vec2, radius: f32) -> impl Iterator<Item = OrganismId> + '_ {
        self.find(move |disc, r| (disc - centre).length() <= r + radius, Some((centre, radius)))
    }

    /// Organisms with a disc that reaches into the box from `low` to `high`.
    pub fn organisms_in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = OrganismId> + '_ {
        self.find(move |disc, r| (disc - disc.clamp(low, high.max(low))).length() <= r, None)
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

impl<'w> Queries<'w> {
    /// The first thing along a ray of at most `length` units. `None` also for a direction of no length.
    #[must_use]
    pub fn cast_ray(&self, origin: Vec2, direction: Vec2, length: f32, filter: &QueryFilter<'_>) -> Option<RayHit> {
        self.cast_disc(origin, direction, length, 0.0, filter)
    }

    /// The first thing that a disc of this radius touches on its way along a ray.
    #[must_use]
    pub fn cast_disc(
        &self,
        origin: Vec2,
        direction: Vec2,
        length: f32,
        radius: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<RayHit> {
        let mut ray = ray(origin, direction, length, radius)?;
        let first = self.surfaces_along(ray, filter).reduce(|a, b| if b.distance < a.distance { b } else { a });
        ray.length = first.map_or(ray.length, |hit| hit.distance);
        let best = std::cell::Cell::new(f32::INFINITY);
        let mut nearest = None;
        let visit = |disc: &Disc, distance: f32| {
            if distance < best.get() && self.organism_of(disc, filter).is_some() {
                best.set(distance);
                nearest = Some(*disc);
            }
        };
        self.sorted.discs.along(&ray, visit, |done| best.get() <= done);
        let disc = nearest.and_then(|disc| self.disc_hit(&ray, &disc, filter));
        disc.filter(|disc| first.is_none_or(|first| disc.distance <= first.distance)).or(first)
    }

    /// Everything along a ray, each where it is met first, by distance.
    #[must_use]
    pub fn cast_ray_all(&self, origin: Vec2, direction: Vec2, length: f32, filter: &QueryFilter<'_>) -> Vec<RayHit> {
        let Some(ray) = ray(origin, direction, length, 0.0) else { return Vec::new() };
        let mut hits: Vec<RayHit> = self.surfaces_along(ray, filter).collect();
        self.sorted.discs.along(&ray, |disc, _| hits.extend(self.disc_hit(&ray, disc, filter)), |_| false);
        let by_distance = |a: &RayHit, b: &RayHit| a.distance.total_cmp(&b.distance);
        hits.sort_by(|a, b| (a.collider.cmp(&b.collider)).then(by_distance(a, b)).then(a.node.cmp(&b.node)));
        hits.dedup_by_key(|hit| hit.collider);
        hits.sort_by(by_distance);
        hits
    }

    /// The nearest point of the nearest thing that is at most `distance` units away.
    #[must_use]
    pub fn nearest(&self, point: Vec2, distance: f32, filter: &QueryFilter<'_>) -> Option<NearestPoint> {
        if !(point.is_finite() && distance >= 0.0) {
            return None;
        }
        let surfaces = self.surfaces(filter).map(|(collider, obstacle, _)| {
            let (surface, is_inside) = obstacle.nearest(point);
            let on = if is_inside { point } else { surface };
            NearestPoint { collider, node: None, point: on, distance: (on - point).length() }
        });
        let sound = surfaces.filter(|found| found.distance.is_finite());
        let first = sound.reduce(|a, b| if b.distance < a.distance { b } else { a });
        let most = first.map_or(distance, |first| if first.distance < distance { first.distance } else { distance });
        let disc = self.nearest_disc(point, most, filter);
        disc.or(first).filter(|found| found.distance <= distance)
    }

    /// What a disc overlaps: discs of organisms, the area within their outlines, obstacles, walls. In a stable order.
    #[must_use]
    pub fn overlap_disc(&self, centre: Vec2, radius: f32, filter: &QueryFilter<'_>) -> Vec<Collider> {
        self.overlap(&QueryArea::Disc(centre, radius), filter)
    }

    /// What a box overlaps, see [`Queries::overlap_disc`].
    #[must_use]
    pub fn overlap_box(&self, low: Vec2, high: Vec2, filter: &QueryFilter<'_>) -> Vec<Collider> {
        let corners = [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
        self.overlap(&QueryArea::Polygon(&corners), filter)
    }

    /// What a simple polygon overlaps, see [`Queries::overlap_disc`]. Fewer than three corners overlap nothing.
    #[must_use]
    pub fn overlap_polygon(&self, corners: &[Vec2], filter: &QueryFilter<'_>) -> Vec<Collider> {
        self.overlap(&QueryArea::Polygon(corners), filter)
    }

    fn overlap(&self, area: &QueryArea<'_>, filter: &QueryFilter<'_>) -> Vec<Collider> {
        let Some(bounds) = area.aabb() else { return Vec::new() };
        let near = self.sorted.discs.in_box(bounds.mins, bounds.maxs).filter(|disc| area.touches_disc(disc));
        let mut found: Vec<Collider> = near.filter_map(|disc| self.organism_of(disc, filter)).collect();
        found.sort_unstable();
        found.dedup();
        let around = self.sorted.outlined.iter().filter(|(_, organism)| organism.intersects(&bounds));
        let around = around.filter(|(id, _)| found.binary_search(&Collider::Organism(*id)).is_err());
        let around: Vec<_> = around.filter(|(id, _)| self.is_within(*id, area, filter)).map(|(id, _)| *id).collect();
        found.extend(around.into_iter().map(Collider::Organism));
        let near = self.surfaces(filter).filter(|(.., aabb)| aabb.intersects(&bounds));
        found.extend(near.filter(|(_, obstacle, _)| area.touches_obstacle(obstacle)).map(|(collider, ..)| collider));
        found.sort_unstable();
        found
    }

    /// Whether an area overlaps that within an organism's outline.
    fn is_within(&self, id: OrganismId, area: &QueryArea<'_>, filter: &QueryFilter<'_>) -> bool {
        let Some(organism) = self.world.organisms.get(id) else { return false };
        let mut nodes = organism.outline_particles().map(|i| self.world.particles.groups[i as usize]);
        nodes.any(|groups| groups.meets(filter.groups))
            && self.is_asked_for(id, filter)
            && area.touches_outline(&self.world.outline_of(organism))
    }

    fn nearest_disc(&self, point: Vec2, max_distance: f32, filter: &QueryFilter<'_>) -> Option<NearestPoint> {
        let mut searched: f32 = 1.0;
        loop {
            let within = if searched < max_distance { searched } else { max_distance };
            let gap = |disc: &Disc| {
                let gap = (disc.at - point).length() - disc.radius;
                if gap > 0.0 { gap } else { 0.0 }
            };
            let near = self.sorted.discs.in_box(point - within, point + within).map(|disc| (gap(disc), disc));
            let near = near.filter(|(gap, disc)| *gap <= within && self.organism_of(disc, filter).is_some());
            let first = near.reduce(|a, b| if (b.0, b.1.index) < (a.0, a.1.index) { b } else { a });
            if let Some((distance, disc)) = first {
                let (collider, node) = (self.organism_of(disc, filter)?, Some(disc.index));
                let outwards = (point - disc.at).normalize_or_zero() * disc.radius;
                let point = if distance > 0.0 { disc.at + outwards } else { point };
                return Some(NearestPoint { collider, node, point, distance });
            }
            let Vec2 { x, y } = self.world.config.size;
            if within == max_distance || searched > 4.0 * (x + y) + point.length() {
                return None;
            }
            searched *= 2.0;
        }
    }

    /// The obstacles and walls that a filter lets through.
    fn surfaces<'a>(
        &'a self,
        filter: &'a QueryFilter<'_>,
    ) -> impl Iterator<Item = (Collider, &'w Obstacle, Aabb)> + 'a {
        let is_asked_for = move |collider: Collider, obstacle: &Obstacle| {
            let is_of_kind = if let Collider::Wall(_) = collider { filter.walls } else { filter.obstacles };
            is_of_kind
                && (filter.sensors || !obstacle.is_sensor)
                && obstacle.groups.meets(filter.groups)
                && filter.accepts(collider)
        };
        let all = self.sorted.obstacles.iter().map(|&(collider, k, aabb)| (collider, &self.world.obstacles[k], aabb));
        all.filter(move |(collider, obstacle, _)| is_asked_for(*collider, obstacle))
    }

    /// The obstacles and walls along a ray.
    fn surfaces_along<'a>(&'a self, ray: Ray, filter: &'a QueryFilter<'_>) -> impl Iterator<Item = RayHit> + 'a {
        self.surfaces(filter).filter_map(move |(collider, obstacle, aabb)| {
            let (start, distance) = (aabb.loosened(ray.radius), aabb.loosened(ray.radius + ray.length));
            if !distance.contains_local_point(ray.origin) || !may_enter(&ray, &start) {
                return None;
            }
            let (distance, along) = meets(&ray, obstacle)?;
            let centre = ray.point_at(distance);
            let (surface, is_inside) = obstacle.nearest(centre);
            let begins_inside = distance == 0.0 && (is_inside || (centre - surface).length() < ray.radius);
            let away = along.unwrap_or(if is_inside { surface - centre } else { centre - surface });
            // On the surface itself the way out is the way back.
            let away = away.try_normalize().filter(|away| away.dot(ray.direction) < 0.0).unwrap_or(-ray.direction);
            let normal = if begins_inside { Vec2::ZERO } else { away };
            // Not where a number overflows far outside.
            surface.is_finite().then_some(RayHit { collider, node: None, distance, point: surface, normal })
        })
    }

    fn disc_hit(&self, ray: &Ray, disc: &Disc, filter: &QueryFilter<'_>) -> Option<RayHit> {
        let (collider, distance) = (self.organism_of(disc, filter)?, ray.touches(disc)?);
        let away = (ray.point_at(distance) - disc.at).normalize_or_zero();
        let normal = if distance > 0.0 { away } else { Vec2::ZERO };
        let point = if distance > 0.0 { disc.at + away * disc.radius } else { ray.origin };
        point.is_finite().then_some(RayHit { collider, node: Some(disc.index), distance, point, normal })
    }

    /// Whose disc it is, if a filter lets it through.
    fn organism_of(&self, disc: &Disc, filter: &QueryFilter<'_>) -> Option<Collider> {
        let (world, i) = (self.world, disc.index as usize);
        let id = world.organisms.id_at(world.particles.owner[i])?;
        let is_asked_for = world.particles.groups[i].meets(filter.groups) && self.is_asked_for(id, filter);
        is_asked_for.then_some(Collider::Organism(id))
    }

    fn is_asked_for(&self, id: OrganismId, filter: &QueryFilter<'_>) -> bool {
        filter.organisms
            && filter.excluded != Some(id)
            && filter.kind.is_none_or(|kind| self.world.kind(id) == Some(kind))
            && filter.accepts(Collider::Organism(id))
    }
}

/// A ray, if these numbers make one.
fn ray(origin: Vec2, direction: Vec2, length: f32, radius: f32) -> Option<Ray> {
    let direction = direction.try_normalize()?;
    let is_sound = origin.is_finite() && length >= 0.0 && (0.0..f32::INFINITY).contains(&radius);
    is_sound.then_some(Ray { origin, direction, length, radius })
}

/// Whether a ray comes into a box.
fn may_enter(ray: &Ray, aabb: &Aabb) -> bool {
    let ray = parry2d::query::Ray::new(ray.origin, ray.direction);
    aabb.clip_ray_parameters(&ray).is_some()
}

/// How far along a ray an obstacle is met, and for a line the normal of its surface there.
fn meets(ray: &Ray, obstacle: &Obstacle) -> Option<(f32, Option<Vec2>)> {
    if ray.radius == 0.0 {
        let line = parry2d::query::Ray::new(ray.origin, ray.direction);
        let hit = obstacle.shape.cast_ray_and_get_normal(&obstacle.pose, &line, ray.length, true)?;
        return Some((hit.time_of_impact, Some(hit.normal)));
    }
    let (surface, is_inside) = obstacle.nearest(ray.origin);
    if is_inside || (ray.origin - surface).length() <= ray.radius {
        return Some((0.0, None));
    }
    let options = ShapeCastOptions { max_time_of_impact: ray.length, ..ShapeCastOptions::default() };
    let (at, ball) = (Pose::from_translation(ray.origin), Ball::new(ray.radius));
    let shape = obstacle.shape.0.as_ref();
    let hit = cast_shapes(&at, ray.direction, &ball, &obstacle.pose, Vec2::ZERO, shape, options);
    hit.ok().flatten().map(|hit| (refined(ray, obstacle, hit.time_of_impact), None))
}

/// A distance at which a disc nearly touches an obstacle, corrected along the surface's normal (Newton's method): that of a
/// large shape is off by a hundredth of a unit.
fn refined(ray: &Ray, obstacle: &Obstacle, mut distance: f32) -> f32 {
    for _ in 0..4 {
        let centre = ray.point_at(distance);
        let (surface, is_inside) = obstacle.nearest(centre);
        let gap = (centre - surface).length();
        let approach = -(centre - surface).dot(ray.direction);
        if is_inside || approach <= 0.01 * gap {
            break;
        }
        distance = (distance + (gap - ray.radius) * gap / approach).clamp(0.0, ray.length);
    }
    distance
}
