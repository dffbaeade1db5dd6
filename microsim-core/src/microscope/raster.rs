//! Square pixels over a part of the world: their grid, interpolation between them, and their blur.

use glam::{IVec2, Vec2};

/// A grid of pixels, rows from the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PixelGrid {
    /// Upper left corner of the whole picture, micrometres.
    pub corner: Vec2,
    /// Side of a pixel, micrometres.
    pub pixel: f32,
    pub columns: usize,
    /// Rows of the whole picture above this part of it.
    pub top: usize,
    pub rows: usize,
}

impl PixelGrid {
    /// Centre of a pixel, micrometres: the same to the bit whatever part of the picture this is.
    pub(super) fn place(&self, x: usize, y: usize) -> Vec2 {
        self.corner + Vec2::new(x as f32 + 0.5, -((self.top + y) as f32 + 0.5)) * self.pixel
    }

    /// Lower left and upper right corner, micrometres.
    pub(super) fn bounds(&self) -> (Vec2, Vec2) {
        let (top, bottom) = (self.top as f32, (self.top + self.rows) as f32);
        let low = self.corner - Vec2::new(0.0, bottom) * self.pixel;
        (low, self.corner + Vec2::new(self.columns as f32, -top) * self.pixel)
    }

    /// A place in pixels, (0, 0) at the centre of the first one.
    pub(super) fn locate(&self, place: Vec2) -> Vec2 {
        let from = (place - self.corner) / self.pixel;
        Vec2::new(from.x - 0.5, -from.y - 0.5 - self.top as f32)
    }

    /// Calls `visit` with index and place of each pixel whose centre lies in a box.
    pub(super) fn each_in(&self, low: Vec2, high: Vec2, mut visit: impl FnMut(usize, Vec2)) {
        let (first, last) = (self.locate(Vec2::new(low.x, high.y)), self.locate(Vec2::new(high.x, low.y)));
        let span = |first: f32, last: f32, count: usize| {
            let end = (last.floor() + 1.0).clamp(0.0, count as f32) as usize;
            ((first.ceil().clamp(0.0, count as f32) as usize).min(end), end)
        };
        let (left, right) = span(first.x, last.x, self.columns);
        let (top, bottom) = span(first.y, last.y, self.rows);
        for y in top..bottom {
            for x in left..right {
                visit(y * self.columns + x, self.place(x, y));
            }
        }
    }

    pub(super) fn len(&self) -> usize {
        self.columns * self.rows
    }
}

/// Bilinear interpolation: the value `share` of the way from a pixel to the next. Border pixels repeat beyond the border.
pub(super) fn bilinear<T>(
    [columns, rows]: [usize; 2],
    pixel: IVec2,
    share: Vec2,
    value: impl Fn(usize) -> T,
    mix: impl Fn(T, T, f32) -> T,
) -> T {
    let inside = |k: i32, count: usize| (k.max(0) as usize).min(count - 1);
    let row = |y: i32| {
        let first = inside(y, rows) * columns;
        let at = |x: i32| value(first + inside(x, columns));
        mix(at(pixel.x), at(pixel.x + 1), share.x)
    };
    mix(row(pixel.y), row(pixel.y + 1), share.y)
}

/// Convolves pixels with a kernel along rows and columns. Border pixels repeat beyond the border.
pub(super) fn blur<const N: usize>(pixels: &mut [[f32; N]], columns: usize, kernel: &[f32]) {
    let half = kernel.len() / 2;
    let mut across = pixels.to_vec();
    let mut padded = Vec::with_capacity(columns + 2 * half);
    for (line, blurred) in pixels.chunks_exact(columns).zip(across.chunks_exact_mut(columns)) {
        padded.clear();
        padded.resize(half, line[0]);
        padded.extend_from_slice(line);
        padded.resize(columns + 2 * half, line[columns - 1]);
        weighted_sum(blurred, kernel, |k| &padded[k..]);
    }
    let last = pixels.len() / columns - 1;
    for (y, blurred) in pixels.chunks_exact_mut(columns).enumerate() {
        weighted_sum(blurred, kernel, |k| &across[(y + k).saturating_sub(half).min(last) * columns..]);
    }
}

/// Sets a line to the weighted sum of others.
fn weighted_sum<'a, const N: usize>(sum: &mut [[f32; N]], weights: &[f32], line: impl Fn(usize) -> &'a [[f32; N]]) {
    sum.fill([0.0; N]);
    for (k, weight) in weights.iter().enumerate() {
        for (sum, pixel) in sum.iter_mut().zip(line(k)) {
            for channel in 0..N {
                sum[channel] += weight * pixel[channel];
            }
        }
    }
}

/// Weights of a normal distribution of this standard deviation in pixels, up to three of them on either side; they add
/// up to 1.
pub(super) fn gaussian(sigma: f32) -> Vec<f32> {
    let half = (3.0 * sigma).ceil() as i32;
    let weight = |k: i32| if k == 0 { 1.0 } else { libm::expf(-0.5 * (k as f32 / sigma) * (k as f32 / sigma)) };
    let weights: Vec<f32> = (-half..=half).map(weight).collect();
    let sum: f32 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::super::maths::mix;
    use super::*;

    #[test]
    fn a_place_is_the_centre_of_its_pixel() {
        let grid = PixelGrid { corner: Vec2::new(0.0, 4.0), pixel: 1.0, columns: 4, top: 0, rows: 4 };
        assert_eq!(grid.locate(grid.place(2, 3)), Vec2::new(2.0, 3.0));
    }

    #[test]
    fn interpolation_meets_the_pixels_and_ends_at_the_border() {
        let at = |x, y, share| bilinear([2, 2], IVec2::new(x, y), share, |k| [1.0, 2.0, 3.0, 6.0][k], mix);
        assert_eq!([at(0, 0, Vec2::ZERO), at(1, 1, Vec2::ZERO), at(0, 0, Vec2::splat(0.5))], [1.0, 6.0, 3.0]);
        assert_eq!([at(0, 0, Vec2::Y * 0.25), at(-1, 5, Vec2::splat(0.5)), at(7, -9, Vec2::ONE)], [1.5, 3.0, 2.0]);
    }

    #[test]
    fn a_blur_spreads_a_pixel_and_keeps_what_is_even() {
        let mut even = [[0.5, 2.0]; 12];
        blur(&mut even, 3, &[0.25, 0.5, 0.25]);
        assert_eq!(even, [[0.5, 2.0]; 12]);
        let mut spot = [0., 0., 0., 0., 16., 0., 0., 0., 0., 0., 0., 0.].map(|light| [light]);
        blur(&mut spot, 3, &[0.25, 0.5, 0.25]);
        assert_eq!(spot.as_flattened(), [1., 2., 1., 2., 4., 2., 1., 2., 1., 0., 0., 0.]);
        let mut corner = [16., 0., 0., 0.].map(|light| [light]);
        blur(&mut corner, 2, &gaussian(9.0));
        assert!((corner.as_flattened().iter().sum::<f32>() - 16.0).abs() < 1e-3, "{corner:?}");
    }

    #[test]
    fn weights_add_up_to_one() {
        for sigma in [0.0, 0.3, 2.0, 9.0] {
            let sum: f32 = gaussian(sigma).iter().sum();
            assert!((sum - 1.0).abs() < 1e-5, "{sigma}: {sum}");
        }
    }
}
