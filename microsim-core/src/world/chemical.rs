//! Chemicals, and which organisms secrete and take them up.

use super::World;
use super::change::WorldChange;
use crate::capability::exchange::Exchange;
use crate::chemical::{Chemical, ChemicalSpec};
use crate::collision::obstacle::Obstacle;
use crate::error::{Error, ErrorKind};
use crate::float_environment::with_default_float_environment;
use crate::id::{ChemicalId, OrganismId};

impl World {
    /// Adds a chemical, in the concentration that its spec says.
    ///
    /// # Errors
    /// Names the field out of its range, which may depend on the room, the time step and the other chemicals. A room with periodic
    /// sides has none.
    pub fn add_chemical(&mut self, spec: ChemicalSpec) -> Result<ChemicalId, Error> {
        let id = with_default_float_environment(|| self.insert_chemical(spec))?;
        self.changed(|| WorldChange::AddChemical(spec));
        Ok(id)
    }

    fn insert_chemical(&mut self, spec: ChemicalSpec) -> Result<ChemicalId, Error> {
        self.check_chemicals_allowed()?;
        spec.cells_beside(self.chemicals.iter().map(|other| other.values().len()).sum(), &self.config)?;
        let mut chemical = Chemical::new(spec, &self.config)?;
        let shut = self.solid_obstacles().filter(|obstacle| obstacle.stops_chemicals());
        shut.for_each(|obstacle| keep_out(&mut chemical, obstacle));
        self.chemicals.push(chemical);
        Ok(ChemicalId(self.chemicals.len() as u32 - 1))
    }

    /// Lets an organism secrete and take up a chemical, in place of what it did with that one before.
    ///
    /// # Errors
    /// When the organism or the chemical does not exist, or a number is out of range.
    pub fn set_exchange(&mut self, id: OrganismId, exchange: Exchange) -> Result<(), Error> {
        with_default_float_environment(|| exchange.validate())?;
        self.check_chemical(exchange.chemical, "chemical")?;
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        organism.exchanges.retain(|other| other.chemical != exchange.chemical);
        organism.exchanges.push(exchange);
        self.changed(|| WorldChange::SetExchange(id, exchange));
        Ok(())
    }

    pub(super) fn check_chemical(&self, id: ChemicalId, field: &str) -> Result<(), Error> {
        let is_known = (id.0 as usize) < self.chemicals.len();
        is_known.then_some(()).ok_or_else(|| Error::reference(field, "a chemical of this world"))
    }
}

/// Keeps a chemical out of an obstacle.
pub(super) fn keep_out(chemical: &mut Chemical, obstacle: &Obstacle) {
    let bounds = obstacle.aabb();
    chemical.close([bounds.mins, bounds.maxs], |at| obstacle.nearest(at).1);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Inputs, WorldConfig};
    use glam::Vec2;
    use parry2d::math::Pose;
    use parry2d::shape::SharedShape;

    #[test]
    fn a_wall_that_is_switched_off_lets_chemicals_in_and_one_that_is_switched_on_keeps_them_out() {
        let mut world = World::new(WorldConfig { size: Vec2::splat(40.0), ..WorldConfig::default() }).unwrap();
        let spec = ChemicalSpec { initial: 1.0, spacing: 1.0, ..ChemicalSpec::default() };
        let chemical = world.add_chemical(spec).unwrap();
        let wall = Obstacle::new(SharedShape::cuboid(4.0, 20.0), Pose::translation(20.0, 20.0));
        let id = world.add_obstacle(wall).unwrap();
        let within = |world: &mut World| {
            (0..300).for_each(|_| world.step(&Inputs::new()));
            world.chemicals[chemical.0 as usize].concentration(Vec2::splat(20.0))
        };
        assert_eq!(within(&mut world), 0.0);
        world.set_obstacle_enabled(id, false).unwrap();
        assert!(within(&mut world) > 0.1);
        world.set_obstacle_enabled(id, true).unwrap();
        assert_eq!(within(&mut world), 0.0);
    }

    #[test]
    fn all_chemicals_together_have_a_limited_number_of_cells() {
        let mut world = World::new(WorldConfig { size: Vec2::splat(1000.0), ..WorldConfig::default() }).unwrap();
        let spec = ChemicalSpec { spacing: 1.0, ..ChemicalSpec::default() };
        (0..4).for_each(|_| _ = world.add_chemical(spec).unwrap());
        let coarse = ChemicalSpec { spacing: 1000.0, ..spec };
        for refused in [spec, coarse] {
            assert_eq!(world.add_chemical(refused).unwrap_err().field(), "spacing");
        }
        assert_eq!(world.chemicals.len(), 4);
    }
}
