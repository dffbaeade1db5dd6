//! Stars, drawn as shapes: the font has none.

use super::pen::Pen;
use crate::draw::palette::fade;
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Most stars there are.
const STARS: u32 = 3;
/// Directions of a star's five points and of the five notches between them, and how deep those are.
const POINTS: [(f32, f32); 5] = [(0.0, -1.0), (0.951, -0.309), (0.588, 0.809), (-0.588, 0.809), (-0.951, -0.309)];
const NOTCHES: [(f32, f32); 5] = [(0.588, -0.809), (0.951, 0.309), (0.0, 1.0), (-0.951, 0.309), (-0.588, -0.809)];
const DEPTH: f32 = 0.42;
/// How strong a star is that is still to be got.
const FAINT: f32 = 0.35;
/// How large it is.
const OPEN: f32 = 0.7;

/// Width of three stars of this radius.
#[must_use]
pub fn stars_width(radius: f32) -> f32 {
    STARS as f32 * 2.3 * radius
}

/// Draws three stars around a point, of which so many are full and the others smaller and faint.
pub fn draw_stars(pen: &mut Pen, middle: Vec2, radius: f32, stars: u32, colour: Color) {
    for k in 0..STARS {
        let at = middle + Vec2::new((k as f32 - 1.0) * 2.3 * radius, 0.0);
        let (radius, colour) = if k < stars { (radius, colour) } else { (OPEN * radius, fade(colour, FAINT)) };
        draw_star(pen, at, radius, colour);
    }
}

fn draw_star(pen: &mut Pen, at: Vec2, radius: f32, colour: Color) {
    let [points, notches] = [(POINTS, radius), (NOTCHES, DEPTH * radius)]
        .map(|(ways, length)| ways.map(|(x, y)| at + length * Vec2::new(x, y)));
    for k in 0..points.len() {
        let before = notches[(k + notches.len() - 1) % notches.len()];
        pen.canvas().corner([points[k], before, notches[k]], colour);
        pen.canvas().corner([at, before, notches[k]], colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::palette::READY;

    #[test]
    fn stars_that_are_got_are_larger() {
        let area = |stars| {
            let mut pen = Pen::bare();
            draw_stars(&mut pen, Vec2::splat(100.0), 10.0, stars, READY);
            let corners: Vec<Vec2> = pen.canvas().corners().map(|(at, ..)| at).collect();
            corners
                .chunks(3)
                .map(|corner| 0.5 * (corner[1] - corner[0]).perp_dot(corner[2] - corner[0]).abs())
                .sum::<f32>()
        };
        let areas = [0, 1, 2, 3].map(area);
        assert!(areas.windows(2).all(|pair| pair[1] > 1.15 * pair[0]), "{areas:?}");
    }

    #[test]
    fn stars_that_are_not_got_are_faint() {
        let mut pen = Pen::bare();
        draw_stars(&mut pen, Vec2::splat(100.0), 10.0, 1, READY);
        let strengths: Vec<u8> = pen.canvas().corners().map(|(.., colour)| colour[3]).collect();
        let (got, others) = strengths.split_at(strengths.len() / 3);
        assert!(others.iter().all(|strength| *strength < got[0] / 2), "{strengths:?}");
    }
}
