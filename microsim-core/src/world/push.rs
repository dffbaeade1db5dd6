//! Pushing an organism: a change of its velocity.

use super::World;
use super::change::WorldChange;
use crate::error::{Error, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use glam::Vec2;

impl World {
    /// Adds a velocity to everything in an organism that can move: its own particles, and what it holds, up to the speed
    /// limit. Constraints and contacts act as usual, so nothing is pushed through anything.
    ///
    /// # Errors
    /// When the handle is stale, or a coordinate is not finite or beyond ±1000 units/s. Nothing is changed then.
    pub fn push(&mut self, id: OrganismId, velocity: Vec2) -> Result<(), Error> {
        with_default_float_environment(|| self.add_velocity(id, velocity))?;
        self.changed(|| WorldChange::Push(id, velocity));
        Ok(())
    }

    fn add_velocity(&mut self, id: OrganismId, velocity: Vec2) -> Result<(), Error> {
        self.organism_or_stale(id, "organism")?;
        in_range("velocity.x", velocity.x, -1000.0, 1000.0)?;
        in_range("velocity.y", velocity.y, -1000.0, 1000.0)?;
        let held = self.view().organism(id).into_iter().flat_map(|organism| organism.meals());
        let inside = held.filter(|(_, phase)| phase.is_inside()).map(|(prey, _)| prey);
        let limit = self.config.speed_limit();
        for organism in std::iter::once(id).chain(inside).collect::<Vec<_>>() {
            self.wake_up(organism);
            for i in self.discs_of(organism).collect::<Vec<_>>() {
                let Vec2 { x, y } = (self.particles.velocity(i) + velocity).clamp_length_max(limit);
                (self.particles.vx[i], self.particles.vy[i]) = (x, y);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::{AgarSpec, AmoeboidCellSpec, Inputs, Placement, PlateletSpec, World, WorldConfig};
    use glam::Vec2;

    #[test]
    fn only_the_pushed_organism_moves() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let agar = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 40.0)).unwrap();
        let other = world.spawn(&PlateletSpec::default().into(), Placement::at(40.0, 60.0)).unwrap();
        let before = [agar, cell, other].map(|id| world.centroid(id).unwrap());
        for _ in 0..60 {
            for id in [agar, cell] {
                world.push(id, Vec2::new(0.5, 0.0)).unwrap();
            }
            world.step(&Inputs::new());
        }
        let moved = |k: usize, id| (world.centroid(id).unwrap() - before[k]).x;
        assert!(moved(0, agar) > 2.0 && moved(1, cell) > 2.0, "{} {}", moved(0, agar), moved(1, cell));
        assert!(moved(2, other).abs() < 0.01);
        assert_eq!(world.census().leaks, 0);
    }

    #[test]
    fn many_pushes_in_a_step_stay_below_the_speed_limit() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let agar = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        (0..100).for_each(|_| world.push(agar, Vec2::new(-1000.0, 0.0)).unwrap());
        world.validate().unwrap();
    }

    #[test]
    fn invalid_pushes_are_refused_and_change_nothing() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let agar = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        let before = world.digest();
        assert_eq!(world.push(agar, Vec2::new(f32::NAN, 0.0)).unwrap_err().field(), "velocity.x");
        assert_eq!(world.digest(), before);
        world.remove(agar).unwrap();
        assert_eq!(world.push(agar, Vec2::X).unwrap_err().field(), "organism");
    }
}
