//! Bodies: discs that belong together, a soft body's or a single one. Two levels: first bodies whose boxes meet, then the
//! discs of each that are near the other's box.
//!
//! Bodies differ in size by a factor of ten and more, so there are two grids of them: small bodies in a fine one, large ones
//! in a coarse one, and large ones also look through the fine one.

use super::Contact;
use super::aabb::Aabb;
use super::disc_grid::{Disc, DiscColumns, DiscGrid};
use super::exemptions::Exemptions;
use super::leeway::{self, Leeway, Reach};
use super::uniform_grid::UniformGrid;
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
    pub aabb: Aabb,
    /// Of all its discs.
    owner: u32,
    /// Its block, or [`NO_BLOCK`], and its lane there.
    pub block: u32,
    lane: usize,
    /// How much farther it can get in the step than it is expected to.
    slack: f32,
    /// Whether it has moved in the last step.
    is_restless: bool,
    discs: Range<usize>,
}

/// Bodies of like size, in the order of the cells that their centres are in.
#[derive(Clone, Debug, Default)]
struct Layer {
    bodies: Vec<Body>,
    grid: UniformGrid,
    /// The largest width or height.
    extent: f32,
}

/// What decides whether two bodies meet.
#[derive(Clone, Copy)]
pub(super) struct Meeting<'a> {
    pub particles: &'a Particles,
    pub exemptions: &'a Exemptions,
    pub sleep: &'a Sleep,
}

/// All bodies.
#[derive(Debug, Default)]
pub(super) struct Bodies {
    /// Body by body; what lies between two bodies means nothing.
    discs: Vec<Disc>,
    /// The box of each disc.
    aabbs: Vec<Aabb>,
    found: Vec<Body>,
    small: Layer,
    large: Layer,
}

impl Bodies {
    /// Makes a body of each instance in some blocks, in place of all there were, and grants it its leeway.
    pub(super) fn collect(
        &mut self,
        blocks: &[BlockRange],
        particles: &Particles,
        sleep: &Sleep,
        reach: Reach,
        leeway: &mut Leeway,
    ) {
        let Self { discs, aabbs, found, .. } = self;
        let columns = DiscColumns::of(particles);
        let len = blocks.iter().map(BlockRange::len).sum();
        discs.resize(len, Disc::default());
        aabbs.resize(len, Aabb::EMPTY);
        let (mut portions, mut start) = (Vec::new(), 0);
        let mut rest = (discs.as_mut_slice(), aabbs.as_mut_slice());
        let leeways = leeway.renew(blocks.len()).chunks_mut(PORTION);
        for ((blocks, first), leeways) in blocks.chunks(PORTION).zip((0..).step_by(PORTION)).zip(leeways) {
            let len = blocks.iter().map(BlockRange::len).sum();
            let (discs, others) = rest.0.split_at_mut(len);
            let (aabbs, other_aabbs) = rest.1.split_at_mut(len);
            portions.push((blocks, first, start, discs, aabbs, leeways));
            (rest, start) = ((others, other_aabbs), start + len);
        }
        let collected = parallel::map(portions, |(blocks, first_block, start, discs, aabbs, leeways)| {
            leeways.iter_mut().zip(blocks).for_each(|(left, block)| *left = leeway::grant(block, particles, reach));
            let mut bodies = Vec::with_capacity(blocks.len() * LANES);
            let mut end = 0;
            let lanes = blocks.iter().zip(first_block..).flat_map(|block| (0..LANES).map(move |lane| (block, lane)));
            for ((block, index), lane) in lanes {
                let (first, mut aabb) = (end, Aabb::EMPTY);
                for i in (0..block.slots).map(|slot| block.entry(slot, lane)) {
                    if let Some(disc) = columns.disc(i, reach.step) {
                        discs[end] = disc;
                        aabbs[end] = disc.aabb();
                        aabb = aabb.union(aabbs[end]);
                        end += 1;
                    }
                }
                if end > first {
                    let owner = particles.owner[discs[first].index as usize];
                    let (is_restless, discs) = (sleep.is_restless(index, lane), start + first..start + end);
                    let slack = reach.slack(leeways[index - first_block][lane]);
                    bodies.push(Body { aabb, owner, block: index as u32, lane, slack, is_restless, discs });
                }
            }
            bodies
        });
        found.clear();
        collected.into_iter().for_each(|bodies| found.extend(bodies));
    }

    /// Makes a body of a disc on its own.
    pub(super) fn add_single(&mut self, disc: Disc, owner: u32) {
        let (aabb, first) = (disc.aabb(), self.discs.len());
        let (lane, slack, is_restless, discs) = (0, 0.0, true, first..first + 1);
        self.found.push(Body { aabb, owner, block: NO_BLOCK, lane, slack, is_restless, discs });
        self.discs.push(disc);
        self.aabbs.push(aabb);
    }

    /// Sorts the bodies for the search.
    pub(super) fn sort(&mut self, size: Vec2) {
        let Self { found, small, large, .. } = self;
        let mean = found.iter().map(|body| body.aabb.extent()).sum::<f32>() / found.len() as f32;
        let larger = found.extract_if(.., |body| body.aabb.extent() > 2.0 * mean).collect::<Vec<_>>();
        small.sort(found, size);
        large.sort(&larger, size);
    }

    /// Its discs.
    pub(super) fn discs_of(&self, body: &Body) -> &[Disc] {
        &self.discs[body.discs.clone()]
    }

    /// Calls `visit` once for each disc of a body and each disc of a grid that may touch.
    pub(super) fn pairs_with(&self, grid: &DiscGrid, mut visit: impl FnMut(&Disc, &Disc)) {
        for body in self.small.bodies.iter().chain(&self.large.bodies) {
            let near_body = grid.in_box(body.aabb.low(), body.aabb.high());
            for other in near_body.filter(|other| other.aabb().overlaps(body.aabb)) {
                let near = self.discs_of(body).iter().filter(|disc| disc.is_near(other));
                near.for_each(|disc| visit(disc, other));
            }
        }
    }

    /// Bodies whose boxes overlap this one.
    pub(super) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &Body> {
        let aabb = Aabb::new(low, high);
        self.small.overlapping(aabb).chain(self.large.overlapping(aabb))
    }

    /// Bodies that sleep, unless something that moves comes near.
    pub(super) fn sleepers(&self, sleep: &Sleep) -> impl Iterator<Item = &Body> {
        let all = self.small.bodies.iter().chain(&self.large.bodies);
        all.filter(|body| sleep.is_asleep(body.block))
    }

    /// Whether a body near this one has moved in the last step.
    pub(super) fn is_stirred(&self, body: &Body) -> bool {
        self.in_box(body.aabb.low(), body.aabb.high()).any(|other| other.is_restless)
    }

    /// Adds the contacts of discs that may touch, if they move no farther than expected: of small bodies to the lists, strip by
    /// strip of rows, of large ones to the others.
    pub(super) fn pairs(&self, meeting: Meeting<'_>, strips: &mut Vec<Vec<Contact>>, others: &mut Vec<Contact>) {
        let between = |a: &Body, b: &Body, near: &mut Vec<Disc>, found: &mut Vec<Contact>| {
            let slack = a.slack + b.slack;
            if a.aabb.shrunk(slack).overlaps(b.aabb)
                && let Some(asleep) = meeting.of(a, b)
            {
                self.pairs_between(a, b, slack, near, |a, b| found.extend(meeting.contact(a, b, asleep)));
            }
        };
        let within = |layer: &Layer, rows: Range<usize>, found: &mut Vec<Contact>| {
            let mut near = Vec::new();
            layer.grid.pairs(rows, |a, b| between(&layer.bodies[a], &layer.bodies[b], &mut near, found));
        };
        let rows = (0..self.small.grid.rows()).step_by(STRIP).map(|row| row..row + STRIP);
        strips.resize_with(rows.len(), Vec::new);
        parallel::for_each(rows.zip(strips).collect(), |(rows, found)| within(&self.small, rows, found));
        within(&self.large, 0..self.large.grid.rows(), others);
        let mut near = Vec::new();
        for body in &self.large.bodies {
            for other in self.small.overlapping(body.aabb) {
                between(body, other, &mut near, others);
            }
        }
    }

    /// Adds the contacts that were left out because a body was not expected to move as far as it may have when everything has
    /// moved by `next` more than was noted.
    pub(super) fn widen(&self, meeting: Meeting<'_>, leeway: &mut Leeway, next: f32, found: &mut Vec<Contact>) {
        let mut near = Vec::new();
        let all = self.small.bodies.iter().chain(&self.large.bodies);
        for body in all.filter(|body| body.block != NO_BLOCK) {
            if leeway.left(body.block, body.lane) >= next {
                continue;
            }
            for other in self.in_box(body.aabb.low(), body.aabb.high()) {
                let Some(asleep) = meeting.of(body, other) else { continue };
                let is_lifted = other.block != NO_BLOCK && leeway.left(other.block, other.lane).is_infinite();
                let slack = if is_lifted { 0.0 } else { other.slack };
                self.pairs_between(body, other, slack, &mut near, |a, b| {
                    if !a.is_within(b, body.slack + slack) {
                        found.extend(meeting.contact(a, b, asleep));
                    }
                });
            }
            leeway.lift(body.block, body.lane);
        }
    }

    /// Calls `visit` for each two discs of two bodies that may touch even if both together move by so much less than they
    /// can.
    fn pairs_between(&self, a: &Body, b: &Body, slack: f32, near: &mut Vec<Disc>, mut visit: impl FnMut(&Disc, &Disc)) {
        near.clear();
        near.extend(self.discs_in(b, a.aabb.shrunk(slack)));
        for disc in self.discs_in(a, b.aabb.shrunk(slack)) {
            near.iter().filter(|other| disc.is_within(other, slack)).for_each(|other| visit(disc, other));
        }
    }

    /// Discs of a body that may reach into a box.
    fn discs_in(&self, body: &Body, aabb: Aabb) -> impl Iterator<Item = &Disc> {
        let discs = self.aabbs[body.discs.clone()].iter().zip(self.discs_of(body));
        discs.filter(move |(disc, _)| disc.overlaps(aabb)).map(|(_, disc)| disc)
    }
}

impl Meeting<'_> {
    /// Which of two bodies sleep, if they meet at all.
    fn of(self, a: &Body, b: &Body) -> Option<[bool; 2]> {
        let asleep = [a, b].map(|body| self.sleep.is_asleep(body.block));
        let meets = asleep != [true; 2] && a.owner != b.owner && !self.exemptions.contains(a.owner, b.owner);
        meets.then_some(asleep)
    }

    /// The contact of a disc of one with a disc of the other, if they collide; neither is in fluid or a ring.
    fn contact(self, a: &Disc, b: &Disc, asleep: [bool; 2]) -> Option<Contact> {
        let (p, i, j) = (self.particles, a.index as usize, b.index as usize);
        let collide = p.inv_mass[i] + p.inv_mass[j] > 0.0 && p.groups[i].meets(p.groups[j]);
        collide.then(|| Contact { asleep, ..Contact::new(p, i, j) })
    }
}

impl Layer {
    fn sort(&mut self, found: &[Body], size: Vec2) {
        let Self { bodies, grid, extent } = self;
        *extent = found
            .iter()
            .map(|body| body.aabb.extent())
            .fold(0.0, |far, extent| if extent > far { extent } else { far });
        grid.fill(Vec2::ZERO, size, Vec2::splat(*extent), found.len(), |k| found[k].aabb.centre());
        bodies.clear();
        bodies.extend(grid.order().iter().map(|&k| found[k as usize].clone()));
    }

    /// Bodies whose boxes overlap this one.
    fn overlapping(&self, aabb: Aabb) -> impl Iterator<Item = &Body> {
        let half = Vec2::splat(0.5 * self.extent);
        let cells = self.grid.ranges_in_box(aabb.low() - half, aabb.high() + half);
        cells.flat_map(|range| &self.bodies[range]).filter(move |body| body.aabb.overlaps(aabb))
    }
}
