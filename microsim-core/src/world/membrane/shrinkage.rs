//! Shrinkage of an amoeboid cell, the inverse of growth: what hunger uses up, or another cell bites off. Cytoplasm leaves the
//! world, and the membrane follows node by node.

use crate::error::{Error, ErrorKind, out_of_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use crate::world::World;
use crate::world::change::WorldChange;

impl World {
    /// Takes so many particles of cytoplasm out of a cell, those that came last first. Its membrane gives up nodes in the
    /// steps after, as many as suits what is left.
    ///
    /// ```
    /// # use microsim_core::{AmoeboidCellSpec, Inputs, Placement, World, WorldConfig};
    /// # let mut world = World::new(WorldConfig::default())?;
    /// let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(50.0, 40.0))?;
    /// let before = world.view().organism(cell).unwrap().cytoplasm_area();
    /// world.shrink(cell, 30)?;
    /// assert!(world.view().organism(cell).unwrap().cytoplasm_area() < before);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the handle is stale, the organism is no amoeboid cell or is dividing, or fewer particles would be left than
    /// [`crate::DivisionParams::least_particles`]. Nothing is changed then.
    pub fn shrink(&mut self, id: OrganismId, particles: u32) -> Result<(), Error> {
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        if organism.furrow().is_some() {
            return Err(Error::unsupported("organism", "an organism that is not dividing"));
        }
        let (Some(divider), Some(fluid)) = (&organism.divider, organism.fluid) else {
            return Err(Error::unsupported("organism", "an amoeboid cell"));
        };
        let count = organism.fluid_particles.len();
        let most = count.saturating_sub(divider.params.least_particles as usize);
        if particles as usize > most {
            return Err(out_of_range("particles", f64::from(particles), format!("at most {most}, now")));
        }
        with_default_float_environment(|| self.lose_cytoplasm(id, fluid, particles as usize));
        self.changed(|| WorldChange::Shrink(id, particles));
        Ok(())
    }

    /// Takes cytoplasm of this fluid out of a cell that has more than that, and sends its membrane on the way to fewer nodes.
    pub(in crate::world) fn lose_cytoplasm(&mut self, id: OrganismId, fluid: u32, particles: usize) {
        let Some(organism) = self.organisms.get_mut(id) else { return };
        organism.record_nodes_per_root(&self.fluids);
        let left = organism.fluid_particles.len().saturating_sub(particles);
        let mut lost = organism.fluid_particles.split_off(left);
        organism.update_wanted_nodes(&self.fluids);
        lost.sort_unstable();
        self.fluids[fluid as usize].particles.retain(|i| lost.binary_search(i).is_err());
        self.lose_joints(|i| lost.binary_search(&i).is_ok());
        lost.into_iter().for_each(|i| self.particles.remove(i));
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::polygon::is_simple;
    use crate::{AgarSpec, AmoeboidCellSpec, Inputs, Intent, OrganismId, Placement, World, WorldConfig};
    use glam::Vec2;

    fn room() -> (World, OrganismId) {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        (world, cell)
    }

    fn size(world: &World, cell: OrganismId) -> (usize, usize) {
        let organism = world.organisms.get(cell).unwrap();
        (organism.fluid_particles.len(), organism.outline.len())
    }

    #[test]
    fn a_starving_cell_gets_smaller_and_keeps_its_shape() {
        let (mut world, cell) = room();
        let (before, nodes) = size(&world, cell);
        let mut inputs = Inputs::new();
        inputs.set(cell, Intent::toward(Vec2::new(150.0, 45.0)).unwrap());
        for step in 0..1200 {
            if step % 10 == 0 {
                let _ = world.shrink(cell, 1);
            }
            world.step(&inputs);
            assert_eq!(world.census().leaks, 0, "step {step}");
        }
        world.validate().unwrap();
        let (left, fewer) = size(&world, cell);
        assert_eq!(left, before - 120);
        let expected = nodes as f32 * (left as f32 / before as f32).sqrt();
        assert!((fewer as f32 - expected).abs() <= 2.0, "{fewer} nodes of {nodes}, expected {expected}");
        let ring: Vec<Vec2> = world.view().organism(cell).unwrap().outline().collect();
        assert!(is_simple(&ring));
    }

    #[test]
    fn it_stops_at_the_least_size_and_refuses_others() {
        let (mut world, cell) = room();
        let (count, _) = size(&world, cell);
        assert_eq!(world.shrink(cell, count as u32 - 19).unwrap_err().field(), "particles");
        let pellet = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0)).unwrap();
        assert_eq!(world.shrink(pellet, 1).unwrap_err().field(), "organism");
        world.remove(pellet).unwrap();
        let mut dividing = world.clone();
        dividing.divide(cell).unwrap();
        dividing.step(&Inputs::new());
        assert_eq!(dividing.shrink(cell, 1).unwrap_err().field(), "organism");
        assert_eq!(world.shrink(pellet, 1).unwrap_err().field(), "organism");
        assert_eq!(size(&world, cell).0, count, "nothing was changed");
        world.shrink(cell, count as u32 - 20).unwrap();
        assert_eq!((size(&world, cell).0, world.shrink(cell, 1).unwrap_err().field()), (20, "particles"));
    }

    #[test]
    fn most_of_a_cell_may_go_at_once_and_come_back() {
        let (mut world, cell) = room();
        let (before, nodes) = size(&world, cell);
        world.shrink(cell, before as u32 - 20).unwrap();
        for _ in 0..600 {
            world.step(&Inputs::new());
            assert_eq!(world.census().leaks, 0);
        }
        assert!(size(&world, cell).1 < nodes, "{:?} of {nodes}", size(&world, cell));
        for _ in 0..12 {
            world.grow(cell, 4, 10).unwrap();
            for _ in 0..30 {
                world.step(&Inputs::new());
                assert_eq!(world.census().leaks, 0);
            }
        }
        world.validate().unwrap();
        assert_eq!(size(&world, cell).0, 20 + 120);
    }
}
