//! Bodies: discs that belong together, a soft body's or a single one. Two levels: first bodies whose boxes overlap, then the
//! discs of each that are near the other's box.
//!
//! Bodies differ in size by a factor of ten and more, so there are two grids of them: small bodies in a fine one, large ones
//! in a coarse one, and large ones also look through the fine one.

use super::aabb::Aabb;
use super::disc_grid::{Disc, DiscColumns, DiscGrid};
use super::exemptions::Exemptions;
use super::speculative_margin::{DisplacementLimits, SpeculativeMargins, margins_of};
use super::uniform_grid::UniformGrid;
use super::{Contact, Mobility};
use crate::parallel;
use crate::particle::sleep::{NO_BLOCK, Sleep};
use crate::particle::{BlockRange, LANES, Particles};
use glam::Vec2;
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

/// Which pairs of bodies, and of their discs, collide.
#[derive(Clone, Copy)]
pub(super) struct PairFilter<'a> {
    pub particles: &'a Particles,
    pub exemptions: &'a Exemptions,
    pub sleep: &'a Sleep,
}

/// Some of the blocks, and the parts of the lists that they fill.
struct Portion<'a> {
    blocks: &'a [BlockRange],
    first_block: usize,
    first_disc: usize,
    discs: &'a mut [Disc],
    aabbs: &'a mut [Aabb],
    margins: &'a mut [[f32; LANES]],
}

/// All bodies.
#[derive(Debug, Default)]
pub(super) struct Bodies {
    /// Body by body; entries between two bodies are unused.
    discs: Vec<Disc>,
    /// The box of each disc.
    aabbs: Vec<Aabb>,
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
    ) {
        let len = blocks.iter().map(BlockRange::len).sum();
        self.discs.resize(len, Disc::default());
        self.aabbs.resize(len, Aabb::EMPTY);
        let portions = portions(blocks, &mut self.discs, &mut self.aabbs, margins.reset(blocks.len()));
        let collected = parallel::map(portions, |portion| portion.collect(particles, sleep, limits));
        self.found.clear();
        self.found.extend(collected.into_iter().flatten());
    }

    /// Makes a body of a disc on its own.
    pub(super) fn add_single(&mut self, disc: Disc, owner: u32) {
        let (aabb, first) = (disc.aabb(), self.discs.len());
        let (lane, slack, is_moving, discs) = (0, 0.0, true, first..first + 1);
        self.found.push(BodyProxy { aabb, owner, block: NO_BLOCK, lane, slack, is_moving, is_linked: false, discs });
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

    fn iter(&self) -> impl Iterator<Item = &BodyProxy> {
        self.small.bodies.iter().chain(&self.large.bodies)
    }

    /// Its discs.
    pub(super) fn discs_of(&self, body: &BodyProxy) -> &[Disc] {
        &self.discs[body.discs.clone()]
    }

    /// Calls `visit` once for each disc of a body and each disc of a grid that may touch.
    pub(super) fn pairs_with(&self, grid: &DiscGrid, mut visit: impl FnMut(&Disc, &Disc)) {
        for body in self.iter() {
            let near_body = grid.in_box(body.aabb.low(), body.aabb.high());
            near_body.filter(|other| other.aabb().overlaps(body.aabb)).for_each(|other| {
                let near = self.discs_of(body).iter().filter(|disc| disc.is_near(other));
                near.for_each(|disc| visit(disc, other));
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

    /// Whether a body near this one moves.
    pub(super) fn has_moving_neighbour(&self, body: &BodyProxy) -> bool {
        self.in_box(body.aabb.low(), body.aabb.high()).any(|other| other.is_moving)
    }

    /// Adds the contacts of discs that may touch within the speculative margins: of small bodies to the lists, strip by strip of
    /// rows, of large ones to the others.
    pub(super) fn pairs(&self, filter: PairFilter<'_>, strips: &mut Vec<Vec<Contact>>, others: &mut Vec<Contact>) {
        let between = |a: &BodyProxy, b: &BodyProxy, near: &mut Vec<Disc>, found: &mut Vec<Contact>| {
            let slack = a.slack + b.slack;
            if a.aabb.shrunk(slack).overlaps(b.aabb)
                && let Some(mobility) = filter.mobility(a, b)
            {
                self.pairs_between(a, b, slack, near, |a, b| found.extend(filter.contact(a, b, mobility)));
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
        found: &mut Vec<Contact>,
    ) {
        let mut near = Vec::new();
        for body in self.iter().filter(|body| body.block != NO_BLOCK) {
            if margins.remaining(body.block, body.lane) >= next {
                continue;
            }
            for other in self.in_box(body.aabb.low(), body.aabb.high()) {
                let Some(mobility) = filter.mobility(body, other) else { continue };
                let is_lifted = other.block != NO_BLOCK && margins.remaining(other.block, other.lane).is_infinite();
                let slack = if is_lifted { 0.0 } else { other.slack };
                self.pairs_between(body, other, slack, &mut near, |a, b| {
                    if !a.is_within(b, body.slack + slack) {
                        found.extend(filter.contact(a, b, mobility));
                    }
                });
            }
            margins.lift(body.block, body.lane);
        }
    }

    /// Calls `visit` for each two discs of two bodies that may touch if both together move by `slack` less than the largest
    /// displacements.
    fn pairs_between(
        &self,
        a: &BodyProxy,
        b: &BodyProxy,
        slack: f32,
        near: &mut Vec<Disc>,
        mut visit: impl FnMut(&Disc, &Disc),
    ) {
        near.clear();
        near.extend(self.discs_in(b, a.aabb.shrunk(slack)));
        for disc in self.discs_in(a, b.aabb.shrunk(slack)) {
            near.iter().filter(|other| disc.is_within(other, slack)).for_each(|other| visit(disc, other));
        }
    }

    /// Discs of a body whose boxes overlap a box.
    fn discs_in(&self, body: &BodyProxy, aabb: Aabb) -> impl Iterator<Item = &Disc> {
        let discs = self.aabbs[body.discs.clone()].iter().zip(self.discs_of(body));
        discs.filter(move |(disc, _)| disc.overlaps(aabb)).map(|(_, disc)| disc)
    }
}

/// The blocks in portions of fixed size, with the parts of the lists that they fill.
fn portions<'a>(
    blocks: &'a [BlockRange],
    mut discs: &'a mut [Disc],
    mut aabbs: &'a mut [Aabb],
    margins: &'a mut [[f32; LANES]],
) -> Vec<Portion<'a>> {
    let (mut portions, mut first_block, mut first_disc) = (Vec::new(), 0, 0);
    for (blocks, margins) in blocks.chunks(PORTION).zip(margins.chunks_mut(PORTION)) {
        let len = blocks.iter().map(BlockRange::len).sum();
        let (own_discs, other_discs) = discs.split_at_mut(len);
        let (own_aabbs, other_aabbs) = aabbs.split_at_mut(len);
        portions.push(Portion { blocks, first_block, first_disc, discs: own_discs, aabbs: own_aabbs, margins });
        (discs, aabbs) = (other_discs, other_aabbs);
        (first_block, first_disc) = (first_block + blocks.len(), first_disc + len);
    }
    portions
}

impl Portion<'_> {
    /// Its bodies, after their discs, boxes and margins have been written.
    fn collect(self, particles: &Particles, sleep: &Sleep, limits: DisplacementLimits) -> Vec<BodyProxy> {
        let columns = DiscColumns::of(particles);
        let mut bodies = Vec::with_capacity(self.blocks.len() * LANES);
        let mut end = 0;
        for ((block, margins), index) in self.blocks.iter().zip(self.margins).zip(self.first_block..) {
            *margins = margins_of(block, particles, limits);
            for (lane, margin) in margins.iter().enumerate() {
                let (first, mut aabb) = (end, Aabb::EMPTY);
                for slot in 0..block.slots {
                    if let Some(disc) = columns.disc(block.entry(slot, lane), limits.step) {
                        self.discs[end] = disc;
                        self.aabbs[end] = disc.aabb();
                        aabb = aabb.union(self.aabbs[end]);
                        end += 1;
                    }
                }
                if end > first {
                    let owner = particles.owner[self.discs[first].index as usize];
                    let (is_moving, slack) = (sleep.is_moving(index, lane), limits.slack(*margin));
                    let discs = self.first_disc + first..self.first_disc + end;
                    let (block, is_linked) = (index as u32, block.slots > 1);
                    bodies.push(BodyProxy { aabb, owner, block, lane, slack, is_moving, is_linked, discs });
                }
            }
        }
        bodies
    }
}

impl PairFilter<'_> {
    /// How two bodies give way, if they collide at all.
    fn mobility(self, a: &BodyProxy, b: &BodyProxy) -> Option<[Mobility; 2]> {
        let mobility = [a, b].map(|body| match body.is_linked {
            _ if self.sleep.is_asleep(body.block) => Mobility::Asleep,
            true => Mobility::Linked,
            false => Mobility::Single,
        });
        let sleep = mobility == [Mobility::Asleep; 2];
        let collide = !sleep && a.owner != b.owner && !self.exemptions.contains(a.owner, b.owner);
        collide.then_some(mobility)
    }

    /// The contact of a disc of one with a disc of the other, if they collide; neither is in fluid or a ring.
    fn contact(self, a: &Disc, b: &Disc, mobility: [Mobility; 2]) -> Option<Contact> {
        let (p, i, j) = (self.particles, a.index as usize, b.index as usize);
        let collide = p.inv_mass[i] + p.inv_mass[j] > 0.0 && p.groups[i].meets(p.groups[j]);
        collide.then(|| Contact::new(p, i, j, mobility))
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
