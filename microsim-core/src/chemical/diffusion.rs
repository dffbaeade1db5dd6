//! Diffusion on a grid: explicit and in flux form, in as many rounds a step as keep it stable. What leaves a cell enters the
//! next one, so nothing is lost, and no round makes anything negative or a peak higher.

use glam::Vec2;
use std::ops::Range;

/// Largest share of a cell's content that crosses one of its faces in a round. 1/4 is the limit of stability; with 1/6 a
/// third of the finest ripple is left after a round.
const SHARE: f32 = 1.0 / 6.0;
/// Most rounds in a step.
const MAX_ROUNDS: f32 = 256.0;

/// Rounds that a step needs with cells of this size, or the largest diffusion coefficient for which they are not too many.
pub(super) fn rounds(cell: Vec2, diffusion: f32, dt: f32) -> Result<u32, f32> {
    let shorter = cell.min_element();
    let each = dt / (SHARE * shorter * shorter);
    let rounds = (diffusion * each).ceil();
    if rounds > MAX_ROUNDS { Err(MAX_ROUNDS / each) } else { Ok((rounds as u32).max(1)) }
}

/// The cells from one place to another along a side of so many, with one more at each end.
fn within(first: f32, last: f32, count: usize) -> Range<usize> {
    (first as usize).saturating_sub(1)..(last as usize).saturating_add(2).min(count)
}

/// The cells of a room and the faces between them.
#[derive(Clone, Debug)]
pub(super) struct DiffusionGrid {
    /// Columns and rows.
    pub count: [usize; 2],
    /// Width and height of a cell, units.
    pub cell: Vec2,
    /// Cells that lie in no obstacle.
    pub is_open: Vec<bool>,
    /// 1 for faces that something crosses, else 0: in each row from the left wall to the right one, ...
    across: Vec<f32>,
    /// ... and in rows from the lower wall to the upper one.
    upwards: Vec<f32>,
}

impl DiffusionGrid {
    pub(super) fn new(count: [usize; 2], size: Vec2) -> Self {
        let [columns, rows] = count;
        let is_inner = |k: usize, of: usize| f32::from(u8::from(k > 0 && k < of));
        let across = (0..rows).flat_map(|_| (0..=columns).map(|k| is_inner(k, columns)));
        let upwards = (0..=rows).flat_map(|k| std::iter::repeat_n(is_inner(k, rows), columns));
        Self {
            count,
            cell: size / Vec2::new(columns as f32, rows as f32),
            is_open: vec![true; columns * rows],
            across: across.collect(),
            upwards: upwards.collect(),
        }
    }

    pub(super) fn cell_area(&self) -> f32 {
        self.cell.x * self.cell.y
    }

    /// Closes and empties cells whose centre is inside of something within a box, and closes the faces of which the middle is.
    pub(super) fn close(&mut self, values: &mut [f32], [low, high]: [Vec2; 2], is_inside: impl Fn(Vec2) -> bool) {
        let [columns, rows] = self.count;
        let corner = |x: f32, y: f32| is_inside(Vec2::new(x, y) * self.cell);
        let (first, last) = (low / self.cell, high / self.cell);
        let (columns_in, rows_in) = (within(first.x, last.x, columns), within(first.y, last.y, rows));
        for (row, column) in rows_in.flat_map(|row| columns_in.clone().map(move |column| (row, column))) {
            let (x, y, at) = (column as f32, row as f32, row * columns + column);
            let (left, below) = (at + row, at);
            if self.is_open[at] && corner(x + 0.5, y + 0.5) {
                (self.is_open[at], values[at]) = (false, 0.0);
                self.across[left..=left + 1].fill(0.0);
                (self.upwards[below], self.upwards[below + columns]) = (0.0, 0.0);
            }
            if self.across[left] > 0.0 && corner(x, y + 0.5) {
                self.across[left] = 0.0;
            }
            if self.upwards[below] > 0.0 && corner(x + 0.5, y) {
                self.upwards[below] = 0.0;
            }
        }
    }

    /// One round: `spread` is the diffusion coefficient times the time of the round, `keep` the share that does not decay.
    #[inline(always)]
    pub(super) fn diffuse(&self, values: &mut [f32], spread: f32, keep: f32) {
        let [columns, rows] = self.count;
        let share = spread / (self.cell * self.cell);
        // The old values of the row that is being written, with a cell beyond each wall, and of the one below.
        let (mut here, mut below) = (vec![0.0; columns + 2], vec![0.0; columns]);
        let none = vec![0.0; columns];
        for row in 0..rows {
            let (written, next) = values[row * columns..].split_at_mut(columns);
            here[1..=columns].copy_from_slice(written);
            let above = if row + 1 < rows { &next[..columns] } else { &none[..] };
            let left = &self.across[row * (columns + 1)..][..columns];
            let right = &self.across[row * (columns + 1) + 1..][..columns];
            let low = &self.upwards[row * columns..][..columns];
            let high = &self.upwards[(row + 1) * columns..][..columns];
            let (before, now, after) = (&here[..columns], &here[1..=columns], &here[2..columns + 2]);
            for k in 0..columns {
                let c = now[k];
                let sideways = left[k] * (before[k] - c) + right[k] * (after[k] - c);
                let lengthways = low[k] * (below[k] - c) + high[k] * (above[k] - c);
                written[k] = (c + (share.x * sideways + share.y * lengthways)) * keep;
            }
            below.copy_from_slice(&here[1..=columns]);
        }
    }

    /// The open ones of the four cells whose centres are around a point, with their shares in a bilinear interpolation.
    pub(super) fn around(&self, at: Vec2) -> [(usize, f32); 4] {
        let [columns, rows] = self.count;
        let last = Vec2::new(columns as f32 - 1.0, rows as f32 - 1.0);
        let place = (at / self.cell - 0.5).clamp(Vec2::ZERO, last);
        // Places that are no numbers become the first cell.
        let (column, row) = (place.x as usize, place.y as usize);
        let part = place - Vec2::new(column as f32, row as f32);
        let (right, up) = ((column + 1).min(columns - 1), (row + 1).min(rows - 1));
        let mut cells = [
            (row * columns + column, (1.0 - part.x) * (1.0 - part.y)),
            (row * columns + right, part.x * (1.0 - part.y)),
            (up * columns + column, (1.0 - part.x) * part.y),
            (up * columns + right, part.x * part.y),
        ];
        let is_open = |cell: usize| f32::from(u8::from(self.is_open[cell]));
        cells.iter_mut().for_each(|(cell, share)| *share *= is_open(*cell));
        let sum: f32 = cells.iter().map(|(_, share)| share).sum();
        cells.iter_mut().for_each(|(_, share)| *share = if sum > 0.0 { *share / sum } else { 0.0 });
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn only_cells_near_an_obstacle_are_looked_at_and_the_same_are_closed() {
        let size = Vec2::new(400.0, 300.0);
        for at in [[200.0, 150.0], [0.5, 299.0], [-3.0, 7.0], [405.0, 310.0], [-90.0, 20.0]].map(Vec2::from) {
            let looks = Cell::new(0);
            let is_inside = |point: Vec2| {
                looks.set(looks.get() + 1);
                (point - at).length() < 7.3
            };
            let closed = |bounds: [Vec2; 2]| {
                let (mut grid, mut values) = (DiffusionGrid::new([400, 300], size), vec![1.0; 120_000]);
                grid.close(&mut values, bounds, is_inside);
                (grid.is_open, grid.across, grid.upwards, values)
            };
            let all = closed([Vec2::ZERO, size]);
            looks.set(0);
            assert!(closed([at - 7.3, at + 7.3]) == all, "{at}");
            assert!(looks.get() < 1000, "{} at {at}", looks.get());
        }
    }
}
