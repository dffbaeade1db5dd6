//! Jittered grids of places.

use crate::rng::Rng;
use glam::Vec2;

/// Width over height of a room that is made for a field.
const ASPECT: f32 = 16.0 / 9.0;

/// A grid without a room.
#[derive(Clone, Debug)]
pub(super) struct GridPlan {
    pub count: u32,
    /// Distance of neighbours, units.
    pub pitch: f32,
    /// Farthest from its grid point that an organism is put, in each direction, units.
    pub jitter: f32,
    /// Free room between the field and the walls, units.
    pub margin: f32,
}

/// A grid in a room.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    plan: GridPlan,
    columns: u32,
    /// Its lower left corner.
    low: Vec2,
}

impl GridPlan {
    /// Size of a room of the usual shape that the field fills.
    pub(super) fn room(&self) -> Vec2 {
        self.size(self.columns(ASPECT)) + 2.0 * self.margin
    }

    /// Lays the grid out in the middle of a room, if it fits.
    pub(super) fn fit(self, room: Vec2) -> Option<Grid> {
        let inner = room - 2.0 * self.margin;
        let most = (inner.x / self.pitch * (1.0 + 1e-5)) as u32;
        let columns = [ASPECT, inner.x / inner.y].map(|aspect| self.columns(aspect));
        let fits = |columns: &u32| *columns > 0 && self.size(*columns).cmple(inner * (1.0 + 1e-5)).all();
        let columns = columns.into_iter().chain([most]).find(fits)?;
        let low = (room - self.size(columns)) * 0.5;
        Some(Grid { plan: self, columns, low })
    }

    /// Columns of a grid of about this shape.
    fn columns(&self, aspect: f32) -> u32 {
        ((self.count as f32 * aspect).sqrt().ceil() as u32).clamp(1, self.count)
    }

    fn size(&self, columns: u32) -> Vec2 {
        Vec2::new(columns as f32, self.count.div_ceil(columns) as f32) * self.pitch
    }
}

impl Grid {
    pub(super) fn count(&self) -> u32 {
        self.plan.count
    }

    /// The places, row by row.
    pub(super) fn places<'a>(&'a self, rng: &'a mut Rng) -> impl Iterator<Item = Vec2> + 'a {
        let GridPlan { count, pitch, jitter, .. } = self.plan;
        (0..count).map(move |index| {
            let cell = Vec2::new((index % self.columns) as f32, (index / self.columns) as f32);
            let shift = Vec2::new(rng.range(-jitter, jitter), rng.range(-jitter, jitter));
            self.low + (cell + 0.5) * pitch + shift
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(count: u32) -> GridPlan {
        GridPlan { count, pitch: 5.6, jitter: 0.2, margin: 10.0 }
    }

    #[test]
    fn any_count_fits_the_room_made_for_it_and_keeps_its_distance() {
        for count in [1, 2, 3, 90, 120, 150, 200, 997, 20_000] {
            let room = plan(count).room();
            let grid = plan(count).fit(room).unwrap();
            let places: Vec<Vec2> = grid.places(&mut Rng::new(1, 1)).collect();
            assert_eq!(places.len() as u32, count);
            let is_inside = |p: &Vec2| p.cmpge(Vec2::splat(12.6)).all() && p.cmple(room - 12.6).all();
            assert!(places.iter().all(is_inside), "{count} in {room}");
            let columns = grid.columns as usize;
            let apart = |k: usize, other: usize| (places[k] - places[other]).length() > 5.6 - 0.4;
            assert!((columns..places.len()).all(|k| apart(k, k - columns)));
            assert!((1..places.len()).all(|k| apart(k, k - 1)));
        }
        assert!((plan(200).room().x / plan(200).room().y - ASPECT).abs() < 0.3);
    }

    #[test]
    fn a_grid_takes_the_shape_of_its_room_or_does_not_fit() {
        let tall = plan(10).fit(Vec2::new(26.0, 90.0)).unwrap();
        assert_eq!(tall.columns, 1);
        assert!(plan(10).fit(Vec2::new(26.0, 60.0)).is_none());
        assert!(plan(10).fit(Vec2::new(15.0, 60.0)).is_none());
        assert!(plan(10).fit(Vec2::new(f32::NAN, 60.0)).is_none());
    }
}
