//! Putting another organism in the place of one.

use super::World;
use super::change::WorldChange;
use crate::error::Error;
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use crate::organism::Placement;
use crate::supply::Recipe;

impl World {
    /// Puts another organism in the place of one, with its velocity, gravity scale and user data, and a handle of its own. It may lie
    /// where the other one did, but not inside a membrane. It costs a clone of the world.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, CoccusSpec, OrganismSpec, Placement, World, WorldConfig};
    /// # let mut world = World::new(WorldConfig::default())?;
    /// let spore = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
    /// let coccus = OrganismSpec::from(CoccusSpec::default());
    /// let coccus = world.replace(spore, &coccus.into(), Placement::at(30.0, 30.0))?;
    /// assert_eq!((world.kind(spore), world.organisms().collect()), (None, vec![coccus]));
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the handle is stale, and as for [`World::spawn`] and [`World::spawn_template`]. Nothing is changed then.
    pub fn replace(&mut self, id: OrganismId, by: &Recipe, placement: Placement) -> Result<OrganismId, Error> {
        let new = with_default_float_environment(|| self.put_in_place(id, by, placement.clone()))?;
        self.changed(|| WorldChange::Replace(id, Box::new((by.clone(), placement))));
        Ok(new)
    }

    fn put_in_place(&mut self, id: OrganismId, by: &Recipe, placement: Placement) -> Result<OrganismId, Error> {
        let old = self.view().organism(id).ok_or_else(|| Error::stale("organism"))?;
        let (velocity, gravity_scale, data) = (old.velocity(), old.gravity_scale(), old.user_data());
        let blueprint = self.blueprint_of(by)?;
        // Whether there is room only a world without the old one can tell.
        let mut world = self.clone();
        world.record_changes(false);
        world.remove(id)?;
        let new = world.spawn_blueprint(blueprint, placement)?;
        world.set_velocity(new, velocity);
        world.set_gravity_scale(new, gravity_scale)?;
        world.set_user_data(new, data)?;
        world.record_changes(self.record_changes(false));
        *self = world;
        Ok(new)
    }
}

#[cfg(test)]
mod tests {
    use crate::{AgarSpec, Inputs, OrganismSpec, Placement, PlateletSpec, World, WorldConfig};
    use glam::Vec2;

    #[test]
    fn what_is_replaced_hands_over_its_motion_and_a_refusal_changes_nothing() {
        let mut world = World::new(WorldConfig { damping: 0.0, ..WorldConfig::default() }).unwrap();
        let ball = OrganismSpec::from(AgarSpec::default());
        let [one, other] = [30.0, 36.0].map(|x| world.spawn(&ball, Placement::at(x, 30.0)).unwrap());
        world.push(one, Vec2::new(0.0, 5.0)).unwrap();
        world.set_user_data(one, 7).unwrap();
        world.set_gravity_scale(one, 0.5).unwrap();
        let before = world.digest();
        let large = OrganismSpec::from(PlateletSpec { radius: 4.0, ..PlateletSpec::default() }).into();
        let refused = world.replace(one, &large, Placement::at(33.0, 30.0)).unwrap_err();
        assert_eq!((refused.field(), world.digest()), ("at", before), "the other ball is in its way");
        let new = world.replace(one, &large, Placement::at(30.0, 30.0)).unwrap();
        let view = world.view().organism(new).unwrap();
        assert!((view.velocity() - Vec2::new(0.0, 5.0)).length() < 1e-5);
        assert_eq!((view.user_data(), view.gravity_scale(), world.kind(one)), (7, 0.5, None));
        world.step(&Inputs::new());
        world.validate().unwrap();
        assert!(world.kind(other).is_some());
        assert_eq!(world.replace(one, &large, Placement::at(90.0, 30.0)).unwrap_err().field(), "organism");
    }
}
