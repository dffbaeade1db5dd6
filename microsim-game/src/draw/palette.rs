//! Colours of what lies above the scene, and how they mix. The scene's own are the core's, by role.

use crate::words::Key;
use macroquad::color::Color;
use microsim_core::drawing::shape::Colour;
use microsim_core::{Rng, drawing};

/// The empty room.
pub(crate) const SLIDE: Colour = drawing::palette::ROOM;
pub(crate) const HALO: Color = rgb(0.97, 0.985, 0.95);
pub(crate) const INK: Color = rgb(0.16, 0.20, 0.17);
/// What can be done now, what has to wait, and what is running out: told apart also with two kinds of cones.
pub(crate) const READY: Color = rgb(0.36, 0.92, 0.42);
/// Cells of players, by number: sky blue, orange, bluish green and reddish purple, which the colour-blind tell apart (Okabe and Ito,
/// "Color universal design", 2008).
pub(crate) const PLAYERS: [(Key, Color); 4] = [
    (Key::ColourBlue, rgb(0.34, 0.71, 0.91)),
    (Key::ColourOrange, rgb(0.90, 0.62, 0.0)),
    (Key::ColourGreen, rgb(0.0, 0.62, 0.45)),
    (Key::ColourPurple, rgb(0.80, 0.47, 0.65)),
];
pub(crate) const WAIT: Color = rgb(0.62, 0.72, 0.86);
pub(crate) const ALERT: Color = rgb(1.0, 0.72, 0.25);

const fn rgb(r: f32, g: f32, b: f32) -> Color {
    Color::new(r, g, b, 1.0)
}

/// A colour of the scene.
pub(crate) fn scene(colour: Colour) -> Color {
    let Colour { red, green, blue, alpha } = colour;
    let [r, g, b] = [red, green, blue].map(|channel| f32::from(channel) / 255.0);
    Color::new(r, g, b, alpha)
}

/// The same colour, this opaque.
pub(crate) fn fade(colour: Color, alpha: f32) -> Color {
    Color { a: alpha, ..colour }
}

/// The colour `share` of the way from `a` to `b`.
pub(crate) fn mix(a: Color, b: Color, share: f32) -> Color {
    let between = |a: f32, b: f32| a + (b - a) * share;
    Color::new(between(a.r, b.r), between(a.g, b.g), between(a.b, b.b), between(a.a, b.a))
}

/// A number from 0 to 1 that belongs to an index, the same in every run.
pub(crate) fn chance(index: usize) -> f32 {
    Rng::new(index as u64, 0).unit()
}
