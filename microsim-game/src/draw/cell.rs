//! Textures, cilia and granules: the parts of cells that are more than plain areas (thesis, 3.2.1 and 3.2.2).

use super::atlas::Tile;
use super::canvas::Canvas;
use super::frame::SceneFrame;
use super::palette::{HALO, INK, chance, fade, mix, scene};
use super::plain::{area, sprite};
use crate::camera::Camera;
use macroquad::color::Color;
use microsim_core::drawing::shape::{Item, Paint};
use microsim_core::geometry::triangulate;
use microsim_core::glam::Vec2;
use microsim_core::{Form, OrganismView};
use std::f32::consts::TAU;

/// Radius of a sprite of cytoplasm or fluid in radii of its disc: sprites overlap into one body.
const CYTOPLASM_BLUR: f32 = 4.6;
const FLUID_BLUR: f32 = 2.1;
/// Speed at which fluid looks foamy, units/s.
const FOAM_SPEED: f32 = 60.0;
/// Hairs per particle of the outline, their length in units, the waves around the body and their pace, rad/s.
const HAIRS: usize = 3;
const HAIR_LENGTH: f32 = 0.9;
const WAVES: f32 = 7.0;
const BEAT: f64 = 9.0;

/// The body of a cell: a textured fan from the nucleus over the surface, or a plain area where there is no texture.
pub(super) fn paint_body(canvas: &mut Canvas, frame: &SceneFrame<'_>, item: &Item, points: &[Vec2]) {
    let owner = item.owner.and_then(|id| frame.view.organism(id));
    let textured = owner.and_then(|cell| Some((cell, tile(cell.drawn_look().form)?)));
    let Some((cell, tile)) = textured else {
        return canvas.fill(points, &triangulate(points), area(item));
    };
    let centre = frame.camera.to_screen(cell.nucleus().map_or_else(|| cell.centroid(), |nucleus| nucleus.position));
    if tile == Tile::Cell {
        paint_hairs(canvas, frame, points);
    }
    canvas.fan(centre, points, tile, tinted(item, cell));
    if cell.drawn_look().form == Form::RedCell {
        // It is thinner in its middle.
        canvas.sprite(centre, 0.62 * (points[0] - centre).length(), Tile::Soft, fade(HALO, 0.38));
    }
}

/// The inside of a cell.
fn tile(form: Form) -> Option<Tile> {
    match form {
        Form::Ciliate => Some(Tile::Cell),
        Form::Platelet | Form::RedCell => Some(Tile::Platelet),
        _ => None,
    }
}

/// The inner colour, a little different from one individual to the next.
fn tinted(item: &Item, cell: OrganismView<'_>) -> Color {
    let colour = match item.fill {
        Some(Paint::Radial { inner, .. }) => scene(inner),
        _ => area(item),
    };
    let tint = 0.98 + 0.12 * chance(cell.id().index() as usize);
    Color::new(colour.r * tint, colour.g * tint, colour.b * tint, area(item).a)
}

/// Cilia, beating in waves that run along the body.
fn paint_hairs(canvas: &mut Canvas, frame: &SceneFrame<'_>, surface: &[Vec2]) {
    let (count, length) = (surface.len(), HAIR_LENGTH * frame.camera.scale());
    let total = (count * HAIRS) as f32;
    let beat = (frame.view.time() * BEAT % f64::from(TAU)) as f32;
    for hair in 0..count * HAIRS {
        let (k, between) = (hair / HAIRS, (hair % HAIRS) as f32 / HAIRS as f32);
        let side = surface[(k + 1) % count] - surface[k];
        let root = surface[k] + side * between;
        let (along, out) = (side.normalize_or_zero(), side.perp().normalize_or_zero());
        let phase = hair as f32 / total * WAVES * TAU - beat;
        let tip = root + (out + along * (0.35 + 0.55 * phase.sin())) * length;
        let half = along * 0.7;
        let (base, end) = (fade(INK, 0.55), fade(INK, 0.05));
        canvas.quad([root - half, root + half, tip + half * 0.4, tip - half * 0.4], [base, base, end, end]);
    }
}

/// Soft spots that overlap into one body, and granules and vacuoles in it.
pub(super) fn paint_cytoplasm(canvas: &mut Canvas, camera: &Camera, discs: &[(Vec2, f32)], colour: Color) {
    discs.iter().for_each(|&disc| sprite(canvas, camera, disc, CYTOPLASM_BLUR, Tile::Soft, colour));
    for (k, &(centre, radius)) in discs.iter().enumerate() {
        let size = chance(k);
        let radius = (0.40 + 0.84 * size * size) * radius * camera.scale();
        let is_vacuole = chance(k + 7919) < 0.22;
        let colour = if is_vacuole { fade(HALO, 0.55) } else { fade(mix(colour, INK, 0.6), 0.20 + 0.30 * size) };
        canvas.sprite(camera.to_screen(centre), radius.max(0.8), Tile::Disc, colour);
    }
}

pub(super) fn paint_nucleus(canvas: &mut Canvas, camera: &Camera, discs: &[(Vec2, f32)], colour: Color) {
    for &disc in discs {
        sprite(canvas, camera, disc, 1.5, Tile::Soft, colour);
        sprite(canvas, camera, disc, 1.0, Tile::Disc, fade(colour, 0.7));
        let light = (disc.0 + Vec2::new(-0.25, 0.25) * disc.1, 0.7 * disc.1);
        sprite(canvas, camera, light, 1.0, Tile::Soft, fade(HALO, 0.35));
    }
}

/// Soft spots that overlap into one body; what flows fast is lighter.
pub(super) fn paint_fluid(canvas: &mut Canvas, frame: &SceneFrame<'_>, item: &Item, discs: &[(Vec2, f32)]) {
    let (camera, colour) = (frame.camera, area(item));
    discs.iter().for_each(|&disc| sprite(canvas, camera, disc, FLUID_BLUR, Tile::Soft, colour));
    let Some(owner) = item.owner.and_then(|id| frame.view.organism(id)) else { return };
    for (particle, &disc) in owner.particles().zip(discs) {
        let foam = (particle.velocity.length() / FOAM_SPEED).min(1.0);
        sprite(canvas, camera, disc, FLUID_BLUR, Tile::Soft, fade(mix(colour, HALO, 0.75), 0.30 * foam));
    }
}
