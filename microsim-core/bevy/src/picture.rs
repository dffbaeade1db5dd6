//! A world as one mesh of coloured triangles, made for each frame from what `microsim_core::drawing` says.

use bevy::asset::RenderAssetUsages;
use bevy::color::{Alpha, ColorToComponents, LinearRgba};
use bevy::mesh::{Mesh, PrimitiveTopology};
use bevy::prelude::Color;
use microsim_core::View;
use microsim_core::drawing::shape::{Colour, Geometry, Item, Paint};
use microsim_core::drawing::{DrawingLayer, draw};
use microsim_core::geometry::triangulate;
use microsim_core::glam::Vec2;
use std::f32::consts::TAU;

/// Corners of a disc.
const CORNERS: u8 = 24;

/// Corners of triangles, and their colours.
#[derive(Default)]
struct Triangles {
    positions: Vec<[f32; 3]>,
    colours: Vec<[f32; 4]>,
}

/// The room with all that is in it.
pub(crate) fn mesh(view: View<'_>) -> Mesh {
    let mut triangles = Triangles::default();
    let layers = [DrawingLayer::Room, DrawingLayer::Obstacles, DrawingLayer::Organisms];
    for item in draw(view, [Vec2::ZERO, view.world().config().size], &layers) {
        triangles.item(&item);
    }
    let Triangles { positions, colours } = triangles;
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::RENDER_WORLD)
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, colours)
}

impl Triangles {
    fn item(&mut self, item: &Item) {
        let fill = item.fill.map(|paint| match paint {
            Paint::Flat(colour) | Paint::Radial { outer: colour, .. } => colour,
        });
        let stroke = item.stroke.map(|stroke| (stroke.width, stroke.colour));
        let mut path = |points: &[Vec2], is_closed: bool| {
            fill.filter(|_| is_closed).into_iter().for_each(|colour| self.area(points, colour));
            stroke.into_iter().for_each(|(width, colour)| self.line(points, is_closed, width, colour));
        };
        match &item.geometry {
            Geometry::Discs(discs) => discs.iter().for_each(|&(centre, radius)| path(&circle(centre, radius), true)),
            Geometry::Outline(points) => path(points, true),
            Geometry::Curve(points) => path(points, false),
            Geometry::Polygons(paths) => paths.iter().for_each(|points| path(points, true)),
            Geometry::Lines(paths) => paths.iter().for_each(|points| path(points, false)),
        }
    }

    fn area(&mut self, points: &[Vec2], colour: Colour) {
        for corners in triangulate(points) {
            self.triangle(corners.map(|k| points[k as usize]), colour);
        }
    }

    fn line(&mut self, points: &[Vec2], is_closed: bool, width: f32, colour: Colour) {
        let next = points.iter().skip(1).chain(points.first().filter(|_| is_closed));
        for (&from, &to) in points.iter().zip(next) {
            let side = 0.5 * width * (to - from).perp().normalize_or_zero();
            let [a, b, c, d] = [from - side, to - side, to + side, from + side];
            self.triangle([a, b, c], colour);
            self.triangle([a, c, d], colour);
        }
    }

    fn triangle(&mut self, corners: [Vec2; 3], Colour { red, green, blue, alpha }: Colour) {
        let colour = LinearRgba::from(Color::srgb_u8(red, green, blue)).with_alpha(alpha);
        self.positions.extend(corners.map(|corner| corner.extend(0.0).to_array()));
        self.colours.extend([colour.to_f32_array(); 3]);
    }
}

/// A circle as a polygon. The platform's sine will do: what is drawn needs no equal bits.
fn circle(centre: Vec2, radius: f32) -> Vec<Vec2> {
    let corner = |k| centre + radius * Vec2::from_angle(f32::from(k) * TAU / f32::from(CORNERS));
    (0..CORNERS).map(corner).collect()
}
