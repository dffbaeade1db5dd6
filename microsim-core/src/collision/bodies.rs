//! Bodies: discs that belong together, a soft body's or a single one. Two levels: first bodies whose boxes meet, then the
//! discs of each that are near the other's box.
//!
//! Bodies differ in size by a factor of ten and more, so there are two grids of them: small bodies in a fine one, large ones
//! in a coarse one, and large ones also look through the fine one.

use super::bounds::Bounds;
use super::crowd::{Crowd, Disc, Store};
use super::grid::Grid;
use crate::parallel;
use crate::particle::sleep::{NO_BLOCK, Sleep};
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
    pub bounds: Bounds,
    /// Of all its discs.
    owner: u32,
    /// Its block, or [`NO_BLOCK`].
    pub block: u32,
    /// Whether it has moved in the last step.
    is_restless: bool,
    discs: Range<usize>,
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
    discs: Vec<Disc>,
    /// The box of each disc.
    boxes: Vec<Bounds>,
    found: Vec<Body>,
    small: Layer,
    large: Layer,
}

impl Bodies {
    /// Makes a body of each instance in some blocks, in place of all there were.
    pub(super) fn collect(&mut self, blocks: &[BlockRange], particles: &Particles, sleep: &Sleep, reach: f32) {
        let Self { discs, boxes, found, .. } = self;
        let store = Store::of(particles);
        let len = blocks.iter().map(BlockRange::len).sum();
        discs.resize(len, Disc::default());
        boxes.resize(len, Bounds::EMPTY);
        let (mut portions, mut start) = (Vec::new(), 0);
        let mut rest = (discs.as_mut_slice(), boxes.as_mut_slice());
        for (blocks, first) in blocks.chunks(PORTION).zip((0..).step_by(PORTION)) {
            let len = blocks.iter().map(BlockRange::len).sum();
            let (discs, others) = rest.0.split_at_mut(len);
            let (boxes, other_boxes) = rest.1.split_at_mut(len);
            portions.push((blocks, first, start, discs, boxes));
            (rest, start) = ((others, other_boxes), start + len);
        }
        let collected = parallel::map(portions, |(blocks, first_block, start, discs, boxes)| {
            let mut bodies = Vec::with_capacity(blocks.len() * LANES);
            let mut end = 0;
            let lanes = blocks.iter().zip(first_block..).flat_map(|block| (0..LANES).map(move |lane| (block, lane)));
            for ((block, index), lane) in lanes {
                let (first, mut bounds) = (end, Bounds::EMPTY);
                for i in (0..block.slots).map(|slot| block.entry(slot, lane)) {
                    if let Some(disc) = store.disc(i, reach) {
                        discs[end] = disc;
                        boxes[end] = disc.bounds();
                        bounds = bounds.join(boxes[end]);
                        end += 1;
                    }
                }
                if end > first {
                    let owner = particles.owner[discs[first].index as usize];
                    let (is_restless, discs) = (sleep.is_restless(index, lane), start + first..start + end);
                    bodies.push(Body { bounds, owner, block: index as u32, is_restless, discs });
                }
            }
            bodies
        });
        found.clear();
        collected.into_iter().for_each(|bodies| found.extend(bodies));
    }

    /// Makes a body of a disc on its own.
    pub(super) fn add_single(&mut self, disc: Disc, owner: u32) {
        let (bounds, first) = (disc.bounds(), self.discs.len());
        self.found.push(Body { bounds, owner, block: NO_BLOCK, is_restless: true, discs: first..first + 1 });
        self.discs.push(disc);
        self.boxes.push(bounds);
    }

    /// Sorts the bodies for the search.
    pub(super) fn sort(&mut self, size: Vec2) {
        let Self { found, small, large, .. } = self;
        let mean = found.iter().map(|body| body.bounds.extent()).sum::<f32>() / found.len() as f32;
        let larger = found.extract_if(.., |body| body.bounds.extent() > 2.0 * mean).collect::<Vec<_>>();
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
            let near_body = crowd.in_box(body.bounds.low(), body.bounds.high());
            for other in near_body.filter(|other| other.bounds().meets(body.bounds)) {
                let near = self.discs_of(body).iter().filter(|disc| disc.is_near(other));
                near.for_each(|disc| visit(disc, other));
            }
        }
    }

    /// Bodies whose boxes meet this one.
    pub(super) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &Body> {
        let bounds = Bounds::new(low, high);
        self.small.meeting(bounds).chain(self.large.meeting(bounds))
    }

    /// Bodies that sleep, unless something that moves comes near.
    pub(super) fn sleepers(&self, sleep: &Sleep) -> impl Iterator<Item = &Body> {
        let all = self.small.bodies.iter().chain(&self.large.bodies);
        all.filter(|body| sleep.is_asleep(body.block))
    }

    /// Whether a body near this one has moved in the last step.
    pub(super) fn is_stirred(&self, body: &Body) -> bool {
        self.in_box(body.bounds.low(), body.bounds.high()).any(|other| other.is_restless)
    }

    /// Adds what `find` gives for each two discs that may touch, of bodies whose owners may meet and that do not both sleep: of
    /// small bodies to the lists, strip by strip of rows, of large ones to the others.
    pub(super) fn pairs<R: Send>(
        &self,
        may_meet: impl Fn(u32, u32) -> bool + Send + Sync,
        find: impl Fn(&Disc, &Disc, [bool; 2]) -> Option<R> + Send + Sync,
        sleep: &Sleep,
        strips: &mut Vec<Vec<R>>,
        others: &mut Vec<R>,
    ) {
        let between = |a: &Body, b: &Body, near: &mut Vec<Disc>, found: &mut Vec<R>| {
            let asleep = [a, b].map(|body| sleep.is_asleep(body.block));
            if a.bounds.meets(b.bounds) && asleep != [true; 2] && may_meet(a.owner, b.owner) {
                self.pairs_between(a, b, near, |a, b| found.extend(find(a, b, asleep)));
            }
        };
        let within = |layer: &Layer, rows: Range<usize>, found: &mut Vec<R>| {
            let mut near = Vec::new();
            layer.grid.pairs(rows, |a, b| between(&layer.bodies[a], &layer.bodies[b], &mut near, found));
        };
        let rows = (0..self.small.grid.rows()).step_by(STRIP).map(|row| row..row + STRIP);
        strips.resize_with(rows.len(), Vec::new);
        parallel::for_each(rows.zip(strips).collect(), |(rows, found)| within(&self.small, rows, found));
        within(&self.large, 0..self.large.grid.rows(), others);
        let mut near = Vec::new();
        for body in &self.large.bodies {
            for other in self.small.meeting(body.bounds) {
                between(body, other, &mut near, others);
            }
        }
    }

    fn pairs_between(&self, a: &Body, b: &Body, near: &mut Vec<Disc>, mut visit: impl FnMut(&Disc, &Disc)) {
        near.clear();
        near.extend(self.discs_meeting(b, a.bounds));
        for disc in self.discs_meeting(a, b.bounds) {
            near.iter().filter(|other| disc.is_near(other)).for_each(|other| visit(disc, other));
        }
    }

    /// Discs of a body that may reach into a box.
    fn discs_meeting(&self, body: &Body, bounds: Bounds) -> impl Iterator<Item = &Disc> {
        let discs = self.boxes[body.discs.clone()].iter().zip(self.discs_of(body));
        discs.filter(move |(disc, _)| disc.meets(bounds)).map(|(_, disc)| disc)
    }
}

impl Layer {
    fn sort(&mut self, found: &[Body], size: Vec2) {
        let Self { bodies, grid, extent } = self;
        *extent = found
            .iter()
            .map(|body| body.bounds.extent())
            .fold(0.0, |far, extent| if extent > far { extent } else { far });
        grid.fill(Vec2::ZERO, size, Vec2::splat(*extent), found.len(), |k| found[k].bounds.centre());
        bodies.clear();
        bodies.extend(grid.order().iter().map(|&k| found[k as usize].clone()));
    }

    /// Bodies whose boxes meet this one.
    fn meeting(&self, bounds: Bounds) -> impl Iterator<Item = &Body> {
        let half = Vec2::splat(0.5 * self.extent);
        let cells = self.grid.ranges_in_box(bounds.low() - half, bounds.high() + half);
        cells.flat_map(|range| &self.bodies[range]).filter(move |body| body.bounds.meets(bounds))
    }
}
