//! A sensor whose pixels see one colour each (Bayer, US patent 3 971 065): the two others are interpolated. It is read in two
//! fields, every second row at a time, of which one is made up from its neighbours.

/// Colour that a pixel of the sensor sees: green on every second one, red and blue in every second row.
fn seen(x: usize, y: usize) -> usize {
    match (x % 2, y % 2) {
        (0, 0) => 0,
        (1, 1) => 2,
        _ => 1,
    }
}

/// Replaces, in rows of red, green and blue from `top` on, what a pixel does not see by the mean of those around it that do. The
/// first and the last row should be of no use to the caller unless the picture ends there.
pub(super) fn interpolate(bytes: &[u8], columns: usize, top: usize) -> Vec<u8> {
    let rows = bytes.len() / (3 * columns);
    let pixel = |k: usize| {
        let (x, y) = (k % columns, k / columns);
        std::array::from_fn(|colour| {
            if seen(x, top + y) == colour {
                return bytes[3 * k + colour];
            }
            let around = (y.saturating_sub(1)..rows.min(y + 2))
                .flat_map(|y| (x.saturating_sub(1)..columns.min(x + 2)).map(move |x| (x, y)))
                .filter(|&(x, y)| seen(x, top + y) == colour)
                .map(|(x, y)| u32::from(bytes[3 * (y * columns + x) + colour]));
            let (sum, count) = around.fold((0, 0), |(sum, count), value| (sum + value, count + 1));
            // A picture one pixel wide or high may have none.
            (sum + count / 2).checked_div(count).map_or(bytes[3 * k + colour], |mean| mean as u8)
        })
    };
    (0..rows * columns).flat_map(|k| -> [u8; 3] { pixel(k) }).collect()
}

/// Means of each row with a quarter of the rows above and below, which a camera that is read in fields leaves; the first and the
/// last row as before.
pub(super) fn smooth_fields(bytes: &[u8], columns: usize) -> Vec<u8> {
    let (last, stride) = (bytes.len().saturating_sub(3 * columns), 3 * columns);
    let mean = |k: usize| {
        let [above, below] = [k.checked_sub(stride).unwrap_or(k), if k < last { k + stride } else { k }];
        let [a, b, c] = [above, k, below].map(|at| u32::from(bytes[at]));
        ((a + 2 * b + c + 2) / 4) as u8
    };
    (0..bytes.len()).map(mean).collect()
}

/// Averages, over so many pixels to each side along rows, by how much red and blue differ from green: cameras keep noise of
/// colours low.
pub(super) fn smooth_colours(bytes: &[u8], columns: usize) -> Vec<u8> {
    const SIDE: usize = 2;
    let mean = |k: usize| -> [u8; 3] {
        let (row, x) = (k / columns * columns, k % columns);
        let around = x.saturating_sub(SIDE)..columns.min(x + SIDE + 1);
        let count = around.len() as i32;
        let pixels = around.map(|x| &bytes[3 * (row + x)..][..3]);
        let sums = pixels.fold([0; 3], |sums: [i32; 3], pixel| {
            std::array::from_fn(|colour| sums[colour] + i32::from(pixel[colour]) - i32::from(pixel[1]))
        });
        sums.map(|sum| (i32::from(bytes[3 * k + 1]) + sum / count).clamp(0, 255) as u8)
    };
    (0..bytes.len() / 3).flat_map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_colour_stays_and_a_thin_line_gets_fringes() {
        let even: Vec<u8> = [200, 120, 60].repeat(5 * 4);
        assert_eq!(interpolate(&even, 5, 3), even);
        // A white column on black: the pixels beside it see a part of its light, each in one or two colours.
        let line: Vec<u8> = (0..6 * 6).flat_map(|k| [if k % 6 == 2 { 255 } else { 0 }; 3]).collect();
        let seen = interpolate(&line, 6, 0);
        let at = |x: usize, y: usize| &seen[3 * (y * 6 + x)..][..3];
        assert_eq!(at(2, 2)[0], 255);
        assert!(at(3, 2).iter().any(|value| *value > 0) && at(3, 2).windows(2).any(|pair| pair[0] != pair[1]));
    }

    #[test]
    fn fields_smooth_columns_and_leave_rows() {
        let rows: Vec<u8> = (0..4 * 8).flat_map(|k| [if k / 4 == 3 { 200 } else { 0 }; 3]).collect();
        let smooth = smooth_fields(&rows, 4);
        let column: Vec<u8> = (0..8).map(|y| smooth[3 * 4 * y]).collect();
        assert_eq!(column, [0, 0, 50, 100, 50, 0, 0, 0]);
        let columns: Vec<u8> = (0..4 * 8).flat_map(|k| [(k % 4 * 60) as u8; 3]).collect();
        assert_eq!(smooth_fields(&columns, 4), columns);
    }

    #[test]
    fn colours_are_smoothed_along_rows_and_green_is_kept() {
        let red: Vec<u8> = (0..9 * 3).flat_map(|k| [if k % 9 == 4 { 150 } else { 100 }, 100, 100]).collect();
        let smooth = smooth_colours(&red, 9);
        let row: Vec<u8> = (0..9).map(|x| smooth[3 * (9 + x)]).collect();
        assert_eq!(row, [100, 100, 110, 110, 110, 110, 110, 100, 100]);
        assert!(smooth.chunks_exact(3).all(|pixel| pixel[1..] == [100, 100]));
    }

    #[test]
    fn what_a_pixel_sees_is_kept() {
        let bytes: Vec<u8> = (0..8 * 6 * 3).map(|k| (k * 37 % 251) as u8).collect();
        let after = interpolate(&bytes, 8, 0);
        for (k, (before, after)) in bytes.chunks_exact(3).zip(after.chunks_exact(3)).enumerate() {
            let colour = seen(k % 8, k / 8);
            assert_eq!(before[colour], after[colour]);
        }
    }
}
