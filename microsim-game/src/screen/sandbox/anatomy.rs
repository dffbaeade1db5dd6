//! The debug view: chemicals, particles, constraints, contacts and the regions of crawling membranes.

use crate::camera::Camera;
use crate::draw::canvas::Canvas;
use crate::draw::palette::{ALERT, HALO, INK, READY, WAIT, fade};
use crate::hud::tint;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use macroquad::color::Color;
use microsim_core::glam::Vec2;
use microsim_core::{Bond, Constraint, MembraneRegion, OrganismView, View};

/// Draws a world's anatomy over its picture.
pub(super) fn draw(pen: &mut Pen, view: View<'_>, camera: &Camera) {
    let screen = pen.screen();
    let canvas = pen.canvas();
    canvas.rectangle(Vec2::ZERO, screen, fade(INK, 0.55));
    for ((_, chemical), colour) in view.chemicals().zip([READY, ALERT, WAIT].into_iter().cycle()) {
        tint::draw_chemical(canvas, camera, chemical, colour, 0.2);
    }
    for (bond, ends) in view.bonds() {
        let (width, colour) = stroke(bond);
        draw_segment(canvas, camera, ends, width, colour);
    }
    for organism in view.organisms() {
        draw_particles(canvas, camera, organism);
        draw_regions(canvas, camera, organism);
    }
    for ends in view.contacts() {
        draw_segment(canvas, camera, ends, 2.4, ALERT);
    }
    draw_legend(pen);
}

fn stroke(bond: Bond<'_>) -> (f32, Color) {
    match bond {
        Bond::Membrane => (1.6, HALO),
        Bond::Joint(_) => (1.6, READY),
        Bond::Constraint(Constraint::Anchor(_)) => (2.0, WAIT),
        Bond::Constraint(Constraint::Rope(_)) => (0.6, fade(WAIT, 0.6)),
        Bond::Constraint(Constraint::MinDistance(_) | Constraint::Area(_)) => (0.6, fade(HALO, 0.3)),
        Bond::Constraint(_) => (1.0, fade(HALO, 0.75)),
    }
}

fn draw_segment(canvas: &mut Canvas, camera: &Camera, ends: [Vec2; 2], width: f32, colour: Color) {
    let [from, to] = ends.map(|end| camera.to_screen(end));
    let is_seen = from.max(to).cmpge(Vec2::ZERO).all() && from.min(to).cmple(camera.screen()).all();
    if is_seen {
        canvas.segment(from, to, width, colour);
    }
}

fn draw_particles(canvas: &mut Canvas, camera: &Camera, organism: OrganismView<'_>) {
    for particle in organism.particles() {
        let (at, radius) = (camera.to_screen(particle.position), particle.radius * camera.scale());
        let is_seen = at.cmpge(-Vec2::splat(radius)).all() && at.cmple(camera.screen() + radius).all();
        if is_seen && radius > 0.0 {
            canvas.circle(at, radius, 1.0, fade(HALO, 0.5));
        }
    }
}

/// Nodes of a crawling membrane: squares in front, bars behind, and dots on the left and hollow dots on the right.
fn draw_regions(canvas: &mut Canvas, camera: &Camera, organism: OrganismView<'_>) {
    let Some(regions) = organism.membrane_regions() else { return };
    for (region, at) in regions.into_iter().zip(organism.outline()) {
        let at = camera.to_screen(at);
        match region {
            MembraneRegion::Front => canvas.rectangle(at - 3.0, at + 3.0, READY),
            MembraneRegion::Rear => canvas.rectangle(at - Vec2::new(4.0, 1.2), at + Vec2::new(4.0, 1.2), ALERT),
            MembraneRegion::LeftWing => canvas.circle(at, 1.5, 3.0, WAIT),
            MembraneRegion::RightWing => canvas.circle(at, 2.5, 1.0, WAIT),
        }
    }
}

/// What the strokes mean.
fn draw_legend(pen: &mut Pen) {
    let line = pen.line(TextSize::Small);
    let legend = words::text(Key::SandboxLegend);
    let widest = legend.lines().map(|entry| pen.width(TextSize::Small, entry)).fold(0.0, f32::max);
    let low = Vec2::new(pen.screen().x - widest - 1.3 * line, 1.6 * line);
    pen.panel(low, low + Vec2::new(widest + 0.8 * line, 1.2 * line * legend.lines().count() as f32));
    for (k, entry) in legend.lines().enumerate() {
        let at = low + line * Vec2::new(0.4, 0.6 + 1.2 * k as f32);
        pen.write(at, TextSize::Small, Align::Left, HALO, entry);
    }
}
