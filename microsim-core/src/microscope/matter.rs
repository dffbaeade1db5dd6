//! What light meets: how much a place of the specimen delays it and how much of what dyes it there is.

use super::glsl::Glsl;
use super::raster::PixelGrid;
use glam::Vec2;
use std::ops::{AddAssign, Mul};

pub(super) const GLSL: Glsl = Glsl { source: include_str!("matter.glsl"), constants: &[] };

/// What lies in the light's way at one place; amounts of things that lie over each other add up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Matter {
    /// Delay of the light relative to the medium, radians at 0.55 micrometres; negative where it is thinner.
    pub phase: f32,
    /// Haemoglobin, 1 in the thickest part of a red cell.
    pub haemoglobin: f32,
    /// What eosin stains, 1 in a neutrophil's body.
    pub cytoplasm: f32,
    /// What basic dyes and nucleic acid probes stain, 1 in a nucleus.
    pub nucleus: f32,
}

impl Matter {
    pub(super) const NONE: Self = Self { phase: 0.0, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.0 };

    /// As a graphics card keeps it.
    pub(super) fn to_array(self) -> [f32; 4] {
        [self.phase, self.haemoglobin, self.cytoplasm, self.nucleus]
    }

    /// Whether matter is missing rather than there, and how much: it adds to a target or is taken from it.
    pub(super) fn magnitude(self) -> (bool, Self) {
        if self.phase < 0.0 { (true, self * -1.0) } else { (false, self) }
    }

    /// Nothing but a delay.
    pub(super) const fn phase(phase: f32) -> Self {
        Self { phase, ..Self::NONE }
    }
}

impl Mul<f32> for Matter {
    type Output = Self;

    fn mul(self, share: f32) -> Self {
        Self {
            phase: self.phase * share,
            haemoglobin: self.haemoglobin * share,
            cytoplasm: self.cytoplasm * share,
            nucleus: self.nucleus * share,
        }
    }
}

impl AddAssign for Matter {
    fn add_assign(&mut self, other: Self) {
        self.phase += other.phase;
        self.haemoglobin += other.haemoglobin;
        self.cytoplasm += other.cytoplasm;
        self.nucleus += other.nucleus;
    }
}

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
