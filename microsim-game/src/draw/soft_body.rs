//! Soft bodies (seed, 3.2.1): a fan from the nucleus over the pushed-out outline, textured, and the nucleus on its own.

use super::SceneFrame;
use super::atlas::Tile;
use super::canvas::Canvas;
use super::palette::{HALO, INK, NUCLEUS, PLATELET, RED_CELL, RIGID, chance, fade};
use macroquad::color::Color;
use microsim_core::OrganismView;
use microsim_core::glam::Vec2;
use std::f32::consts::TAU;

/// Hairs per body of the outline, their length in units, the waves around the body and their pace, rad/s.
const HAIRS: usize = 3;
const HAIR_LENGTH: f32 = 0.9;
const WAVES: f32 = 7.0;
const BEAT: f64 = 9.0;

pub(super) fn draw_halo(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let Some(body) = SoftOutline::of(frame, organism) else { return };
    let width = 3.0 + 0.4 * frame.camera.scale();
    let (bright, faint) = (fade(HALO, 0.80), fade(HALO, 0.40));
    canvas.band(&body.surface, &[(-0.5, bright), (0.4 * width, faint), (width, fade(HALO, 0.0))]);
}

pub(super) fn draw_rigid_cell(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let Some(body) = SoftOutline::of(frame, organism) else { return };
    body.draw_hairs(canvas, frame);
    canvas.fan(body.centre, &body.surface, Tile::Cell, fade(RIGID, 0.96));
    body.draw_rim(canvas, 0.75);
    if let Some(nucleus) = organism.nucleus() {
        let (at, radius) = (frame.camera.to_screen(nucleus.position), nucleus.radius * frame.camera.scale());
        canvas.sprite(at, 1.5 * radius, Tile::Soft, fade(NUCLEUS, 0.55));
        canvas.sprite(at, radius, Tile::Disc, fade(NUCLEUS, 0.70));
        canvas.sprite(at - 0.25 * radius, 0.7 * radius, Tile::Soft, fade(HALO, 0.35));
    }
    if let Some(&front) = organism.front_index().and_then(|front| body.surface.get(front)) {
        let radius = 0.16 * (front - body.centre).length();
        let inside = front.lerp(body.centre, 0.16);
        canvas.sprite(inside, 1.5 * radius, Tile::Soft, fade(HALO, 0.95));
        canvas.sprite(inside, 0.45 * radius, Tile::Disc, fade(NUCLEUS, 0.75));
    }
}

/// A disc that is thinner in its middle.
pub(super) fn draw_red_cell(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let Some(body) = SoftOutline::of(frame, organism) else { return };
    canvas.fan(body.centre, &body.surface, Tile::Platelet, tinted(RED_CELL, organism));
    let size = (body.surface[0] - body.centre).length();
    canvas.sprite(body.centre, 0.62 * size, Tile::Soft, fade(HALO, 0.38));
    body.draw_rim(canvas, 0.40);
}

/// A colour that differs a little from one individual to the next.
fn tinted(colour: Color, organism: OrganismView<'_>) -> Color {
    let tint = 0.92 + 0.12 * chance(organism.id().index() as usize);
    Color::new(colour.r * tint, colour.g * tint, colour.b * tint, 0.93)
}

pub(super) fn draw_platelet(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let Some(body) = SoftOutline::of(frame, organism) else { return };
    let size = (body.surface[0] - body.centre).length();
    canvas.fan(body.centre, &body.surface, Tile::Platelet, tinted(PLATELET, organism));
    body.draw_rim(canvas, 0.45);
    if let Some(nucleus) = organism.nucleus() {
        canvas.sprite(frame.camera.to_screen(nucleus.position), 0.20 * size, Tile::Soft, fade(NUCLEUS, 0.40));
    }
}

/// What the picture shows of a soft body, in picture pixels.
struct SoftOutline {
    centre: Vec2,
    surface: Vec<Vec2>,
}

impl SoftOutline {
    fn of(frame: &SceneFrame<'_>, organism: OrganismView<'_>) -> Option<Self> {
        let surface: Vec<Vec2> = organism.surface().iter().map(|&point| frame.camera.to_screen(point)).collect();
        let centre = organism.nucleus().map_or_else(|| organism.centroid(), |nucleus| nucleus.position);
        (!surface.is_empty()).then(|| Self { centre: frame.camera.to_screen(centre), surface })
    }

    fn draw_rim(&self, canvas: &mut Canvas, strength: f32) {
        let clear = fade(INK, 0.0);
        let dark = fade(INK, strength);
        canvas.band(&self.surface, &[(-2.6, clear), (-0.9, dark), (-0.1, dark), (0.9, clear)]);
    }

    /// Cilia, beating in waves that run along the body.
    fn draw_hairs(&self, canvas: &mut Canvas, frame: &SceneFrame<'_>) {
        let (count, length) = (self.surface.len(), HAIR_LENGTH * frame.camera.scale());
        let total = (count * HAIRS) as f32;
        let beat = (frame.view.time() * BEAT % f64::from(TAU)) as f32;
        for hair in 0..count * HAIRS {
            let (k, between) = (hair / HAIRS, (hair % HAIRS) as f32 / HAIRS as f32);
            let side = self.surface[(k + 1) % count] - self.surface[k];
            let root = self.surface[k] + side * between;
            let (along, out) = (side.normalize_or_zero(), side.perp().normalize_or_zero());
            let phase = hair as f32 / total * WAVES * TAU - beat;
            let tip = root + (out + along * (0.35 + 0.55 * phase.sin())) * length;
            let half = along * 0.7;
            let (base, end) = (fade(INK, 0.55), fade(INK, 0.05));
            canvas.quad([root - half, root + half, tip + half * 0.4, tip - half * 0.4], [base, base, end, end]);
        }
    }
}
