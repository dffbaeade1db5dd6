//! Letters: all that can be written, in every size, as one texture for one scale.

use super::font::{TITLE, TextSize};
use super::letters::letters;
use crate::draw::canvas::Canvas;
use macroquad::color::Color;
use macroquad::texture::Texture2D;
use microsim_core::glam::Vec2;
use std::collections::BTreeMap;

/// What is written in place of what is not there.
const MISSING: char = '?';
/// Free pixels around a glyph, so that its neighbours do not show.
const GAP: usize = 1;

/// Letters of one scale.
#[derive(Debug)]
pub(super) struct Glyphs {
    /// Pixels per drawing unit.
    density: f32,
    all: GlyphMap,
    /// Size of the texture, pixels.
    sheet: Vec2,
    canvas: Canvas,
}

/// One letter, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Glyph {
    /// Upper left corner in the texture, and size.
    corner: [usize; 2],
    side: [usize; 2],
    /// From where it is written to its upper left corner.
    offset: Vec2,
    advance: f32,
}

/// What a texture is made from: columns, rows, and how much of each pixel is covered.
#[derive(Debug, PartialEq)]
struct Sheet {
    columns: usize,
    rows: usize,
    coverage: Vec<u8>,
}

impl Glyphs {
    /// The letters, as high as `pixels` says. Needs an open window.
    pub(super) fn new(font: &fontdue::Font, density: f32, pixels: impl Fn(TextSize) -> f32) -> Self {
        let (sheet, all) = sheet(font, pixels);
        let bytes: Vec<u8> = sheet.coverage.iter().flat_map(|&covered| [255, 255, 255, covered]).collect();
        let texture = Texture2D::from_rgba8(sheet.columns as u16, sheet.rows as u16, &bytes);
        Self { density, all, sheet: point([sheet.columns, sheet.rows]), canvas: Canvas::of(texture) }
    }

    /// Width of text, drawing units.
    pub(super) fn width(&self, size: TextSize, text: &str) -> f32 {
        glyphs(&self.all, size, text).map(|glyph| glyph.advance).sum::<f32>() / self.density
    }

    /// Writes text from a point on its base line on.
    pub(super) fn write(&mut self, at: Vec2, size: TextSize, colour: Color, text: &str) {
        let mut pen = (at * self.density).round();
        for &Glyph { corner, side, offset, advance } in glyphs(&self.all, size, text) {
            let low = (pen + offset).round();
            let on_sheet = [corner, [corner[0] + side[0], corner[1] + side[1]]].map(|place| point(place) / self.sheet);
            let on_screen = [low, low + point(side)].map(|place| place / self.density);
            self.canvas.image(on_screen, on_sheet, colour);
            pen.x += advance;
        }
    }

    /// Draws what has been written.
    pub(super) fn flush(&mut self) {
        self.canvas.flush();
    }
}

type GlyphMap = BTreeMap<(TextSize, char), Glyph>;

/// The glyphs of a text.
fn glyphs<'a>(all: &'a GlyphMap, size: TextSize, text: &'a str) -> impl Iterator<Item = &'a Glyph> {
    let of = move |letter| all.get(&(size, letter));
    text.chars().filter_map(move |letter| of(letter).or_else(|| of(MISSING)))
}

fn point([x, y]: [usize; 2]) -> Vec2 {
    Vec2::new(x as f32, y as f32)
}

fn characters(size: TextSize) -> Vec<char> {
    match size {
        TextSize::Huge => TITLE.chars().collect(),
        _ => letters().collect(),
    }
}

/// All letters in rows, one below the other.
fn sheet(font: &fontdue::Font, pixels: impl Fn(TextSize) -> f32) -> (Sheet, GlyphMap) {
    let keys =
        TextSize::ALL.into_iter().flat_map(|size| characters(size).into_iter().map(move |letter| (size, letter)));
    let drawn: BTreeMap<_, _> = keys.map(|key| (key, font.rasterize(key.1, pixels(key.0)))).collect();
    let area: usize = drawn.values().map(|(metrics, _)| (metrics.width + GAP) * (metrics.height + GAP)).sum();
    let columns = ((1.2 * area as f32).sqrt() as usize).next_power_of_two().max(256);
    let (mut all, mut next, mut below) = (BTreeMap::new(), [GAP, GAP], 0);
    for (&key, (metrics, _)) in &drawn {
        if next[0] + metrics.width + GAP > columns {
            next = [GAP, below];
        }
        let offset = Vec2::new(metrics.xmin as f32, -(metrics.ymin as f32) - metrics.height as f32);
        let side = [metrics.width, metrics.height];
        all.insert(key, Glyph { corner: next, side, offset, advance: metrics.advance_width });
        next[0] += metrics.width + GAP;
        below = below.max(next[1] + metrics.height + GAP);
    }
    let mut coverage = vec![0; columns * below];
    for (key, (metrics, bitmap)) in &drawn {
        let [x, y] = all[key].corner;
        for (row, line) in bitmap.chunks_exact(metrics.width.max(1)).enumerate() {
            let from = (y + row) * columns + x;
            coverage[from..from + line.len()].copy_from_slice(line);
        }
    }
    (Sheet { columns, rows: below, coverage }, all)
}

#[cfg(test)]
mod tests {
    use super::super::font;
    use super::*;

    #[test]
    fn letters_lie_apart_and_the_largest_scale_takes_little_memory() {
        for (scale, most) in [(0.68, 300_000), (1.0, 500_000), (6.0, 16_000_000)] {
            let (sheet, all) = sheet(&font::load().unwrap(), |size| (size.usual() * scale).round());
            assert!(sheet.coverage.len() <= most && sheet.rows <= 4096, "{scale}: {} x {}", sheet.columns, sheet.rows);
            let mut taken = vec![false; sheet.coverage.len()];
            for glyph in all.values() {
                for y in glyph.corner[1]..glyph.corner[1] + glyph.side[1] {
                    let row = y * sheet.columns + glyph.corner[0];
                    let pixels = &mut taken[row..row + glyph.side[0]];
                    assert!(pixels.iter().all(|taken| !taken), "two letters share a pixel");
                    pixels.fill(true);
                }
            }
        }
    }

    #[test]
    fn a_letter_stands_on_its_line_and_has_its_shape() {
        let (sheet, all) = sheet(&font::load().unwrap(), |_| 40.0);
        let glyph = all[&(TextSize::Body, 'H')];
        assert!((glyph.offset.y + glyph.side[1] as f32).abs() < 1.0, "{glyph:?}");
        assert!(glyph.offset.y < -20.0 && glyph.advance > glyph.side[0] as f32);
        let covered = |x: usize, y: usize| sheet.coverage[(glyph.corner[1] + y) * sheet.columns + glyph.corner[0] + x];
        assert!(covered(1, 10) > 200, "the left stroke");
        assert_eq!(covered(glyph.side[0] / 2, 2), 0, "between the strokes");
    }
}
