//! Bodies: discs that belong together, a soft body's or a single one. Two levels: first bodies whose boxes meet, then the
//! discs of each that are near the other's box.
//!
//! Bodies differ in size by a factor of ten and more, so there are two grids of them: small bodies in a fine one, large ones
//! in a coarse one, and large ones also look through the fine one.

use super::crowd::{Crowd, Disc};
use super::grid::Grid;
use crate::parallel;
use crate::particle::{BlockRange, LANES, Particles};
use glam::Vec2;
use std::ops::Range;

/// Rows of cells that are searched at a time, a fixed number whatever the number of threads.
const STRIP: usize = 4;
/// Blocks that are collected at a time, likewise.
const PORTION: usize = 16;

/// A body: its discs, and the box around what they can reach in the step.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub low: Vec2,
    pub high: Vec2,
    discs: Range<usize>,
}

impl Body {
    /// The body of these discs, the first of which is at `first` of all.
    fn around(discs: &[Disc], first: usize) -> Self {
        let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for disc in discs {
            low = low.min(disc.at - disc.reach);
            high = high.max(disc.at + disc.reach);
        }
        Self { low, high, discs: first..first + discs.len() }
    }

    fn centre(&self) -> Vec2 {
        (self.low + self.high) * 0.5
    }

    fn extent(&self) -> f32 {
        let Vec2 { x, y } = self.high - self.low;
        if x > y { x } else { y }
    }

    pub(super) fn meets(&self, low: Vec2, high: Vec2) -> bool {
        self.low.cmple(high).all() && self.high.cmpge(low).all()
    }
}

/// Bodies of like size, in the order of the cells that their centres are in.
#[derive(Clone, Debug, Default)]
struct Layer {
    bodies: Vec<Body>,
    grid: Grid,
    /// The largest width or height.
    extent: f32,
}

/// All bodies.
#[derive(Debug, Default)]
pub(super) struct Bodies {
    /// Body by body; what lies between two bodies means nothing.
    pub discs: Vec<Disc>,
    found: Vec<Body>,
    small: Layer,
    large: Layer,
}

impl Bodies {
    /// Makes a body of each instance in some blocks, in place of all there were.
    pub(super) fn collect(&mut self, blocks: &[BlockRange], particles: &Particles, reach: f32) {
        let Self { discs, found, .. } = self;
        discs.resize(blocks.iter().map(BlockRange::len).sum(), Disc::default());
        let (mut portions, mut rest, mut start) = (Vec::new(), discs.as_mut_slice(), 0);
        for blocks in blocks.chunks(PORTION) {
            let len = blocks.iter().map(BlockRange::len).sum();
            let (discs, others) = rest.split_at_mut(len);
            portions.push((blocks, start, discs));
            (rest, start) = (others, start + len);
        }
        let collected = parallel::map(portions, |(blocks, start, discs)| {
            let mut bodies = Vec::with_capacity(blocks.len() * LANES);
            let mut end = 0;
            for (block, lane) in blocks.iter().flat_map(|block| (0..LANES).map(move |lane| (block, lane))) {
                let first = end;
                for i in (0..block.slots).map(|slot| block.entry(slot, lane)) {
                    if particles.groups[i].memberships != 0 {
                        discs[end] = Disc::of(particles, i, reach);
                        end += 1;
                    }
                }
                if end > first {
                    bodies.push(Body::around(&discs[first..end], start + first));
                }
            }
            bodies
        });
        found.clear();
        collected.into_iter().for_each(|bodies| found.extend(bodies));
    }

    /// Makes a body of a disc on its own.
    pub(super) fn add_single(&mut self, disc: Disc) {
        self.found.push(Body::around(&[disc], self.discs.len()));
        self.discs.push(disc);
    }

    /// Sorts the bodies for the search.
    pub(super) fn sort(&mut self, size: Vec2) {
        let Self { found, small, large, .. } = self;
        let mean = found.iter().map(Body::extent).sum::<f32>() / found.len() as f32;
        let larger = found.extract_if(.., |body| body.extent() > 2.0 * mean).collect::<Vec<_>>();
        small.sort(found, size);
        large.sort(&larger, size);
    }

    /// Its discs.
    pub(super) fn discs_of(&self, body: &Body) -> &[Disc] {
        &self.discs[body.discs.clone()]
    }

    /// Calls `visit` once for each disc of a body and each disc of a crowd that may touch.
    pub(super) fn pairs_with(&self, crowd: &Crowd, mut visit: impl FnMut(&Disc, &Disc)) {
        for body in self.small.bodies.iter().chain(&self.large.bodies) {
            for other in crowd.in_box(body.low, body.high).filter(|other| other.meets(body)) {
                let near = self.discs_of(body).iter().filter(|disc| disc.is_near(other));
                near.for_each(|disc| visit(disc, other));
            }
        }
    }

    /// Bodies whose boxes meet this one.
    pub(super) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &Body> {
        self.small.in_box(low, high).chain(self.large.in_box(low, high))
    }

    /// Adds what `find` gives for each two discs of different bodies that may touch: of small bodies to the lists, strip by
    /// strip of rows, of large ones to the others.
    pub(super) fn pairs<R: Send>(
        &self,
        find: impl Fn(&Disc, &Disc) -> Option<R> + Send + Sync,
        strips: &mut Vec<Vec<R>>,
        others: &mut Vec<R>,
    ) {
        let within = |layer: &Layer, rows: Range<usize>, found: &mut Vec<R>| {
            let mut near = Vec::new();
            layer.grid.pairs(rows, |a, b| {
                self.pairs_between(&layer.bodies[a], &layer.bodies[b], &mut near, |a, b| found.extend(find(a, b)));
            });
        };
        let rows = (0..self.small.grid.rows()).step_by(STRIP).map(|row| row..row + STRIP);
        strips.resize_with(rows.len(), Vec::new);
        parallel::for_each(rows.zip(strips).collect(), |(rows, found)| within(&self.small, rows, found));
        within(&self.large, 0..self.large.grid.rows(), others);
        let mut near = Vec::new();
        for body in &self.large.bodies {
            for other in self.small.in_box(body.low, body.high) {
                self.pairs_between(body, other, &mut near, |a, b| others.extend(find(a, b)));
            }
        }
    }

    fn pairs_between(&self, a: &Body, b: &Body, near: &mut Vec<Disc>, mut visit: impl FnMut(&Disc, &Disc)) {
        if a.meets(b.low, b.high) {
            near.clear();
            near.extend(self.discs_of(b).iter().filter(|disc| disc.meets(a)));
            for disc in self.discs_of(a).iter().filter(|disc| disc.meets(b)) {
                near.iter().filter(|other| disc.is_near(other)).for_each(|other| visit(disc, other));
            }
        }
    }
}

/// Found anew in each step: a clone starts without.
impl Clone for Bodies {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Layer {
    fn sort(&mut self, found: &[Body], size: Vec2) {
        let Self { bodies, grid, extent } = self;
        *extent = found.iter().map(Body::extent).fold(0.0, |far, extent| if extent > far { extent } else { far });
        grid.fill(Vec2::ZERO, size, Vec2::splat(*extent), found.len(), |k| found[k].centre());
        bodies.clear();
        bodies.extend(grid.order().iter().map(|&k| found[k as usize].clone()));
    }

    fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &Body> {
        let half = Vec2::splat(0.5 * self.extent);
        let cells = self.grid.ranges_in_box(low - half, high + half);
        cells.flat_map(|range| &self.bodies[range]).filter(move |body| body.meets(low, high))
    }
}

impl Disc {
    fn meets(&self, body: &Body) -> bool {
        body.meets(self.at - self.reach, self.at + self.reach)
    }
}
