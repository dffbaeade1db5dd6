//! Queries: organisms at a point, in a circle, in a box; and [`Queries`]: rays, casts of discs, nearest points and overlaps with
//! organisms, obstacles and walls. The world is sorted for them once after each change.

mod across;
mod area;
mod entry;
mod filter;
mod index;
mod ray;
mod sorted;
mod surface;

use super::World;
use crate::collider::Collider;
use crate::id::OrganismId;
use area::{QueryArea, reaches_into};
use entry::{Disc, Entry, rounding};
pub use filter::QueryFilter;
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};
use ray::Ray;
pub(crate) use sorted::QueryIndex;
use std::cell::Cell;

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
/// In a room with periodic sides queries see images of everything: a ray goes on at the opposite side, for at most 32 lengths of
/// the room along an axis. What they find has its place where it lies itself, with its centre in the room, so from the origin of a ray
/// its distance leads to that place or to an image of it.
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
}

impl World {
    /// Queries of the present state. The first since the last step, or since another change, sorts what it looks at.
    #[must_use]
    pub fn queries(&self) -> Queries<'_> {
        Queries { world: self }
    }

    /// Organisms at a point: one of their discs, or the area within their outline, contains it.
    pub fn organisms_at(&self, point: Vec2) -> impl Iterator<Item = OrganismId> + '_ {
        self.organisms_in_circle(point, 0.0)
    }

    /// Organisms that a circle touches: one of their discs, or the area within their outline, reaches into it. The first question
    /// since the last step, or since another change, looks at every particle.
    pub fn organisms_in_circle(&self, centre: Vec2, radius: f32) -> impl Iterator<Item = OrganismId> + '_ {
        let extent = Vec2::splat(if radius < 0.0 { 0.0 } else { radius });
        self.find_images([centre - extent, centre + extent], move |shift| {
            let centre = centre + shift;
            let meets = move |disc: Vec2, r: f32| (disc - centre).length() <= r + radius;
            self.find([centre - extent, centre + extent], meets, Some((centre, radius)))
        })
    }

    /// Organisms with a disc that reaches into the box from `low` to `high`.
    pub fn organisms_in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = OrganismId> + '_ {
        let high = high.max(low);
        self.find_images([low, high], move |shift| {
            let (low, high) = (low + shift, high + shift);
            self.find([low, high], move |disc, r| (disc - disc.clamp(low, high)).length() <= r, None)
        })
    }

    /// Organisms near a box with a disc that `meets`, or an area that a disc, centre and radius, reaches into; by index.
    fn find<'a>(
        &'a self,
        [low, high]: [Vec2; 2],
        meets: impl Fn(Vec2, f32) -> bool + 'a,
        inside: Option<(Vec2, f32)>,
    ) -> impl Iterator<Item = OrganismId> + 'a {
        let is_met = move |id: &OrganismId| {
            let Some(organism) = self.organisms.get(*id) else { return false };
            let discs = organism.particles().map(|i| i as usize);
            let mut solid = discs.filter(|&i| self.particles.groups[i].memberships != 0);
            solid.any(|i| meets(self.particles.position(i), self.particles.radius[i]))
                || inside.is_some_and(|(centre, radius)| reaches_into(&self.outline_of(organism), centre, radius))
        };
        let slack = rounding(low, high);
        self.organisms_near(&Aabb { mins: low - slack, maxs: high + slack }).into_iter().filter(is_met)
    }

    /// Organisms whose boxes overlap another one, by index; none if that is not a number.
    fn organisms_near(&self, aabb: &Aabb) -> Vec<OrganismId> {
        if aabb.mins.is_nan() || aabb.maxs.is_nan() {
            return Vec::new();
        }
        let index = self.sorted_organisms();
        let near = index.in_box(aabb.mins, aabb.maxs).filter(|bounds| bounds.aabb.intersects(aabb));
        let mut found: Vec<OrganismId> = near.filter_map(|bounds| self.organisms.id_at(bounds.index)).collect();
        found.sort_unstable();
        found
    }
}

impl Queries<'_> {
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
        let ray = Ray::new(origin, direction, length, radius)?;
        self.first_of_images(ray, |ray| self.first_hit(ray, filter))
    }

    fn first_hit(&self, mut ray: Ray, filter: &QueryFilter<'_>) -> Option<RayHit> {
        let first = self.first_surface(&ray, filter);
        ray.length = first.map_or(ray.length, |hit| hit.distance);
        let disc = self.first_disc(&ray, filter);
        disc.filter(|disc| first.is_none_or(|first| disc.distance <= first.distance)).or(first)
    }

    /// Everything along a ray, each where it is met first, by distance.
    #[must_use]
    pub fn cast_ray_all(&self, origin: Vec2, direction: Vec2, length: f32, filter: &QueryFilter<'_>) -> Vec<RayHit> {
        let Some(ray) = Ray::new(origin, direction, length, 0.0) else { return Vec::new() };
        let mut hits = Vec::new();
        for ray in self.images_of_ray(ray) {
            self.visit_surfaces(&ray, filter, |_, hit| hits.push(hit), |_| false);
            if filter.organisms {
                let visit = |disc: &Disc, _| hits.extend(self.disc_hit(&ray, disc, filter));
                self.world.sorted_discs().along(&ray, visit, |_| false);
            }
        }
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
        self.nearest_of_images(point, distance, |point, distance| self.nearest_to(point, distance, filter))
    }

    fn nearest_to(&self, point: Vec2, distance: f32, filter: &QueryFilter<'_>) -> Option<NearestPoint> {
        let first = self.nearest_surface(point, distance, filter);
        let disc = self.nearest_disc(point, first.map_or(distance, |first| first.distance), filter);
        disc.or(first)
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
        self.found_by_images(area, &bounds, |area, bounds| {
            let mut found = if filter.organisms { self.organisms_in(area, bounds, filter) } else { Vec::new() };
            found.extend(self.surfaces_in(area, bounds, filter));
            found.sort_unstable();
            found
        })
    }

    fn organisms_in(&self, area: &QueryArea<'_>, bounds: &Aabb, filter: &QueryFilter<'_>) -> Vec<Collider> {
        let index = self.world.sorted_discs();
        let discs = index.in_box(bounds.mins, bounds.maxs).filter(|disc| area.touches_disc(disc));
        let mut found: Vec<Collider> = discs.filter_map(|disc| self.organism_of(disc, filter)).collect();
        found.sort_unstable();
        found.dedup();
        let others = self.world.organisms_near(bounds).into_iter();
        let others = others.filter(|id| found.binary_search(&Collider::Organism(*id)).is_err());
        let around: Vec<OrganismId> = others.filter(|id| self.is_within(*id, area, filter)).collect();
        found.extend(around.into_iter().map(Collider::Organism));
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

    /// The first disc along a ray.
    fn first_disc(&self, ray: &Ray, filter: &QueryFilter<'_>) -> Option<RayHit> {
        if !filter.organisms {
            return None;
        }
        let first: Cell<Option<(f32, u32, Disc)>> = Cell::new(None);
        let visit = |disc: &Disc, at: f32| {
            let is_first = first.get().is_none_or(|(distance, index, _)| (at, disc.index) < (distance, index));
            if is_first && self.organism_of(disc, filter).is_some() {
                first.set(Some((at, disc.index, *disc)));
            }
        };
        let is_enough = |done| first.get().is_some_and(|(distance, ..)| distance < done);
        self.world.sorted_discs().along(ray, visit, is_enough);
        first.get().and_then(|(.., disc)| self.disc_hit(ray, &disc, filter))
    }

    fn nearest_disc(&self, point: Vec2, max_distance: f32, filter: &QueryFilter<'_>) -> Option<NearestPoint> {
        if !filter.organisms {
            return None;
        }
        let gap = |disc: &Disc, within: f32| {
            let gap = (disc.at - point).length() - disc.radius;
            let gap = if gap > 0.0 { gap } else { 0.0 };
            (gap <= within && self.organism_of(disc, filter).is_some()).then_some(gap)
        };
        let index = self.world.sorted_discs();
        let (distance, disc) = index.nearest(point, max_distance, gap)?;
        let (collider, node) = (self.organism_of(disc, filter)?, Some(disc.index));
        let outwards = (point - disc.at).normalize_or_zero() * disc.radius;
        let point = if distance > 0.0 { disc.at + outwards } else { point };
        Some(NearestPoint { collider, node, point, distance })
    }

    fn disc_hit(&self, ray: &Ray, disc: &Disc, filter: &QueryFilter<'_>) -> Option<RayHit> {
        let (collider, distance) = (self.organism_of(disc, filter)?, disc.first_touch(ray)?);
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
