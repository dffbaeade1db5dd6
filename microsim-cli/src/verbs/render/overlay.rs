//! Overlays of a picture: chemicals, and the scale bar in a corner.

use crate::draw::{caption, png::Picture};
use microsim_core::World;
use microsim_core::drawing::{self, DrawingLayer, shape::Colour};
use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Optics};

/// Height of the letters and distance from the corner, as shares of the picture's height.
const LETTERS: f32 = 0.026;
const MARGIN: f32 = 0.04;
/// Of the scale bar. It must be read on any ground, but be no harder an edge than the picture has: hence a hue that no
/// specimen has, and not black, on light grounds.
const ON_LIGHT: u32 = 0x78_5a_e6;
const ON_DARK: u32 = 0xe1_e1_e1;
/// Sides from which on a picture has room for a scale bar, pixels.
const LEAST: [usize; 2] = [160, 90];

/// The picture with the chemicals that are there, which no microscope shows.
pub(crate) fn with_chemicals(picture: Picture, field: &Field, world: &World) -> Picture {
    let pixel = field.pixel();
    let corner = field.centre - 0.5 * pixel * Vec2::new(field.pixels[0] as f32, field.pixels[1] as f32);
    let items = drawing::draw(world.view(), [Vec2::MIN, Vec2::MAX], &[DrawingLayer::Chemicals]);
    picture.painted_over(&items, corner, 1.0 / pixel)
}

/// The picture with a scale bar at the lower left, if there is room for one.
pub(crate) fn with_scale_bar(picture: Picture, field: &Field, optics: Optics) -> Picture {
    let [width, height] = picture.size();
    if width < LEAST[0] || height < LEAST[1] {
        return picture;
    }
    let colour = Colour::hex(if optics.is_bright() { ON_LIGHT } else { ON_DARK });
    let length = caption::bar_length(field.width);
    let height = height as f32;
    let items =
        caption::scale_bar(length, length / field.pixel(), LETTERS * height, MARGIN * height, colour.faded(0.85));
    picture.painted_over(&items, Vec2::ZERO, 1.0)
}
