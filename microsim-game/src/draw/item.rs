//! Paints the items of a drawing as triangles: some parts in a way of their own, all others as plain areas and lines.

use super::SceneFrame;
use super::atlas::Tile;
use super::canvas::{Canvas, Rim};
use super::cell;
use super::palette::{HALO, fade, scene};
use crate::camera::Camera;
use macroquad::color::Color;
use microsim_core::drawing::shape::{Item, Paint, Part, Shape, Stroke};
use microsim_core::geometry::triangulate;
use microsim_core::glam::Vec2;
use std::f32::consts::TAU;

/// Sides of a round obstacle.
const ROUND: usize = 64;
/// Radius of a soft spot in radii of the disc that it stands for: it fades out to its rim.
const SOFT: f32 = 2.5;

pub(super) fn paint(canvas: &mut Canvas, frame: &SceneFrame<'_>, item: &Item) {
    let camera = frame.camera;
    match (item.part, &item.shape) {
        (Part::Body, Shape::Outline(points)) => cell::paint_body(canvas, frame, item, &placed(points, camera)),
        (Part::Cytoplasm | Part::GrownCytoplasm, Shape::Discs(discs)) => {
            cell::paint_cytoplasm(canvas, camera, discs, area(item));
        }
        (Part::Nucleus, Shape::Discs(discs)) => cell::paint_nucleus(canvas, camera, discs, area(item)),
        (Part::Fluid, Shape::Discs(discs)) => cell::paint_fluid(canvas, frame, item, discs),
        (Part::Halo, Shape::Outline(points)) => paint_halo(canvas, item, &placed(points, camera), camera),
        (Part::Spot, Shape::Discs(discs)) if item.stroke.is_none() => {
            discs.iter().for_each(|&disc| sprite(canvas, camera, disc, SOFT, Tile::Soft, area(item)));
        }
        (Part::ObstacleRim | Part::Obstacle, shape) => {
            outlines(shape, camera).iter().for_each(|outline| paint_outline(canvas, camera, item, outline));
        }
        (Part::Border, _) => paint_border(canvas, camera, line(item)),
        _ => paint_plain(canvas, camera, item),
    }
}

/// The colour of an item's area, at its edge.
pub(super) fn area(item: &Item) -> Color {
    match item.fill {
        Some(Paint::Flat(colour)) => scene(colour),
        Some(Paint::Radial { outer, .. }) => scene(outer),
        None => Color::default(),
    }
}

fn line(item: &Item) -> Color {
    item.stroke.map_or(Color::default(), |stroke| scene(stroke.colour))
}

/// Points in picture pixels.
fn placed(points: &[Vec2], camera: &Camera) -> Vec<Vec2> {
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

/// The closed lines of an obstacle, in picture pixels.
fn outlines(shape: &Shape, camera: &Camera) -> Vec<Vec<Vec2>> {
    let around = |k: usize| Vec2::from_angle(k as f32 / ROUND as f32 * TAU);
    match shape {
        Shape::Discs(discs) => {
            let outline = |&(centre, radius): &(Vec2, f32)| {
                (0..ROUND).map(|k| camera.to_screen(centre + around(k) * radius)).collect()
            };
            discs.iter().map(outline).collect()
        }
        Shape::Polygons(polygons) => polygons.iter().map(|points| placed(points, camera)).collect(),
        _ => Vec::new(),
    }
}

fn paint_plain(canvas: &mut Canvas, camera: &Camera, item: &Item) {
    match &item.shape {
        Shape::Discs(discs) => discs.iter().for_each(|&disc| paint_disc(canvas, camera, item, disc)),
        Shape::Outline(points) => paint_outline(canvas, camera, item, &placed(points, camera)),
        Shape::Polygons(polygons) => {
            polygons.iter().for_each(|points| paint_outline(canvas, camera, item, &placed(points, camera)));
        }
        Shape::Curve(points) => paint_line(canvas, camera, item, &placed(points, camera)),
        Shape::Lines(lines) => {
            lines.iter().for_each(|points| paint_line(canvas, camera, item, &placed(points, camera)));
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

fn paint_outline(canvas: &mut Canvas, camera: &Camera, item: &Item, points: &[Vec2]) {
    if item.fill.is_some() {
        canvas.fill(points, &triangulate(points), area(item));
    }
    if item.part == Part::ObstacleRim {
        canvas.band(points, &[(-1.0, fade(HALO, 0.8)), (3.0, fade(HALO, 0.5)), (11.0, fade(HALO, 0.0))]);
    }
    if let Some(stroke) = item.stroke {
        canvas.band(points, &rims(stroke, camera));
    }
}

fn paint_line(canvas: &mut Canvas, camera: &Camera, item: &Item, points: &[Vec2]) {
    if item.fill.is_some() {
        canvas.fill(points, &triangulate(points), area(item));
    }
    if let Some(stroke) = item.stroke {
        canvas.line(points, &rims(stroke, camera));
    }
}

/// A line of the stroke's width, at least a pixel, with soft edges.
pub(super) fn rims(stroke: Stroke, camera: &Camera) -> [Rim; 4] {
    let (half, colour) = ((0.5 * stroke.width * camera.scale()).max(0.5), scene(stroke.colour));
    let clear = fade(colour, 0.0);
    [(-half - 0.8, clear), (-half, colour), (half, colour), (half + 0.8, clear)]
}

/// A seam that fades outwards.
fn paint_halo(canvas: &mut Canvas, item: &Item, points: &[Vec2], camera: &Camera) {
    let Some(stroke) = item.stroke else { return };
    let (width, colour) = (0.5 * stroke.width * camera.scale() + 3.0, scene(stroke.colour));
    canvas.band(points, &[(-0.5, colour), (0.4 * width, fade(colour, 0.5 * colour.a)), (width, fade(colour, 0.0))]);
}

/// Covers what lies outside of the room.
fn paint_border(canvas: &mut Canvas, camera: &Camera, colour: Color) {
    let (low, high) = (camera.to_screen(Vec2::ZERO), camera.to_screen(camera.room()));
    let (left, bottom, right, top) = (low.x, low.y, high.x, high.y);
    let screen = camera.screen();
    let sheets = [
        (Vec2::ZERO, Vec2::new(screen.x, top)),
        (Vec2::new(0.0, bottom), screen),
        (Vec2::new(0.0, top), Vec2::new(left, bottom)),
        (Vec2::new(right, top), Vec2::new(screen.x, bottom)),
    ];
    for (from, to) in sheets.into_iter().filter(|(from, to)| from.cmplt(*to).all()) {
        canvas.rectangle(from, to, colour);
    }
}
