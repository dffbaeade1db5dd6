//! Anatomy: the constraints and contacts of a world, for a debug view.

use super::View;
use crate::id::JointId;
use crate::organism::Organism;
use crate::solver::constraint::Constraint;
use glam::Vec2;

/// What acts between two particles of an organism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bond<'a> {
    /// A constraint of its template.
    Constraint(&'a Constraint),
    /// A link of its membrane.
    Membrane,
    /// A joint.
    Joint(JointId),
}

impl<'a> View<'a> {
    /// Every link of a membrane and of a constraint ([`Constraint::links`]) that has not torn, and every joint, with the positions
    /// of its two ends.
    pub fn bonds(self) -> impl Iterator<Item = (Bond<'a>, [Vec2; 2])> + 'a {
        let organisms = self.world.organisms.iter();
        let bonds = organisms.flat_map(move |(_, organism)| self.bonds_of(organism));
        let joints = self.world.joints().map(|joint| (Bond::Joint(joint.id), joint.ends));
        bonds.map(move |(bond, ends)| (bond, ends.map(|i| self.position(i)))).chain(joints)
    }

    /// Pairs of particles that touched in the last step, as positions of their centres; for a link of a membrane that of its
    /// nearer node.
    pub fn contacts(self) -> impl Iterator<Item = [Vec2; 2]> + 'a {
        let touching = self.world.near_pairs().filter(|pair| pair.touched);
        let period = self.world.period();
        touching.map(move |pair| {
            let [a, b] = [pair.i, pair.j].map(|i| self.position(i));
            [a, if period.is_none() { b } else { a + period.nearest(b - a) }]
        })
    }

    fn bonds_of(self, organism: &'a Organism) -> Vec<(Bond<'a>, [u32; 2])> {
        let rings = organism.membranes().map(|(_, ring)| ring);
        let links = rings.flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]));
        let mut bonds: Vec<_> = links.map(|link| (Bond::Membrane, link)).collect();
        let whole = self.world.whole_constraints_of(organism);
        for constraint in whole {
            let links = constraint.links().into_iter().map(|link| link.map(|node| organism.body.particle(node)));
            bonds.extend(links.map(|link| (Bond::Constraint(constraint), link)));
        }
        bonds
    }
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
        let count = |is_wanted: fn(Bond<'_>) -> bool| world.view().bonds().filter(|(bond, _)| is_wanted(*bond)).count();
        let membrane = world.view().organisms().last().unwrap().outline().len();
        assert_eq!(count(|bond| bond == Bond::Membrane), membrane);
        assert_eq!(count(|bond| matches!(bond, Bond::Constraint(Constraint::Anchor(_)))), 1);
        assert_eq!(count(|bond| matches!(bond, Bond::Constraint(Constraint::Distance(_)))), 28 + 28 + 1);
        assert_eq!(world.view().bonds().count(), world.census().constraints);
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

    #[test]
    fn contacts_of_what_is_gone_do_not_pass_to_what_takes_its_place() {
        let mut world = World::new(WorldConfig { gravity: Vec2::ZERO, ..WorldConfig::default() }).unwrap();
        let ids = [40.0, 45.2].map(|x| world.spawn(&PlateletSpec::default().into(), Placement::at(x, 40.0)).unwrap());
        while world.view().contacts().count() == 0 {
            world.push(ids[0], Vec2::new(1.0, 0.0)).unwrap();
            world.step(&Inputs::new());
        }
        world.remove(ids[1]).unwrap();
        world.spawn(&PlateletSpec::default().into(), Placement::at(90.0, 40.0)).unwrap();
        assert_eq!(world.view().contacts().count(), 0);
    }
}
