//! Uniform grid, filled by counting sort: the entries of a cell, and of a row of cells, lie side by side.

use glam::Vec2;
use std::ops::Range;

/// Cells along one side at most; a sparser world gets larger cells, about one for every four entries.
const MAX_CELLS: f32 = 2048.0;

/// Entries sorted by cell, row by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    origin: Vec2,
    inverse_cell: f32,
    columns: usize,
    rows: usize,
    /// First entry of each cell, and one past the last entry of the last cell.
    starts: Vec<u32>,
    /// What was sorted, in cell order; within a cell in the order given.
    entries: Vec<u32>,
    cells: Vec<u32>,
}

impl Grid {
    /// Sorts `entries` by the cell of their position. `low..high` is the area to cover; what lies outside it is put into
    /// the border cells.
    pub(crate) fn fill(&mut self, low: Vec2, high: Vec2, cell: f32, entries: &[u32], position: impl Fn(u32) -> Vec2) {
        self.resize(low, high, cell, entries.len());
        let mut cells = std::mem::take(&mut self.cells);
        cells.clear();
        cells.extend(entries.iter().map(|&e| self.cell_index(position(e)) as u32));
        self.cells = cells;
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &cell in &self.cells {
            self.starts[cell as usize] += 1;
        }
        for k in 1..self.starts.len() {
            self.starts[k] += self.starts[k - 1];
        }
        self.entries.clear();
        self.entries.resize(entries.len(), 0);
        // Each start is the end of its cell so far; filling backwards turns it into the first entry and keeps the order.
        for (&entry, &cell) in entries.iter().zip(&self.cells).rev() {
            let end = &mut self.starts[cell as usize];
            *end -= 1;
            self.entries[*end as usize] = entry;
        }
    }

    fn resize(&mut self, low: Vec2, high: Vec2, cell: f32, count: usize) {
        let extent = high - low;
        let longest = if extent.x > extent.y { extent.x } else { extent.y };
        let budget = (4 * count + 1024) as f32;
        let bounds = [cell, longest / MAX_CELLS, (extent.x * extent.y / budget).sqrt()];
        let cell = bounds.into_iter().fold(0.0, |largest, bound| if bound > largest { bound } else { largest });
        self.origin = low;
        self.inverse_cell = if cell > 0.0 { 1.0 / cell } else { 0.0 };
        self.columns = (extent.x * self.inverse_cell) as usize + 1;
        self.rows = (extent.y * self.inverse_cell) as usize + 1;
    }

    /// All entries, in cell order.
    pub(crate) fn entries(&self) -> &[u32] {
        &self.entries
    }

    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// Column and row of the cell that holds `point`; a float-to-integer cast saturates, so any point has one.
    pub(crate) fn cell_of(&self, point: Vec2) -> (usize, usize) {
        let local = (point - self.origin) * self.inverse_cell;
        ((local.x as usize).min(self.columns - 1), (local.y as usize).min(self.rows - 1))
    }

    fn cell_index(&self, point: Vec2) -> usize {
        let (column, row) = self.cell_of(point);
        row * self.columns + column
    }

    /// Entries of the cells `columns` of one row, as a range of [`Grid::entries`].
    pub(crate) fn row_range(&self, row: usize, columns: Range<usize>) -> Range<usize> {
        if columns.is_empty() || row >= self.rows {
            return 0..0;
        }
        let last = columns.end.min(self.columns);
        let base = row * self.columns;
        self.starts[base + columns.start] as usize..self.starts[base + last] as usize
    }

    /// Entries of the cells that a box touches, row by row.
    pub(crate) fn in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = u32> + '_ {
        let ((c0, r0), (c1, r1)) = (self.cell_of(low), self.cell_of(high));
        (r0..=r1).flat_map(move |row| self.entries[self.row_range(row, c0..c1 + 1)].iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    #[test]
    fn every_entry_is_in_its_cell_and_boxes_find_all() {
        let mut rng = Rng::new(3, 0);
        let points: Vec<Vec2> = (0..500).map(|_| Vec2::new(rng.range(-2.0, 22.0), rng.range(-2.0, 12.0))).collect();
        let entries: Vec<u32> = (0..500).collect();
        let mut grid = Grid::default();
        for _ in 0..2 {
            grid.fill(Vec2::ZERO, Vec2::new(20.0, 10.0), 1.5, &entries, |e| points[e as usize]);
        }
        let mut seen = grid.entries().to_vec();
        seen.sort_unstable();
        assert_eq!(seen, entries);
        for row in 0..grid.rows() {
            for column in 0..grid.columns() {
                for &e in &grid.entries()[grid.row_range(row, column..column + 1)] {
                    assert_eq!(grid.cell_of(points[e as usize]), (column, row));
                }
            }
        }
        let (low, high) = (Vec2::new(3.0, 2.0), Vec2::new(7.0, 9.0));
        let found: Vec<u32> = grid.in_box(low, high).collect();
        for (e, p) in points.iter().enumerate() {
            let is_inside = p.cmpge(low).all() && p.cmple(high).all();
            assert!(!is_inside || found.contains(&(e as u32)), "{p} missing");
        }
    }

    #[test]
    fn non_finite_points_and_empty_grids_are_harmless() {
        let mut grid = Grid::default();
        grid.fill(Vec2::ZERO, Vec2::ONE, 0.1, &[0, 1], |_| Vec2::NAN);
        assert_eq!(grid.entries().len(), 2);
        grid.fill(Vec2::ZERO, Vec2::ZERO, 0.0, &[], |_| Vec2::ZERO);
        assert_eq!(grid.in_box(Vec2::ZERO, Vec2::ONE).count(), 0);
    }
}
