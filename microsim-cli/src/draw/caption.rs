//! The strip below the room: a scale bar and the time, in letters made of lines so that no font is needed.

use microsim_core::drawing::palette::INK;
use microsim_core::drawing::shape::{Colour, Item, Part, Shape, Stroke};
use microsim_core::glam::Vec2;

/// Height of a digit as a share of the strip.
const LETTER: f32 = 0.34;
/// Height of a digit on the grid that letters are drawn on.
const GRID: f32 = 6.0;
/// Space between letters on that grid.
const GAP: f32 = 1.8;

/// Scale bar at the left, time at the right. `margin` is the height of the strip, units.
pub(crate) fn draw(size: Vec2, margin: f32, time: f64) -> Vec<Item> {
    let scale = margin * LETTER / GRID;
    let base = -margin * 0.5 - scale * GRID * 0.5;
    let pen = Stroke { colour: INK, width: scale * 0.8 };
    let length = bar_length(size.x);
    let middle = -margin * 0.5;
    let tick = Vec2::new(0.0, scale * 1.6);
    let (from, to) = (Vec2::new(0.0, middle), Vec2::new(length, middle));
    let bar = vec![vec![from, to], vec![from - tick, from + tick], vec![to - tick, to + tick]];
    let label = format!("{length} µm");
    let clock = format!("{time:.2} s");
    let right = size.x - width(&clock) * scale;
    vec![
        lines(bar, pen),
        lines(text(&label, Vec2::new(length + scale * 6.0, base), scale), pen),
        lines(text(&clock, Vec2::new(right, base), scale), pen),
    ]
}

/// A scale bar in the lower left corner of a picture of this size, everything in pixels but the length that it says.
pub(crate) fn scale_bar(length: f32, pixels: f32, height: f32, margin: f32, colour: Colour) -> Vec<Item> {
    let scale = height / GRID;
    let bar = vec![vec![Vec2::splat(margin), Vec2::new(margin + pixels, margin)]];
    let at = Vec2::new(margin, margin + 2.2 * scale);
    vec![
        lines(bar, Stroke { colour, width: scale * 1.6 }),
        lines(text(&format!("{length} µm"), at, scale), Stroke { colour, width: scale }),
    ]
}

fn lines(lines: Vec<Vec<Vec2>>, stroke: Stroke) -> Item {
    Item::stroked(Part::Caption, Shape::Lines(lines), stroke)
}

/// The largest of 1, 2, 5, 10, ... that is at most a fifth of the width.
pub(crate) fn bar_length(width: f32) -> f32 {
    let steps = (-2..6).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10_f32.powi(power)));
    steps.filter(|length| *length <= width * 0.2).fold(0.1, f32::max)
}

fn text(letters: &str, mut at: Vec2, scale: f32) -> Vec<Vec<Vec2>> {
    let mut drawn = Vec::new();
    for letter in letters.chars() {
        let (advance, lines) = glyph(letter);
        for line in lines {
            drawn.push(line.iter().map(|&[x, y]| at + Vec2::new(x, y) * scale).collect());
        }
        at.x += (advance + GAP) * scale;
    }
    drawn
}

fn width(letters: &str) -> f32 {
    letters.chars().map(|letter| glyph(letter).0 + GAP).sum::<f32>() - GAP
}

/// Lines of a letter on the grid, the base line at 0.
type Lines = &'static [&'static [[f32; 2]]];

/// Width and lines of a letter; nothing for one that captions never use.
#[rustfmt::skip]
fn glyph(letter: char) -> (f32, Lines) {
    match letter {
        '0' => (4.0, &[&[[1.0, 0.0], [3.0, 0.0], [4.0, 1.2], [4.0, 4.8], [3.0, 6.0], [1.0, 6.0], [0.0, 4.8], [0.0, 1.2], [1.0, 0.0]]]),
        '1' => (2.4, &[&[[0.4, 4.8], [2.0, 6.0], [2.0, 0.0]]]),
        '2' => (4.0, &[&[[0.0, 5.0], [1.0, 6.0], [3.0, 6.0], [4.0, 5.0], [4.0, 3.9], [0.0, 0.0], [4.0, 0.0]]]),
        '3' => (4.0, &[&[[0.0, 5.2], [1.0, 6.0], [3.0, 6.0], [4.0, 5.1], [4.0, 4.0], [3.0, 3.2], [1.6, 3.2]], &[[3.0, 3.2], [4.0, 2.3], [4.0, 1.0], [3.0, 0.0], [1.0, 0.0], [0.0, 0.8]]]),
        '4' => (4.0, &[&[[3.0, 0.0], [3.0, 6.0], [0.0, 1.8], [4.2, 1.8]]]),
        '5' => (4.0, &[&[[3.8, 6.0], [0.5, 6.0], [0.3, 3.3], [1.2, 3.8], [3.0, 3.8], [4.0, 2.8], [4.0, 1.0], [3.0, 0.0], [1.0, 0.0], [0.0, 0.8]]]),
        '6' => (4.0, &[&[[3.4, 6.0], [1.4, 5.0], [0.2, 3.0], [0.0, 1.4], [1.0, 0.0], [3.0, 0.0], [4.0, 1.1], [4.0, 2.4], [3.0, 3.5], [1.2, 3.5], [0.1, 2.4]]]),
        '7' => (4.0, &[&[[0.0, 6.0], [4.0, 6.0], [1.4, 0.0]]]),
        '8' => (4.0, &[&[[1.0, 3.2], [0.3, 4.0], [0.3, 5.2], [1.0, 6.0], [3.0, 6.0], [3.7, 5.2], [3.7, 4.0], [3.0, 3.2], [1.0, 3.2], [0.0, 2.2], [0.0, 1.0], [1.0, 0.0], [3.0, 0.0], [4.0, 1.0], [4.0, 2.2], [3.0, 3.2]]]),
        '9' => (4.0, &[&[[0.6, 0.0], [2.6, 1.0], [3.8, 3.0], [4.0, 4.6], [3.0, 6.0], [1.0, 6.0], [0.0, 4.9], [0.0, 3.6], [1.0, 2.5], [2.8, 2.5], [3.9, 3.6]]]),
        '.' => (0.2, &[&[[0.1, 0.0], [0.1, 0.2]]]),
        'µ' => (4.0, &[&[[0.0, 4.2], [0.0, -1.8]], &[[0.0, 1.0], [0.9, 0.0], [2.4, 0.0], [3.4, 1.0]], &[[3.4, 4.2], [3.4, 0.6], [4.0, 0.0]]]),
        'm' => (5.2, &[&[[0.0, 0.0], [0.0, 4.2]], &[[0.0, 3.2], [0.9, 4.2], [1.9, 4.2], [2.6, 3.4], [2.6, 0.0]], &[[2.6, 3.2], [3.5, 4.2], [4.5, 4.2], [5.2, 3.4], [5.2, 0.0]]]),
        's' => (3.2, &[&[[3.1, 3.5], [2.4, 4.2], [0.8, 4.2], [0.1, 3.5], [0.5, 2.6], [2.7, 1.7], [3.2, 0.9], [2.5, 0.0], [0.8, 0.0], [0.0, 0.7]]]),
        _ => (2.0, &[]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_has_a_round_length() {
        assert_eq!(bar_length(160.0), 20.0);
        assert_eq!(bar_length(20_000.0), 2000.0);
        assert_eq!(bar_length(1.0), 0.2);
    }

    #[test]
    fn every_letter_of_a_caption_has_a_shape() {
        for letter in "0123456789.µms".chars() {
            assert!(!glyph(letter).1.is_empty(), "{letter}");
        }
        assert!((width("1") - 2.4).abs() < 1e-6);
    }
}
