//! What light meets: how much a place of the specimen delays it and how much of what dyes it there is.

use super::formula::Formula;
pub(super) use crate::look::Matter;
use glam::Vec2;

pub(super) const FORMULA: Formula = Formula { source: include_str!("matter.glsl"), constants: &[] };

/// Square pixels over a part of the specimen, rows from the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    /// Upper left corner of the whole picture, micrometres.
    pub corner: Vec2,
    /// Side of a pixel, micrometres.
    pub pixel: f32,
    pub columns: usize,
    /// Rows of the whole picture above this part of it.
    pub top: usize,
    pub rows: usize,
}

impl Grid {
    /// Centre of a pixel, micrometres: the same to the bit whatever part of the picture this is.
    pub(super) fn place(&self, x: usize, y: usize) -> Vec2 {
        self.corner + Vec2::new(x as f32 + 0.5, -((self.top + y) as f32 + 0.5)) * self.pixel
    }

    /// Lower left and upper right corner, micrometres.
    pub(super) fn bounds(&self) -> (Vec2, Vec2) {
        let (top, bottom) = (self.top as f32, (self.top + self.rows) as f32);
        let low = self.corner - Vec2::new(0.0, bottom) * self.pixel;
        (low, self.corner + Vec2::new(self.columns as f32, -top) * self.pixel)
    }

    /// A place in pixels, (0, 0) at the centre of the first one.
    pub(super) fn locate(&self, place: Vec2) -> Vec2 {
        let from = (place - self.corner) / self.pixel;
        Vec2::new(from.x - 0.5, -from.y - 0.5 - self.top as f32)
    }

    /// Calls `visit` with index and place of each pixel whose centre lies in a box.
    pub(super) fn each_in(&self, low: Vec2, high: Vec2, mut visit: impl FnMut(usize, Vec2)) {
        let (first, last) = (self.locate(Vec2::new(low.x, high.y)), self.locate(Vec2::new(high.x, low.y)));
        let span = |first: f32, last: f32, count: usize| {
            let end = (last.floor() + 1.0).clamp(0.0, count as f32) as usize;
            ((first.ceil().clamp(0.0, count as f32) as usize).min(end), end)
        };
        let (left, right) = span(first.x, last.x, self.columns);
        let (top, bottom) = span(first.y, last.y, self.rows);
        for y in top..bottom {
            for x in left..right {
                visit(y * self.columns + x, self.place(x, y));
            }
        }
    }

    pub(super) fn len(&self) -> usize {
        self.columns * self.rows
    }
}

/// Matter on a grid.
#[derive(Clone, Debug)]
pub(super) struct Plate {
    pub grid: Grid,
    pub matter: Vec<Matter>,
}

impl Plate {
    pub(super) fn empty(grid: Grid) -> Self {
        Self { grid, matter: vec![Matter::NONE; grid.len()] }
    }

    /// Adds what `matter` says to the pixels whose centres lie in a box.
    pub(super) fn add(&mut self, low: Vec2, high: Vec2, matter: impl Fn(Vec2) -> Matter) {
        self.grid.each_in(low, high, |k, place| self.matter[k] += matter(place));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_covers_the_pixels_whose_centres_it_holds() {
        let grid = Grid { corner: Vec2::new(0.0, 4.0), pixel: 1.0, columns: 4, top: 0, rows: 4 };
        let mut plate = Plate::empty(grid);
        plate.add(Vec2::new(1.0, 2.0), Vec2::new(3.0, 9.0), |_| Matter::phase(1.0));
        let rows: Vec<f32> = plate.matter.iter().map(|m| m.phase).collect();
        assert_eq!(rows, [0., 1., 1., 0., 0., 1., 1., 0., 0., 0., 0., 0., 0., 0., 0., 0.]);
        plate.add(Vec2::new(90.0, 2.0), Vec2::new(95.0, 3.0), |_| Matter::phase(1.0));
        plate.add(Vec2::NAN, Vec2::NAN, |_| Matter::phase(1.0));
        plate.add(Vec2::splat(5.0), Vec2::splat(-5.0), |_| Matter::phase(1.0));
        assert_eq!(plate.matter.iter().map(|m| m.phase).sum::<f32>(), 4.0);
        assert_eq!(grid.locate(grid.place(2, 3)), Vec2::new(2.0, 3.0));
    }
}
