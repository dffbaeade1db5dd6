//! The pen: text and plain shapes in drawing units, in few draw calls.

use super::font::{self, TextSize};
use super::glyphs::Glyphs;
use crate::draw::canvas::Canvas;
use crate::draw::palette::{INK, fade};
use macroquad::color::Color;
use macroquad::window::screen_dpi_scale;
use microsim_core::glam::Vec2;

/// Height of a picture for which text has its usual size, and its width.
const USUAL: Vec2 = Vec2::new(1280.0, 720.0);

/// Radius of the corners of panels, lines of text.
const ROUNDING: f32 = 0.22;

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

impl Align {
    /// Share of the text to the left of its place.
    fn share_on_left(self) -> f32 {
        match self {
            Self::Left => 0.0,
            Self::Centre => 0.5,
            Self::Right => 1.0,
        }
    }
}

/// Draws above the scene. Shapes come below text until [`Pen::flush`].
#[derive(Debug)]
pub struct Pen {
    canvas: Canvas,
    /// The font, and its letters at the present scale.
    font: Option<(fontdue::Font, Glyphs)>,
    factor: f32,
    /// Pixels per drawing unit, with the player's wish.
    scale: f32,
    screen: Vec2,
}

impl Pen {
    /// A pen for a picture of the usual size. Needs an open window.
    #[must_use]
    pub fn new() -> Self {
        let mut pen = Self { canvas: Canvas::new(), font: None, factor: 1.0, scale: 0.0, screen: USUAL };
        pen.fit(USUAL, 1.0);
        pen
    }

    /// One that draws no text, and into no window.
    #[cfg(test)]
    pub(crate) fn bare() -> Self {
        Self { canvas: Canvas::bare(), font: None, factor: 1.0, scale: 1.0, screen: USUAL }
    }

    /// One for a picture of this size, and the width that text would have in it.
    #[cfg(test)]
    pub(crate) fn measured(screen: Vec2, wish: f32) -> (Self, impl Fn(TextSize, &str) -> f32) {
        let pen = Self { screen, factor: factor(screen) * wish, ..Self::bare() };
        let (font, factor) = (font::load().unwrap(), pen.factor);
        let advance = move |size: TextSize, letter| font.metrics(letter, (size.usual() * factor).round()).advance_width;
        (pen, move |size, text: &str| text.chars().map(|letter| advance(size, letter)).sum())
    }

    /// Adapts to a picture of this size, and to the player's wish.
    pub fn fit(&mut self, screen: Vec2, wish: f32) {
        (self.screen, self.factor) = (screen, factor(screen) * wish);
        let density = screen_dpi_scale();
        if self.scale != self.factor * density {
            self.scale = self.factor * density;
            let font = self.font.take().map(|(font, _)| font).or_else(font::load);
            self.font = font.map(|font| {
                let glyphs = Glyphs::new(&font, density, |size| self.pixels(size) * density);
                (font, glyphs)
            });
        }
    }

    /// Size of the picture, drawing units.
    #[must_use]
    pub fn screen(&self) -> Vec2 {
        self.screen
    }

    /// Height of a line of text, drawing units. What is clicked is at least 1.4 times as high.
    #[must_use]
    pub fn line(&self, size: TextSize) -> f32 {
        1.35 * self.pixels(size)
    }

    /// Surface for plain shapes.
    pub(crate) fn canvas(&mut self) -> &mut Canvas {
        &mut self.canvas
    }

    /// Writes text of which the middle is as high as `at`.
    pub fn write(&mut self, at: Vec2, size: TextSize, align: Align, colour: Color, text: &str) {
        let left = at.x - align.share_on_left() * self.width(size, text);
        let at = Vec2::new(left, at.y + 0.34 * self.pixels(size));
        if let Some((_, glyphs)) = &mut self.font {
            glyphs.write(at, size, colour, text);
        }
    }

    /// The same on a dark panel, to be read above anything, and wholly in the picture.
    pub fn label(&mut self, at: Vec2, size: TextSize, align: Align, colour: Color, text: &str) {
        let half = Vec2::new(0.5 * self.width(size, text) + 0.35 * self.line(size), 0.56 * self.line(size));
        let middle = Vec2::new(at.x + (1.0 - 2.0 * align.share_on_left()) * half.x, at.y);
        let middle = middle.clamp(half, (self.screen - half).max(half));
        self.panel(middle - half, middle + half);
        self.write(middle, size, Align::Centre, colour, text);
    }

    /// Radius of the corners of panels and menus, drawing units.
    #[must_use]
    pub fn rounding(&self) -> f32 {
        ROUNDING * self.line(TextSize::Body)
    }

    /// A dark panel.
    pub fn panel(&mut self, low: Vec2, high: Vec2) {
        let radius = self.rounding();
        self.canvas.rounded(low, high, radius, fade(INK, 0.78));
    }

    /// Width of text, drawing units.
    #[must_use]
    pub fn width(&self, size: TextSize, text: &str) -> f32 {
        self.font.as_ref().map_or(0.0, |(_, glyphs)| glyphs.width(size, text))
    }

    /// Text in lines that are no wider than this, drawing units, where its words are not.
    #[must_use]
    pub fn wrap(&self, size: TextSize, text: &str, width: f32) -> Vec<String> {
        wrap(text, |line| self.width(size, line) <= width)
    }

    /// The same in as many lines, which are as even as they can be: no last line of one word.
    #[must_use]
    pub fn wrap_evenly(&self, size: TextSize, text: &str, width: f32) -> Vec<String> {
        evenly(width, |width| self.wrap(size, text, width))
    }

    /// Draws what has been collected: what comes later lies above it.
    pub fn flush(&mut self) {
        self.canvas.flush();
        if let Some((_, glyphs)) = &mut self.font {
            glyphs.flush();
        }
    }

    fn pixels(&self, size: TextSize) -> f32 {
        (size.usual() * self.factor).round()
    }
}

impl Default for Pen {
    fn default() -> Self {
        Self::new()
    }
}

/// Text in lines that fit; a word that does not has a line of its own.
pub(crate) fn wrap(text: &str, fits: impl Fn(&str) -> bool) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if line.is_empty() || fits(&longer) {
                line = longer;
            } else {
                lines.push(std::mem::replace(&mut line, word.to_owned()));
            }
        }
        lines.push(line);
    }
    lines
}

/// The lines of the least width, from half of this one on, that are not more than those of this one.
fn evenly(width: f32, wrap: impl Fn(f32) -> Vec<String>) -> Vec<String> {
    let lines = wrap(width);
    let count = lines.len();
    let narrower = (1..=12).filter(|_| count > 1).map(|k| wrap(width * (1.0 - k as f32 / 24.0)));
    narrower.take_while(|lines| lines.len() <= count).last().unwrap_or(lines)
}

/// Size of text for a picture: few different ones, for every one needs glyphs of its own.
fn factor(screen: Vec2) -> f32 {
    let fit = (screen / USUAL).min_element();
    let steps = [0.8, 1.0, 1.25, 1.5, 2.0];
    steps.into_iter().rev().find(|&step| step <= fit.max(0.8)).unwrap_or(0.8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn long_lines_are_broken_between_words() {
        let lines = wrap("a.toml:\nline 5: unknown field, incomprehensibilities\n", |line| line.len() <= 14);
        assert_eq!(lines, ["a.toml:", "line 5:", "unknown field,", "incomprehensibilities"]);
    }

    #[test]
    fn no_line_is_left_with_one_word_if_others_can_do_with_less() {
        let lines = |text: &str, width| evenly(width, |width| wrap(text, |line| line.len() as f32 <= width));
        assert_eq!(lines("one two three four five", 19.0), ["one two three", "four five"]);
        assert_eq!(lines("one two three", 19.0), ["one two three"]);
        assert_eq!(lines("incomprehensibilities one", 5.0), ["incomprehensibilities", "one"]);
    }

    #[test]
    fn text_comes_in_few_sizes_and_is_never_tiny() {
        let sizes: BTreeSet<u32> =
            (100..4000).map(|width| factor(Vec2::new(width as f32, width as f32 * 0.6)).to_bits()).collect();
        assert_eq!(sizes.len(), 5);
        assert_eq!((factor(Vec2::new(640.0, 360.0)), factor(USUAL)), (0.8, 1.0));
    }
}
