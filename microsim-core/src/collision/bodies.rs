//! Bodies: discs that belong together, a soft body's or a single one. Two levels: first bodies whose boxes overlap, then the
//! discs of each that are near the other's box.
//!
//! Bodies differ in size by a factor of ten and more, so there are two grids of them: small bodies in a fine one, large ones
//! in a coarse one, and large ones also look through the fine one.
//!
//! The discs of sleepers are hardly ever asked for, so only their boxes are made.

mod across;
mod disc_list;
mod pair_filter;

use super::aabb::{Aabb, LaneBoxes};
use super::disc_grid::{Disc, DiscColumns, DiscGrid};
use super::images::Images;
use super::speculative_margin::{DisplacementLimits, SpeculativeMargins, margins_of};
use super::uniform_grid::UniformGrid;
use super::{Contact, Mobility};
use crate::instruction_set::Dispatch;
use crate::parallel;
use crate::particle::sleep::{NO_BLOCK, Sleep};
use crate::particle::{BlockRange, LANES, Particles};
use disc_list::DiscList;
use glam::Vec2;
pub(super) use pair_filter::PairFilter;
use std::borrow::Cow;
use std::ops::Range;

/// Rows of cells that are searched at a time, a fixed number whatever the number of threads.
const STRIP: usize = 4;
/// Blocks that are collected at a time, likewise.
const PORTION: usize = 16;

/// A body as the broad phase sees it: its discs, and the box around all places that they can get to in the step.
#[derive(Clone, Debug)]
pub(super) struct BodyProxy {
    pub aabb: Aabb,
    /// Of all its discs.
    owner: u32,
    /// Its block, or [`NO_BLOCK`], and its lane there.
    pub block: u32,
    lane: usize,
    /// How much smaller its speculative margin is than the largest displacement, units.
    slack: f32,
    /// Whether it was above the sleep speed in the last step.
    is_moving: bool,
    /// Whether constraints link its discs.
    is_linked: bool,
    /// Its particle in slot 0, and the number of its slots.
    first: usize,
    slots: usize,
    discs: Range<usize>,
}

/// Bodies of like size, in the order of the cells that their centres are in.
#[derive(Clone, Debug, Default)]
struct SizeClass {
    bodies: Vec<BodyProxy>,
    grid: UniformGrid,
    /// The largest width or height.
    extent: f32,
}

/// Some of the blocks, and the part of a list with an entry for each or for each of their particles.
struct Portion<'a, T> {
    blocks: &'a [BlockRange],
    first_block: usize,
    first_disc: usize,
    list: &'a mut [T],
}

/// All bodies.
#[derive(Debug, Default)]
pub(super) struct Bodies {
    /// Block by block, in each of them lane by lane, then single ones; entries between two bodies are unused.
    discs: Vec<Disc>,
    /// By block.
    has_discs: Vec<bool>,
    /// Largest displacement of a particle in the step, units.
    displacement: f32,
    found: Vec<BodyProxy>,
    small: SizeClass,
    large: SizeClass,
}

impl Bodies {
    /// Replaces all bodies by those in some blocks, without discs, and sets their speculative margins.
    pub(super) fn collect(
        &mut self,
        blocks: &[BlockRange],
        particles: &Particles,
        sleep: &Sleep,
        limits: DisplacementLimits,
        margins: &mut SpeculativeMargins,
        dispatch: Dispatch,
    ) {
        self.displacement = limits.step;
        self.discs.resize(blocks.iter().map(BlockRange::len).sum(), Disc::default());
        let portions = portions(blocks, margins.reset(blocks.len()), |_| 1);
        let collected = parallel::map(portions, |portion| portion.collect(particles, sleep, limits, dispatch));
        self.found.clear();
        self.found.extend(collected.into_iter().flatten());
    }

    /// Makes the discs of all that is awake in the blocks.
    pub(super) fn make_discs(&mut self, blocks: &[BlockRange], particles: &Particles, sleep: &Sleep) {
        let Self { discs, has_discs, displacement, .. } = self;
        has_discs.clear();
        has_discs.extend((0..).map(|k| !sleep.is_asleep(k)).take(blocks.len()));
        let portions = portions(blocks, discs, BlockRange::len);
        parallel::for_each(portions, |portion| portion.make_discs(particles, has_discs, *displacement));
    }

    /// Makes a body of a disc on its own.
    pub(super) fn add_single(&mut self, disc: Disc, owner: u32) {
        let (aabb, end) = (disc.aabb(), self.discs.len());
        let (lane, slack, is_moving, discs) = (0, 0.0, true, end..end + 1);
        let (is_linked, first, slots) = (false, disc.index as usize, 1);
        let block = NO_BLOCK;
        self.found.push(BodyProxy { aabb, owner, block, lane, slack, is_moving, is_linked, first, slots, discs });
        self.discs.push(disc);
    }

    /// Sorts the bodies for the search.
    pub(super) fn sort(&mut self, size: Vec2) {
        let Self { found, small, large, .. } = self;
        let mean = found.iter().map(|body| body.aabb.extent()).sum::<f32>() / found.len() as f32;
        let larger = found.extract_if(.., |body| body.aabb.extent() > 2.0 * mean).collect::<Vec<_>>();
        small.sort(found, size);
        large.sort(&larger, size);
    }

    fn iter(&self) -> impl Iterator<Item = &BodyProxy> + Clone {
        self.small.bodies.iter().chain(&self.large.bodies)
    }

    /// Its discs, if they have been made.
    fn made_discs(&self, body: &BodyProxy) -> Option<&[Disc]> {
        let are_made = body.block == NO_BLOCK || self.has_discs[body.block as usize];
        are_made.then(|| &self.discs[body.discs.clone()])
    }

    /// The discs of a sleeper.
    #[cold]
    #[inline(never)]
    fn missing_discs(&self, body: &BodyProxy, particles: &Particles) -> Vec<Disc> {
        self.discs_of(body, particles).collect()
    }

    /// Its discs.
    #[inline]
    pub(super) fn discs_of(&self, body: &BodyProxy, particles: &Particles) -> impl Iterator<Item = Disc> {
        let (made, missing) = self.made_discs(body).map_or((&[][..], body.slots), |discs| (discs, 0));
        let (columns, first, displacement) = (DiscColumns::of(particles), body.first, self.displacement);
        let others = (0..missing).filter_map(move |slot| columns.disc(first + slot * LANES, displacement));
        made.iter().copied().chain(others)
    }

    /// Calls `visit` once for each disc of a body and each disc of a grid that may touch.
    pub(super) fn pairs_with(&self, grid: &DiscGrid, particles: &Particles, mut visit: impl FnMut(&Disc, &Disc)) {
        for body in self.iter() {
            let near_body = grid.in_box(body.aabb.low(), body.aabb.high());
            near_body.filter(|other| other.aabb().overlaps(body.aabb)).for_each(|other| {
                let near = self.discs_of(body, particles).filter(|disc| disc.is_near(other));
                near.for_each(|disc| visit(&disc, other));
            });
        }
    }

    /// Bodies whose boxes overlap this one.
    pub(super) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = &BodyProxy> {
        let aabb = Aabb::new(low, high);
        self.small.overlapping(aabb).chain(self.large.overlapping(aabb))
    }

    /// Bodies that sleep, unless something that moves comes near.
    pub(super) fn sleepers(&self, sleep: &Sleep) -> impl Iterator<Item = &BodyProxy> {
        self.iter().filter(|body| sleep.is_asleep(body.block))
    }

    /// Blocks of sleepers near which a body moves.
    pub(super) fn woken(&self, sleep: &Sleep) -> Vec<u32> {
        let near = |body: &BodyProxy| self.in_box(body.aabb.low(), body.aabb.high());
        let moving = self.iter().filter(|body| body.is_moving);
        if moving.clone().count() < self.sleepers(sleep).count() {
            let near = moving.flat_map(near).filter(|other| sleep.is_asleep(other.block));
            near.map(|sleeper| sleeper.block).collect()
        } else {
            let woken = self.sleepers(sleep).filter(|body| near(body).any(|other| other.is_moving));
            woken.map(|sleeper| sleeper.block).collect()
        }
    }

    /// Adds the contacts of discs that may touch within the speculative margins: of small bodies to the lists, strip by strip of
    /// rows, of large ones to the others.
    pub(super) fn pairs(&self, filter: PairFilter<'_>, strips: &mut Vec<Vec<Contact>>, others: &mut Vec<Contact>) {
        let between = |a: &BodyProxy, b: &BodyProxy, near: &mut DiscList, found: &mut Vec<Contact>| {
            if a.aabb.shrunk(a.slack + b.slack).overlaps(b.aabb)
                && let Some(mobility) = filter.mobility(a, b)
            {
                self.contacts_between([a, b], mobility, filter, near, found);
            }
        };
        let within = |class: &SizeClass, rows: Range<usize>, found: &mut Vec<Contact>| {
            let mut near = DiscList::default();
            class.grid.pairs(rows, |a, b| between(&class.bodies[a], &class.bodies[b], &mut near, found));
        };
        let rows = (0..self.small.grid.rows()).step_by(STRIP).map(|row| row..row + STRIP);
        strips.resize_with(rows.len(), Vec::new);
        parallel::for_each(rows.zip(strips).collect(), |(rows, found)| within(&self.small, rows, found));
        within(&self.large, 0..self.large.grid.rows(), others);
        let mut near = DiscList::default();
        for body in &self.large.bodies {
            for other in self.small.overlapping(body.aabb) {
                between(body, other, &mut near, others);
            }
        }
    }

    /// Adds the contacts that the speculative margins left out, of bodies that may exceed theirs with another displacement of
    /// `next`.
    pub(super) fn late_pairs(
        &self,
        filter: PairFilter<'_>,
        margins: &mut SpeculativeMargins,
        next: f32,
        images: Option<&Images>,
        found: &mut Vec<Contact>,
    ) {
        let mut near = DiscList::default();
        for body in self.iter().filter(|body| body.block != NO_BLOCK) {
            if margins.remaining(body.block, body.lane) >= next {
                continue;
            }
            for other in self.in_box(body.aabb.low(), body.aabb.high()) {
                let Some(mobility) = filter.mobility(body, other) else { continue };
                let slack = margins.slack_of(other);
                self.pairs_between([body, other], filter.particles, slack, &mut near, |a, b| {
                    if !a.is_within(b, body.slack + slack) {
                        found.extend(filter.contact(a, b, mobility));
                    }
                });
            }
            if let Some(images) = images {
                self.late_pairs_of_images(body, images, filter, margins, found);
            }
            margins.lift(body.block, body.lane);
        }
    }

    /// Adds the contacts of the discs of two bodies that may touch within the speculative margins.
    #[inline(never)]
    fn contacts_between(
        &self,
        [a, b]: [&BodyProxy; 2],
        mobility: [Mobility; 2],
        filter: PairFilter<'_>,
        near: &mut DiscList,
        found: &mut Vec<Contact>,
    ) {
        self.pairs_between([a, b], filter.particles, a.slack + b.slack, near, |a, b| {
            found.extend(filter.contact(a, b, mobility));
        });
    }

    /// Calls `visit` for each two discs of two bodies that may touch if both together move by `slack` less than the largest
    /// displacements.
    fn pairs_between(
        &self,
        [a, b]: [&BodyProxy; 2],
        particles: &Particles,
        slack: f32,
        near: &mut DiscList,
        mut visit: impl FnMut(&Disc, &Disc),
    ) {
        near.clear();
        self.for_each_disc_in(b, a.aabb.shrunk(slack), particles, |disc| near.push(*disc));
        if near.is_empty() {
            return;
        }
        self.for_each_disc_in(a, b.aabb.shrunk(slack), particles, |disc| {
            near.for_each_within(disc, slack, |other| visit(disc, other));
        });
    }

    /// Calls `visit` for each disc of a body whose box overlaps a box.
    #[inline(always)]
    fn for_each_disc_in(&self, body: &BodyProxy, aabb: Aabb, particles: &Particles, visit: impl FnMut(&Disc)) {
        let discs =
            self.made_discs(body).map_or_else(|| Cow::Owned(self.missing_discs(body, particles)), Cow::Borrowed);
        discs.iter().filter(|disc| disc.aabb().overlaps(aabb)).for_each(visit);
    }
}

/// The blocks in portions of fixed size, with the parts of a list of which each block has as many entries as `len` says.
fn portions<'a, T>(
    blocks: &'a [BlockRange],
    mut list: &'a mut [T],
    len: impl Fn(&BlockRange) -> usize,
) -> Vec<Portion<'a, T>> {
    let (mut portions, mut first_block, mut first_disc) = (Vec::new(), 0, 0);
    for blocks in blocks.chunks(PORTION) {
        let (own, others) = list.split_at_mut(blocks.iter().map(&len).sum());
        portions.push(Portion { blocks, first_block, first_disc, list: own });
        list = others;
        (first_block, first_disc) =
            (first_block + blocks.len(), first_disc + blocks.iter().map(BlockRange::len).sum::<usize>());
    }
    portions
}

impl Portion<'_, [f32; LANES]> {
    /// Its bodies, after their margins have been written.
    fn collect(
        self,
        particles: &Particles,
        sleep: &Sleep,
        limits: DisplacementLimits,
        dispatch: Dispatch,
    ) -> Vec<BodyProxy> {
        let columns = DiscColumns::of(particles);
        let mut bodies = Vec::with_capacity(self.blocks.len() * LANES);
        let mut first_disc = self.first_disc;
        for ((block, margins), index) in self.blocks.iter().zip(self.list).zip(self.first_block..) {
            let boxes = dispatch.run(
                #[inline(always)]
                || {
                    *margins = margins_of(block, particles, limits);
                    boxes_of(block, columns, limits.step)
                },
            );
            for (lane, margin) in margins.iter().enumerate().filter(|(lane, _)| boxes.counts[*lane] > 0) {
                let (first, slots) = (block.entry(0, lane), block.slots);
                let (owner, is_moving) = (particles.owner[first], sleep.is_moving(index, lane));
                let discs = first_disc + lane * slots..first_disc + lane * slots + boxes.counts[lane];
                let (aabb, slack) = (boxes.aabb(lane), limits.slack(*margin));
                let (block, is_linked) = (index as u32, slots > 1);
                bodies.push(BodyProxy { aabb, owner, block, lane, slack, is_moving, is_linked, first, slots, discs });
            }
            first_disc += block.len();
        }
        bodies
    }
}

impl Portion<'_, Disc> {
    /// Makes the discs of the blocks that have any.
    fn make_discs(self, particles: &Particles, has_discs: &[bool], displacement: f32) {
        let (columns, mut rest) = (DiscColumns::of(particles), self.list);
        for (block, has_discs) in self.blocks.iter().zip(&has_discs[self.first_block..]) {
            let (own, others) = rest.split_at_mut(block.len());
            for lane in (0..LANES).filter(|_| *has_discs) {
                let discs = (0..block.slots).filter_map(|slot| columns.disc(block.entry(slot, lane), displacement));
                own[lane * block.slots..].iter_mut().zip(discs).for_each(|(own, disc)| *own = disc);
            }
            rest = others;
        }
    }
}

/// The boxes around the discs of each lane of a block.
#[inline(always)]
fn boxes_of(block: &BlockRange, columns: DiscColumns<'_>, displacement: f32) -> LaneBoxes {
    let mut boxes = LaneBoxes::EMPTY;
    for slot in 0..block.slots {
        columns.add_to_boxes(block.entry(slot, 0), displacement, &mut boxes);
    }
    boxes
}

impl SpeculativeMargins {
    /// How much smaller the margin of a body is than the largest displacement, if it has not been lifted.
    fn slack_of(&self, body: &BodyProxy) -> f32 {
        let is_lifted = body.block != NO_BLOCK && self.remaining(body.block, body.lane).is_infinite();
        if is_lifted { 0.0 } else { body.slack }
    }
}

impl SizeClass {
    fn sort(&mut self, found: &[BodyProxy], size: Vec2) {
        let Self { bodies, grid, extent } = self;
        let extents = found.iter().map(|body| body.aabb.extent());
        *extent = extents.fold(0.0, |most, extent| if extent > most { extent } else { most });
        grid.fill(Vec2::ZERO, size, Vec2::splat(*extent), found.len(), |k| found[k].aabb.centre());
        bodies.clear();
        bodies.extend(grid.order().iter().map(|&k| found[k as usize].clone()));
    }

    /// Bodies whose boxes overlap this one.
    fn overlapping(&self, aabb: Aabb) -> impl Iterator<Item = &BodyProxy> {
        let half = Vec2::splat(0.5 * self.extent);
        let cells = self.grid.ranges_in_box(aabb.low() - half, aabb.high() + half);
        cells.flat_map(|range| &self.bodies[range]).filter(move |body| body.aabb.overlaps(aabb))
    }
}

#[cfg(test)]
mod tests;
