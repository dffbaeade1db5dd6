//! Entries of a world in grids, those of like size in one, so that a query looks at those that are near.

use super::entry::{Entry, rounding};
use super::ray::Ray;
use crate::collision::uniform_grid::UniformGrid;
use glam::Vec2;

/// Entries of like size, in cell order.
#[derive(Clone, Debug)]
struct SizeClass<E> {
    entries: Vec<E>,
    grid: UniformGrid,
    max_extent: f32,
    low: Vec2,
    high: Vec2,
}

/// All entries.
#[derive(Clone, Debug)]
pub(super) struct Index<E>(Vec<SizeClass<E>>);

impl<E: Entry> Index<E> {
    /// An index of a room of this size.
    pub(super) fn new(entries: impl IntoIterator<Item = E>, size: Vec2) -> Self {
        let mut classes: Vec<(u32, Vec<E>)> = Vec::new();
        for entry in entries {
            let rank = size_rank(entry.extent());
            match classes.iter_mut().find(|class| class.0 == rank) {
                Some((_, class)) => class.push(entry),
                None => classes.push((rank, vec![entry])),
            }
        }
        Self(classes.into_iter().map(|(_, entries)| SizeClass::new(&entries, size)).collect())
    }

    /// Lower left and upper right corner of the box around all entries.
    pub(super) fn bounds(&self) -> [Vec2; 2] {
        let all = [Vec2::INFINITY, Vec2::NEG_INFINITY];
        self.0.iter().fold(all, |[low, high], class| [low.min(class.low), high.max(class.high)])
    }

    /// Entries that may reach into a box.
    pub(super) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &E> {
        self.0.iter().flat_map(move |class| class.in_box(low, high))
    }

    /// Calls `visit` once with each entry that a ray touches and where, those of one stretch after those of the one before, until
    /// `is_enough` of the distance up to which all have been visited.
    pub(super) fn along(&self, ray: &Ray, mut visit: impl FnMut(&E, f32), is_enough: impl Fn(f32) -> bool + Copy) {
        for class in &self.0 {
            class.along(ray, &mut visit, is_enough);
        }
    }

    /// The nearest entry at most `max_distance` away; the first by index of equally near ones. `measure` tells the distance of one if
    /// it is at most its second argument.
    pub(super) fn nearest(
        &self,
        point: Vec2,
        max_distance: f32,
        measure: impl Fn(&E, f32) -> Option<f32>,
    ) -> Option<(f32, &E)> {
        let mut searched = FIRST_SEARCH;
        loop {
            let within = if searched < max_distance { searched } else { max_distance };
            let (low, high) = (point - within, point + within);
            let near = self.in_box(low, high).filter_map(|entry| Some((measure(entry, within)?, entry)));
            let first = near.reduce(|a, b| if (b.0, b.1.index()) < (a.0, a.1.index()) { b } else { a });
            let is_all = self.0.iter().all(|class| class.low.cmpge(low).all() && class.high.cmple(high).all());
            if first.is_some() || within == max_distance || is_all {
                return first;
            }
            searched *= 2.0;
        }
    }
}

/// Distance in which the nearest entry is searched first, units.
const FIRST_SEARCH: f32 = 1.0;

/// Equal for extents of one class, which differ by less than a factor of four: half the exponent.
fn size_rank(extent: f32) -> u32 {
    extent.to_bits() >> 24
}

impl<E: Entry> SizeClass<E> {
    fn new(found: &[E], size: Vec2) -> Self {
        let mut grid = UniformGrid::default();
        let max_extent =
            found.iter().map(E::extent).fold(0.0, |most, extent| if extent > most { extent } else { most });
        let cell = Vec2::splat(if max_extent > 0.0 { 2.0 * max_extent } else { 1.0 });
        grid.fill(Vec2::ZERO, size, cell, found.len(), |k| found[k].centre());
        let entries: Vec<E> = grid.order().iter().map(|&k| found[k as usize]).collect();
        let low = entries.iter().fold(Vec2::INFINITY, |low, entry| low.min(entry.centre() - entry.extent()));
        let high = entries.iter().fold(Vec2::NEG_INFINITY, |high, entry| high.max(entry.centre() + entry.extent()));
        Self { entries, grid, max_extent, low, high }
    }

    fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &E> {
        let extent = self.max_extent + rounding(low, high);
        let ranges = self.grid.ranges_in_box(low - extent, high + extent);
        ranges.flat_map(|range| &self.entries[range])
    }

    fn along(&self, ray: &Ray, visit: &mut impl FnMut(&E, f32), is_enough: impl Fn(f32) -> bool) {
        let extent = ray.radius + self.max_extent;
        let Some((first, last)) = ray.within(self.low - extent, self.high + extent) else { return };
        let stretch = 4.0 * extent + 1.0;
        let mut start = first;
        while !is_enough(start) {
            let end = start + stretch;
            // Also where a stretch is less than rounding.
            let is_last = end >= last || end == start;
            let (a, b) = (ray.point_at(start), ray.point_at(if is_last { last } else { end }));
            let near = self.in_box(a.min(b) - ray.radius, a.max(b) + ray.radius);
            for (entry, at) in near.filter_map(|entry| Some((entry, entry.first_touch(ray)?))) {
                // Each where its distance is; rounding must not lose it at the ends.
                let (after, before) = (at >= start || start == first, at < end || is_last);
                if after && before {
                    visit(entry, at);
                }
            }
            if is_last {
                return;
            }
            start = end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;
    use crate::world::query::entry::{Bounds, Disc};
    use parry2d::bounding_volume::Aabb;

    fn discs(rng: &mut Rng) -> Vec<Disc> {
        let disc = |index: u32| {
            let at = Vec2::new(rng.range(-3.0, 83.0), rng.range(-3.0, 43.0));
            let radius = if index.is_multiple_of(40) { rng.range(3.0, 8.0) } else { rng.range(0.0, 0.8) };
            Disc { at, radius, index }
        };
        (0..400).map(disc).collect()
    }

    #[test]
    fn a_ray_visits_exactly_the_discs_that_it_touches_once_each() {
        let mut rng = Rng::new(4, 4);
        let discs = discs(&mut rng);
        let index = Index::new(discs.clone(), Vec2::new(80.0, 40.0));
        let mut touched = 0;
        for k in 0..500 {
            let origin = Vec2::new(rng.range(-50.0, 130.0), rng.range(-50.0, 90.0));
            let direction = Vec2::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0)).normalize();
            let direction = [direction, Vec2::X, Vec2::NEG_Y][if k % 10 < 2 { k % 10 + 1 } else { 0 }];
            let ray = Ray { origin, direction, length: rng.range(0.0, 300.0), radius: (k % 3) as f32 * 0.7 };
            let mut visited = Vec::new();
            index.along(&ray, |disc, at| visited.push((disc.index, at.to_bits())), |_| false);
            visited.sort_unstable();
            let all = discs.iter().filter_map(|disc| Some((disc.index, disc.first_touch(&ray)?.to_bits())));
            assert_eq!(visited, all.collect::<Vec<_>>(), "{ray:?}");
            touched += visited.len();
        }
        assert!(touched > 1000, "{touched}");
    }

    #[test]
    fn a_ray_visits_the_boxes_that_it_touches_also_those_without_a_breadth() {
        let mut rng = Rng::new(6, 6);
        let bounds = |index: u32| {
            let at = Vec2::new(rng.range(-3.0, 83.0), rng.range(-3.0, 43.0));
            let half = Vec2::new(rng.range(0.0, 3.0), if index.is_multiple_of(3) { 0.0 } else { rng.range(0.0, 20.0) });
            Bounds::new(Aabb::new(at - half, at + half), index)
        };
        let boxes: Vec<Bounds> = (0..200).map(bounds).collect();
        let index = Index::new(boxes.clone(), Vec2::new(80.0, 40.0));
        for k in 0..200 {
            let target = boxes[k].centre();
            let origin = Vec2::new(rng.range(-50.0, 130.0), if k % 2 == 0 { target.y } else { rng.range(-50.0, 90.0) });
            let ray = Ray::new(origin, target - origin, rng.range(100.0, 300.0), (k % 3) as f32 * 0.7).unwrap();
            let mut visited = Vec::new();
            index.along(&ray, |bounds, _| visited.push(bounds.index), |_| false);
            visited.sort_unstable();
            let all = boxes.iter().filter(|bounds| bounds.first_touch(&ray).is_some()).map(|bounds| bounds.index);
            assert_eq!(visited, all.collect::<Vec<_>>(), "{ray:?}");
            assert!(visited.contains(&(k as u32)), "{ray:?}");
        }
    }

    #[test]
    fn a_ray_without_a_length_touches_what_it_begins_in() {
        let discs = discs(&mut Rng::new(9, 9));
        let index = Index::new(discs.clone(), Vec2::new(80.0, 40.0));
        for disc in discs {
            let mut visited = Vec::new();
            index.along(&Ray::new(disc.at, Vec2::X, 0.0, 0.0).unwrap(), |disc, _| visited.push(disc.index), |_| false);
            assert!(visited.contains(&disc.index));
        }
    }

    #[test]
    fn a_ray_from_far_away_comes_to_an_end() {
        let index = Index::new(discs(&mut Rng::new(7, 7)), Vec2::new(80.0, 40.0));
        for far in [1e6, 1e9, 1e12, 1e20, 1e38] {
            let ray = Ray::new(Vec2::new(-far, 20.0), Vec2::X, f32::INFINITY, 0.0).unwrap();
            let mut count = 0;
            index.along(&ray, |_, _| count += 1, |_| false);
            assert!(count > 0, "from {far} away");
        }
    }

    #[test]
    fn the_nearest_disc_is_that_of_brute_force() {
        let mut rng = Rng::new(8, 8);
        let discs = discs(&mut rng);
        let index = Index::new(discs.clone(), Vec2::new(80.0, 40.0));
        for k in 0..300 {
            let point = Vec2::new(rng.range(-90.0, 170.0), rng.range(-90.0, 130.0));
            let most = if k % 3 == 0 { f32::INFINITY } else { rng.range(0.0, 9.0) };
            // Many are equally near.
            let gap = |disc: &Disc| ((disc.at - point).length() - disc.radius).max(0.0).ceil();
            let found = index.nearest(point, most, |disc, within| Some(gap(disc)).filter(|gap| *gap <= within));
            let all = discs.iter().map(|disc| (gap(disc), disc.index)).filter(|(gap, _)| *gap <= most);
            let first = all.reduce(|a, b| if b < a { b } else { a });
            assert_eq!(found.map(|(gap, disc)| (gap, disc.index)), first);
        }
        assert!(Index::<Disc>::new([], Vec2::ONE).nearest(Vec2::ZERO, f32::INFINITY, |_, _| Some(0.0)).is_none());
    }

    #[test]
    fn boxes_find_all_discs_that_reach_into_them() {
        let mut rng = Rng::new(5, 5);
        let discs = discs(&mut rng);
        let index = Index::new(discs.clone(), Vec2::new(80.0, 40.0));
        for _ in 0..200 {
            let low = Vec2::new(rng.range(-9.0, 80.0), rng.range(-9.0, 40.0));
            let high = low + Vec2::new(rng.range(0.0, 20.0), rng.range(0.0, 9.0));
            let found: Vec<u32> = index.in_box(low, high).map(|disc| disc.index).collect();
            for disc in &discs {
                let reaches = (disc.at - disc.at.clamp(low, high)).length() <= disc.radius;
                assert!(!reaches || found.contains(&disc.index));
            }
        }
        assert_eq!(Index::<Disc>::new([], Vec2::ONE).in_box(Vec2::ZERO, Vec2::ONE).count(), 0);
    }
}
