//! Ways around obstacles: A* on a grid of the room (Hart, Nilsson and Raphael 1968).

use microsim_core::glam::Vec2;
use microsim_core::{QueryFilter, World};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Side of a cell of the grid, units.
const CELL: f32 = 2.0;
/// Gap to obstacles beyond which more of it is no better, units.
const FREE: f32 = 8.0;
/// Least gap of the middle of a way: a soft cell gets through twice as wide a hole, units.
const LEAST: f32 = 1.5;
/// How far ahead on its way one looks, cells.
const AHEAD: usize = 3;

/// How far each cell of a grid is from obstacles and walls.
#[derive(Clone, Debug)]
pub struct PathMap {
    columns: usize,
    rows: usize,
    gaps: Vec<f32>,
}

impl PathMap {
    /// The map of a world whose obstacles stand still.
    #[must_use]
    pub fn new(world: &World) -> Self {
        let cells = (world.config().size / CELL).ceil();
        let (columns, rows) = (cells.x as usize, cells.y as usize);
        let (queries, surfaces) = (world.queries(), QueryFilter::surfaces());
        let gap = |at| queries.nearest(at, FREE, &surfaces).map_or(FREE, |found| found.distance);
        let gaps = (0..columns * rows).map(|cell| gap(middle(cell, columns))).collect();
        Self { columns, rows, gaps }
    }

    /// Where to head for now on the way from one point to another: the other itself when it is near or no way leads there.
    #[must_use]
    pub fn next(&self, from: Vec2, to: Vec2) -> Vec2 {
        self.next_past(from, to, |_| 0.0)
    }

    /// The same where a unit of way costs so much more, by the cell of the grid.
    pub fn next_past(&self, from: Vec2, to: Vec2, risk: impl Fn(usize) -> f32) -> Vec2 {
        let way = self.way(self.cell(from), self.cell(to), risk);
        way.get(AHEAD).filter(|_| way.len() > AHEAD + 1).map_or(to, |&cell| middle(cell, self.columns))
    }

    /// How far each cell is from a point for a body that needs this gap around its middle, and reaches this far into what is
    /// narrower, units; infinite where it does not get.
    #[must_use]
    pub fn reach(&self, from: Vec2, needed: f32, body: f32) -> Vec<f32> {
        let from = self.cell(from);
        // How far it is into what is narrow, and how far away.
        let mut found = vec![(f32::INFINITY, f32::INFINITY); self.gaps.len()];
        let mut open = BinaryHeap::from([(Reverse((0, 0)), from)]);
        found[from] = (0.0, 0.0);
        while let Some((_, cell)) = open.pop() {
            let (deep, far) = found[cell];
            for (next, length) in self.neighbours(cell) {
                let is_free = deep == 0.0 && self.gaps[next] >= needed;
                let new = (if is_free { 0.0 } else { deep + length }, far + length);
                if new.0 <= body && new < found[next] {
                    found[next] = new;
                    open.push((Reverse(((1000.0 * new.0) as u64, (1000.0 * new.1) as u64)), next));
                }
            }
        }
        found.into_iter().map(|(_, far)| far).collect()
    }

    /// Middles of all cells, in the order of their numbers.
    pub fn middles(&self) -> impl Iterator<Item = Vec2> {
        (0..self.gaps.len()).map(|cell| middle(cell, self.columns))
    }

    /// Number of the cell at a point.
    #[must_use]
    pub fn cell(&self, at: Vec2) -> usize {
        let most = Vec2::new(self.columns as f32, self.rows as f32) - 1.0;
        let place = (at / CELL).floor().clamp(Vec2::ZERO, most);
        place.y as usize * self.columns + place.x as usize
    }

    /// Cells from one to another; empty if no way leads there.
    fn way(&self, from: usize, to: usize, risk: impl Fn(usize) -> f32) -> Vec<usize> {
        let mut costs = vec![f32::INFINITY; self.gaps.len()];
        let mut before = vec![from; self.gaps.len()];
        let mut open = BinaryHeap::from([(Reverse(0), from)]);
        costs[from] = 0.0;
        while let Some((_, cell)) = open.pop() {
            if cell == to {
                return trace(&before, from, to);
            }
            for (next, length) in self.neighbours(cell) {
                let cost = costs[cell] + length * (1.0 + 2.0 * CELL / self.gaps[next].max(LEAST) + risk(next));
                if cost < costs[next] {
                    (costs[next], before[next]) = (cost, cell);
                    open.push((Reverse(self.rank(cost, next, to)), next));
                }
            }
        }
        Vec::new()
    }

    /// Least cost of a way over a cell, in thousandths.
    fn rank(&self, cost: f32, cell: usize, to: usize) -> u64 {
        let left = (middle(cell, self.columns) - middle(to, self.columns)).length();
        (1000.0 * (cost + left)) as u64
    }

    /// The cells around one that are wide enough, and how far they are.
    fn neighbours(&self, cell: usize) -> impl Iterator<Item = (usize, f32)> {
        let (x, y) = ((cell % self.columns) as isize, (cell / self.columns) as isize);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))).filter(|by| *by != (0, 0));
        around.filter_map(move |(dx, dy)| {
            let column = usize::try_from(x + dx).ok().filter(|&column| column < self.columns)?;
            let row = usize::try_from(y + dy).ok().filter(|&row| row < self.rows)?;
            let next = row * self.columns + column;
            (self.gaps[next] >= LEAST).then(|| (next, CELL * Vec2::new(dx as f32, dy as f32).length()))
        })
    }
}

fn trace(before: &[usize], from: usize, to: usize) -> Vec<usize> {
    let mut way: Vec<usize> = std::iter::successors(Some(to), |&cell| (cell != from).then(|| before[cell])).collect();
    way.reverse();
    way
}

fn middle(cell: usize, columns: usize) -> Vec2 {
    CELL * Vec2::new((cell % columns) as f32 + 0.5, (cell / columns) as f32 + 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::scenario::Scenario;

    #[test]
    fn a_way_leads_around_a_wall_and_none_through_it() {
        let world = |wall: &str| {
            let text = format!("schema = 1\n[world]\nsize = [60.0, 40.0]\n[[wall]]\nthickness = 4.0\n{wall}");
            Scenario::parse(&text, &[]).unwrap().build().unwrap().world
        };
        let (from, to) = (Vec2::new(15.0, 10.0), Vec2::new(45.0, 10.0));
        let open = PathMap::new(&world("from = [30.0, 0.0]\nto = [30.0, 26.0]"));
        let (mut at, mut highest, mut steps) = (from, 0.0_f32, 0);
        while (at - to).length() > 2.0 && steps < 100 {
            at += (open.next(at, to) - at).clamp_length_max(1.0);
            (highest, steps) = (highest.max(at.y), steps + 1);
            assert!((at.x - 30.0).abs() > 2.0 || at.y > 26.0, "{at} in the wall");
        }
        assert!(highest > 28.0 && steps < 100, "{at} after {steps}");
        let shut = PathMap::new(&world("from = [30.0, 0.0]\nto = [30.0, 40.0]"));
        assert_eq!(shut.next(from, to), to, "no way");
    }

    #[test]
    fn what_is_wide_does_not_get_through_a_gap() {
        let text = "schema = 1\n[world]\nsize = [60.0, 40.0]\n\
                    [[wall]]\nthickness = 4.0\nfrom = [30.0, 0.0]\nto = [30.0, 14.0]\n\
                    [[wall]]\nthickness = 4.0\nfrom = [30.0, 26.0]\nto = [30.0, 40.0]\n";
        let map = PathMap::new(&Scenario::parse(text, &[]).unwrap().build().unwrap().world);
        let ways = |needed, body| {
            let far = map.reach(Vec2::new(15.0, 20.0), needed, body);
            [[29.0, 20.0], [45.0, 20.0]].map(|at| far[map.cell(Vec2::from(at))])
        };
        let [gap, behind] = ways(2.0, 0.0);
        assert!((gap - 14.0).abs() < 2.0 && (behind - 30.0).abs() < 2.0, "{gap} {behind}");
        assert_eq!(ways(7.0, 0.0), [f32::INFINITY; 2]);
        let [gap, behind] = ways(7.0, 10.0);
        assert!(gap < 20.0 && behind == f32::INFINITY, "its rim is in the gap: {gap} {behind}");
    }
}
