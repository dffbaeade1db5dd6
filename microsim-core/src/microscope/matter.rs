//! What light meets: how much a place of the specimen delays it and how much of what dyes it there is.

use super::glsl::Glsl;
use super::raster::PixelGrid;
use crate::bare_text::bare_text;
pub(super) use crate::look::Matter;
use glam::Vec2;

pub(super) const GLSL: Glsl = Glsl { source: bare_text!("matter.glsl", "//"), constants: &[] };

/// Matter on a grid.
#[derive(Clone, Debug)]
pub(super) struct MatterRaster {
    pub grid: PixelGrid,
    pub matter: Vec<Matter>,
}

impl MatterRaster {
    pub(super) fn empty(grid: PixelGrid) -> Self {
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
        let grid = PixelGrid { corner: Vec2::new(0.0, 4.0), pixel: 1.0, columns: 4, top: 0, rows: 4 };
        let mut raster = MatterRaster::empty(grid);
        raster.add(Vec2::new(1.0, 2.0), Vec2::new(3.0, 9.0), |_| Matter::phase(1.0));
        let rows: Vec<f32> = raster.matter.iter().map(|m| m.phase).collect();
        assert_eq!(rows, [0., 1., 1., 0., 0., 1., 1., 0., 0., 0., 0., 0., 0., 0., 0., 0.]);
        raster.add(Vec2::new(90.0, 2.0), Vec2::new(95.0, 3.0), |_| Matter::phase(1.0));
        raster.add(Vec2::NAN, Vec2::NAN, |_| Matter::phase(1.0));
        raster.add(Vec2::splat(5.0), Vec2::splat(-5.0), |_| Matter::phase(1.0));
        assert_eq!(raster.matter.iter().map(|m| m.phase).sum::<f32>(), 4.0);
    }
}
