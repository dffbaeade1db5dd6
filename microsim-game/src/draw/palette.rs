//! Colours, and chance that is the same in every run.

use macroquad::color::Color;

pub(crate) const SLIDE: Color = rgb(0.862, 0.882, 0.845);
pub(crate) const OUTSIDE: Color = rgb(0.55, 0.58, 0.55);
pub(crate) const HALO: Color = rgb(0.97, 0.985, 0.95);
pub(crate) const INK: Color = rgb(0.16, 0.20, 0.17);

pub(crate) const CYTOPLASM: Color = rgb(0.60, 0.67, 0.58);
pub(crate) const GROWN: Color = rgb(0.82, 0.64, 0.42);
pub(crate) const CELL_BODY: Color = rgb(0.80, 0.84, 0.77);
pub(crate) const RIGID: Color = rgb(0.90, 0.86, 0.70);
pub(crate) const NUCLEUS: Color = rgb(0.30, 0.23, 0.38);
pub(crate) const PLATELET: Color = rgb(0.86, 0.66, 0.62);
pub(crate) const RED_CELL: Color = rgb(0.80, 0.46, 0.42);
pub(crate) const COCCUS: Color = rgb(0.34, 0.29, 0.44);
pub(crate) const AGAR: Color = rgb(0.91, 0.71, 0.33);
pub(crate) const PROBE: Color = rgb(0.30, 0.34, 0.38);
pub(crate) const FLUID: Color = rgb(0.36, 0.60, 0.68);
pub(crate) const CUSTOM: Color = rgb(0.55, 0.64, 0.45);
/// What can be done now, what has to wait, and what is running out: told apart also with two kinds of cones.
pub(crate) const READY: Color = rgb(0.36, 0.92, 0.42);
pub(crate) const WAIT: Color = rgb(0.62, 0.72, 0.86);
pub(crate) const ALERT: Color = rgb(1.0, 0.72, 0.25);

pub(crate) const OBSTACLE: Color = rgb(0.66, 0.67, 0.65);

const fn rgb(r: f32, g: f32, b: f32) -> Color {
    Color::new(r, g, b, 1.0)
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

/// A number from 0 to 1 that belongs to an index.
pub(crate) fn chance(index: usize) -> f32 {
    Dice::new(index as u32).roll()
}

/// A row of numbers from 0 to 1.
#[derive(Clone, Debug)]
pub(crate) struct Dice(u32);

impl Dice {
    pub(crate) fn new(seed: u32) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9) ^ 0x5BD1_E995)
    }

    pub(crate) fn roll(&mut self) -> f32 {
        // A permuted congruential generator, 32 bits (O'Neill 2014).
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        ((word >> 22) ^ word) as f32 / 4_294_967_296.0
    }
}
