//! Accelerations on the nodes of a regular grid, for a force field.

use super::{STRONGEST, point_in_range};
use crate::error::{Error, count_in_range, in_range, out_of_range};
use crate::float_environment::with_default_float_environment;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Accelerations on the nodes of a regular grid over an upright rectangle, units/s2. Between nodes they are interpolated
/// bilinearly; outside of the rectangle there are none. Clones share the nodes.
///
/// ```
/// use microsim_core::{AccelerationGrid, glam::Vec2};
///
/// let (low, high) = (Vec2::ZERO, Vec2::new(20.0, 10.0));
/// let shear = AccelerationGrid::sampled(low, high, [3, 2], |at| Vec2::new(0.5 * at.y, 0.0))?;
/// assert_eq!(shear.acceleration_at(Vec2::new(13.0, 4.0)), Vec2::new(2.0, 0.0));
/// assert_eq!(shear.acceleration_at(Vec2::new(13.0, 10.1)), Vec2::ZERO);
/// # Ok::<(), microsim_core::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Parts")]
pub struct AccelerationGrid {
    low: Vec2,
    high: Vec2,
    size: [u32; 2],
    nodes: Arc<[Vec2]>,
}

/// An [`AccelerationGrid`] as it is read, to be checked.
#[derive(Deserialize)]
struct Parts {
    low: Vec2,
    high: Vec2,
    size: [u32; 2],
    nodes: Vec<Vec2>,
}

impl TryFrom<Parts> for AccelerationGrid {
    type Error = Error;

    fn try_from(Parts { low, high, size, nodes }: Parts) -> Result<Self, Error> {
        Self::new(low, high, size, nodes)
    }
}

impl AccelerationGrid {
    /// Most nodes of a grid: 512 by 512, 2 MiB. A digest and a snapshot of a world read all of them.
    pub const MOST_NODES: u32 = 1 << 18;

    /// A grid of so many columns and rows, at least 2 each, from the lower left to the upper right corner of a rectangle: row by row,
    /// upwards, each from left to right. Coordinates are within ±100 000, components of accelerations within ±1 000 000.
    ///
    /// # Errors
    /// Names the number that is out of its range; `nodes` when there are others than columns times rows of them, or more than
    /// [`AccelerationGrid::MOST_NODES`].
    pub fn new(low: Vec2, high: Vec2, [columns, rows]: [u32; 2], nodes: Vec<Vec2>) -> Result<Self, Error> {
        check(low, high, [columns, rows])?;
        let count = columns as usize * rows as usize;
        if nodes.len() != count {
            return Err(out_of_range("nodes", nodes.len() as f64, format!("{count}, columns times rows")));
        }
        for (k, node) in nodes.iter().enumerate() {
            in_range("x", node.x, -STRONGEST, STRONGEST).map_err(|error| error.within(&format!("nodes[{k}]")))?;
            in_range("y", node.y, -STRONGEST, STRONGEST).map_err(|error| error.within(&format!("nodes[{k}]")))?;
        }
        Ok(Self { low, high, size: [columns, rows], nodes: nodes.into() })
    }

    /// The same from the acceleration at the place of each node.
    ///
    /// # Errors
    /// As for [`AccelerationGrid::new`].
    pub fn sampled(low: Vec2, high: Vec2, size: [u32; 2], at: impl FnMut(Vec2) -> Vec2) -> Result<Self, Error> {
        check(low, high, size)?;
        let places = with_default_float_environment(|| places(low, high, size));
        Self::new(low, high, size, places.into_iter().map(at).collect())
    }

    /// Lower left and upper right corner of its rectangle, units.
    #[must_use]
    pub fn bounds(&self) -> [Vec2; 2] {
        [self.low, self.high]
    }

    /// Number of its columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Accelerations on its nodes, row by row, units/s2.
    #[must_use]
    pub fn nodes(&self) -> &[Vec2] {
        &self.nodes
    }

    /// Acceleration at a point, units/s2; zero outside of its rectangle.
    #[must_use]
    pub fn acceleration_at(&self, point: Vec2) -> Vec2 {
        let is_inside = point.cmpge(self.low).all() && point.cmple(self.high).all();
        if !is_inside {
            return Vec2::ZERO;
        }
        let [columns, rows] = self.size;
        let at = (point - self.low) / (self.high - self.low) * Vec2::new((columns - 1) as f32, (rows - 1) as f32);
        let (column, row) = ((at.x as u32).min(columns - 2), (at.y as u32).min(rows - 2));
        let part = at - Vec2::new(column as f32, row as f32);
        let first = (row * columns + column) as usize;
        let along = |k: usize| between(self.nodes[k], self.nodes[k + 1], part.x);
        between(along(first), along(first + columns as usize), part.y)
    }
}

/// Linear interpolation; between equal values exact.
fn between(a: Vec2, b: Vec2, part: f32) -> Vec2 {
    a + (b - a) * part
}

/// Checks the rectangle and the number of nodes.
fn check(low: Vec2, high: Vec2, [columns, rows]: [u32; 2]) -> Result<(), Error> {
    point_in_range("low", low)?;
    point_in_range("high", high)?;
    for (field, low, high) in [("high.x", low.x, high.x), ("high.y", low.y, high.y)] {
        if high <= low {
            return Err(out_of_range(field, high.into(), format!("more than {low}")));
        }
    }
    let most = AccelerationGrid::MOST_NODES;
    count_in_range("columns", columns, 2, most / 2)?;
    count_in_range("rows", rows, 2, most / 2)?;
    let count = u64::from(columns) * u64::from(rows);
    if count > most.into() {
        return Err(out_of_range("nodes", count as f64, format!("at most {most}")));
    }
    Ok(())
}

/// Places of the nodes, row by row.
fn places(low: Vec2, high: Vec2, [columns, rows]: [u32; 2]) -> Vec<Vec2> {
    let pitch = (high - low) / Vec2::new((columns - 1) as f32, (rows - 1) as f32);
    let row = |k: u32| (0..columns).map(move |column| low + pitch * Vec2::new(column as f32, k as f32));
    (0..rows).flat_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOW: Vec2 = Vec2::new(-3.0, 2.0);
    const HIGH: Vec2 = Vec2::new(9.0, 8.0);

    /// `a + b x + c y + d x y` in each component, which bilinear interpolation leaves as it is.
    fn twisted(at: Vec2) -> Vec2 {
        Vec2::new(1.0 + 2.0 * at.x - 0.5 * at.y + 0.25 * at.x * at.y, -3.0 + at.y - 0.125 * at.x * at.y)
    }

    #[test]
    fn what_is_bilinear_is_interpolated_exactly_on_any_grid() {
        for size in [[2, 2], [7, 4], [13, 5]] {
            let grid = AccelerationGrid::sampled(LOW, HIGH, size, twisted).unwrap();
            for k in 0..=100u8 {
                let part = Vec2::new(f32::from(k % 11) / 10.0, f32::from(k / 11) / 10.0);
                let at = LOW + (HIGH - LOW) * if part.y > 1.0 { Vec2::ONE } else { part };
                let (found, expected) = (grid.acceleration_at(at), twisted(at));
                assert!((found - expected).length() < 1e-4, "{found} instead of {expected} at {at}");
            }
        }
    }

    #[test]
    fn a_parabola_differs_by_an_eighth_of_the_square_of_the_pitch_between_two_nodes() {
        let grid = AccelerationGrid::sampled(LOW, HIGH, [13, 2], |at| Vec2::new(at.x * at.x, 0.0)).unwrap();
        for (x, excess) in [(2.0, 0.0), (2.5, 0.25), (2.25, 0.1875)] {
            let found = grid.acceleration_at(Vec2::new(x, 5.0)).x;
            assert!((found - x * x - excess).abs() < 1e-4, "{found} at {x}");
        }
    }

    #[test]
    fn nodes_go_row_by_row_and_outside_there_is_nothing() {
        let nodes = (0..6u8).map(|k| Vec2::new(f32::from(k), 1.0)).collect();
        let grid = AccelerationGrid::new(LOW, HIGH, [3, 2], nodes).unwrap();
        let at = |x: f32, y: f32| grid.acceleration_at(Vec2::new(x, y)).x;
        assert_eq!([at(-3.0, 2.0), at(3.0, 2.0), at(9.0, 2.0), at(-3.0, 8.0), at(9.0, 8.0)], [0.0, 1.0, 2.0, 3.0, 5.0]);
        assert_eq!([at(6.0, 5.0), at(0.0, 2.0)], [3.0, 0.5]);
        for outside in [Vec2::new(-3.01, 5.0), Vec2::new(0.0, 8.01), Vec2::NAN, Vec2::INFINITY] {
            assert_eq!(grid.acceleration_at(outside), Vec2::ZERO);
        }
        assert_eq!((grid.bounds(), grid.size(), grid.nodes().len()), ([LOW, HIGH], [3, 2], 6));
    }

    #[test]
    fn clones_share_their_nodes() {
        let grid = AccelerationGrid::sampled(LOW, HIGH, [4, 4], twisted).unwrap();
        assert!(std::ptr::eq(grid.nodes(), grid.clone().nodes()));
    }

    #[test]
    fn every_number_out_of_range_is_named() {
        let refused = |low, high, size, value: Vec2| {
            let grid = AccelerationGrid::sampled(low, high, size, |_| value);
            grid.unwrap_err().field().to_owned()
        };
        assert_eq!(refused(Vec2::NAN, HIGH, [2, 2], Vec2::ZERO), "low.x");
        assert_eq!(refused(LOW, Vec2::new(9.0, 2e5), [2, 2], Vec2::ZERO), "high.y");
        assert_eq!(refused(LOW, LOW, [2, 2], Vec2::ZERO), "high.x");
        assert_eq!(refused(LOW, HIGH, [1, 2], Vec2::ZERO), "columns");
        assert_eq!(refused(LOW, HIGH, [2, u32::MAX], Vec2::ZERO), "rows");
        assert_eq!(refused(LOW, HIGH, [513, 512], Vec2::ZERO), "nodes");
        assert_eq!(refused(LOW, HIGH, [2, 2], Vec2::new(0.0, 1.1e6)), "nodes[0].y");
        assert_eq!(refused(LOW, HIGH, [2, 2], Vec2::NAN), "nodes[0].x");
        let few = AccelerationGrid::new(LOW, HIGH, [2, 2], vec![Vec2::ZERO; 3]).unwrap_err();
        assert_eq!(few.to_string(), "`nodes` is 3, accepted: 4, columns times rows");
    }
}
