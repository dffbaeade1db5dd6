//! The pen: text and plain shapes in drawing units, in few draw calls.

use crate::draw::canvas::Canvas;
use crate::draw::palette::{INK, fade};
use macroquad::color::Color;
use macroquad::text::{Font, TextParams, draw_text_ex, load_ttf_font_from_bytes, measure_text};
use macroquad::window::screen_dpi_scale;
use microsim_core::glam::Vec2;
use std::collections::BTreeSet;

/// Height of a picture for which text has its usual size, and its width.
const USUAL: Vec2 = Vec2::new(1280.0, 720.0);

/// Sizes of text; every size costs an atlas of glyphs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// What may be overlooked.
    Small,
    /// What is to be read.
    Body,
    /// What is to be seen.
    Large,
    /// The title.
    Huge,
}

/// Where text lies from its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// To the right of it.
    Left,
    /// Around it.
    Centre,
    /// To the left of it.
    Right,
}

/// Draws above the scene. Shapes come below text until [`Pen::flush`].
#[derive(Debug)]
pub struct Pen {
    canvas: Canvas,
    font: Option<Font>,
    factor: f32,
    screen: Vec2,
    warm: BTreeSet<u16>,
    texts: Vec<Text>,
}

#[derive(Debug)]
struct Text {
    at: Vec2,
    size: u16,
    colour: Color,
    text: String,
}

impl Pen {
    /// Makes the font. Needs an open window.
    #[must_use]
    pub fn new() -> Self {
        let font = load_ttf_font_from_bytes(epaint_default_fonts::UBUNTU_LIGHT).ok();
        let (warm, texts) = (BTreeSet::new(), Vec::new());
        Self { canvas: Canvas::new(), font, factor: 1.0, screen: USUAL, warm, texts }
    }

    /// Adapts to a picture of this size, and to the player's wish.
    pub fn fit(&mut self, screen: Vec2, wish: f32) {
        (self.screen, self.factor) = (screen, factor(screen) * wish);
        // Glyphs that are made in the middle of a frame come out as black boxes.
        for size in [Size::Small, Size::Body, Size::Large, Size::Huge] {
            let pixels = (f32::from(self.pixels(size)) * screen_dpi_scale()).ceil() as u16;
            if self.warm.insert(pixels)
                && let Some(font) = &self.font
            {
                font.populate_font_cache(&CHARACTERS.chars().collect::<Vec<_>>(), pixels);
            }
        }
    }

    /// Size of the picture, drawing units.
    #[must_use]
    pub fn screen(&self) -> Vec2 {
        self.screen
    }

    /// Height of a line of text, drawing units. What is clicked is at least half as high again.
    #[must_use]
    pub fn line(&self, size: Size) -> f32 {
        1.35 * f32::from(self.pixels(size))
    }

    /// Surface for plain shapes.
    pub(crate) fn canvas(&mut self) -> &mut Canvas {
        &mut self.canvas
    }

    /// Writes text of which the middle is as high as `at`.
    pub fn write(&mut self, at: Vec2, size: Size, align: Align, colour: Color, text: &str) {
        let shift = match align {
            Align::Left => 0.0,
            Align::Centre => 0.5,
            Align::Right => 1.0,
        };
        let left = if shift > 0.0 { at.x - shift * self.width(size, text) } else { at.x };
        let pixels = self.pixels(size);
        let at = Vec2::new(left, at.y + 0.34 * f32::from(pixels)).round();
        self.texts.push(Text { at, size: pixels, colour, text: text.to_owned() });
    }

    /// The same on a dark panel, to be read above anything.
    pub fn label(&mut self, at: Vec2, size: Size, align: Align, colour: Color, text: &str) {
        let half = Vec2::new(0.5 * self.width(size, text) + 0.35 * self.line(size), 0.56 * self.line(size));
        let middle = match align {
            Align::Left => at.x + half.x,
            Align::Centre => at.x,
            Align::Right => at.x - half.x,
        };
        let middle = Vec2::new(middle, at.y);
        self.panel(middle - half, middle + half);
        self.write(middle, size, Align::Centre, colour, text);
    }

    /// A dark panel.
    pub fn panel(&mut self, low: Vec2, high: Vec2) {
        self.canvas.rectangle(low, high, fade(INK, 0.72));
    }

    /// Width of text, drawing units.
    #[must_use]
    pub fn width(&self, size: Size, text: &str) -> f32 {
        measure_text(text, self.font.as_ref(), self.pixels(size), 1.0).width
    }

    /// Draws what has been collected: what comes later lies above it.
    pub fn flush(&mut self) {
        self.canvas.flush();
        for Text { at, size, colour, text } in self.texts.drain(..) {
            let params =
                TextParams { font: self.font.as_ref(), font_size: size, color: colour, ..TextParams::default() };
            draw_text_ex(&text, at.x, at.y, params);
        }
    }

    fn pixels(&self, size: Size) -> u16 {
        let usual = match size {
            Size::Small => 15.0,
            Size::Body => 19.0,
            Size::Large => 30.0,
            Size::Huge => 64.0,
        };
        (usual * self.factor).round() as u16
    }
}

impl Default for Pen {
    fn default() -> Self {
        Self::new()
    }
}

/// All that is ever written.
const CHARACTERS: &str = " !\"#$%&'()*+,-./0123456789:;<=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_`abcdefghijklmnopqrstuvwxyz{|}~\u{d7}\u{b7}\u{b5}\u{b2}";

/// Size of text for a picture: few different ones, for every one costs memory.
fn factor(screen: Vec2) -> f32 {
    let fit = (screen / USUAL).min_element();
    let steps = [0.8, 1.0, 1.25, 1.5, 2.0];
    steps.into_iter().rev().find(|&step| step <= fit.max(0.8)).unwrap_or(0.8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_comes_in_few_sizes_and_is_never_tiny() {
        let sizes: BTreeSet<u32> =
            (100..4000).map(|width| factor(Vec2::new(width as f32, width as f32 * 0.6)).to_bits()).collect();
        assert_eq!(sizes.len(), 5);
        assert_eq!((factor(Vec2::new(640.0, 360.0)), factor(USUAL)), (0.8, 1.0));
    }
}
