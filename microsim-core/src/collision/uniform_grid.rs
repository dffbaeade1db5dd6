//! Uniform grid, filled by counting sort: the entries of a cell, and of a row of cells, lie side by side.

use glam::Vec2;
use std::ops::Range;

/// Cells along one side at most; a sparser world gets larger cells, about one for every four entries.
const MAX_CELLS: f32 = 2048.0;

/// Entries sorted by cell, row by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct UniformGrid {
    origin: Vec2,
    inverse_cell: Vec2,
    columns: usize,
    rows: usize,
    /// First entry of each cell, and one past the last entry of the last cell.
    starts: Vec<u32>,
    /// What was sorted, in cell order; within a cell in the order given.
    order: Vec<u32>,
    cells: Vec<u32>,
}

impl UniformGrid {
    /// Sorts entries `0..count` by the cell of their position. `low..high` is the area to cover; what lies outside it is
    /// put into the border cells. Cells have at least the size `cell`.
    pub(crate) fn fill(&mut self, low: Vec2, high: Vec2, cell: Vec2, count: usize, position: impl Fn(usize) -> Vec2) {
        self.resize(low, high, cell, count);
        let mut cells = std::mem::take(&mut self.cells);
        cells.clear();
        cells.extend((0..count).map(|e| self.cell_index(position(e)) as u32));
        self.cells = cells;
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &cell in &self.cells {
            self.starts[cell as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.order.clear();
        self.order.resize(count, 0);
        // Each start is the end of its cell so far; filling backwards turns it into the first entry and keeps the order.
        for (entry, &cell) in self.cells.iter().enumerate().rev() {
            let end = &mut self.starts[cell as usize];
            *end -= 1;
            self.order[*end as usize] = entry as u32;
        }
    }

    fn resize(&mut self, low: Vec2, high: Vec2, cell: Vec2, count: usize) {
        let extent = high - low;
        let budget = (4 * count + 1024) as f32;
        let coarser = largest([1.0, extent.x / (cell.x * MAX_CELLS), extent.y / (cell.y * MAX_CELLS)]);
        let crowded = (extent.x * extent.y / (cell.x * cell.y * budget)).sqrt();
        let cell = cell * largest([coarser, crowded]);
        let inverse = |size: f32| if size > 0.0 { 1.0 / size } else { 0.0 };
        self.origin = low;
        self.inverse_cell = Vec2::new(inverse(cell.x), inverse(cell.y));
        self.columns = (extent.x * self.inverse_cell.x) as usize + 1;
        self.rows = (extent.y * self.inverse_cell.y) as usize + 1;
    }

    /// All entries, in cell order.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    /// How many columns away something within this distance can be.
    pub(crate) fn columns_within(&self, distance: f32) -> usize {
        (distance * self.inverse_cell.x).ceil() as usize
    }

    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// Column and row of the cell that holds `point`; a float-to-integer cast saturates, so any point has one. (To `i32`:
    /// one instruction on x86-64, where `usize` takes several.)
    #[inline(always)]
    pub(crate) fn cell_of(&self, point: Vec2) -> (usize, usize) {
        let local = (point - self.origin) * self.inverse_cell;
        let place = |along: f32, cells: usize| ((along as i32).max(0) as usize).min(cells - 1);
        (place(local.x, self.columns), place(local.y, self.rows))
    }

    /// Column of the cell that an entry of [`UniformGrid::order`] in this row is in.
    pub(crate) fn column_at(&self, row: usize, place: usize) -> usize {
        self.cells[self.order[place] as usize] as usize - row * self.columns
    }

    fn cell_index(&self, point: Vec2) -> usize {
        let (column, row) = self.cell_of(point);
        row * self.columns + column
    }

    /// Entries of the cells `columns` of one row, as a range of [`UniformGrid::order`].
    pub(crate) fn row_range(&self, row: usize, columns: Range<usize>) -> Range<usize> {
        if columns.is_empty() || row >= self.rows {
            return 0..0;
        }
        let last = columns.end.min(self.columns);
        let base = row * self.columns;
        self.starts[base + columns.start] as usize..self.starts[base + last] as usize
    }

    /// Entries of the cells that a box touches, row by row, as ranges of [`UniformGrid::order`].
    pub(crate) fn ranges_in_box(&self, low: Vec2, high: Vec2) -> impl Iterator<Item = Range<usize>> {
        let ((c0, r0), (c1, r1)) = (self.cell_of(low), self.cell_of(high));
        (r0..=r1).map(move |row| self.row_range(row, c0..c1 + 1))
    }

    /// Calls `visit` once for each two places in [`UniformGrid::order`] in the same or neighbouring cells, the first of them in
    /// these rows: within a cell, with the cell to the right, and with the three cells above.
    #[inline(always)]
    pub(crate) fn pairs(&self, rows: Range<usize>, mut visit: impl FnMut(usize, usize)) {
        self.neighbours(rows, |cell, right, above| {
            for k in cell {
                (k + 1..right.end).chain(above.clone()).for_each(|other| visit(k, other));
            }
        });
    }

    /// The same cell by cell: calls `visit` with the places in each that is not empty, those in it and in the cell to the right,
    /// and those in the three cells above.
    #[inline(always)]
    pub(crate) fn neighbours(
        &self,
        rows: Range<usize>,
        mut visit: impl FnMut(Range<usize>, Range<usize>, Range<usize>),
    ) {
        for row in rows.start..rows.end.min(self.rows) {
            for column in 0..self.columns {
                let cell = self.row_range(row, column..column + 1);
                if !cell.is_empty() {
                    let right = self.row_range(row, column..column + 2);
                    visit(cell, right, self.row_range(row + 1, column.saturating_sub(1)..column + 2));
                }
            }
        }
    }
}

/// The largest of some numbers; NaN counts as none.
fn largest<const N: usize>(numbers: [f32; N]) -> f32 {
    numbers.into_iter().fold(0.0, |most, number| if number > most { number } else { most })
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
        let mut grid = UniformGrid::default();
        for _ in 0..2 {
            grid.fill(Vec2::ZERO, Vec2::new(20.0, 10.0), Vec2::splat(1.5), points.len(), |e| points[e]);
        }
        let mut seen = grid.order().to_vec();
        seen.sort_unstable();
        assert_eq!(seen, entries);
        for row in 0..grid.rows() {
            for column in 0..grid.columns() {
                for &e in &grid.order()[grid.row_range(row, column..column + 1)] {
                    assert_eq!(grid.cell_of(points[e as usize]), (column, row));
                }
            }
        }
        let (low, high) = (Vec2::new(3.0, 2.0), Vec2::new(7.0, 9.0));
        let ranges = grid.ranges_in_box(low, high);
        let found: Vec<u32> = ranges.flat_map(|range| grid.order()[range].to_vec()).collect();
        for (e, p) in points.iter().enumerate() {
            let is_inside = p.cmpge(low).all() && p.cmple(high).all();
            assert!(!is_inside || found.contains(&(e as u32)), "{p} missing");
        }
    }

    #[test]
    fn non_finite_points_and_empty_grids_are_harmless() {
        let mut grid = UniformGrid::default();
        grid.fill(Vec2::ZERO, Vec2::ONE, Vec2::splat(0.1), 2, |_| Vec2::NAN);
        assert_eq!(grid.order().len(), 2);
        grid.fill(Vec2::ZERO, Vec2::ZERO, Vec2::ZERO, 0, |_| Vec2::ZERO);
        assert_eq!(grid.ranges_in_box(Vec2::ZERO, Vec2::ONE).flatten().count(), 0);
    }

    #[test]
    fn nan_is_never_the_largest() {
        assert_eq!(largest([1.0, f32::NAN, 3.0, 2.0]), 3.0);
        assert_eq!(largest([f32::NAN]), 0.0);
    }
}
