//! Blocks: eight instances of one template side by side in the particle store, solved in lanes.

use super::constraint::{self, Constraint};
use super::lanes::{LANES, Span, load};
use super::muscle::{Scaled, runs};
use crate::instruction_set::{Dispatch, each};
use crate::particle::{BlockRange, Columns, NO_OWNER, Particles};
use serde::{Deserialize, Serialize};

/// Blocks that are projected side by side: enough for the processor to go on while the spokes of one wait for each other.
const BATCH: usize = 8;

/// Eight instances of a template; empty lanes hold dead particles.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Block {
    /// Index of the template in the world.
    pub template: u32,
    pub slots: u32,
    /// First particle of slot 0.
    pub base: u32,
    /// Owner in each lane, or [`NO_OWNER`].
    pub owner: [u32; LANES],
    /// Size of each instance relative to the template.
    pub scale: [f32; LANES],
    /// What scales lengths: first the factor on those of the muscles of each channel at the end of the step, then the plastic
    /// strain of each yielding link.
    pub length_state: Vec<[f32; LANES]>,
    /// The factors of the channels at the beginning of the step.
    #[serde(skip)]
    pub contraction_before: Vec<[f32; LANES]>,
}

impl Block {
    /// A block with eight empty lanes, its `slots * 8` particles appended to the store.
    pub(crate) fn new(template: u32, slots: usize, particles: &mut Particles) -> Self {
        let base = particles.extend(slots * LANES);
        Self {
            template,
            slots: slots as u32,
            base,
            owner: [NO_OWNER; LANES],
            scale: [1.0; LANES],
            length_state: Vec::new(),
            contraction_before: Vec::new(),
        }
    }

    /// Particle of a slot in a lane.
    pub(crate) fn particle(&self, slot: u32, lane: usize) -> u32 {
        self.base + slot * LANES as u32 + lane as u32
    }

    /// The first empty lane.
    pub(crate) fn free_lane(&self) -> Option<usize> {
        self.owner.iter().position(|&owner| owner == NO_OWNER)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.owner.iter().all(|&owner| owner == NO_OWNER)
    }

    /// Where it lies in the store.
    pub(crate) fn range(&self) -> BlockRange {
        BlockRange { base: self.base as usize, slots: self.slots as usize }
    }

    /// Whether a particle is of it.
    pub(crate) fn holds(&self, particle: u32) -> bool {
        particle.wrapping_sub(self.base) < self.slots * LANES as u32
    }

    /// Where it lies in a chunk of the store that begins at `start`.
    fn span(&self, start: usize) -> Span<LANES> {
        Span { base: self.base - start as u32, scale: self.scale }
    }

    /// The same for the rest lengths of a constraint that is scaled, after a share of the step. The scale of a torn link is 0.
    fn span_of(&self, scaled: &Scaled, share: f32, start: usize) -> Span<LANES> {
        let span = self.contracted(scaled, share, start);
        let Some(row) = scaled.link else { return span };
        let plastic = self.length_state[row as usize];
        Span { scale: each(|l| span.scale[l] * (1.0 + plastic[l])), ..span }
    }

    /// The same without plastic strains.
    pub(super) fn contracted(&self, scaled: &Scaled, share: f32, start: usize) -> Span<LANES> {
        let span = self.span(start);
        let Some(channel) = scaled.channel else { return span };
        let (from, to) = (self.contraction_before[channel as usize], self.length_state[channel as usize]);
        Span { scale: each(|l| span.scale[l] * (from[l] + share * (to[l] - from[l]))), ..span }
    }
}

/// A few neighbouring blocks of one template, each with a value of the caller's, and the stretch of the store that they lie
/// in. They are projected together: what one has loaded the others find in the cache.
pub(crate) struct Batch<'a, T> {
    pub(super) blocks: &'a mut [(&'a Block, T)],
    /// First particle of the stretch.
    pub(super) start: usize,
    pub(super) stretch: Columns<'a>,
}

/// Divides blocks, in the order of the store, into batches of up to [`BATCH`].
pub(crate) fn batches<'a, T>(blocks: &'a mut [(&'a Block, T)], particles: &'a mut Particles) -> Vec<Batch<'a, T>> {
    let mut batches = Vec::with_capacity(blocks.len());
    let (mut rest, mut start) = (particles.columns(), 0);
    for of_template in blocks.chunk_by_mut(|a, b| a.0.template == b.0.template) {
        for blocks in of_template.chunks_mut(BATCH) {
            let end = blocks.last().map_or(start, |(block, _)| block.range().end());
            batches.push(Batch { blocks, start, stretch: rest.take_front(end - start) });
            start = end;
        }
    }
    batches
}

impl<T> Batch<'_, T> {
    /// Index of the template in the world.
    pub(crate) fn template(&self) -> usize {
        self.blocks[0].0.template as usize
    }

    /// Hands each block's particles and value to a kernel.
    #[inline(always)]
    pub(crate) fn for_each_block(&mut self, kernel: impl Fn(&mut Columns<'_>, &mut T)) {
        for (block, value) in &mut *self.blocks {
            let range = block.range();
            kernel(&mut self.stretch.part(range.base - self.start..range.end() - self.start), value);
        }
    }

    /// Projects the template's constraints in all blocks, those that are scaled with the lengths that they have after a share of the
    /// step.
    pub(crate) fn project(
        &mut self,
        constraints: &[Constraint],
        scaled: &[Scaled],
        share: f32,
        h: f32,
        dispatch: Dispatch,
    ) {
        for (run, scaled) in runs(constraints.len(), scaled).filter(|(run, _)| !run.is_empty()) {
            let live = self.blocks.iter().filter(|(block, _)| !block.is_empty());
            let spans: Vec<_> = match scaled {
                None => live.map(|(block, _)| block.span(self.start)).collect(),
                Some(scaled) => live.map(|(block, _)| block.span_of(scaled, share, self.start)).collect(),
            };
            project(&constraints[run], &spans, &mut self.stretch, h, dispatch);
        }
    }
}

/// Projects constraints in some spans: the kernel, once for all that ask for it, because it is large.
#[inline(never)]
fn project(list: &[Constraint], spans: &[Span<LANES>], particles: &mut Columns<'_>, h: f32, dispatch: Dispatch) {
    dispatch.run(
        #[inline(always)]
        || constraint::project(list, spans, particles, h),
    );
}

impl Batch<'_, ()> {
    /// Projects rigid links of the template in all blocks.
    pub(crate) fn project_links(&mut self, links: &[Constraint], dispatch: Dispatch) {
        // How long the substep is matters to soft ones only.
        self.project(links, &[], 1.0, 1.0, dispatch);
    }
}

/// Subtracts from the remaining margin of each body of a block the largest displacement of its particles in the last substep.
#[inline(always)]
pub(crate) fn subtract_displacement(block: &mut Columns<'_>, margins: &mut [f32; LANES]) {
    let block = block.even();
    let mut farthest = [0.0; LANES];
    for at in (0..block.x.len()).step_by(LANES) {
        let (x, y) = (load::<LANES>(block.x, at), load::<LANES>(block.y, at));
        let (from_x, from_y) = (load::<LANES>(block.prev_x, at), load::<LANES>(block.prev_y, at));
        let (dx, dy) = (each::<LANES>(|l| x[l] - from_x[l]), each::<LANES>(|l| y[l] - from_y[l]));
        let squared = each::<LANES>(|l| dx[l] * dx[l] + dy[l] * dy[l]);
        farthest = each::<LANES>(|l| if squared[l] > farthest[l] { squared[l] } else { farthest[l] });
    }
    *margins = each::<LANES>(|l| margins[l] - farthest[l].sqrt());
}

#[cfg(test)]
mod tests {
    use super::super::constraint::{Anchor, Area, Bend, Distance, LinkDrag, MinDistance, Rope, TORN, YieldingDistance};
    use super::super::testing::disc;
    use super::*;
    use glam::Vec2;

    fn spring_chain(nodes: u32) -> Vec<Constraint> {
        let link = |a| Distance { a, b: a + 1, rest_length: 1.0, compliance: 1e-4, damping: 0.01 };
        (0..nodes - 1).map(|a| link(a).into()).collect()
    }

    /// Constraints of every kind on five nodes; those that limit something act on some sizes only.
    fn every_kind() -> Vec<Constraint> {
        let mut list = spring_chain(5);
        list.push(Distance { a: 0, b: 2, rest_length: 2.0, compliance: 1e-5, damping: 0.0 }.into());
        list.push(MinDistance { a: 1, b: 3, min_length: 3.0 }.into());
        list.push(Rope { a: 2, b: 4, max_length: 2.9 }.into());
        list.push(Bend::new([0, 3, 4], 0.4, 1e-3).into());
        list.push(Anchor { node: 3, anchor: 0, rest_length: 1.0, max_length: 4.4, compliance: 1e-4 }.into());
        let spring = Distance { a: 0, b: 4, rest_length: 3.0, compliance: 1e-4, damping: 0.01 };
        list.push(YieldingDistance::from(spring).into());
        list.push(LinkDrag { a: 1, b: 4, along: 30.0, across: 50.0 }.into());
        for is_upper_bound in [false, true] {
            list.push(Area { ring: vec![0, 1, 2, 4], rest_area: 1.0, compliance: 1e-3, is_upper_bound }.into());
        }
        list
    }

    fn wobbly(slot: u32, lane: usize) -> Vec2 {
        Vec2::new(slot as f32 * 1.3 + lane as f32 * 0.01, (slot as f32 * 0.7 + lane as f32) * 0.1)
    }

    #[test]
    fn lanes_give_the_same_bits_as_the_generic_path() {
        let constraints = every_kind();
        let mut in_lanes = Particles::default();
        let mut block = Block::new(0, 5, &mut in_lanes);
        block.owner = [0; LANES];
        block.scale = [0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3];
        block.length_state =
            vec![[1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3], [0.0, 0.1, -0.2, TORN, 0.4, 0.5, TORN, 0.7]];
        block.contraction_before = block.length_state[..1].to_vec();
        let yielding = constraints.iter().position(|it| matches!(it, Constraint::YieldingDistance(_))).unwrap();
        let scaled = [
            Scaled { constraint: 2, channel: Some(0), link: None },
            Scaled { constraint: yielding as u32, channel: None, link: Some(1) },
        ];
        let mut loose = vec![Particles::default(); LANES];
        for (lane, loose) in loose.iter_mut().enumerate() {
            for slot in 0..5 {
                in_lanes.set(block.particle(slot, lane) as usize, &disc(wobbly(slot, lane), 1.0));
                loose.insert(&disc(wobbly(slot, lane), 1.0));
            }
        }
        for _ in 0..10 {
            let dispatch = Dispatch::default();
            batches(&mut [(&block, ())], &mut in_lanes)[0].project(&constraints, &scaled, 1.0, 0.01, dispatch);
            for (lane, p) in loose.iter_mut().enumerate() {
                for (k, constraint) in constraints.iter().enumerate() {
                    let [contraction, plastic] = [0, 1].map(|row: usize| block.length_state[row][lane]);
                    let factor = if k == 2 { contraction } else { 1.0 };
                    let factor = if k == yielding { factor * (1.0 + plastic) } else { factor };
                    let scale = [block.scale[lane] * factor];
                    constraint::project(
                        std::slice::from_ref(constraint),
                        &[Span { base: 0, scale }],
                        &mut p.columns(),
                        0.01,
                    );
                }
            }
        }
        for (lane, loose) in loose.iter().enumerate() {
            for slot in 0..5 {
                let i = block.particle(slot, lane) as usize;
                assert_eq!(in_lanes.position(i), loose.position(slot as usize), "slot {slot} lane {lane}");
            }
        }
    }

    #[test]
    fn the_displacement_of_a_body_is_that_of_its_farthest_particle() {
        let mut particles = Particles::default();
        let block = Block::new(0, 3, &mut particles);
        particles.prev_x[block.particle(1, 4) as usize] = 3.0;
        particles.y[block.particle(1, 4) as usize] = -4.0;
        particles.x[block.particle(2, 4) as usize] = 1.0;
        let mut left = [6.0; LANES];
        subtract_displacement(&mut particles.columns(), &mut left);
        assert_eq!(left, [6.0, 6.0, 6.0, 6.0, 1.0, 6.0, 6.0, 6.0]);
    }

    #[test]
    fn an_empty_lane_stays_as_it_is() {
        let mut particles = Particles::default();
        let block = Block::new(0, 5, &mut particles);
        let constraints = spring_chain(5);
        constraint::project(&constraints, &[block.span(0)], &mut particles.columns(), 0.01);
        assert!(block.is_empty() && (0..particles.len()).all(|i| particles.position(i) == Vec2::ZERO));
    }
}
