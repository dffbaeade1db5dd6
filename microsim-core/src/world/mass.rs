//! Mass of a body, for what grows.

use super::World;
use super::change::WorldChange;
use crate::error::{Error, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use crate::organism::Storage;
use crate::particle::LANES;

/// Least and greatest mass of a disc.
pub(in crate::world) const MASSES: [f32; 2] = [1e-6, 1e6];

impl World {
    /// Sets the mass of a body of a template, of what can move of it together; its nodes share it in the proportions of the template,
    /// and velocities stay as they are. For bodies that grow: a division shares the mass, [`World::set_scale`] leaves it.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Placement, World, WorldConfig};
    /// # let mut world = World::new(WorldConfig::default())?;
    /// let ball = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
    /// world.set_mass(ball, 2.5)?;
    /// assert_eq!(world.view().organism(ball).unwrap().mass(), 2.5);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the handle is stale; when the organism is frozen, held by another, has no template, or nothing of it can move; and when
    /// a disc of it would have less than 0.000 001 or more than 1 000 000.
    pub fn set_mass(&mut self, id: OrganismId, mass: f32) -> Result<(), Error> {
        let organism = self.organisms.get(id).ok_or_else(|| Error::stale("organism"))?;
        let Storage::Lane { block, first } = organism.body else {
            return Err(Error::unsupported("organism", "a body of a template"));
        };
        if organism.is_quarantined || organism.is_held() {
            return Err(Error::unsupported("organism", "one that is not frozen or held"));
        }
        let inv_masses = with_default_float_environment(|| self.inv_masses(block, mass))?;
        for (slot, inv_mass) in inv_masses {
            self.particles.inv_mass[first as usize + slot * LANES] = inv_mass;
        }
        self.wake_up(id);
        self.changed(|| WorldChange::SetMass(id, mass));
        Ok(())
    }

    /// Inverse masses of the slots of a block that can move, for a mass of all together.
    fn inv_masses(&self, block: u32, mass: f32) -> Result<Vec<(usize, f32)>, Error> {
        let nodes = self.templates[self.blocks[block as usize].template as usize].nodes().iter().enumerate();
        let movable: Vec<(usize, f32)> =
            nodes.filter(|(_, node)| node.mass.is_finite()).map(|(slot, node)| (slot, node.mass)).collect();
        let total: f32 = movable.iter().map(|(_, mass)| mass).sum();
        if movable.is_empty() {
            return Err(Error::unsupported("organism", "a body that can move"));
        }
        let (mut least, mut most) = (f32::INFINITY, 0.0);
        for &(_, mass) in &movable {
            (least, most) = (if mass < least { mass } else { least }, if mass > most { mass } else { most });
        }
        in_range("mass", mass, MASSES[0] / least * total, MASSES[1] / most * total)?;
        Ok(movable.into_iter().map(|(slot, share)| (slot, total / (share * mass))).collect())
    }
}

#[cfg(test)]
mod tests {
    use crate::{AgarSpec, AmoeboidCellSpec, Node, Placement, Template, World, WorldConfig};
    use glam::Vec2;

    #[test]
    fn nodes_share_a_mass_as_their_template_says_and_anchors_stay() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let mut builder = Template::builder();
        for (x, mass) in [(0.0, 1.0), (2.0, 3.0)] {
            builder.node(Node::disc(Vec2::new(x, 0.0), mass, 0.5));
        }
        builder.node(Node::fixed(Vec2::new(4.0, 0.0)));
        let template = world.add_template(builder.build().unwrap());
        let body = world.spawn_template(template, Placement::at(40.0, 40.0)).unwrap();
        world.set_mass(body, 10.0).unwrap();
        let particles: Vec<u32> = world.organisms.get(body).unwrap().particles().collect();
        let found: Vec<f32> = particles.into_iter().map(|i| world.particles.inv_mass[i as usize]).collect();
        assert!((found[0] - 0.4).abs() < 1e-6 && (found[1] - 2.0 / 15.0).abs() < 1e-6 && found[2] == 0.0, "{found:?}");
        world.validate().unwrap();
    }

    #[test]
    fn masses_that_cannot_be_are_refused() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let ball = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 40.0)).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        for mass in [0.0, -1.0, 1e-7, 2e6, f32::NAN] {
            assert_eq!(world.set_mass(ball, mass).unwrap_err().field(), "mass");
        }
        assert_eq!(world.set_mass(cell, 1.0).unwrap_err().field(), "organism");
        world.remove(ball).unwrap();
        assert_eq!(world.set_mass(ball, 1.0).unwrap_err().field(), "organism");
    }
}
