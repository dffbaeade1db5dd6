//! Encounters: the prey that touches the front of an engulfer in a step.

use crate::behavior::crawl::front_and_rear::{MembraneRegion, region};
use crate::behavior::heading;
use crate::capability::phagocytosis::{Encounter, IngestionWay};
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::world::World;
use crate::world::contacts::{Near, NearPair};
use glam::Vec2;
use std::f32::consts::PI;

/// Gap at which two discs still count as touching, as a share of the smaller one's radius.
const TOUCH_GAP: f32 = 0.5;

/// What lies near the membranes of engulfers and belongs to prey, by engulfer: looked for once a step and not by each of them,
/// so that a crowd takes as long as its members.
#[derive(Debug, Default)]
pub(super) struct NearPrey(Vec<(u32, Near)>);

/// An engulfer as its prey meets it.
#[derive(Clone, Copy)]
struct Seeker {
    way: IngestionWay,
    at: Vec2,
    /// Unit vector; none at rest.
    to_goal: Option<Vec2>,
    /// Of its cytoplasm, square units.
    area: f32,
}

impl NearPrey {
    fn of(&self, engulfer: OrganismId) -> impl Iterator<Item = Near> {
        let first = self.0.partition_point(|(owner, _)| *owner < engulfer.index);
        self.0[first..].iter().take_while(move |(owner, _)| *owner == engulfer.index).map(|(_, near)| *near)
    }
}

impl World {
    /// What the last step's search found of prey near engulfers.
    pub(super) fn near_prey(&self) -> NearPrey {
        let organism = |owner| self.organisms.id_at(owner).and_then(|id| self.organisms.get(id));
        let may_eat = |engulfer: u32, prey: u32| {
            let eats = organism(engulfer).and_then(|organism| organism.engulfer.as_ref());
            let eats_cells = eats.is_some_and(|eats| eats.params.way == IngestionWay::WideGate);
            let is_prey = |organism: &Organism| organism.prey.is_some() || (eats_cells && organism.is_cell());
            eats.is_some() && organism(prey).is_some_and(is_prey)
        };
        // What is near of two of them lies side by side.
        let (mut found, mut last, mut eat) = (Vec::new(), None, [false; 2]);
        for (owners, near) in self.near_of_others() {
            if last != Some(owners) {
                let [a, b] = owners;
                (last, eat) = (Some(owners), [may_eat(a, b), may_eat(b, a)]);
            }
            let engulfers = owners.into_iter().zip(eat).filter(|(_, eats)| *eats);
            found.extend(engulfers.map(|(engulfer, _)| (engulfer, near)));
        }
        found.sort_by_key(|(engulfer, _)| *engulfer);
        NearPrey(found)
    }

    /// The prey that touches the front of an engulfer in this step.
    pub(super) fn encounters(&self, id: OrganismId, way: IngestionWay, near_prey: &NearPrey) -> Vec<Encounter> {
        let Some(organism) = self.organisms.get(id) else { return Vec::new() };
        let front = front_nodes(organism);
        let mut touched: Vec<OrganismId> = Vec::new();
        let pairs = near_prey.of(id).filter_map(|near| self.near_pair(near));
        for pair in pairs.filter(|pair| self.is_contact(pair)) {
            let other = match (front.binary_search(&pair.i), front.binary_search(&pair.j)) {
                (Ok(_), Err(_)) => pair.j,
                (Err(_), Ok(_)) => pair.i,
                _ => continue,
            };
            let owner = self.organisms.id_at(self.particles.owner[other as usize]);
            touched.extend(owner.filter(|&other| other != id && !self.exemptions.contains(id.index, other.index)));
        }
        touched.sort_unstable();
        let Some(at) = self.centroid(id) else { return Vec::new() };
        let to_goal = organism.goal.map(|goal| heading(goal - at));
        let seeker = Seeker { way, at, to_goal, area: self.engulfer_area(organism) };
        let groups = touched.chunk_by(|a, b| a == b);
        groups.filter_map(|group| self.encounter(group[0], group.len() as u32, seeker)).collect()
    }

    /// Whether two discs touched in any substep of this step or are close now: contacts of soft bodies come and go from
    /// substep to substep.
    fn is_contact(&self, pair: &NearPair) -> bool {
        pair.touched || pair.gap < TOUCH_GAP * self.particles.smaller_radius(pair.i, pair.j)
    }

    fn encounter(&self, id: OrganismId, contacts: u32, seeker: Seeker) -> Option<Encounter> {
        let prey = self.organisms.get(id)?;
        let class = prey.class_for(seeker.way)?;
        let to_prey = heading(self.centroid(id)? - seeker.at);
        let heading = seeker.to_goal.map(|to_goal| to_goal.dot(to_prey));
        let area = prey.cell_area(&self.fluids).unwrap_or(prey.full_area());
        Some(Encounter { prey: id, class, contacts, heading, size_ratio: seeker.area / area })
    }

    /// Sum of the areas of the cytoplasm particles (thesis, 3.3.1).
    pub(in crate::world) fn engulfer_area(&self, organism: &Organism) -> f32 {
        let radius = |&i: &u32| self.particles.radius[i as usize];
        organism.fluid_particles.iter().map(radius).map(|r| PI * r * r).sum()
    }
}

/// Particles of the front, sorted; none at rest.
pub(in crate::world) fn front_nodes(organism: &Organism) -> Vec<u32> {
    let Some(front) = organism.locomotion.crawling_front() else { return Vec::new() };
    let count = organism.outline.len() as u32;
    let is_front = |k: u32| region(k, front, count) == MembraneRegion::Front;
    let mut nodes: Vec<u32> =
        organism.outline_particles().zip(0..count).filter(|&(_, k)| is_front(k)).map(|(node, _)| node).collect();
    nodes.sort_unstable();
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AgarSpec, AmoeboidCellSpec, Inputs, Placement, PlateletSpec, WorldConfig};

    #[test]
    fn an_engulfer_looks_at_nothing_but_the_prey_near_it() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cells = [30.0, 53.0, 76.0].map(|x| {
            world.spawn(&PlateletSpec::default().into(), Placement::at(x, 59.5)).unwrap();
            world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(x, 45.0)).unwrap()
        });
        let pellets = [30.0, 76.0].map(|x| world.spawn(&AgarSpec::default().into(), Placement::at(x, 32.5)).unwrap());
        world.step(&Inputs::new());
        let near_prey = world.near_prey();
        let owners = |cell| near_prey.of(cell).map(|near| near.owners(&world.particles)).collect::<Vec<_>>();
        for (cell, pellet) in [(cells[0], pellets[0]), (cells[2], pellets[1])] {
            assert!(!owners(cell).is_empty());
            assert!(owners(cell).iter().all(|pair| pair.contains(&cell.index) && pair.contains(&pellet.index)));
        }
        assert!(owners(cells[1]).is_empty());
        let (looked_at, all) = (near_prey.0.len(), world.near().count());
        assert!(looked_at < 20 && all > 200, "{looked_at} of {all}");
    }
}
