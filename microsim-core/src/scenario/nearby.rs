//! What may lie near a place: circles of like size in one grid, so that a few large ones among many small ones cost little.

use glam::Vec2;
use std::collections::BTreeMap;
use std::iter;

/// The smallest circles, which are in one grid, have at most this radius, units.
const LEAST: f32 = 1.0 / 16.0;
/// Share of its largest radius by which a grid is searched farther than needed, far above rounding.
const MARGIN: f32 = 0.1;

/// Exponent of infinity.
const INFINITE: u32 = 255;

/// Things within circles, in grids by the power of two that is next to the radius.
#[derive(Clone, Debug)]
pub(super) struct Nearby<T>(BTreeMap<u32, Grid<T>>);

/// Things within circles of at most a radius.
#[derive(Clone, Debug)]
struct Grid<T> {
    radius: f32,
    /// What has its centre in a cell, by row and column.
    cells: BTreeMap<[i32; 2], Vec<T>>,
}

impl<T> Default for Nearby<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<T> Nearby<T> {
    /// Adds something that lies within a circle.
    pub(super) fn add(&mut self, centre: Vec2, radius: f32, thing: T) {
        // The next power of two has an exponent more and no fraction.
        let radius = if radius > LEAST { radius } else { LEAST };
        let rank = ((radius.to_bits() >> 23) + 1).min(INFINITE);
        let grid = self.0.entry(rank);
        let grid = grid.or_insert_with(|| Grid { radius: f32::from_bits(rank << 23), cells: BTreeMap::new() });
        grid.cells.entry(grid.cell_of(centre)).or_default().push(thing);
    }

    /// All whose circles reach into a circle, and some that do not.
    pub(super) fn around(&self, centre: Vec2, radius: f32) -> impl Iterator<Item = &T> {
        self.0.values().flat_map(move |grid| {
            let reach = radius + (1.0 + MARGIN) * grid.radius;
            grid.within(grid.cell_of(centre - reach), grid.cell_of(centre + reach))
        })
    }
}

impl<T> Grid<T> {
    fn cell_of(&self, at: Vec2) -> [i32; 2] {
        let [x, y] = (at / (2.0 * self.radius)).floor().as_ivec2().to_array();
        [y, x]
    }

    /// What is in the cells of a rectangle; cells without anything cost nothing.
    fn within(&self, low: [i32; 2], high: [i32; 2]) -> impl Iterator<Item = &T> {
        let mut next = Some(low);
        let filled = iter::from_fn(move || {
            loop {
                let (&cell, things) = self.cells.range(next?..).next().filter(|(cell, _)| **cell <= high)?;
                let [row, column] = cell;
                next = match column {
                    _ if column < low[1] => Some([row, low[1]]),
                    _ if column < high[1] => Some([row, column + 1]),
                    _ => row.checked_add(1).map(|row| [row, low[1]]),
                };
                if (low[1]..=high[1]).contains(&column) {
                    return Some(things);
                }
            }
        });
        filled.flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    #[test]
    fn all_that_reach_into_a_circle_are_found_and_few_others() {
        let mut rng = Rng::new(3, 3);
        let (mut nearby, mut circles) = (Nearby::default(), Vec::new());
        for k in 0..4000_usize {
            let centre = Vec2::new(rng.range(-30.0, 130.0), rng.range(-30.0, 130.0));
            let radius =
                [0.0, 1e-4, rng.range(0.0, 0.5), rng.range(0.5, 4.0), 40.0][if k % 500 == 0 { 4 } else { k % 4 }];
            nearby.add(centre, radius, k);
            circles.push((centre, radius));
        }
        let (mut looked, mut reaching) = (0, 0);
        for k in 0..400 {
            let at = Vec2::new(rng.range(-40.0, 140.0), rng.range(-40.0, 140.0));
            let within = if k % 40 == 0 { 50.0 } else { rng.range(0.0, 3.0) };
            let mut found: Vec<usize> = nearby.around(at, within).copied().collect();
            looked += found.len();
            found.sort_unstable();
            assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "each once");
            for (k, &(centre, radius)) in circles.iter().enumerate() {
                let reaches = (centre - at).length() < radius + within;
                reaching += usize::from(reaches);
                assert!(!reaches || found.binary_search(&k).is_ok(), "{centre} {radius} from {at} within {within}");
            }
        }
        assert!(looked < 3 * reaching, "{looked} for {reaching}");
    }

    #[test]
    fn places_far_away_do_no_harm() {
        let mut nearby = Nearby::default();
        for far in [1e30, -1e30, f32::MAX, f32::NAN] {
            nearby.add(Vec2::splat(far), 1.0, far);
            nearby.add(Vec2::new(5.0, far), 1e-3, far);
        }
        nearby.add(Vec2::splat(5.0), 1e30, 0.0);
        assert_eq!(nearby.around(Vec2::splat(50.0), 10.0).count(), 1);
        assert!(nearby.around(Vec2::ZERO, f32::INFINITY).count() > 4);
    }
}
