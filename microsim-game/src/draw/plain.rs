//! Items as plain areas and lines.

use super::atlas::Tile;
use super::canvas::{Canvas, Rim};
use super::palette::{fade, scene};
use crate::camera::Camera;
use macroquad::color::Color;
use microsim_core::drawing::shape::{Geometry, Item, Paint, Stroke};
use microsim_core::geometry::triangulate;
use microsim_core::glam::Vec2;

/// The colour of an item's area, at its edge.
pub(super) fn area(item: &Item) -> Color {
    match item.fill {
        Some(Paint::Flat(colour)) => scene(colour),
        Some(Paint::Radial { outer, .. }) => scene(outer),
        None => Color::default(),
    }
}

/// Points in picture pixels.
pub(super) fn placed(points: &[Vec2], camera: &Camera) -> Vec<Vec2> {
    points.iter().map(|&point| camera.to_screen(point)).collect()
}

/// A sprite at a disc, `scale` times as large.
pub(super) fn sprite(
    canvas: &mut Canvas,
    camera: &Camera,
    (centre, radius): (Vec2, f32),
    scale: f32,
    tile: Tile,
    colour: Color,
) {
    canvas.sprite(camera.to_screen(centre), scale * radius * camera.scale(), tile, colour);
}

/// An item as a plain area with a plain line.
pub(super) fn paint(canvas: &mut Canvas, camera: &Camera, item: &Item) {
    match &item.geometry {
        Geometry::Discs(discs) => discs.iter().for_each(|&disc| paint_disc(canvas, camera, item, disc)),
        Geometry::Outline(points) => paint_path(canvas, camera, item, &placed(points, camera), true),
        Geometry::Curve(points) => paint_path(canvas, camera, item, &placed(points, camera), false),
        Geometry::Polygons(paths) | Geometry::Lines(paths) => {
            let is_closed = matches!(item.geometry, Geometry::Polygons(_));
            paths.iter().for_each(|points| paint_path(canvas, camera, item, &placed(points, camera), is_closed));
        }
    }
}

fn paint_disc(canvas: &mut Canvas, camera: &Camera, item: &Item, disc: (Vec2, f32)) {
    if item.fill.is_some() {
        sprite(canvas, camera, disc, 1.0, Tile::Disc, area(item));
    }
    if let Some(Paint::Radial { inner, .. }) = item.fill {
        sprite(canvas, camera, disc, 1.0, Tile::Soft, scene(inner));
    }
    if let Some(stroke) = item.stroke {
        let width = (stroke.width * camera.scale()).max(1.0);
        canvas.circle(camera.to_screen(disc.0), disc.1 * camera.scale(), width, scene(stroke.colour));
    }
}

/// A closed or open line in picture pixels, and the area within it.
pub(super) fn paint_path(canvas: &mut Canvas, camera: &Camera, item: &Item, points: &[Vec2], is_closed: bool) {
    if item.fill.is_some() {
        canvas.fill(points, &triangulate(points), area(item));
    }
    match item.stroke {
        Some(stroke) if is_closed => canvas.band(points, &rims(stroke, camera)),
        Some(stroke) => canvas.line(points, &rims(stroke, camera)),
        None => {}
    }
}

/// A line of the stroke's width, at least a pixel, with soft edges.
fn rims(stroke: Stroke, camera: &Camera) -> [Rim; 4] {
    let (half, colour) = ((0.5 * stroke.width * camera.scale()).max(0.5), scene(stroke.colour));
    let clear = fade(colour, 0.0);
    [(-half - 0.8, clear), (-half, colour), (half, colour), (half + 0.8, clear)]
}
