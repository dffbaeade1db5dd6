//! All discs of a world in two grids, small ones and large ones, so that a query looks at those that are near.

use crate::collision::uniform_grid::UniformGrid;
use glam::Vec2;
use std::ops::Range;

/// A disc is large if its radius is more than so many times the mean.
const LARGE: f32 = 2.0;

/// A disc as queries see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub at: Vec2,
    pub radius: f32,
    /// Which particle it is.
    pub index: u32,
}

/// Discs of like size, in cell order.
#[derive(Clone, Debug, Default)]
struct SizeClass {
    discs: Vec<Disc>,
    grid: UniformGrid,
    max_radius: f32,
    low: Vec2,
    high: Vec2,
}

/// All discs.
#[derive(Clone, Debug)]
pub(super) struct DiscIndex([SizeClass; 2]);

/// A ray, thick as a disc that moves along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub origin: Vec2,
    /// Of length 1.
    pub direction: Vec2,
    pub length: f32,
    pub radius: f32,
}

impl Ray {
    pub(super) fn point_at(&self, distance: f32) -> Vec2 {
        self.origin + self.direction * distance
    }

    /// Where it first touches a disc; 0 if it begins there.
    pub(super) fn touches(&self, disc: &Disc) -> Option<f32> {
        let to_centre = disc.at - self.origin;
        let (along, reach) = (to_centre.dot(self.direction), disc.radius + self.radius);
        if to_centre.length_squared() <= reach * reach {
            return Some(0.0);
        }
        // The distance from the line, not the difference of two large squares: far discs are hit as exactly as near ones.
        let aside = (to_centre - self.direction * along).length_squared();
        let half_chord = reach * reach - aside;
        let distance = along - if half_chord > 0.0 { half_chord.sqrt() } else { 0.0 };
        (along > 0.0 && half_chord >= 0.0 && distance <= self.length).then_some(distance)
    }

    /// The part of it within a box, as distances; empty if it misses.
    fn within(&self, low: Vec2, high: Vec2) -> Range<f32> {
        let (mut start, mut end) = (0.0, self.length);
        for axis in 0..2 {
            let (origin, direction) = (self.origin[axis], self.direction[axis]);
            let (a, b) = ((low[axis] - origin) / direction, (high[axis] - origin) / direction);
            if direction == 0.0 {
                if origin < low[axis] || origin > high[axis] {
                    return 0.0..0.0;
                }
            } else {
                let (near, far) = if a < b { (a, b) } else { (b, a) };
                start = if near > start { near } else { start };
                end = if far < end { far } else { end };
            }
        }
        start..end
    }
}

impl DiscIndex {
    pub(super) fn new(discs: Vec<Disc>, size: Vec2) -> Self {
        let mean = discs.iter().map(|disc| disc.radius).sum::<f32>() / discs.len() as f32;
        let (large, small) = discs.into_iter().partition(|disc: &Disc| disc.radius > LARGE * mean);
        Self([SizeClass::new(small, size), SizeClass::new(large, size)])
    }

    /// Discs that may reach into a box.
    pub(super) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &Disc> {
        self.0.iter().flat_map(move |class| class.in_box(low, high))
    }

    /// Calls `visit` once with each disc that a ray touches and where, those of one stretch after those of the one before, until
    /// `is_enough` of the distance up to which all have been visited.
    pub(super) fn along(&self, ray: &Ray, mut visit: impl FnMut(&Disc, f32), is_enough: impl Fn(f32) -> bool + Copy) {
        for class in &self.0 {
            class.along(ray, &mut visit, is_enough);
        }
    }
}

impl SizeClass {
    fn new(found: Vec<Disc>, size: Vec2) -> Self {
        let mut grid = UniformGrid::default();
        let max_radius = found.iter().fold(0.0, |most, disc| if disc.radius > most { disc.radius } else { most });
        let cell = Vec2::splat(if max_radius > 0.0 { 2.0 * max_radius } else { 1.0 });
        grid.fill(Vec2::ZERO, size, cell, found.len(), |k| found[k].at);
        let discs: Vec<Disc> = grid.order().iter().map(|&k| found[k as usize]).collect();
        let low = discs.iter().fold(Vec2::INFINITY, |low, disc| low.min(disc.at - disc.radius));
        let high = discs.iter().fold(Vec2::NEG_INFINITY, |high, disc| high.max(disc.at + disc.radius));
        Self { discs, grid, max_radius, low, high }
    }

    fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &Disc> {
        let ranges = self.grid.ranges_in_box(low - self.max_radius, high + self.max_radius);
        ranges.flat_map(|range| &self.discs[range])
    }

    fn along(&self, ray: &Ray, visit: &mut impl FnMut(&Disc, f32), is_enough: impl Fn(f32) -> bool) {
        if self.discs.is_empty() {
            return;
        }
        let reach = Vec2::splat(ray.radius + self.max_radius);
        let whole = ray.within(self.low - reach, self.high + reach);
        let stretch = 4.0 * reach.x + 1.0;
        let mut start = whole.start;
        while start < whole.end && !is_enough(start) {
            let end = start + stretch;
            let (a, b) = (ray.point_at(start), ray.point_at(if end < whole.end { end } else { whole.end }));
            let near = self.in_box(a.min(b) - ray.radius, a.max(b) + ray.radius);
            let is_first = start == whole.start;
            for (disc, at) in near.filter_map(|disc| Some((disc, ray.touches(disc)?))) {
                // Each where its distance is; rounding must not lose it at the ends.
                let (after, before) = (at >= start || is_first, at < end || end >= whole.end);
                if after && before {
                    visit(disc, at);
                }
            }
            start = end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

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
        let index = DiscIndex::new(discs.clone(), Vec2::new(80.0, 40.0));
        let mut touched = 0;
        for k in 0..500 {
            let origin = Vec2::new(rng.range(-50.0, 130.0), rng.range(-50.0, 90.0));
            let direction = Vec2::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0)).normalize();
            let direction = [direction, Vec2::X, Vec2::NEG_Y][if k % 10 < 2 { k % 10 + 1 } else { 0 }];
            let ray = Ray { origin, direction, length: rng.range(0.0, 300.0), radius: (k % 3) as f32 * 0.7 };
            let mut visited = Vec::new();
            index.along(&ray, |disc, at| visited.push((disc.index, at.to_bits())), |_| false);
            visited.sort_unstable();
            let all = discs.iter().filter_map(|disc| Some((disc.index, ray.touches(disc)?.to_bits())));
            assert_eq!(visited, all.collect::<Vec<_>>(), "{ray:?}");
            touched += visited.len();
        }
        assert!(touched > 1000, "{touched}");
    }

    #[test]
    fn boxes_find_all_discs_that_reach_into_them() {
        let mut rng = Rng::new(5, 5);
        let discs = discs(&mut rng);
        let index = DiscIndex::new(discs.clone(), Vec2::new(80.0, 40.0));
        for _ in 0..200 {
            let low = Vec2::new(rng.range(-9.0, 80.0), rng.range(-9.0, 40.0));
            let high = low + Vec2::new(rng.range(0.0, 20.0), rng.range(0.0, 9.0));
            let found: Vec<u32> = index.in_box(low, high).map(|disc| disc.index).collect();
            for disc in &discs {
                let reaches = (disc.at - disc.at.clamp(low, high)).length() <= disc.radius;
                assert!(!reaches || found.contains(&disc.index));
            }
        }
        assert_eq!(DiscIndex::new(Vec::new(), Vec2::ONE).in_box(Vec2::ZERO, Vec2::ONE).count(), 0);
    }
}
