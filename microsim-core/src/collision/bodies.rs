//! Bodies: discs that belong together, a soft body's or a single one. Two levels: first bodies whose boxes overlap, then the
//! discs of each that are near the other's box.
//!
//! Bodies differ in size by a factor of ten and more, so there are two grids of them: small bodies in a fine one, large ones
//! in a coarse one, and large ones also look through the fine one.
//!
//! The discs of a body lie side by side, so that four at a time are looked at.

mod across;
mod pair_filter;

use super::aabb::Aabb;
use super::disc::{Disc, DiscGroup, WIDTH, lanes};
use super::disc_grid::{DiscColumns, DiscGrid};
use super::images::Images;
use super::speculative_margin::{DisplacementLimits, SpeculativeMargins, margins_of};
use super::uniform_grid::UniformGrid;
use super::{Contact, Mobility};
use crate::instruction_set::Dispatch;
use crate::parallel;
use crate::particle::sleep::{NO_BLOCK, Sleep};
use crate::particle::{BlockRange, LANES, Particles};
use glam::Vec2;
pub(super) use pair_filter::PairFilter;
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
    /// Its particle in slot 0, the group that the disc of that is in, and the number of its slots.
    first: usize,
    first_group: usize,
    slots: usize,
}

/// Bodies of like size, in the order of the cells that their centres are in.
#[derive(Clone, Debug, Default)]
struct SizeClass {
    bodies: Vec<BodyProxy>,
    grid: UniformGrid,
    /// The largest width or height.
    extent: f32,
}

/// Some of the blocks, their margins, and their discs.
struct Portion<'a> {
    blocks: &'a [BlockRange],
    first_block: usize,
    first_group: usize,
    margins: &'a mut [[f32; LANES]],
    discs: &'a mut [DiscGroup],
}

/// All bodies.
#[derive(Debug, Default)]
pub(super) struct Bodies {
    /// Block by block, in each of them lane by lane, then single ones.
    discs: Vec<DiscGroup>,
    found: Vec<BodyProxy>,
    small: SizeClass,
    large: SizeClass,
}

impl Bodies {
    /// Replaces all bodies by those in some blocks, and sets their speculative margins.
    pub(super) fn collect(
        &mut self,
        blocks: &[BlockRange],
        particles: &Particles,
        sleep: &Sleep,
        limits: DisplacementLimits,
        margins: &mut SpeculativeMargins,
        dispatch: Dispatch,
    ) {
        let portions = portions(blocks, margins.reset(blocks.len()), &mut self.discs);
        let collected = parallel::map(portions, |portion| portion.collect(particles, sleep, limits, dispatch));
        self.found.clear();
        self.found.extend(collected.into_iter().flatten());
    }

    /// Makes a body of a disc on its own.
    pub(super) fn add_single(&mut self, disc: Disc, owner: u32) {
        let (aabb, block, lane, slack, is_moving) = (disc.aabb(), NO_BLOCK, 0, 0.0, true);
        let (is_linked, first, first_group, slots) = (false, disc.index as usize, self.discs.len(), 1);
        let body = BodyProxy { aabb, owner, block, lane, slack, is_moving, is_linked, first, first_group, slots };
        self.found.push(body);
        self.discs.push(DiscGroup::of(disc));
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

    /// Its discs that collide with anything.
    pub(super) fn discs_of(&self, body: &BodyProxy) -> impl Iterator<Item = Disc> {
        let groups = self.groups_of(body);
        let discs = (0..body.slots).map(|slot| groups[slot / WIDTH].disc(slot % WIDTH, body.particle(slot)));
        discs.filter(|disc| !disc.swept_radius.is_nan())
    }

    fn groups_of(&self, body: &BodyProxy) -> &[DiscGroup] {
        &self.discs[body.first_group..body.first_group + body.slots.div_ceil(WIDTH)]
    }

    /// Calls `visit` once for each disc of a body and each disc of a grid that may touch.
    pub(super) fn pairs_with(&self, grid: &DiscGrid, mut visit: impl FnMut(&Disc, &Disc)) {
        for body in self.iter().filter(|_| !grid.is_empty()) {
            let near_body = grid.in_box(body.aabb.low(), body.aabb.high());
            near_body.filter(|other| other.aabb().overlaps(body.aabb)).for_each(|other| {
                self.discs_of(body).filter(|disc| disc.is_near(other)).for_each(|disc| visit(&disc, other));
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
        let between = |a: &BodyProxy, b: &BodyProxy, near: &mut Vec<(usize, u32)>, found: &mut Vec<Contact>| {
            if a.aabb.shrunk(a.slack + b.slack).overlaps(b.aabb)
                && let Some(mobility) = filter.mobility(a, b)
            {
                self.contacts_between([a, b], mobility, filter, near, found);
            }
        };
        let within = |class: &SizeClass, rows: Range<usize>, found: &mut Vec<Contact>| {
            let mut near = Vec::new();
            class.grid.pairs(rows, |a, b| between(&class.bodies[a], &class.bodies[b], &mut near, found));
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
        let mut near = Vec::new();
        for body in self.iter().filter(|body| body.block != NO_BLOCK) {
            if margins.remaining(body.block, body.lane) >= next {
                continue;
            }
            for other in self.in_box(body.aabb.low(), body.aabb.high()) {
                let Some(mobility) = filter.mobility(body, other) else { continue };
                let slack = margins.slack_of(other);
                self.pairs_between([body, other], slack, &mut near, |a, b| {
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
        near: &mut Vec<(usize, u32)>,
        found: &mut Vec<Contact>,
    ) {
        self.pairs_between([a, b], a.slack + b.slack, near, |a, b| found.extend(filter.contact(a, b, mobility)));
    }

    /// Calls `visit` for each two discs of two bodies that may touch if both together move by `slack` less than the largest
    /// displacements. `near` is room for the groups of the second one that are near the first one, and which discs of each are.
    fn pairs_between(
        &self,
        [a, b]: [&BodyProxy; 2],
        slack: f32,
        near: &mut Vec<(usize, u32)>,
        mut visit: impl FnMut(&Disc, &Disc),
    ) {
        let (of_a, of_b) = (self.groups_of(a), self.groups_of(b));
        let (box_a, box_b) = (a.aabb.shrunk(slack), b.aabb.shrunk(slack));
        near.clear();
        let in_box_a = of_b.iter().map(|group| group.in_box(box_a)).enumerate();
        near.extend(in_box_a.filter(|(_, near)| *near != 0));
        for (group, k) in of_a.iter().zip(0..).filter(|_| !near.is_empty()) {
            for lane in lanes(group.in_box(box_b)) {
                let disc = group.disc(lane, a.particle(k * WIDTH + lane));
                for &(k, near) in &*near {
                    for lane in lanes(of_b[k].within(&disc, slack) & near) {
                        visit(&disc, &of_b[k].disc(lane, b.particle(k * WIDTH + lane)));
                    }
                }
            }
        }
    }

    /// The discs of a body whose boxes overlap a box.
    fn discs_in(&self, body: &BodyProxy, aabb: Aabb) -> impl Iterator<Item = Disc> {
        self.discs_of(body).filter(move |disc| disc.aabb().overlaps(aabb))
    }
}

impl BodyProxy {
    /// Its particle in a slot.
    fn particle(&self, slot: usize) -> u32 {
        (self.first + slot * LANES) as u32
    }
}

/// The blocks in portions of fixed size, with their margins and room for their discs.
fn portions<'a>(
    blocks: &'a [BlockRange],
    margins: &'a mut [[f32; LANES]],
    discs: &'a mut Vec<DiscGroup>,
) -> Vec<Portion<'a>> {
    let groups = |blocks: &[BlockRange]| blocks.iter().map(groups_in).sum::<usize>();
    discs.resize(groups(blocks), DiscGroup::EMPTY);
    let (mut rest, mut first_block, mut first_group) = (discs.as_mut_slice(), 0, 0);
    let portion = |(blocks, margins): (&'a [BlockRange], &'a mut [[f32; LANES]])| {
        let discs = rest.split_off_mut(..groups(blocks)).unwrap_or_default();
        let next = (first_block + blocks.len(), first_group + discs.len());
        let portion = Portion { blocks, first_block, first_group, margins, discs };
        (first_block, first_group) = next;
        portion
    };
    blocks.chunks(PORTION).zip(margins.chunks_mut(PORTION)).map(portion).collect()
}

impl Portion<'_> {
    /// Its bodies, after margins and discs have been written.
    fn collect(
        self,
        particles: &Particles,
        sleep: &Sleep,
        limits: DisplacementLimits,
        dispatch: Dispatch,
    ) -> Vec<BodyProxy> {
        let Self { blocks, first_block, mut first_group, margins, discs: mut rest } = self;
        let columns = DiscColumns::of(particles);
        let mut bodies = Vec::with_capacity(blocks.len() * LANES);
        for ((range, margins), index) in blocks.iter().zip(margins).zip(first_block..) {
            let discs = rest.split_off_mut(..groups_in(range)).unwrap_or_default();
            let boxes = dispatch.run(
                #[inline(always)]
                || {
                    *margins = margins_of(range, particles, limits);
                    columns.make_discs(range, limits.step, discs)
                },
            );
            for (lane, margin) in margins.iter().enumerate().filter(|(lane, _)| !boxes.is_empty(*lane)) {
                let (first, slots) = (range.entry(0, lane), range.slots);
                let first_group = first_group + lane * slots.div_ceil(WIDTH);
                let (owner, is_moving) = (particles.owner[first], sleep.is_moving(index, lane));
                let (aabb, slack) = (boxes.aabb(lane), limits.slack(*margin));
                let (block, is_linked) = (index as u32, slots > 1);
                let body =
                    BodyProxy { aabb, owner, block, lane, slack, is_moving, is_linked, first, first_group, slots };
                bodies.push(body);
            }
            first_group += groups_in(range);
        }
        bodies
    }
}

/// How many groups the discs of a block are in.
fn groups_in(block: &BlockRange) -> usize {
    LANES * block.slots.div_ceil(WIDTH)
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
