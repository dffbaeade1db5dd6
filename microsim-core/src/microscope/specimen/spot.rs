//! Small things: round spots and thin threads.

use crate::look::SpotShape;
use crate::microscope::formula::Formula;
use crate::microscope::maths::{bell, larger, smoothstep};
use crate::microscope::matter::{Matter, Plate};
use crate::microscope::recipe::{Program, QUAD, Slide};
use glam::Vec2;

pub(in crate::microscope) const SPOT: Formula = Formula { source: include_str!("spot.glsl"), constants: &[] };
pub(in crate::microscope) const THREAD: Formula = Formula { source: include_str!("thread.glsl"), constants: &[] };

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

impl Spot {
    /// A square for [`SPOT`].
    pub(super) fn draw_on(&self, slide: &mut Slide) {
        if !slide.sees(self.at, 2.0 * self.radius) {
            return;
        }
        let (is_less, matter) = magnitude(self.matter);
        let shape = match self.shape {
            SpotShape::Bump => 0.0,
            SpotShape::Ball => 1.0,
            SpotShape::Ring => 2.0,
        };
        let [phase, haemoglobin, cytoplasm, nucleus] = matter.to_array();
        let vertices = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| [self.at.x, self.at.y, x, y, self.radius, shape, phase, haemoglobin, cytoplasm, nucleus]);
        slide.add(Program::Spot, is_less, vertices.as_flattened(), QUAD);
    }

    /// Adds the spot to a plate. What is smaller than a pixel is spread over one and loses no matter.
    pub(super) fn draw(&self, plate: &mut Plate) {
        let blur = 0.7 * plate.grid.pixel;
        let radius = (self.radius * self.radius + blur * blur).sqrt();
        let matter = self.matter * (self.radius * self.radius / (radius * radius));
        let reach = Vec2::splat(radius * if self.shape == SpotShape::Ring { 1.8 } else { 1.25 });
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
        };
        plate.add(self.at - reach, self.at + reach, |p| matter * profile((p - self.at).length() / radius));
    }
}

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

    /// A quadrangle for [`THREAD`].
    pub(super) fn draw_on(&self, slide: &mut Slide) {
        if !slide.sees(self.from, (self.to - self.from).length() + 2.0 * self.radius) {
            return;
        }
        let (is_less, matter) = magnitude(self.matter);
        let Self { from, to, radius, peak, .. } = *self;
        let [phase, haemoglobin, cytoplasm, nucleus] = matter.to_array();
        let vertices = [[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]]
            .map(|[x, y]| [from.x, from.y, to.x, to.y, x, y, radius, peak, phase, haemoglobin, cytoplasm, nucleus]);
        slide.add(Program::Thread, is_less, vertices.as_flattened(), QUAD);
    }

    pub(super) fn draw(&self, plate: &mut Plate) {
        let blur = 0.7 * plate.grid.pixel;
        let radius = (self.radius * self.radius + blur * blur).sqrt();
        let matter = self.matter * (self.radius / radius);
        let reach = Vec2::splat(2.0 * radius);
        let way = self.to - self.from;
        let per_length = 1.0 / larger(way.length_squared(), 1e-12);
        plate.add(self.from.min(self.to) - reach, self.from.max(self.to) + reach, |p| {
            let along = ((p - self.from).dot(way) * per_length).clamp(0.0, 1.0);
            let apart = (p - self.from - way * along).length() / radius;
            let share = if along < self.peak { along / self.peak } else { (1.0 - along) / (1.0 - self.peak) };
            matter * (bell(apart) * share)
        });
    }
}

/// Whether matter is rather missing than there, and how much: what is drawn adds to the rest or is taken from it.
fn magnitude(matter: Matter) -> (bool, Matter) {
    if matter.phase < 0.0 { (true, matter * -1.0) } else { (false, matter) }
}
