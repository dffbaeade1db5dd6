//! Bodies: discs that belong together, a soft body's or a single one. Two levels: first bodies whose boxes meet, then the
//! discs of each that are near the other's box.
//!
//! Bodies differ in size by a factor of ten and more, so there are two grids of them: small bodies in a fine one, large ones
//! in a coarse one, and large ones also look through the fine one.

use super::crowd::{Crowd, Disc};
use super::grid::Grid;
use crate::parallel;
use glam::Vec2;
use std::ops::Range;

/// Rows of cells that are searched at a time, a fixed number whatever the number of threads.
const STRIP: usize = 4;

/// A body: its discs, and the box around what they can reach in the step.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub low: Vec2,
    pub high: Vec2,
    discs: Range<usize>,
}

impl Body {
    fn around(discs: &[Disc], range: Range<usize>) -> Self {
        let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for disc in &discs[range.clone()] {
            low = low.min(disc.at - disc.reach);
            high = high.max(disc.at + disc.reach);
        }
        Self { low, high, discs: range }
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
    /// Body by body.
    pub discs: Vec<Disc>,
    found: Vec<Body>,
    small: Layer,
    large: Layer,
}

impl Bodies {
    /// Forms bodies of the discs in `ranges` of [`Bodies::discs`].
    pub(super) fn sort(&mut self, ranges: impl Iterator<Item = Range<usize>>, size: Vec2) {
        let Self { discs, found, small, large } = self;
        found.clear();
        found.extend(ranges.filter(|range| !range.is_empty()).map(|range| Body::around(discs, range)));
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

    /// Adds what `find` gives for each two discs of different bodies that may touch.
    pub(super) fn pairs<R: Send>(&self, find: impl Fn(&Disc, &Disc) -> Option<R> + Send + Sync, found: &mut Vec<R>) {
        let within = |layer: &Layer, rows: Range<usize>| {
            let (mut near, mut found) = (Vec::new(), Vec::new());
            layer.grid.pairs(rows, |a, b| {
                self.pairs_between(&layer.bodies[a], &layer.bodies[b], &mut near, |a, b| found.extend(find(a, b)));
            });
            found
        };
        let strips = (0..self.small.grid.rows()).step_by(STRIP).map(|row| row..row + STRIP).collect();
        for strip in parallel::map(strips, |rows| within(&self.small, rows)) {
            found.extend(strip);
        }
        found.extend(within(&self.large, 0..self.large.grid.rows()));
        let mut near = Vec::new();
        for body in &self.large.bodies {
            for other in self.small.in_box(body.low, body.high) {
                self.pairs_between(body, other, &mut near, |a, b| found.extend(find(a, b)));
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
