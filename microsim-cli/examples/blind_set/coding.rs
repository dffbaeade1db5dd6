//! What lossy coding of pictures (JPEG, ITU-T T.81) leaves of them: blocks of 8 x 8 pixels as rounded cosine coefficients.

use std::f32::consts::PI;

/// Steps of coefficients of brightness and of colour, by T.81 K.1 and K.2 at quality 75: half of what stands there.
const BRIGHTNESS: [u8; 64] = [
    16, 11, 10, 16, 24, 40, 51, 61, 12, 12, 14, 19, 26, 58, 60, 55, 14, 13, 16, 24, 40, 57, 69, 56, 14, 17, 22, 29, 51,
    87, 80, 62, 18, 22, 37, 56, 68, 109, 103, 77, 24, 35, 55, 64, 81, 104, 113, 92, 49, 64, 78, 87, 103, 121, 120, 101,
    72, 92, 95, 98, 112, 100, 103, 99,
];
const COLOUR: [u8; 16] = [17, 18, 24, 47, 18, 21, 26, 66, 24, 26, 56, 99, 47, 66, 99, 99];

/// Codes a square picture and decodes it.
pub(crate) fn degrade(bytes: &mut [u8], side: usize) {
    let mut planes: [Vec<f32>; 3] = std::array::from_fn(|_| Vec::with_capacity(side * side));
    for pixel in bytes.chunks_exact(3) {
        let [r, g, b] = [pixel[0], pixel[1], pixel[2]].map(f32::from);
        let y = 0.299 * r + 0.587 * g + 0.114 * b;
        for (plane, value) in planes.iter_mut().zip([y, 0.564 * (b - y), 0.713 * (r - y)]) {
            plane.push(value);
        }
    }
    // Colour has half as many columns.
    for plane in &mut planes[1..] {
        plane.chunks_exact_mut(2).for_each(|pair| pair.fill(0.5 * (pair[0] + pair[1])));
    }
    round(&mut planes[0], side, 1, |k| f32::from(BRIGHTNESS[k]));
    let colour = |k: usize| if k % 8 < 4 && k / 8 < 4 { f32::from(COLOUR[k / 8 * 4 + k % 8]) } else { 99.0 };
    planes[1..].iter_mut().for_each(|plane| round(plane, side, 2, colour));
    for (k, pixel) in bytes.chunks_exact_mut(3).enumerate() {
        let [y, blue, red] = [planes[0][k], planes[1][k], planes[2][k]];
        let (r, b) = (y + red / 0.713, y + blue / 0.564);
        let g = (y - 0.299 * r - 0.114 * b) / 0.587;
        pixel.copy_from_slice(&[r, g, b].map(|value| (value + 0.5).clamp(0.0, 255.0) as u8));
    }
}

/// Rounds the coefficients of each block; neighbouring columns of a block are `stride` pixels apart.
fn round(plane: &mut [f32], side: usize, stride: usize, step: impl Fn(usize) -> f32) {
    for top in (0..side).step_by(8) {
        for left in (0..side).step_by(8 * stride) {
            let at = |k: usize| (top + k / 8) * side + left + k % 8 * stride;
            let block: [f32; 64] = std::array::from_fn(|k| plane[at(k)]);
            let coefficients = turned(turned(block, false), false);
            let rounded = std::array::from_fn(|k| {
                let step = 0.5 * step(k);
                (coefficients[k] / step).round() * step
            });
            let block = turned(turned(rounded, true), true);
            for (k, value) in block.into_iter().enumerate() {
                plane[at(k)..at(k) + stride].fill(value);
            }
        }
    }
}

/// Cosine transform of the rows of a block, or its inverse; rows become columns.
fn turned(block: [f32; 64], is_inverse: bool) -> [f32; 64] {
    let basis = |wave: usize, at: usize| {
        let scale = if wave == 0 { 0.125_f32.sqrt() } else { 0.5 };
        scale * ((at as f32 + 0.5) * wave as f32 * PI / 8.0).cos()
    };
    std::array::from_fn(|k| {
        let (to, row) = (k / 8, k % 8);
        let term = |from: usize| block[row * 8 + from] * if is_inverse { basis(from, to) } else { basis(to, from) };
        (0..8).map(term).sum()
    })
}
