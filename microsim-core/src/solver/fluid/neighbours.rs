//! Particles in cell order, eight at a time, and where the neighbours of each eight are.
//!
//! ```text
//!            |    | .  |  . | .. |  . | .. |    |       three windows, contiguous in cell order:
//!            |    | .. | AB | CD | EF | GH | .  |       whatever is within reach of one of A to H is in one of them
//!            |    | .  | .. |  . | .  | .. |    |
//! ```
//!
//! Lanes are the eight particles A to H; each of them meets the same candidates one after the other and keeps its own sums.
//! So nothing is scattered or reduced across lanes, and a kernel that vanishes beyond the reach drops the candidates that
//! are not neighbours. Cells are as high as the reach and half as wide.

use crate::collision::grid::Grid;
use crate::particle::Particles;
use crate::solver::lanes::{LANES, each};
use glam::Vec2;
use std::ops::Range;

/// Where a particle without a finite position is put: nowhere near the others.
const NOWHERE: Vec2 = Vec2::splat(-1e9);
/// Nearer than this, in units of the reach, there is no direction between two particles.
const CONTACT: f32 = 1e-6;

/// A value for each particle of a group.
pub(super) type Lanes = [f32; LANES];

/// A particle as its neighbours see it, in units of the reach.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Source {
    pub x: f32,
    pub y: f32,
    /// How far it has moved in this substep.
    pub moved_x: f32,
    pub moved_y: f32,
    /// Multiplier of its density constraint.
    pub multiplier: f32,
}

/// Up to eight consecutive particles of a row of cells.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// Its particles, as a range of the cell order.
    pub members: Range<usize>,
    windows: [Range<usize>; 3],
}

/// A fluid's particles sorted by cell.
#[derive(Debug, Default)]
pub(super) struct Sorted {
    grid: Grid,
    /// In the order of the fluid.
    unsorted: Vec<Source>,
    /// In cell order, and some that are nowhere so that eight can be read from anywhere.
    pub sources: Vec<Source>,
    pub groups: Vec<Group>,
    pub walls: Walls,
}

/// The room, as the sources see it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Walls {
    pub low: Vec2,
    pub high: Vec2,
}

/// Sorted anew in each substep: a clone starts without.
impl Clone for Sorted {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Sorted {
    /// Sorts particles in a room of this size for searches within `reach`.
    pub(super) fn sort(&mut self, indices: &[u32], particles: &Particles, size: Vec2, reach: f32) {
        let (low, high) = bounds(indices, particles);
        let inverse = 1.0 / reach;
        self.unsorted.clear();
        self.unsorted.extend(indices.iter().map(|&i| source(particles, i as usize, low, inverse)));
        self.walls = Walls { low: -low * inverse, high: (size - low) * inverse };
        let extent = (high - low) * inverse;
        self.grid.fill(Vec2::ZERO, extent, Vec2::new(0.5, 1.0), self.unsorted.len(), |k| self.unsorted[k].position());
        self.sources.clear();
        self.sources.extend(self.grid.order().iter().map(|&k| self.unsorted[k as usize]));
        separate_coincident(&mut self.sources);
        let nowhere = Source { x: NOWHERE.x, y: NOWHERE.y, ..Source::default() };
        self.sources.resize(indices.len() + LANES, nowhere);
        self.find_groups();
    }

    /// Places in the fluid of the particles in cell order.
    pub(super) fn order(&self) -> &[u32] {
        self.grid.order()
    }

    fn find_groups(&mut self) {
        let Self { grid, sources, groups, .. } = self;
        let span = grid.columns_within(1.0);
        groups.clear();
        for row in 0..grid.rows() {
            let members = grid.row_range(row, 0..grid.columns());
            for first in members.clone().step_by(LANES) {
                let last = (first + LANES).min(members.end) - 1;
                let column = |k: usize| grid.cell_of(sources[k].position()).0;
                let columns = column(first).saturating_sub(span)..column(last) + span + 1;
                let window = |row: usize| grid.row_range(row, columns.clone());
                let below = if row > 0 { window(row - 1) } else { 0..0 };
                groups.push(Group { members: first..last + 1, windows: [below, window(row), window(row + 1)] });
            }
        }
    }
}

impl Source {
    fn position(&self) -> Vec2 {
        Vec2::new(self.x, self.y)
    }
}

impl Group {
    /// A value of each member; lanes beyond the last one hold what follows in cell order and are to be ignored.
    #[inline(always)]
    pub(super) fn load(&self, sources: &[Source], value: impl Fn(&Source) -> f32) -> Lanes {
        let members = &sources[self.members.start..self.members.start + LANES];
        each(|l| value(&members[l]))
    }

    /// Everything that may be a neighbour of a member, each member itself included.
    #[inline(always)]
    pub(super) fn windows<'a>(&self, sources: &'a [Source]) -> [&'a [Source]; 3] {
        let [below, level, above] = &self.windows;
        [&sources[below.clone()], &sources[level.clone()], &sources[above.clone()]]
    }
}

/// Distance over a way, never 0: a particle is at `CONTACT` from itself.
#[inline(always)]
pub(super) fn distance(dx: f32, dy: f32) -> f32 {
    (dx * dx + dy * dy + CONTACT * CONTACT).sqrt()
}

#[inline(always)]
pub(super) fn positive(value: f32) -> f32 {
    if value > 0.0 { value } else { 0.0 }
}

fn bounds(indices: &[u32], particles: &Particles) -> (Vec2, Vec2) {
    let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    for position in indices.iter().map(|&i| particles.position(i as usize)).filter(|position| position.is_finite()) {
        low = low.min(position);
        high = high.max(position);
    }
    if low.x <= high.x { (low, high) } else { (Vec2::ZERO, Vec2::ZERO) }
}

fn source(particles: &Particles, i: usize, low: Vec2, inverse: f32) -> Source {
    let position = particles.position(i);
    let at = if position.is_finite() { (position - low) * inverse } else { NOWHERE };
    let moved_x = (particles.x[i] - particles.prev_x[i]) * inverse;
    let moved_y = (particles.y[i] - particles.prev_y[i]) * inverse;
    Source { x: at.x, y: at.y, moved_x, moved_y, multiplier: 0.0 }
}

/// Particles in the very same place would never come apart: gives them different ones.
fn separate_coincident(sources: &mut [Source]) {
    for k in 1..sources.len() {
        let (here, before) = (sources[k].position(), &sources[k.saturating_sub(4)..k]);
        if before.iter().any(|other| other.x == here.x) {
            let same = before.iter().filter(|other| other.position() == here).count();
            sources[k].x += same as f32 * 1e-3;
        }
    }
}
