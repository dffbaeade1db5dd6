//! The part of the store that moves: what constraints and integration read and write, for all particles or a chunk of
//! neighbouring ones. Chunks that do not overlap can be worked on at the same time.

use glam::Vec2;
use std::ops::Range;

/// Columns of [`super::Particles`], from some particle on.
#[derive(Debug)]
pub(crate) struct Columns<'a> {
    pub(super) origin_x: &'a [f32],
    pub(super) origin_y: &'a [f32],
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

    /// Some of them.
    pub(crate) fn part(&mut self, range: Range<usize>) -> Columns<'_> {
        let Self { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass } = self;
        Columns {
            origin_x: &origin_x[range.clone()],
            origin_y: &origin_y[range.clone()],
            x: &mut x[range.clone()],
            y: &mut y[range.clone()],
            prev_x: &mut prev_x[range.clone()],
            prev_y: &mut prev_y[range.clone()],
            vx: &mut vx[range.clone()],
            vy: &mut vy[range.clone()],
            inv_mass: &inv_mass[range],
        }
    }

    /// The first `count` entries, and the others.
    pub(crate) fn split_at(self, count: usize) -> (Self, Self) {
        let (origin_x, origin_x_rest) = self.origin_x.split_at(count);
        let (origin_y, origin_y_rest) = self.origin_y.split_at(count);
        let (x, x_rest) = self.x.split_at_mut(count);
        let (y, y_rest) = self.y.split_at_mut(count);
        let (prev_x, prev_x_rest) = self.prev_x.split_at_mut(count);
        let (prev_y, prev_y_rest) = self.prev_y.split_at_mut(count);
        let (vx, vx_rest) = self.vx.split_at_mut(count);
        let (vy, vy_rest) = self.vy.split_at_mut(count);
        let (inv_mass, inv_mass_rest) = self.inv_mass.split_at(count);
        let rest = Columns {
            origin_x: origin_x_rest,
            origin_y: origin_y_rest,
            x: x_rest,
            y: y_rest,
            prev_x: prev_x_rest,
            prev_y: prev_y_rest,
            vx: vx_rest,
            vy: vy_rest,
            inv_mass: inv_mass_rest,
        };
        (Columns { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass }, rest)
    }

    /// Chunks of at most `count` entries that together are these ranges, of which each lies after the one before.
    pub(crate) fn chunks(self, ranges: impl Iterator<Item = Range<usize>>, count: usize) -> Vec<Self> {
        let (mut chunks, mut rest, mut start) = (Vec::new(), self, 0);
        for range in ranges {
            for first in range.clone().step_by(count) {
                let end = range.end.min(first + count);
                let (_, from_first) = rest.split_at(first - start);
                let (chunk, others) = from_first.split_at(end - first);
                chunks.push(chunk);
                (rest, start) = (others, end);
            }
        }
        chunks
    }
}
