//! Things made of single discs: agar, probes, fluid, and bodies that the library does not know.

use super::SceneFrame;
use super::atlas::Tile;
use super::canvas::Canvas;
use super::palette::{AGAR, COCCUS, CUSTOM, FLUID, HALO, INK, PROBE, fade, mix};
use microsim_core::glam::Vec2;
use microsim_core::{OrganismView, Role};

/// Radius of a fluid sprite in particle radii: they overlap into one body.
const BLUR: f32 = 2.4;
/// Speed at which fluid looks foamy, units/s.
const FOAM_SPEED: f32 = 60.0;

/// Discs of an organism in picture pixels.
fn discs(frame: &SceneFrame<'_>, organism: OrganismView<'_>) -> impl Iterator<Item = (Vec2, f32, Role)> {
    let camera = frame.camera;
    organism.particles().map(|disc| (camera.to_screen(disc.position), disc.radius * camera.scale(), disc.role))
}

pub(super) fn draw_halo(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    for (at, radius, _) in discs(frame, organism).filter(|(_, radius, _)| *radius > 0.0) {
        canvas.sprite(at, 1.5 * radius + 3.0, Tile::Soft, fade(HALO, 0.9));
    }
}

pub(super) fn draw_agar(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    for (at, radius, _) in discs(frame, organism) {
        canvas.sprite(at, radius + 0.5, Tile::Disc, fade(mix(AGAR, INK, 0.55), 0.9));
        canvas.sprite(at, 0.86 * radius, Tile::Disc, AGAR);
        canvas.sprite(at + Vec2::new(-0.25, -0.3) * radius, 0.55 * radius, Tile::Soft, fade(HALO, 0.9));
    }
}

/// Bacteria, round or rods: dark bodies with a bright middle. The discs of a rod run into each other.
pub(super) fn draw_bacterium(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    for (at, radius, _) in discs(frame, organism) {
        canvas.sprite(at, radius + 0.5, Tile::Disc, mix(COCCUS, INK, 0.7));
    }
    for (at, radius, _) in discs(frame, organism) {
        canvas.sprite(at, 0.8 * radius, Tile::Disc, COCCUS);
    }
    for (at, radius, _) in discs(frame, organism) {
        canvas.sprite(at, 0.6 * radius, Tile::Soft, fade(HALO, 0.55));
    }
}

pub(super) fn draw_probe(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    for (at, radius, _) in discs(frame, organism) {
        canvas.sprite(at + 0.18 * radius, 1.25 * radius, Tile::Soft, fade(INK, 0.5));
        canvas.sprite(at, radius, Tile::Disc, mix(PROBE, INK, 0.6));
        canvas.sprite(at, 0.92 * radius, Tile::Disc, PROBE);
        canvas.sprite(at, 0.55 * radius, Tile::Soft, fade(INK, 0.6));
        canvas.sprite(at + Vec2::new(-0.35, -0.4) * radius, 0.5 * radius, Tile::Soft, fade(HALO, 0.75));
    }
}

pub(super) fn draw_fluid(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    for (at, radius, _) in discs(frame, organism) {
        canvas.sprite(at, BLUR * radius, Tile::Soft, fade(FLUID, 0.5));
    }
    // What flows fast is lighter.
    for disc in organism.particles() {
        let foam = (disc.velocity.length() / FOAM_SPEED).min(1.0);
        let (at, radius) = (frame.camera.to_screen(disc.position), disc.radius * frame.camera.scale());
        canvas.sprite(at, 1.9 * radius, Tile::Soft, fade(mix(FLUID, HALO, 0.75), 0.30 * foam));
        canvas.sprite(at, 1.2 * radius, Tile::Soft, fade(mix(FLUID, INK, 0.5), 0.16));
    }
}

pub(super) fn draw_discs(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let solid = |(_, radius, _): &(Vec2, f32, Role)| *radius > 0.0;
    for (at, radius, _) in discs(frame, organism).filter(solid) {
        canvas.sprite(at, radius, Tile::Disc, mix(CUSTOM, INK, 0.65));
    }
    for (at, radius, role) in discs(frame, organism).filter(solid) {
        let colour = if role == Role::Nucleus { mix(CUSTOM, INK, 0.35) } else { CUSTOM };
        canvas.sprite(at, (radius - 1.2).max(0.6 * radius), Tile::Disc, colour);
        canvas.sprite(at - 0.25 * radius, 0.6 * radius, Tile::Soft, fade(HALO, 0.55));
    }
    for (at, ..) in discs(frame, organism).filter(|disc| !solid(disc)) {
        canvas.sprite(at, 2.0, Tile::Disc, fade(INK, 0.6));
    }
}
