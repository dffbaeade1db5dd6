//! Thin straight threads: fibres, cilia, canals.

use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{bell, larger};
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::recipe::{DrawList, Program, QUAD};
use glam::Vec2;

pub(in crate::microscope) const GLSL: Glsl = Glsl { source: bare_text!("thread.glsl", "//"), constants: &[] };

/// A thin straight thread.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thread {
    pub from: Vec2,
    pub to: Vec2,
    /// Half its width, micrometres.
    pub radius: f32,
    /// Where it is thickest; it thins out towards its ends.
    pub matter: Matter,
    /// Where that is: 0 at `from`, less than 1.
    pub peak: f32,
}

impl Thread {
    /// A curve through points, thinning out at its last: threads that run into each other, each thickest at a point.
    pub(super) fn curve(points: &[Vec2], radius: impl Fn(usize) -> f32, matter: Matter) -> impl Iterator<Item = Self> {
        let thread = move |k: usize| {
            let (from, to) = (points[k.saturating_sub(1)], points[k + 1]);
            Self { from, to, radius: radius(k), matter, peak: if k == 0 { 0.0 } else { 0.5 } }
        };
        (0..points.len().saturating_sub(1)).map(thread)
    }

    /// A quadrangle for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList) {
        if !draws.sees(self.from, (self.to - self.from).length() + 2.0 * self.radius) {
            return;
        }
        let (is_less, matter) = self.matter.magnitude();
        let Self { from, to, radius, peak, .. } = *self;
        let [phase, haemoglobin, cytoplasm, nucleus] = matter.to_array();
        let vertices = [[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]]
            .map(|[x, y]| [from.x, from.y, to.x, to.y, x, y, radius, peak, phase, haemoglobin, cytoplasm, nucleus]);
        draws.add(Program::Thread, is_less, vertices.as_flattened(), QUAD);
    }

    pub(super) fn draw(&self, raster: &mut MatterRaster) {
        let blur = 0.7 * raster.grid.pixel;
        let radius = (self.radius * self.radius + blur * blur).sqrt();
        let matter = self.matter * (self.radius / radius);
        let extent = Vec2::splat(2.0 * radius);
        let axis = self.to - self.from;
        let per_length = 1.0 / larger(axis.length_squared(), 1e-12);
        raster.add(self.from.min(self.to) - extent, self.from.max(self.to) + extent, |p| {
            let along = ((p - self.from).dot(axis) * per_length).clamp(0.0, 1.0);
            let apart = (p - self.from - axis * along).length() / radius;
            let share = if along < self.peak { along / self.peak } else { (1.0 - along) / (1.0 - self.peak) };
            matter * (bell(apart) * share)
        });
    }
}
