//! Discs in a grid, searched one by one: those of membranes and fluid, which are many and move freely.

use super::aabb::LaneBoxes;
use super::disc::{Disc, DiscGroup, WIDTH};
use super::uniform_grid::UniformGrid;
use crate::instruction_set::each;
use crate::particle::{BlockRange, CollisionGroups, LANES, Particles};
use glam::Vec2;
use std::ops::Range;

/// The columns that discs are made from, looked up once and not for each of them.
#[derive(Clone, Copy)]
pub(super) struct DiscColumns<'a> {
    origin_x: &'a [f32],
    origin_y: &'a [f32],
    x: &'a [f32],
    y: &'a [f32],
    radius: &'a [f32],
    groups: &'a [CollisionGroups],
}

impl<'a> DiscColumns<'a> {
    pub(super) fn of(particles: &'a Particles) -> Self {
        let Particles { origin_x, origin_y, x, y, radius, groups, .. } = particles;
        Self { origin_x, origin_y, x, y, radius, groups }.part(0..particles.len())
    }

    /// Some of them, with lengths that the compiler sees to be equal.
    #[inline(always)]
    fn part(&self, range: Range<usize>) -> Self {
        let Self { origin_x, origin_y, x, y, radius, groups } = *self;
        let [origin_x, origin_y, x, y, radius] =
            [origin_x, origin_y, x, y, radius].map(|column| &column[range.clone()]);
        Self { origin_x, origin_y, x, y, radius, groups: &groups[range] }
    }

    /// Particle `i`, if it collides with anything.
    #[inline(always)]
    pub(super) fn disc(&self, i: usize, displacement: f32) -> Option<Disc> {
        let disc = || {
            let at = Vec2::new(self.origin_x[i] + self.x[i], self.origin_y[i] + self.y[i]);
            Disc { at, swept_radius: self.radius[i] + displacement, index: i as u32 }
        };
        (self.groups[i].memberships != 0).then(disc)
    }

    /// Makes the discs of a block, lane by lane, and the boxes around those of each lane that collide with anything.
    #[inline(always)]
    pub(super) fn make_discs(&self, block: &BlockRange, displacement: f32, discs: &mut [DiscGroup]) -> LaneBoxes {
        let (mut boxes, own) = (LaneBoxes::EMPTY, self.part(block.base..block.end()));
        let groups = discs.len() / LANES;
        for group in 0..groups {
            let [mut x, mut y, mut radius] = [[[f32::NAN; LANES]; WIDTH]; 3];
            for (k, slot) in (group * WIDTH..block.slots).take(WIDTH).enumerate() {
                [x[k], y[k], radius[k]] = own.row(slot * LANES, displacement);
                boxes.add(x[k], y[k], radius[k]);
            }
            // Not by `map`, which is not always inlined.
            let lane = |of: &[[f32; LANES]; WIDTH], l: usize| [of[0][l], of[1][l], of[2][l], of[3][l]];
            for (of_lane, l) in discs.chunks_exact_mut(groups).zip(0..LANES) {
                of_lane[group] = DiscGroup { x: lane(&x, l), y: lane(&y, l), swept_radius: lane(&radius, l) };
            }
        }
        boxes
    }

    /// Coordinates and swept radii of eight neighbouring particles, of those that collide with anything.
    #[inline(always)]
    fn row(&self, first: usize, displacement: f32) -> [[f32; LANES]; 3] {
        let lanes = first..first + LANES;
        let (origin_x, origin_y) = (&self.origin_x[lanes.clone()], &self.origin_y[lanes.clone()]);
        let (x, y) = (&self.x[lanes.clone()], &self.y[lanes.clone()]);
        let (radius, groups) = (&self.radius[lanes.clone()], &self.groups[lanes]);
        // Both first, and then a choice: one or the other would be a branch in each lane.
        let swept = each::<LANES>(|l| radius[l] + displacement);
        let mut memberships = [0; LANES];
        memberships.iter_mut().zip(groups).for_each(|(memberships, groups)| *memberships = groups.memberships);
        let swept = each(|l| if memberships[l] != 0 { swept[l] } else { f32::NAN });
        [each(|l| origin_x[l] + x[l]), each(|l| origin_y[l] + y[l]), swept]
    }
}

/// Discs in cell order.
#[derive(Debug, Default)]
pub(super) struct DiscGrid {
    /// Not yet sorted.
    pub found: Vec<Disc>,
    discs: Vec<Disc>,
    grid: UniformGrid,
    max_swept_radius: f32,
}

impl DiscGrid {
    /// Sorts what was found.
    pub(super) fn sort(&mut self, size: Vec2) {
        let Self { found, discs, grid, max_swept_radius } = self;
        let radii = found.iter().map(|disc| disc.swept_radius);
        *max_swept_radius = radii.fold(0.0, |max, radius| if radius > max { radius } else { max });
        grid.fill(Vec2::ZERO, size, Vec2::splat(2.0 * *max_swept_radius), found.len(), |k| found[k].at);
        discs.clear();
        discs.extend(grid.order().iter().map(|&k| found[k as usize]));
    }

    pub(super) fn is_empty(&self) -> bool {
        self.discs.is_empty()
    }

    /// Discs that may get into a box, and some more.
    pub(super) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &Disc> {
        self.rows_in_box(low, high).flat_map(|row| self.row(&row))
    }

    /// The same row by row.
    pub(super) fn rows_in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = Range<usize>> {
        self.grid.ranges_in_box(low - self.max_swept_radius, high + self.max_swept_radius)
    }

    /// The discs of a row.
    pub(super) fn row(&self, row: &Range<usize>) -> &[Disc] {
        &self.discs[row.clone()]
    }

    /// Discs that may touch one that is not of the grid.
    pub(super) fn near(&self, disc: &Disc) -> impl Iterator<Item = &Disc> {
        let disc = *disc;
        self.in_box(disc.at - disc.swept_radius, disc.at + disc.swept_radius).filter(move |other| other.is_near(&disc))
    }

    /// All discs.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Disc> {
        self.discs.iter()
    }

    /// Calls `visit` once for each two discs that may touch.
    pub(super) fn pairs(&self, mut visit: impl FnMut(&Disc, &Disc)) {
        self.grid.pairs(0..self.grid.rows(), |a, b| {
            let (a, b) = (&self.discs[a], &self.discs[b]);
            if a.is_near(b) {
                visit(a, b);
            }
        });
    }
}

/// Where the fluid changes from one disc of a grid to the next: neighbours of one fluid are skipped without a look at them.
#[derive(Debug, Default)]
pub(super) struct FluidChanges {
    /// The fluid of each disc.
    fluids: Vec<u32>,
    /// Changes up to each disc.
    counts: Vec<u32>,
}

impl FluidChanges {
    /// Finds the changes; returns whether there are any.
    pub(super) fn find(&mut self, grid: &DiscGrid, p: &Particles) -> bool {
        let Self { fluids, counts } = self;
        fluids.clear();
        fluids.extend(grid.iter().map(|disc| p.fluid[disc.index as usize]));
        let (mut count, mut last) = (0, fluids.first().copied());
        counts.clear();
        counts.extend(fluids.iter().map(|&fluid| {
            count += u32::from(Some(fluid) != last);
            last = Some(fluid);
            count
        }));
        count > 0
    }

    /// Calls `visit` once for each two discs that may touch, but for some of the same fluid.
    pub(super) fn pairs(&self, grid: &DiscGrid, mut visit: impl FnMut(&Disc, &Disc)) {
        grid.grid.neighbours(0..grid.grid.rows(), |cell, right, above| {
            // The cell itself is part of what is to the right.
            if self.is_one(cell.start, &right) && self.is_one(cell.start, &above) {
                return;
            }
            for k in cell {
                for others in [k + 1..right.end, above.clone()].into_iter().filter(|others| !self.is_one(k, others)) {
                    let near = grid.discs[others].iter().filter(|other| grid.discs[k].is_near(other));
                    near.for_each(|other| visit(&grid.discs[k], other));
                }
            }
        });
    }

    /// Whether all discs in some places, which lie side by side, are of the fluid of the disc in place `k`.
    #[inline(always)]
    fn is_one(&self, k: usize, others: &Range<usize>) -> bool {
        let Range { start, end } = *others;
        start >= end || (self.counts[start] == self.counts[end - 1] && self.fluids[start] == self.fluids[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::Particle;
    use crate::rng::Rng;
    use crate::solver::testing::disc;

    #[test]
    fn boxes_of_discs_that_are_near_enough_overlap_despite_rounding() {
        let (mut rng, mut near) = (Rng::new(1, 1), 0);
        for _ in 0..100_000 {
            let disc = |at, swept_radius| Disc { at, swept_radius, index: 0 };
            let a = disc(Vec2::new(rng.range(0.0, 20_000.0), rng.range(0.0, 200.0)), rng.range(0.2, 2.0));
            let (radius, slack) = (rng.range(0.2, 2.0), rng.range(0.0, 0.3));
            // Beside it, as far away as it may be and still be near.
            let b = disc(a.at + Vec2::new(a.swept_radius + radius - slack, 0.0), radius);
            if a.is_within(&b, slack) {
                near += 1;
                assert!(a.aabb().shrunk(slack).overlaps(b.aabb()), "{a:?} {b:?} {slack}");
                assert!(b.aabb().shrunk(slack).overlaps(a.aabb()), "{b:?} {a:?} {slack}");
            }
        }
        assert!(near > 10_000, "{near}");
    }

    #[test]
    fn all_pairs_of_different_fluids_are_found_once() {
        let (mut rng, mut p) = (Rng::new(7, 2), Particles::default());
        // Blots of one fluid each, so that some cells and all around them are of one fluid.
        for fluid in 1..9 {
            let centre = Vec2::new(rng.range(4.0, 16.0), rng.range(4.0, 16.0));
            for _ in 0..80 {
                let at = centre + Vec2::new(rng.range(-4.0, 4.0), rng.range(-4.0, 4.0));
                p.insert(&Particle { fluid, ..disc(at, 1.0) });
            }
        }
        let (mut grid, mut changes, columns) = (DiscGrid::default(), FluidChanges::default(), DiscColumns::of(&p));
        grid.found.extend((0..p.len()).filter_map(|i| columns.disc(i, 0.0)));
        grid.sort(Vec2::splat(20.0));
        let is_wanted = |a: &Disc, b: &Disc| p.fluid[a.index as usize] != p.fluid[b.index as usize];
        let sorted = |a: &Disc, b: &Disc| (a.index.min(b.index), a.index.max(b.index));
        let (mut expected, mut found, mut same) = (Vec::new(), Vec::new(), 0);
        grid.pairs(|a, b| if is_wanted(a, b) { expected.push(sorted(a, b)) } else { same += 1 });
        assert!(changes.find(&grid, &p));
        let mut others = 0;
        changes.pairs(&grid, |a, b| if is_wanted(a, b) { found.push(sorted(a, b)) } else { others += 1 });
        assert_eq!(found, expected);
        assert!(found.len() > 100 && others < same, "{} {others} {same}", found.len());
    }
}
