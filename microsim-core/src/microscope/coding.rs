//! What lossy coding of pictures (JPEG, ITU-T T.81) leaves of them: blocks of 8 x 8 pixels as rounded cosine coefficients.

/// Side of a block, pixels; the colour of a block has twice as many columns.
pub(super) const BLOCK: usize = 8;

/// Steps of the coefficients of brightness and of colour at quality 50 (T.81, tables K.1 and K.2); all others of colour are 99.
const BRIGHTNESS: [u8; 64] = [
    16, 11, 10, 16, 24, 40, 51, 61, 12, 12, 14, 19, 26, 58, 60, 55, 14, 13, 16, 24, 40, 57, 69, 56, 14, 17, 22, 29, 51,
    87, 80, 62, 18, 22, 37, 56, 68, 109, 103, 77, 24, 35, 55, 64, 81, 104, 113, 92, 49, 64, 78, 87, 103, 121, 120, 101,
    72, 92, 95, 98, 112, 100, 103, 99,
];
const COLOUR: [u8; 16] = [17, 18, 24, 47, 18, 21, 26, 66, 24, 26, 56, 99, 47, 66, 99, 99];

/// Cosines of 0 to 8 sixteenths of half a turn.
const COSINES: [f32; 9] =
    [1.0, 0.980_785_25, 0.923_879_5, 0.831_469_6, 0.707_106_77, 0.555_570_2, 0.382_683_43, 0.195_090_32, 0.0];

/// Brightness, and what blue and red have beyond it.
type Planes = [Vec<f32>; 3];

/// Codes rows of red, green and blue, of a picture that begins with them or a multiple of 8 rows before them, and decodes
/// them. `quality` is 1 to 100, where 50 takes the tables as they are (as the library of the Independent JPEG Group counts).
/// Colour has half as many columns as the picture. Blocks that the picture does not fill repeat its last column and row.
pub fn code(bytes: &mut [u8], columns: usize, quality: u8) {
    let rows = bytes.len() / (3 * columns.max(1));
    if rows == 0 {
        return;
    }
    let size = [columns.next_multiple_of(2 * BLOCK), rows.next_multiple_of(BLOCK)];
    let mut planes = separated(bytes, [columns, rows], size);
    let scale = scale(quality);
    let step = |table: f32| (table * scale).clamp(1.0, 255.0);
    round(&mut planes[0], size[0], 1, |k| step(f32::from(BRIGHTNESS[k])));
    let colour = |k: usize| if k % 8 < 4 && k / 8 < 4 { f32::from(COLOUR[k / 8 * 4 + k % 8]) } else { 99.0 };
    for plane in &mut planes[1..] {
        round(plane, size[0], 2, |k| step(colour(k)));
        plane.chunks_exact_mut(size[0]).for_each(interpolate);
    }
    for (k, pixel) in bytes.chunks_exact_mut(3).enumerate() {
        let at = k / columns * size[0] + k % columns;
        // Decoders count in whole levels.
        let [y, blue, red] = [0, 1, 2].map(|plane: usize| planes[plane][at].round());
        let (r, b) = (y + red / 0.713, y + blue / 0.564);
        let g = (y - 0.299 * r - 0.114 * b) / 0.587;
        pixel.copy_from_slice(&[r, g, b].map(|value| (value + 0.5).clamp(0.0, 255.0) as u8));
    }
}

/// What the tables' steps are multiplied with.
fn scale(quality: u8) -> f32 {
    let quality = f32::from(quality.clamp(1, 100));
    if quality < 50.0 { 50.0 / quality } else { 2.0 - 0.02 * quality }
}

fn separated(bytes: &[u8], [columns, rows]: [usize; 2], [width, height]: [usize; 2]) -> Planes {
    let mut planes: Planes = std::array::from_fn(|_| Vec::with_capacity(width * height));
    for k in 0..width * height {
        let (x, y) = ((k % width).min(columns - 1), (k / width).min(rows - 1));
        let [r, g, b] = std::array::from_fn(|colour| f32::from(bytes[3 * (y * columns + x) + colour]));
        let brightness = 0.299 * r + 0.587 * g + 0.114 * b;
        let values = [brightness, 0.564 * (b - brightness), 0.713 * (r - brightness)];
        planes.iter_mut().zip(values).for_each(|(plane, value)| plane.push(value));
    }
    for plane in &mut planes[1..] {
        plane.chunks_exact_mut(2).for_each(|pair| pair.fill(0.5 * (pair[0] + pair[1])));
    }
    planes
}

/// Rounds the coefficients of each block; neighbouring columns of a block are `stride` pixels apart.
fn round(plane: &mut [f32], width: usize, stride: usize, step: impl Fn(usize) -> f32) {
    let steps: [f32; 64] = std::array::from_fn(step);
    let height = plane.len() / width;
    for top in (0..height).step_by(BLOCK) {
        for left in (0..width).step_by(BLOCK * stride) {
            let at = |k: usize| (top + k / 8) * width + left + k % 8 * stride;
            let block: [f32; 64] = std::array::from_fn(|k| plane[at(k)]);
            let coefficients = turned(turned(block, false), false);
            let rounded = std::array::from_fn(|k| (coefficients[k] / steps[k]).round() * steps[k]);
            for (k, value) in turned(turned(rounded, true), true).into_iter().enumerate() {
                plane[at(k)..at(k) + stride].fill(value);
            }
        }
    }
}

/// Interpolates a row of which neighbouring pairs are alike, as decoders do: three quarters of a value and one of the next.
fn interpolate(row: &mut [f32]) {
    let values: Vec<f32> = row.iter().copied().step_by(2).collect();
    for (k, value) in row.iter_mut().enumerate() {
        let next = if k % 2 == 0 { (k / 2).checked_sub(1) } else { Some(k / 2 + 1) };
        let next = next.and_then(|next| values.get(next)).copied().unwrap_or(values[k / 2]);
        *value = 0.75 * values[k / 2] + 0.25 * next;
    }
}

/// Cosine transform of the rows of a block, or its inverse; rows become columns.
fn turned(block: [f32; 64], is_inverse: bool) -> [f32; 64] {
    std::array::from_fn(|k| {
        let (to, row) = (k / 8, k % 8);
        let term = |from: usize| block[row * 8 + from] * if is_inverse { basis(from, to) } else { basis(to, from) };
        (0..8).map(term).sum()
    })
}

fn basis(wave: usize, at: usize) -> f32 {
    let turn = (2 * at + 1) * wave % 32;
    let half = if turn > 16 { 32 - turn } else { turn };
    let cosine = if half > 8 { -COSINES[16 - half] } else { COSINES[half] };
    if wave == 0 { 0.353_553_4 } else { 0.5 * cosine }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Waves in all colours, of a size that fills no block.
    fn waves(columns: usize, rows: usize) -> Vec<u8> {
        (0..columns * rows)
            .flat_map(|k| [k % columns * 7 % 256, k / columns * 11 % 256, (k % columns + k / columns) * 5 % 256])
            .map(|value| value as u8)
            .collect()
    }

    fn error(a: &[u8], b: &[u8]) -> f32 {
        let squares = a.iter().zip(b).map(|(a, b)| (f32::from(*a) - f32::from(*b)).powi(2));
        (squares.sum::<f32>() / a.len() as f32).sqrt()
    }

    #[test]
    fn an_even_picture_stays_and_better_quality_loses_less() {
        let mut even = [90, 140, 200].repeat(21 * 13);
        code(&mut even, 21, 90);
        assert!(error(&even, &[90, 140, 200].repeat(21 * 13)) < 1.5);
        let losses = [20, 50, 75, 95].map(|quality| {
            let mut coded = waves(21, 13);
            code(&mut coded, 21, quality);
            error(&coded, &waves(21, 13))
        });
        assert!(losses.is_sorted_by(|a, b| a > b), "{losses:?}");
        code(&mut [], 0, 50);
    }

    #[test]
    fn colours_run_into_each_other_along_rows() {
        let mut row = [0.0, 0.0, 8.0, 8.0, 8.0, 8.0];
        interpolate(&mut row);
        assert_eq!(row, [0.0, 2.0, 6.0, 8.0, 8.0, 8.0]);
    }

    #[test]
    fn the_transform_has_an_inverse() {
        let block: [f32; 64] = std::array::from_fn(|k| (k * k % 17) as f32);
        let back = turned(turned(turned(turned(block, false), false), true), true);
        assert!(block.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-4));
    }
}
