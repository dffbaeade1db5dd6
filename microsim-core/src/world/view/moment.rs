//! Interpolation between two steps, for drawing at another rate than that of the steps.

use super::View;
use crate::particle::NO_OWNER;
use crate::shared::Shared;
use crate::world::World;
use glam::Vec2;

/// Positions of all particles at one moment, see [`World::view_since`].
#[derive(Clone, Debug, Default)]
pub struct Moment {
    time: f64,
    positions: Vec<Vec2>,
    owners: Shared<Vec<u32>>,
}

impl World {
    /// The present positions, for [`World::view_since`] after a later step.
    #[must_use]
    pub fn moment(&self) -> Moment {
        let count = self.particles.len();
        Moment {
            time: self.time(),
            positions: (0..count).map(|i| self.particles.position(i)).collect(),
            owners: self.particles.owner.clone(),
        }
    }

    /// A view of the moment that lies `share` of the way (0 to 1) from an earlier one to the present. What was not there
    /// earlier, or could not have come so far, is where it is now.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Inputs, Placement, World, WorldConfig, glam::Vec2};
    /// # let mut world = World::new(WorldConfig { gravity: Vec2::new(0.0, -10.0), ..WorldConfig::default() })?;
    /// # world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
    /// let before = world.moment();
    /// world.step(&Inputs::new());
    /// let between = world.view_since(&before, 0.5);
    /// assert_eq!(between.time(), 0.5 * world.time());
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    #[must_use]
    pub fn view_since<'a>(&'a self, earlier: &'a Moment, share: f32) -> View<'a> {
        View { earlier: Some((earlier, share)), ..self.view() }
    }
}

impl View<'_> {
    /// Simulated time of the moment that is seen, s.
    #[must_use]
    pub fn time(self) -> f64 {
        let now = self.world.time();
        self.earlier.map_or(now, |(earlier, share)| earlier.time + (now - earlier.time) * f64::from(share))
    }

    /// Where a particle is at that moment.
    pub(crate) fn position(self, i: u32) -> Vec2 {
        let now = self.world.particles.position(i as usize);
        self.earlier.map_or(now, |(earlier, share)| self.before(earlier, i, now).lerp(now, share))
    }

    /// Where a particle was, if it was there.
    fn before(self, earlier: &Moment, i: u32, now: Vec2) -> Vec2 {
        let i = i as usize;
        let owner = self.world.particles.owner[i];
        let was_there = owner != NO_OWNER && earlier.owners.get(i) == Some(&owner);
        // Indices are used again: a particle farther away than twice the speed limit allows was another one.
        let steps = ((self.world.time() - earlier.time) / f64::from(self.world.config.dt)) as f32 + 1.0;
        let farthest = 2.0 * steps * self.world.config.max_displacement();
        let near = |before: &Vec2| (*before - now).length_squared() <= farthest * farthest;
        // What has come in on the other side was that image of itself that is nearest to where it is.
        let period = self.world.period();
        let beside = |before: Vec2| if period.is_none() { before } else { now + period.nearest(before - now) };
        earlier.positions.get(i).copied().map(beside).filter(near).filter(|_| was_there).unwrap_or(now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AgarSpec, AmoeboidCellSpec, Inputs, Placement, PlateletSpec, WorldConfig};

    fn world() -> World {
        let gravity = Vec2::new(0.0, -10.0);
        World::new(WorldConfig { gravity, ..WorldConfig::default() }).unwrap()
    }

    #[test]
    fn positions_are_interpolated() {
        let mut world = world();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 40.0)).unwrap();
        (0..20).for_each(|_| world.step(&Inputs::new()));
        let before = world.moment();
        let from = world.centroid(cell).unwrap();
        world.step(&Inputs::new());
        let to = world.centroid(cell).unwrap();
        let at = |share: f32| world.view_since(&before, share).organism(cell).unwrap().centroid();
        assert!(to.y < from.y - 0.02, "{from} -> {to}");
        assert!((at(0.25) - from.lerp(to, 0.25)).length() < 1e-3);
        assert!((at(0.0) - from).length() < 1e-4);
        assert_eq!(at(1.0), to);
        assert_eq!(world.view().organism(cell).unwrap().centroid(), to);
        let particles =
            |view: View<'_>| view.organism(cell).unwrap().particles().map(|p| p.position).collect::<Vec<_>>();
        let (now, middle) = (particles(world.view()), particles(world.view_since(&before, 0.5)));
        assert!(now.iter().zip(&middle).all(|(now, middle)| now != middle));
    }

    #[test]
    fn organisms_added_or_removed_since_do_not_affect_the_others() {
        let mut world = world();
        let gone = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 30.0)).unwrap();
        let stays = world.spawn(&PlateletSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
        let before = world.moment();
        world.remove(gone).unwrap();
        let again = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 70.0)).unwrap();
        let came = world.spawn(&PlateletSpec::default().into(), Placement::at(90.0, 30.0)).unwrap();
        let view = world.view_since(&before, 0.5);
        assert!(view.organism(gone).is_none());
        for (id, expected) in [(stays, [60.0, 30.0]), (again, [40.0, 70.0]), (came, [90.0, 30.0])] {
            let at = view.organism(id).unwrap().centroid();
            assert!((at - Vec2::from(expected)).length() < 0.1, "{at} instead of {expected:?}");
        }
    }
}
