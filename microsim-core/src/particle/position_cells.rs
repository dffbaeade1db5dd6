//! Positions that several parts of the work move at the same time, each those of particles of its own.

use super::Particles;
use glam::Vec2;
use std::cell::Cell;

/// What contacts read of the store, and the positions that they move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PositionCells<'a> {
    origin_x: &'a [f32],
    origin_y: &'a [f32],
    x: &'a [Cell<f32>],
    y: &'a [Cell<f32>],
    prev_x: &'a [f32],
    prev_y: &'a [f32],
    vx: &'a [f32],
    vy: &'a [f32],
    inv_mass: &'a [f32],
    radius: &'a [f32],
}

impl Particles {
    /// The positions of all particles.
    pub(crate) fn position_cells(&mut self) -> PositionCells<'_> {
        let Self { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass, radius, .. } = self;
        let [x, y] = [x, y].map(|column| Cell::from_mut(column.as_mut_slice()).as_slice_of_cells());
        PositionCells { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass, radius }
    }
}

impl PositionCells<'_> {
    /// The same with columns of lengths that the compiler sees to be equal: a particle that is found in one column is not
    /// checked again in the others.
    #[inline(always)]
    pub(crate) fn even(self) -> Self {
        let count = self.x.len();
        Self {
            origin_x: &self.origin_x[..count],
            origin_y: &self.origin_y[..count],
            x: &self.x[..count],
            y: &self.y[..count],
            prev_x: &self.prev_x[..count],
            prev_y: &self.prev_y[..count],
            vx: &self.vx[..count],
            vy: &self.vy[..count],
            inv_mass: &self.inv_mass[..count],
            radius: &self.radius[..count],
        }
    }

    /// Origin of particle `i`.
    #[inline(always)]
    pub(crate) fn origin(&self, i: usize) -> Vec2 {
        Vec2::new(self.origin_x[i], self.origin_y[i])
    }

    /// Position of particle `i` relative to its origin.
    #[inline(always)]
    pub(crate) fn offset(&self, i: usize) -> Vec2 {
        Vec2::new(self.x[i].get(), self.y[i].get())
    }

    /// Position of particle `i` in the world.
    #[inline(always)]
    pub(crate) fn position(&self, i: usize) -> Vec2 {
        self.origin(i) + self.offset(i)
    }

    /// How far particle `i` has moved since the substep began.
    #[inline(always)]
    pub(crate) fn moved(&self, i: usize) -> Vec2 {
        Vec2::new(self.x[i].get() - self.prev_x[i], self.y[i].get() - self.prev_y[i])
    }

    #[inline(always)]
    pub(crate) fn velocity(&self, i: usize) -> Vec2 {
        Vec2::new(self.vx[i], self.vy[i])
    }

    #[inline(always)]
    pub(crate) fn inv_mass(&self, i: usize) -> f32 {
        self.inv_mass[i]
    }

    #[inline(always)]
    pub(crate) fn radius(&self, i: usize) -> f32 {
        self.radius[i]
    }

    /// Puts particle `i` somewhere else, relative to its origin.
    #[inline(always)]
    pub(crate) fn set_offset(&self, i: usize, to: Vec2) {
        self.x[i].set(to.x);
        self.y[i].set(to.y);
    }

    /// Moves particle `i`.
    #[inline(always)]
    pub(crate) fn shift(&self, i: usize, by: Vec2) {
        self.set_offset(i, self.offset(i) + by);
    }
}

/// The same for parts of the work that run on several threads.
#[derive(Debug)]
pub(crate) struct DisjointPositions<'a>(PositionCells<'a>);

#[expect(unsafe_code, reason = "no safe type says that parts of a list touch different entries, wherever these lie")]
// SAFETY: who makes one promises that no two threads touch the same particle.
unsafe impl Sync for DisjointPositions<'_> {}

#[expect(unsafe_code, reason = "the promise that makes it `Sync`")]
impl<'a> DisjointPositions<'a> {
    /// # Safety
    /// Parts of the work that run at the same time read and move the positions of different particles.
    pub(crate) unsafe fn new(cells: PositionCells<'a>) -> Self {
        Self(cells)
    }
}

impl<'a> DisjointPositions<'a> {
    /// The positions, for one part.
    pub(crate) fn cells(&self) -> PositionCells<'a> {
        self.0
    }
}
