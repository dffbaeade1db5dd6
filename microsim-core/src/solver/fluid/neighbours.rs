//! Particles in cell order, eight at a time, and where the neighbours of each eight are.
//!
//! ```text
//!            |    | .  |  . | .. |  . | .. |    |       three windows, contiguous in cell order: whatever is
//!            |    | .. | AB | CD | EF | GH | .  |       within the support radius of one of A to H is in one of them
//!            |    | .  | .. |  . | .  | .. |    |
//! ```
//!
//! Lanes are the eight particles A to H; each of them meets the same candidates one after the other and keeps its own sums.
//! So nothing is scattered or reduced across lanes, and a kernel that vanishes beyond the support radius drops the
//! candidates that are not neighbours. Cells are as high as the support radius and [`COLUMN_WIDTH`] wide.

use crate::collision::uniform_grid::UniformGrid;
use crate::geometry::period::Period;
use crate::instruction_set::each;
use crate::particle::{Particles, PositionCells};
use crate::solver::lanes::LANES;
use glam::{Vec2, Vec4};
use std::ops::Range;

/// Where a particle without a finite position is put: nowhere near the others.
const NOWHERE: Vec2 = Vec2::splat(-1e9);
/// Nearer than this, in units of the support radius, there is no direction between two particles.
const CONTACT: f32 = 1e-6;
/// Width of a cell, in units of the support radius: about as many cells as particles.
const COLUMN_WIDTH: f32 = 0.25;

/// A value for each particle of a group.
pub(super) type Lanes = [f32; LANES];

/// A particle as its neighbours see it, in units of the support radius.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Neighbour {
    pub x: f32,
    pub y: f32,
    /// How far it has moved in this substep.
    pub moved_x: f32,
    pub moved_y: f32,
    /// Multiplier of its density constraint, or share of a grain's contacts.
    pub multiplier: f32,
}

/// Up to eight consecutive particles of a row of cells.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// Its particles, as a range of the cell order.
    pub members: Range<usize>,
    windows: [Range<usize>; 3],
    /// How many candidates the groups before it have.
    first_candidate: usize,
}

/// A fluid's particles sorted by cell.
#[derive(Debug, Default)]
pub(super) struct Sorted {
    grid: UniformGrid,
    /// Where they were, in the order of the fluid.
    found: Vec<Vec2>,
    /// In cell order.
    pub particles: Vec<u32>,
    /// In cell order, and some that are nowhere so that eight can be read from anywhere.
    pub neighbours: Vec<Neighbour>,
    pub groups: Vec<Group>,
    /// Of each group, how far its members are moved, in units of the support radius.
    pub shifts: Vec<[Lanes; 2]>,
    pub walls: Walls,
    /// Position in the world that their coordinates are relative to.
    low: Vec2,
    images: Vec<Image>,
}

/// An entry that stands for a particle in a room that repeats: a neighbour like others, but what is found for the particle holds for it.
#[derive(Clone, Copy, Debug)]
struct Image {
    /// Its place in the cell order, and that of the particle.
    place: usize,
    original: usize,
    shift: Vec2,
}

/// The walls in the coordinates of the neighbours.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Walls {
    pub low: Vec2,
    pub high: Vec2,
}

/// Where a particle is, relative to its origin, and how far it has moved since the substep began.
pub(super) struct Place {
    pub origin: Vec2,
    pub offset: Vec2,
    pub moved: Vec2,
}

impl Sorted {
    /// Sorts particles between walls, of which these are the lower left and the upper right corner, for searches as far as `margin` beyond `support_radius`, in units of it.
    pub(super) fn sort(
        &mut self,
        indices: &[u32],
        particles: &Particles,
        walls: [Vec2; 2],
        [support_radius, margin]: [f32; 2],
        period: Period,
    ) {
        let inverse = 1.0 / support_radius;
        self.found.clear();
        self.found.extend(indices.iter().map(|&i| particles.position(i as usize)));
        let shifts =
            if period.is_none() { Vec::new() } else { self.find_images(period, (1.0 + margin) * support_radius) };
        let (low, high) = bounds(&self.found);
        // On the grid of origins, so that differences from origins are exact.
        self.low = low.floor();
        self.walls = Walls { low: (walls[0] - self.low) * inverse, high: (walls[1] - self.low) * inverse };
        let cell = Vec2::new(COLUMN_WIDTH, 1.0 + margin) * support_radius;
        self.grid.fill(low, high, cell, self.found.len(), |k| self.found[k]);
        self.particles.clear();
        self.images.clear();
        if shifts.is_empty() {
            self.particles.extend(self.grid.order().iter().map(|&k| indices[k as usize]));
        } else {
            self.place_images(&shifts, indices);
        }
        self.find_groups((1.0 + margin) * support_radius);
    }

    /// How many candidates all groups have.
    pub(super) fn candidates(&self) -> usize {
        self.groups.last().map_or(0, |group| group.candidates().end)
    }

    /// Reads where the particles are now, and how far they have moved in this substep.
    pub(super) fn read(&mut self, place: impl Fn(usize) -> Place, support_radius: f32) {
        let inverse = 1.0 / support_radius;
        let Self { particles: sorted, neighbours, low, .. } = self;
        neighbours.clear();
        neighbours.extend(sorted.iter().map(|&i| neighbour(place(i as usize), *low, inverse)));
        if !self.images.is_empty() {
            self.read_images(place, inverse);
        }
        let Self { particles: sorted, neighbours, .. } = self;
        separate_coincident(neighbours);
        let nowhere = Neighbour { x: NOWHERE.x, y: NOWHERE.y, ..Neighbour::default() };
        neighbours.resize(sorted.len() + LANES, nowhere);
    }

    /// Moves the members of each group by their shifts.
    pub(super) fn shift(&self, support_radius: f32, particles: PositionCells<'_>) {
        for (group, [shift_x, shift_y]) in self.groups.iter().zip(&self.shifts) {
            for (l, &i) in self.particles[group.members.clone()].iter().enumerate() {
                particles.shift(i as usize, Vec2::new(shift_x[l], shift_y[l]) * support_radius);
            }
        }
    }

    /// Adds the images of what was found that are within `reach` of anything; returns of which each is, and its displacement.
    #[cold]
    #[inline(never)]
    fn find_images(&mut self, period: Period, reach: f32) -> Vec<(u32, Vec2)> {
        let (low, high) = bounds(&self.found);
        let onto = [low - reach, high + reach];
        let images = |(&at, k): (&Vec2, u32)| period.image_shifts([at; 2], onto).map(move |shift| (k, shift));
        let shifts: Vec<(u32, Vec2)> = self.found.iter().zip(0..).flat_map(images).collect();
        for &(k, shift) in &shifts {
            self.found.push(self.found[k as usize] + shift);
        }
        shifts
    }

    /// Fills the cell order with particles and the images that come after them in what was found.
    #[cold]
    #[inline(never)]
    fn place_images(&mut self, shifts: &[(u32, Vec2)], indices: &[u32]) {
        let mut places = vec![0; self.found.len()];
        self.grid.order().iter().enumerate().for_each(|(place, &k)| places[k as usize] = place);
        let of = |k: u32| k.checked_sub(indices.len() as u32).map_or(k, |image| shifts[image as usize].0);
        self.particles.extend(self.grid.order().iter().map(|&k| indices[of(k) as usize]));
        let images = shifts.iter().zip(&places[indices.len()..]);
        self.images.extend(images.map(|(&(k, shift), &place)| Image { place, original: places[k as usize], shift }));
        self.images.sort_unstable_by_key(|image| image.place);
    }

    #[cold]
    #[inline(never)]
    fn read_images(&mut self, place: impl Fn(usize) -> Place, inverse: f32) {
        for image in &self.images {
            let i = self.particles[image.place] as usize;
            self.neighbours[image.place] = neighbour(place(i), self.low - image.shift, inverse);
        }
    }

    /// Whether a place in the cell order is that of an image.
    pub(super) fn is_image(&self, place: usize) -> bool {
        self.images.binary_search_by_key(&place, |image| image.place).is_ok()
    }

    /// Gives images the multipliers of their particles.
    pub(super) fn tell_images(&mut self) {
        for image in &self.images {
            self.neighbours[image.place].multiplier = self.neighbours[image.original].multiplier;
        }
    }

    /// Takes back what was found for images: only particles move.
    pub(super) fn hold_images(&mut self) {
        for image in &self.images {
            let group = self.groups.partition_point(|group| group.members.end <= image.place);
            let lane = image.place - self.groups[group].members.start;
            self.shifts[group].iter_mut().for_each(|lanes| lanes[lane] = 0.0);
        }
    }

    fn find_groups(&mut self, distance: f32) {
        let Self { grid, groups, shifts, .. } = self;
        let (span, mut first_candidate) = (grid.columns_within(distance), 0);
        groups.clear();
        for row in 0..grid.rows() {
            let members = grid.row_range(row, 0..grid.columns());
            for first in members.clone().step_by(LANES) {
                let last = (first + LANES).min(members.end) - 1;
                let column = |k: usize| grid.column_at(row, k);
                let columns = column(first).saturating_sub(span)..column(last) + span + 1;
                let window = |row: usize| grid.row_range(row, columns.clone());
                let below = if row > 0 { window(row - 1) } else { 0..0 };
                let windows = [below, window(row), window(row + 1)];
                let group = Group { members: first..last + 1, windows, first_candidate };
                first_candidate = group.candidates().end;
                groups.push(group);
            }
        }
        shifts.resize(groups.len(), Default::default());
    }
}

impl Group {
    /// Its candidates, as a range of those of all groups.
    #[inline(always)]
    pub(super) fn candidates(&self) -> Range<usize> {
        let count: usize = self.windows.iter().map(Range::len).sum();
        self.first_candidate..self.first_candidate + count
    }

    /// A value of each member; lanes beyond the last one hold what follows in cell order and are to be ignored.
    #[inline(always)]
    pub(super) fn load(&self, neighbours: &[Neighbour], value: impl Fn(&Neighbour) -> f32) -> Lanes {
        let members = &neighbours[self.members.start..self.members.start + LANES];
        each(|l| value(&members[l]))
    }

    /// Everything that may be a neighbour of a member, each member itself included.
    #[inline(always)]
    pub(super) fn windows<'a>(&self, neighbours: &'a [Neighbour]) -> [&'a [Neighbour]; 3] {
        let [below, level, above] = &self.windows;
        [&neighbours[below.clone()], &neighbours[level.clone()], &neighbours[above.clone()]]
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

fn bounds(positions: &[Vec2]) -> (Vec2, Vec2) {
    let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    for position in positions.iter().filter(|position| position.is_finite()) {
        (low, high) = (low.min(*position), high.max(*position));
    }
    if low.x <= high.x { (low, high) } else { (Vec2::ZERO, Vec2::ZERO) }
}

#[inline(always)]
fn neighbour(Place { origin, offset, moved }: Place, low: Vec2, inverse: f32) -> Neighbour {
    let at = ((origin - low) + offset) * inverse;
    let is_somewhere = at.x.abs() < -NOWHERE.x && at.y.abs() < -NOWHERE.y;
    let at = if is_somewhere { at } else { NOWHERE };
    let moved = moved * inverse;
    Neighbour { x: at.x, y: at.y, moved_x: moved.x, moved_y: moved.y, multiplier: 0.0 }
}

/// Particles in the very same place would never come apart: gives them different ones.
fn separate_coincident(neighbours: &mut [Neighbour]) {
    // Those of a cell lie side by side: the last four, of which hardly ever one has the same coordinate.
    let mut last = Vec4::NAN;
    for k in 0..neighbours.len() {
        if last.cmpeq(Vec4::splat(neighbours[k].x)).any() {
            separate_from_last(neighbours, k);
        }
        last = Vec4::new(neighbours[k].x, last.x, last.y, last.z);
    }
}

/// The same for one of them, and the last four before it.
#[cold]
fn separate_from_last(neighbours: &mut [Neighbour], k: usize) {
    let (before, here) = neighbours.split_at_mut(k);
    let is_same = |other: &&Neighbour| other.x == here[0].x && other.y == here[0].y;
    let same = before.iter().rev().take(4).filter(is_same).count();
    if same > 0 {
        here[0].x += same as f32 * 1e-3;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;
    use crate::solver::testing::disc;

    #[test]
    fn every_neighbour_is_in_a_window() {
        let mut rng = Rng::new(4, 2);
        let mut particles = Particles::default();
        let mut place = || Vec2::new(rng.range(0.0, 30.0), rng.range(0.0, 12.0));
        let indices: Vec<u32> = (0..600).map(|_| particles.insert(&disc(place(), 1.0))).collect();
        for [support_radius, margin] in [[2.0, 0.0], [1.0, 0.25]] {
            let mut sorted = Sorted::default();
            sorted.sort(&indices, &particles, [Vec2::ZERO, Vec2::INFINITY], [support_radius, margin], Period::NONE);
            for group in &sorted.groups {
                let seen: Vec<u32> = group.windows.iter().flat_map(|w| &sorted.particles[w.clone()]).copied().collect();
                for &member in &sorted.particles[group.members.clone()] {
                    let way = |other: u32| particles.between(member as usize, other as usize).length();
                    let near = indices.iter().filter(|&&other| way(other) < support_radius * (1.0 + margin));
                    assert!(near.copied().all(|other| seen.contains(&other)));
                }
            }
        }
    }

    #[test]
    fn particles_in_the_same_place_come_apart_and_no_others_move() {
        // The last but two is where the fourth before it is, the last where the fifth before it is.
        let first = [[0.5, 0.1], [0.5, 0.7], [0.5, 0.1], [0.2, 0.1], [0.5, 0.7], [0.2, 0.1], [0.3, 0.3], [0.4, 0.3]];
        let places = [&first[..], &[[0.6, 0.3], [0.7, 0.3], [0.3, 0.3], [0.8, 0.3], [0.4, 0.3]]].concat();
        let neighbour = |&[x, y]: &[f32; 2]| Neighbour { x, y, ..Neighbour::default() };
        let mut neighbours: Vec<_> = places.iter().map(neighbour).collect();
        separate_coincident(&mut neighbours);
        let moved = neighbours.iter().zip(places).map(|(now, [x, y])| (now.x - x, now.y - y));
        let expected = [0.0, 0.0, 1e-3, 0.0, 1e-3, 1e-3, 0.0, 0.0, 0.0, 0.0, 1e-3, 0.0, 0.0].map(|by: f32| (by, 0.0));
        for ((moved, expected), k) in moved.zip(expected).zip(0..) {
            assert!((moved.0 - expected.0).abs() < 1e-6 && moved.1 == expected.1, "{k}: {moved:?}");
        }
    }
}
