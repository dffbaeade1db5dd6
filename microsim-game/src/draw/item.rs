//! Paints the items of a drawing as triangles: some parts in a way of their own, all others as plain areas and lines.

use super::atlas::Tile;
use super::canvas::Canvas;
use super::cell;
use super::frame::SceneFrame;
use super::palette::{HALO, fade, scene};
use super::plain::{self, area, placed, sprite};
use crate::camera::Camera;
use macroquad::color::Color;
use microsim_core::drawing::shape::{DrawnPart, Geometry, Item};
use microsim_core::glam::Vec2;
use std::f32::consts::TAU;

/// Sides of a round obstacle.
const ROUND: usize = 64;
/// Radius of a soft spot in radii of the disc that it stands for: it fades out to its rim.
const SOFT: f32 = 2.5;

pub(super) fn paint(canvas: &mut Canvas, frame: &SceneFrame<'_>, item: &Item) {
    let camera = frame.camera;
    match (item.part, &item.geometry) {
        (DrawnPart::Body, Geometry::Outline(points)) => cell::paint_body(canvas, frame, item, &placed(points, camera)),
        (DrawnPart::Cytoplasm | DrawnPart::GrownCytoplasm, Geometry::Discs(discs)) => {
            cell::paint_cytoplasm(canvas, camera, discs, area(item));
        }
        (DrawnPart::Nucleus, Geometry::Discs(discs)) => cell::paint_nucleus(canvas, camera, discs, area(item)),
        (DrawnPart::Fluid, Geometry::Discs(discs)) => cell::paint_fluid(canvas, frame, item, discs),
        (DrawnPart::Halo, Geometry::Outline(points)) => paint_halo(canvas, item, &placed(points, camera), camera),
        (DrawnPart::Spot, Geometry::Discs(discs)) if item.stroke.is_none() => {
            discs.iter().for_each(|&disc| sprite(canvas, camera, disc, SOFT, Tile::Soft, area(item)));
        }
        (DrawnPart::ObstacleRim | DrawnPart::Obstacle, geometry) => {
            outlines(geometry, camera).iter().for_each(|outline| paint_obstacle(canvas, camera, item, outline));
        }
        (DrawnPart::Border, _) => {
            paint_border(canvas, camera, item.stroke.map_or(Color::default(), |stroke| scene(stroke.colour)));
        }
        _ => plain::paint(canvas, camera, item),
    }
}

/// The closed lines of an obstacle, in picture pixels.
fn outlines(geometry: &Geometry, camera: &Camera) -> Vec<Vec<Vec2>> {
    let around = |k: usize| Vec2::from_angle(k as f32 / ROUND as f32 * TAU);
    match geometry {
        Geometry::Discs(discs) => {
            let outline = |&(centre, radius): &(Vec2, f32)| {
                (0..ROUND).map(|k| camera.to_screen(centre + around(k) * radius)).collect()
            };
            discs.iter().map(outline).collect()
        }
        Geometry::Polygons(polygons) => polygons.iter().map(|points| placed(points, camera)).collect(),
        _ => Vec::new(),
    }
}

/// An obstacle, or its edge on a bright seam.
fn paint_obstacle(canvas: &mut Canvas, camera: &Camera, item: &Item, outline: &[Vec2]) {
    if item.part == DrawnPart::ObstacleRim {
        canvas.band(outline, &[(-1.0, fade(HALO, 0.8)), (3.0, fade(HALO, 0.5)), (11.0, fade(HALO, 0.0))]);
    }
    plain::paint_path(canvas, camera, item, outline, true);
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
