//! Anatomy: the constraints and contacts of a world, for a debug view.

use super::View;
use crate::organism::{Organism, Storage};
use crate::solver::ConstraintSet;
use glam::Vec2;

/// What a constraint between two particles does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Bond {
    /// Keeps a distance: [`crate::Distance`].
    Distance,
    /// Keeps two particles apart: [`crate::MinDistance`].
    MinDistance,
    /// Keeps two particles together: [`crate::Rope`].
    Rope,
    /// Ties a particle to a fixed point: [`crate::Anchor`].
    Anchor,
    /// A link of a membrane.
    Membrane,
}

impl<'a> View<'a> {
    /// The constraints between two particles, each with their positions.
    pub fn bonds(self) -> impl Iterator<Item = (Bond, [Vec2; 2])> + 'a {
        let ends = move |(bond, pair): (Bond, [u32; 2])| (bond, pair.map(|i| self.position(i)));
        let organisms = self.world.organisms.iter();
        organisms.flat_map(move |(_, organism)| self.bonds_of(organism)).map(ends)
    }

    /// Pairs of particles that touched in the last step, as positions of their centres; for a link of a membrane that of its
    /// nearer node.
    pub fn contacts(self) -> impl Iterator<Item = [Vec2; 2]> + 'a {
        let touching = self.world.near_pairs().filter(|pair| pair.touched);
        touching.map(move |pair| [pair.i, pair.j].map(|i| self.position(i)))
    }

    fn bonds_of(self, organism: &Organism) -> Vec<(Bond, [u32; 2])> {
        let rings = organism.membranes().map(|(_, ring)| ring);
        let links = rings.flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]));
        let mut bonds: Vec<_> = links.map(|link| (Bond::Membrane, link)).collect();
        if let (Some(set), Storage::Lane { .. }) = (self.world.constraints_of(organism), &organism.body) {
            bonds.extend(pairs(set).map(|(bond, pair)| (bond, pair.map(|node| organism.body.particle(node)))));
        }
        bonds
    }
}

fn pairs(set: &ConstraintSet) -> impl Iterator<Item = (Bond, [u32; 2])> {
    let distances = set.distances.iter().map(|c| (Bond::Distance, [c.a, c.b]));
    let min_distances = set.min_distances.iter().map(|c| (Bond::MinDistance, [c.a, c.b]));
    let ropes = set.ropes.iter().map(|c| (Bond::Rope, [c.a, c.b]));
    let anchors = set.anchors.iter().map(|c| (Bond::Anchor, [c.node, c.anchor]));
    distances.chain(min_distances).chain(ropes).chain(anchors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AmoeboidCellSpec, Inputs, Placement, PlateletSpec, World, WorldConfig};

    #[test]
    fn every_constraint_of_two_particles_is_listed_once() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        world.spawn(&PlateletSpec::default().into(), Placement::at(30.0, 40.0)).unwrap();
        world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 40.0)).unwrap();
        let count = |wanted| world.view().bonds().filter(|(bond, _)| *bond == wanted).count();
        let membrane = world.view().organisms().last().unwrap().outline().len();
        assert_eq!(count(Bond::Membrane), membrane);
        assert!(count(Bond::Anchor) > 0 && count(Bond::Distance) > 0);
        assert!(world.view().bonds().count() <= world.census().constraints);
    }

    #[test]
    fn contacts_lie_between_bodies_that_touch() {
        let mut world = World::new(WorldConfig { gravity: Vec2::ZERO, ..WorldConfig::default() }).unwrap();
        let ids = [40.0, 45.2].map(|x| world.spawn(&PlateletSpec::default().into(), Placement::at(x, 40.0)).unwrap());
        assert_eq!(world.view().contacts().count(), 0);
        let mut touched = 0;
        for _ in 0..60 {
            world.push(ids[0], Vec2::new(1.0, 0.0)).unwrap();
            world.step(&Inputs::new());
            touched += world.view().contacts().filter(|[a, b]| (*a - *b).length() < 5.0).count();
        }
        assert!(touched > 0);
    }
}
