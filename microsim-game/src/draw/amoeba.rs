//! Amoeboid cells (seed, 3.2.2): a triangulated surface, cytoplasm as soft sprites on it, and the membrane.

use super::SceneFrame;
use super::atlas::Tile;
use super::canvas::Canvas;
use super::palette::{CELL_BODY, CYTOPLASM, GROWN, HALO, INK, chance, fade, mix};
use microsim_core::geometry::triangulate;
use microsim_core::glam::Vec2;
use microsim_core::{OrganismView, ParticleView, Role};

/// Radius of a cytoplasm sprite in particle radii: they overlap into one body.
const BLUR: f32 = 2.3;
/// Share of the outline that looks like a front.
const FRONT: f32 = 0.25;

pub(super) fn draw_halo(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let (outline, width) = membrane(frame, organism);
    let (bright, faint) = (fade(HALO, 0.75), fade(HALO, 0.45));
    let far = 4.0 * width + 3.0;
    canvas.band(&outline, &[(0.5 * width, bright), (1.6 * width + 1.0, faint), (far, fade(HALO, 0.0))]);
}

pub(super) fn draw(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let (outline, width) = membrane(frame, organism);
    let triangles = triangulate(&organism.outline().collect::<Vec<_>>());
    canvas.fill(&outline, &triangles, fade(CELL_BODY, 0.80));
    draw_cytoplasm(canvas, frame, organism);
    draw_phagosomes(canvas, frame, organism, width);
    draw_membrane(canvas, &outline, width);
    if let Some(front) = organism.front_index() {
        draw_front(canvas, &outline, front, width);
    }
}

/// Its outline and the radius of the discs on it, in picture pixels.
fn membrane(frame: &SceneFrame<'_>, organism: OrganismView<'_>) -> (Vec<Vec2>, f32) {
    let node = organism.particles().find(|particle| particle.role == Role::Membrane);
    let radius = node.map_or(0.5, |node| node.radius);
    (organism.outline().map(|point| frame.camera.to_screen(point)).collect(), radius * frame.camera.scale())
}

fn draw_cytoplasm(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    let camera = frame.camera;
    let is_fluid = |particle: &ParticleView| matches!(particle.role, Role::Cytoplasm | Role::GrownCytoplasm);
    for disc in organism.particles().filter(is_fluid) {
        let radius = BLUR * disc.radius * camera.scale();
        // What has grown shows how much the cell has eaten (T72).
        let colour = if disc.role == Role::GrownCytoplasm { GROWN } else { CYTOPLASM };
        canvas.sprite(camera.to_screen(disc.position), radius, Tile::Soft, fade(colour, 0.42));
    }
    for (k, disc) in organism.particles().filter(is_fluid).enumerate() {
        let size = chance(k);
        let radius = (0.20 + 0.42 * size * size) * disc.radius * camera.scale();
        let is_vacuole = chance(k + 7919) < 0.22;
        let colour = if is_vacuole { fade(HALO, 0.55) } else { fade(INK, 0.16 + 0.30 * size) };
        canvas.sprite(camera.to_screen(disc.position), radius.max(0.8), Tile::Disc, colour);
    }
}

/// Bright fluid around prey within a thin membrane of its own.
fn draw_phagosomes(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>, width: f32) {
    let (clear, dark) = (fade(INK, 0.0), fade(INK, 0.55));
    for (_, ring) in organism.phagosomes() {
        let triangles = triangulate(&ring);
        let ring: Vec<Vec2> = ring.iter().map(|&point| frame.camera.to_screen(point)).collect();
        canvas.fill(&ring, &triangles, fade(HALO, 0.15));
        canvas.band(
            &ring,
            &[(-0.4 * width - 0.8, clear), (-0.3 * width, dark), (0.3 * width, dark), (0.4 * width + 0.8, clear)],
        );
    }
}

fn draw_membrane(canvas: &mut Canvas, outline: &[Vec2], width: f32) {
    let (clear, dark) = (fade(INK, 0.0), fade(INK, 0.72));
    let (soft, glow) = (fade(mix(INK, CYTOPLASM, 0.5), 0.45), fade(HALO, 0.30));
    let inside = [(-2.2 * width, fade(HALO, 0.0)), (-width, glow), (-0.5 * width, soft), (0.5 * width, soft)];
    canvas.band(outline, &inside);
    let edge = [(0.2 * width - 0.8, clear), (0.55 * width, dark), (width, dark), (width + 0.9, clear)];
    canvas.band(outline, &edge);
}

/// A brighter edge where it advances, free of granules.
fn draw_front(canvas: &mut Canvas, outline: &[Vec2], front: usize, width: f32) {
    let count = outline.len();
    let half = (0.5 * FRONT * count as f32) as usize;
    let middle = outline.iter().sum::<Vec2>() / count as f32;
    for k in 0..=2 * half {
        let at = outline[(front + count - half + k) % count];
        let share = 1.0 - (k as f32 - half as f32).abs() / (half as f32 + 1.0);
        let inward = (middle - at).normalize_or_zero();
        let radius = (1.6 + 2.6 * share) * width;
        canvas.sprite(at + inward * radius, radius, Tile::Soft, fade(HALO, 0.40 * share));
    }
}
