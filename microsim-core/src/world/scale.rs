//! Size of an organism relative to its size when spawned.

use super::World;
use super::change::WorldChange;
use crate::error::{Error, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use crate::organism::{Organism, Storage};
use crate::solver::lanes::LANES;
use crate::template::Node;

/// Largest radius of a disc that is scaled, units: of a template's node times the scale of its placement.
pub(in crate::world) const LARGEST: f32 = 1e5;
/// Least and greatest scale of a body.
pub(in crate::world) const SCALES: [f32; 2] = [1e-6, 1e6];

impl World {
    /// Sets the size of a body of a template, single discs among them, relative to its size when it was spawned: its radii, lengths
    /// and areas; its mass stays. It takes on the size within the next steps and pushes away what is in its place, at up to the
    /// speed limit: let it grow a little in each step. What takes in prey goes by this size; prey that is being taken in or digested
    /// is smaller, and returns to this size when it is released.
    ///
    /// # Errors
    /// When the handle is stale; when the organism is frozen, held by another, or holds fluid, whose size is that of its spec; and
    /// when the scale is not 0.1 to 10, or makes a disc larger than 100 000 units or than there is room for between two walls, a body
    /// wider than half of a room between periodic sides, or a disc so small that a thermal field would kick it beyond the speed
    /// limit.
    pub fn set_scale(&mut self, id: OrganismId, scale: f32) -> Result<(), Error> {
        with_default_float_environment(|| self.check_scale(id, scale))?;
        with_default_float_environment(|| self.scale_body(id, scale));
        if let Some(organism) = self.organisms.get_mut(id) {
            organism.full_scale = scale;
        }
        self.scratch.occupancy.clear();
        self.wake_up_touching(id);
        self.changed(|| WorldChange::SetScale(id, scale));
        Ok(())
    }

    fn check_scale(&self, id: OrganismId, scale: f32) -> Result<(), Error> {
        let organism = self.organisms.get(id).ok_or_else(|| Error::stale("organism"))?;
        let Storage::Lane { block, .. } = organism.body else {
            return Err(Error::unsupported("organism", "a body of a template"));
        };
        if organism.is_quarantined || organism.is_held() {
            return Err(Error::unsupported("organism", "one that is not frozen or held"));
        }
        let nodes = self.templates[self.blocks[block as usize].template as usize].nodes();
        let most = self.greatest_scale(nodes) / organism.spawn_scale;
        in_range("scale", scale, 0.1, smaller(most, 10.0))?;
        self.check_width(nodes, organism.spawn_scale * scale)?;
        self.check_kicks_at_scale(organism, scale)
    }

    /// Greatest scale at which none of these nodes is larger than a disc may be, or than there is room for between two walls.
    pub(in crate::world) fn greatest_scale(&self, nodes: &[Node]) -> f32 {
        let largest = nodes.iter().fold(0.0, |most, node| if node.radius > most { node.radius } else { most });
        smaller(0.5 * self.config.width_between_walls(), LARGEST) / largest
    }

    /// Scale of an organism's constraints.
    pub(crate) fn scale_of(&self, organism: &Organism) -> f32 {
        match organism.body {
            Storage::Lane { block, first } => {
                let block = &self.blocks[block as usize];
                block.scale[(first - block.base) as usize]
            }
            Storage::Loose { .. } => 1.0,
        }
    }

    /// Size of an organism relative to its size when spawned.
    pub(in crate::world) fn present_scale(&self, id: OrganismId) -> f32 {
        self.organisms.get(id).map_or(1.0, |organism| self.scale_of(organism) / organism.spawn_scale)
    }

    /// The same without checks.
    pub(in crate::world) fn scale_body(&mut self, id: OrganismId, factor: f32) {
        let Some(organism) = self.organisms.get(id) else { return };
        let Storage::Lane { block: index, first } = organism.body else { return };
        let block = &mut self.blocks[index as usize];
        let lane = (first - block.base) as usize;
        let (scale, [least, most]) = (organism.spawn_scale * factor, SCALES);
        block.scale[lane] = if scale < least { least } else { smaller(scale, most) };
        self.sleep.wake_up(index, lane);
        for (slot, node) in self.templates[block.template as usize].nodes().iter().enumerate() {
            self.particles.radius[first as usize + slot * LANES] = smaller(node.radius * block.scale[lane], LARGEST);
        }
    }

    /// Present area of an organism.
    pub(in crate::world) fn area_of(&self, id: OrganismId) -> f32 {
        let Some(organism) = self.organisms.get(id) else { return 0.0 };
        let scale = self.present_scale(id);
        organism.cell_area(&self.fluids).unwrap_or(organism.spawn_area * (scale * scale))
    }
}

fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[cfg(test)]
mod tests {
    use crate::{AgarSpec, AmoeboidCellSpec, Inputs, Placement, PlateletSpec, RigidCellSpec, World, WorldConfig};
    use glam::Vec2;

    #[test]
    fn prey_keeps_the_size_that_it_is_given_and_is_judged_by_it() {
        let is_eaten = |scale: f32| {
            let mut world = World::new(WorldConfig::default()).unwrap();
            let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 45.0)).unwrap();
            let ball = world.spawn(&AgarSpec { radius: 1.0, ..AgarSpec::default() }.into(), Placement::at(80.0, 45.0));
            let ball = ball.unwrap();
            world.set_scale(ball, scale).unwrap();
            (0..180).for_each(|_| world.step(&Inputs::new()));
            assert_eq!(world.view().organism(ball).unwrap().scale(), scale);
            let mut inputs = Inputs::new();
            inputs.set(cell, crate::Intent::toward(Vec2::new(80.0, 45.0)).unwrap());
            let eaten = (0..900).any(|_| {
                world.step(&inputs);
                world.view().organism(ball).is_none_or(|ball| ball.held_by().is_some())
            });
            world.validate().unwrap();
            eaten
        };
        assert!(is_eaten(0.5) && is_eaten(1.0) && !is_eaten(10.0));
    }

    #[test]
    fn the_room_that_a_larger_body_takes_is_not_given_to_others() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let agar = |radius| AgarSpec { radius, ..AgarSpec::default() }.into();
        let ball = world.spawn(&agar(1.0), Placement::at(50.0, 45.0)).unwrap();
        world.spawn(&agar(1.0), Placement::at(20.0, 45.0)).unwrap();
        world.set_scale(ball, 3.0).unwrap();
        world.clone().spawn(&agar(0.5), Placement::at(52.0, 45.0)).unwrap_err();
        world.spawn(&agar(0.5), Placement::at(52.0, 45.0)).unwrap_err();
    }

    #[test]
    fn a_body_grows_in_place_and_pushes_its_neighbours_away() {
        let mut world = World::new(WorldConfig { damping: 2.0, ..WorldConfig::default() }).unwrap();
        let cell = world.spawn(&RigidCellSpec::default().into(), Placement::at(50.0, 45.0)).unwrap();
        let width = |world: &World| {
            let (low, high): (Vec2, Vec2) = world.view().organism(cell).unwrap().bounds();
            high.x - low.x
        };
        let before = width(&world);
        let ball = world.spawn(&AgarSpec::default().into(), Placement::at(50.0 + 0.5 * before + 1.1, 45.0)).unwrap();
        let from = world.centroid(ball).unwrap().x;
        for k in 1..=100u8 {
            world.set_scale(cell, 1.0 + 0.005 * f32::from(k)).unwrap();
            world.step(&Inputs::new());
            world.validate().unwrap();
        }
        (0..60).for_each(|_| world.step(&Inputs::new()));
        assert!((width(&world) / before - 1.5).abs() < 0.03, "{} after {before}", width(&world));
        assert!(world.centroid(ball).unwrap().x > from + 0.2 * before);
    }

    #[test]
    fn sizes_that_cannot_be_are_refused() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(50.0, 45.0)).unwrap();
        let platelet = world.spawn(&PlateletSpec::default().into(), Placement::at(90.0, 45.0)).unwrap();
        assert_eq!(world.set_scale(cell, 1.1).unwrap_err().field(), "organism");
        assert_eq!(world.set_scale(platelet, f32::NAN).unwrap_err().field(), "scale");
        assert_eq!(world.set_scale(platelet, 10.1).unwrap_err().field(), "scale");
        world.remove(platelet).unwrap();
        assert_eq!(world.set_scale(platelet, 1.0).unwrap_err().field(), "organism");
    }
}
