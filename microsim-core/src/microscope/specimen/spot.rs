//! Small round things: granules, vacuoles, dust.

use crate::bare_text::bare_text;
use crate::look::SpotShape;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{bell, larger, smoothstep};
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::recipe::{DrawList, Program, QUAD};
use glam::Vec2;

pub(in crate::microscope) const GLSL: Glsl =
    Glsl { source: bare_text!("spot.glsl", "//"), constants: &[("DAMPING", &[DAMPING]), ("LAG", &[LAG])] };

/// Decay of the rings of a thing out of focus, and the phase with which they begin.
const DAMPING: f32 = 1.25;
const LAG: f32 = 1.0;

/// A small round thing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub at: Vec2,
    /// Micrometres.
    pub radius: f32,
    /// Where it is thickest.
    pub matter: Matter,
    pub shape: SpotShape,
}

/// Micrometres by which what lies out of focus is wider for each unit of the chirp of its rings.
const WIDER: f32 = 0.08;

impl Spot {
    /// The same matter above or below the plane of focus.
    pub(super) fn out_of_focus(self, chirp: f32) -> Self {
        let radius = self.radius + WIDER * chirp;
        Self { radius, matter: self.matter * (self.radius / radius), shape: SpotShape::Defocused(chirp), ..self }
    }

    /// A square for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList) {
        if !draws.sees(self.at, 2.0 * self.radius) {
            return;
        }
        let (is_less, matter) = self.matter.magnitude();
        let shape = match self.shape {
            SpotShape::Bump => 0.0,
            SpotShape::Ball => 1.0,
            SpotShape::Ring => 2.0,
            SpotShape::Defocused(_) => 3.0,
        };
        let [phase, haemoglobin, cytoplasm, nucleus] = matter.to_array();
        let chirp = if let SpotShape::Defocused(chirp) = self.shape { chirp } else { 0.0 };
        let Self { at, radius, .. } = *self;
        let mut draw = |shape: f32, is_less: bool| {
            let vertices = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[x, y]| [at.x, at.y, x, y, radius, shape, chirp, phase, haemoglobin, cytoplasm, nucleus]);
            draws.add(Program::Spot, is_less, vertices.as_flattened(), QUAD);
        };
        draw(shape, is_less);
        // A card adds or subtracts: the other half of the rings is drawn on its own.
        if chirp != 0.0 {
            draw(-shape, !is_less);
        }
    }

    /// Adds the spot to a raster. What is smaller than a pixel is spread over one and loses no matter.
    pub(super) fn draw(&self, raster: &mut MatterRaster) {
        let blur = 0.7 * raster.grid.pixel;
        let radius = (self.radius * self.radius + blur * blur).sqrt();
        let matter = self.matter * (self.radius * self.radius / (radius * radius));
        let extent = Vec2::splat(radius * extent(self.shape));
        let softness = larger(blur / radius, 0.08);
        let profile = |rho: f32| match self.shape {
            SpotShape::Bump => {
                let inside = 1.0 - rho * rho / (1.25 * 1.25);
                if inside > 0.0 { inside * inside } else { 0.0 }
            }
            SpotShape::Ball => {
                let inside = 1.0 - rho * rho / ((1.0 + softness) * (1.0 + softness));
                if inside > 0.0 { inside.sqrt() * smoothstep(1.0 + softness, 1.0 - softness, rho) } else { 0.0 }
            }
            SpotShape::Ring => bell((rho - 1.2) / 0.25),
            SpotShape::Defocused(chirp) => bell(DAMPING * rho) * libm::cosf(chirp * rho * rho - LAG),
        };
        raster.add(self.at - extent, self.at + extent, |p| matter * profile((p - self.at).length() / radius));
    }
}

/// How far a spot reaches, in radii.
fn extent(shape: SpotShape) -> f32 {
    match shape {
        SpotShape::Bump | SpotShape::Ball => 1.25,
        SpotShape::Ring | SpotShape::Defocused(_) => 1.8,
    }
}
