//! The part of the store that moves: what constraints and integration read and write, for all particles or a chunk of
//! neighbouring ones. Chunks that do not overlap can be worked on at the same time.

use glam::Vec2;
use std::ops::Range;

/// Columns of [`super::Particles`], from some particle on.
#[derive(Debug)]
pub(crate) struct Columns<'a> {
    pub origin_x: &'a mut [f32],
    pub origin_y: &'a mut [f32],
    pub x: &'a mut [f32],
    pub y: &'a mut [f32],
    pub prev_x: &'a mut [f32],
    pub prev_y: &'a mut [f32],
    pub vx: &'a mut [f32],
    pub vy: &'a mut [f32],
    pub inv_mass: &'a [f32],
}

impl<'a> Columns<'a> {
    /// From entry `i` to entry `j`, see [`super::Particles::between`].
    #[inline(always)]
    pub(crate) fn between(&self, i: usize, j: usize) -> Vec2 {
        Vec2::new(
            (self.origin_x[j] - self.origin_x[i]) + (self.x[j] - self.x[i]),
            (self.origin_y[j] - self.origin_y[i]) + (self.y[j] - self.y[i]),
        )
    }

    /// From `L` entries to `L` others, along x and along y.
    #[inline(always)]
    pub(crate) fn between_lanes<const L: usize>(&self, i: usize, j: usize) -> [[f32; L]; 2] {
        let mut way = [[0.0; L]; 2];
        for (way, (origin, column)) in way.iter_mut().zip([(&*self.origin_x, &*self.x), (&*self.origin_y, &*self.y)]) {
            let [origin_i, i] = [&origin[i..i + L], &column[i..i + L]];
            let [origin_j, j] = [&origin[j..j + L], &column[j..j + L]];
            for (l, way) in way.iter_mut().enumerate() {
                *way = (origin_j[l] - origin_i[l]) + (j[l] - i[l]);
            }
        }
        way
    }

    /// Some of them. Never inlined: a kernel that sees where its columns come from is vectorised across blocks' nodes
    /// instead of across lanes, and takes a quarter longer.
    #[inline(never)]
    pub(crate) fn part(&mut self, range: Range<usize>) -> Columns<'_> {
        let Self { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass } = self;
        let inv_mass = &inv_mass[range.clone()];
        let moving = [origin_x, origin_y, x, y, prev_x, prev_y, vx, vy];
        let [origin_x, origin_y, x, y, prev_x, prev_y, vx, vy] = moving.map(|column| &mut column[range.clone()]);
        Columns { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass }
    }

    /// All of them, with lengths that the compiler sees to be equal: an index that is checked in one column is not checked
    /// again in the others.
    #[inline(always)]
    pub(crate) fn even(&mut self) -> Columns<'_> {
        let count = self.x.len();
        Columns {
            origin_x: &mut self.origin_x[..count],
            origin_y: &mut self.origin_y[..count],
            x: &mut self.x[..count],
            y: &mut self.y[..count],
            prev_x: &mut self.prev_x[..count],
            prev_y: &mut self.prev_y[..count],
            vx: &mut self.vx[..count],
            vy: &mut self.vy[..count],
            inv_mass: &self.inv_mass[..count],
        }
    }

    /// Takes out the first `count` entries; the others stay.
    pub(crate) fn take_front(&mut self, count: usize) -> Self {
        let Self { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass } = self;
        let (front_inv_mass, others) = inv_mass.split_at(count);
        *inv_mass = others;
        let moving = [origin_x, origin_y, x, y, prev_x, prev_y, vx, vy];
        let [origin_x, origin_y, x, y, prev_x, prev_y, vx, vy] = moving.map(|column| {
            let (front, others) = std::mem::take(column).split_at_mut(count);
            *column = others;
            front
        });
        Columns { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass: front_inv_mass }
    }

    /// Chunks of at most `count` entries that together are these ranges, of which each lies after the one before.
    pub(crate) fn chunks(mut self, ranges: impl Iterator<Item = Range<usize>>, count: usize) -> Vec<Self> {
        let (mut chunks, mut start) = (Vec::new(), 0);
        for range in ranges {
            for first in range.clone().step_by(count) {
                let end = range.end.min(first + count);
                self.take_front(first - start);
                chunks.push(self.take_front(end - first));
                start = end;
            }
        }
        chunks
    }
}
