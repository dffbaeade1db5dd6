//! Growth of an amoeboid cell (thesis, 3.1.2): new nodes in the membrane, new cytoplasm at the centroid.

use crate::error::{Error, ErrorKind, out_of_range};
use crate::float_environment::with_default_float_environment;
use crate::geometry::polygon::{contains_point, signed_area};
use crate::geometry::ring::{GOLDEN_ANGLE, unit_vector};
use crate::id::OrganismId;
use crate::organism::ring_surgery::{insert_node, remove_node};
use crate::organism::{MAX_NODES, Organism};
use crate::particle::{Particle, Particles};
use crate::solver::fluid::rest_area;
use crate::solver::membrane::STRAIN_LIMIT;
use crate::template::Role;
use crate::world::World;
use crate::world::change::WorldChange;
use glam::Vec2;

/// Largest amount of cytoplasm in a membrane that has not stretched yet, over its content at rest. With more the pressure
/// rises faster than the substeps of a step can spread it.
const MOST_CROWDED: f32 = 1.5;
/// Distance of new particle number `n` from their common centre, in spacings times the square root of `n`.
const CROWDING: f32 = 0.3;

impl World {
    /// Grows an organism that has a membrane: `nodes` new membrane nodes, each in the middle of the link that is longest
    /// then, and `particles` of new cytoplasm around the centroid of the membrane (around the cytoplasm particle nearest
    /// to it, if the centroid lies outside). New cytoplasm has the role [`Role::GrownCytoplasm`].
    ///
    /// # Errors
    /// When the handle is stale, the organism has no membrane, is dividing or held by another cell, the nodes would be more than
    /// 4096 or fill more than the present length of the membrane, twice as many as at rest, the membrane could not go round so much
    /// cytoplasm or would at first hold more than one and a half times what it has room for, or the world would hold too many
    /// particles. Nothing is changed then.
    pub fn grow(&mut self, id: OrganismId, nodes: u32, particles: u32) -> Result<(), Error> {
        if self.organisms.get(id).is_some_and(|organism| organism.furrow().is_some()) {
            return Err(Error::unsupported("organism", "an organism that is not dividing"));
        }
        if self.organisms.get(id).is_some_and(Organism::is_held) {
            return Err(Error::unsupported("organism", "one that no other cell holds"));
        }
        with_default_float_environment(|| {
            self.check_nodes(id, nodes)?;
            self.enlarge(id, nodes, particles)
        })?;
        if let Some(organism) = self.organisms.get_mut(id) {
            with_default_float_environment(|| organism.add_wanted_nodes(nodes, &self.fluids));
        }
        self.changed(|| WorldChange::Grow(id, nodes, particles));
        Ok(())
    }

    /// Adds or removes one node of a membrane that has not reached its wanted number of nodes, unless prey is going in.
    pub(super) fn adapt_membrane(&mut self, id: OrganismId) {
        let room = (self.particles.live_count() as u64) < u64::from(self.config.max_particles);
        let Self { organisms, particles, fluids, .. } = self;
        let Some(organism) = organisms.get_mut(id).filter(|organism| Self::refusal(organism).is_none()) else {
            return;
        };
        organism.unfold(fluids);
        let count = organism.outline.len() as u32;
        let Some(divider) = &mut organism.divider else { return };
        let Some(wanted) = divider.wanted_nodes else { return };
        if count == wanted {
            divider.wanted_nodes = None;
        } else if count < wanted && room {
            insert_node(organism, particles);
        } else if count > wanted && organism.has_spare_node() {
            remove_node(organism, particles);
        }
    }

    fn check_nodes(&self, id: OrganismId, nodes: u32) -> Result<(), Error> {
        let organism = self.organisms.get(id).filter(|_| nodes > 0);
        let Some((organism, membrane)) = organism.and_then(|organism| Some((organism, organism.body.membrane()?)))
        else {
            return Ok(());
        };
        let outline = self.outline_of(organism);
        let links = outline.iter().zip(outline.iter().cycle().skip(1));
        let room = links.map(|(a, b)| (*b - *a).length()).sum::<f32>() / membrane.node_radius;
        let most = if room < MAX_NODES { room } else { MAX_NODES };
        let all = outline.len() as f32 + nodes as f32;
        let accepted = || format!("at most {} nodes in all, now", most as u32);
        (all <= most).then_some(()).ok_or_else(|| out_of_range("nodes", f64::from(all), accepted()))
    }

    /// Adds nodes and cytoplasm; the wanted number of nodes stays.
    pub(in crate::world) fn enlarge(&mut self, id: OrganismId, nodes: u32, particles: u32) -> Result<(), Error> {
        let asked = self.particles.live_count() as u64 + u64::from(nodes) + u64::from(particles);
        let limit = u64::from(self.config.max_particles);
        if asked > limit {
            return Err(Error::new(ErrorKind::TooMany { asked, limit }, "particles"));
        }
        let held = self.organisms.get(id).map_or(Vec::new(), |organism| self.held_cells(organism));
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        let spacing = organism.fluid_spacing(&self.fluids);
        let (Some(_), Some(fluid), Some(spacing)) = (organism.body.membrane(), organism.fluid, spacing) else {
            return Err(Error::unsupported("organism", "an organism with a membrane"));
        };
        check_room(organism, &self.particles, spacing, nodes, particles)?;
        self.scratch.occupancy.clear();
        for _ in 0..nodes {
            insert_node(organism, &mut self.particles);
        }
        let fluid = &mut self.fluids[fluid as usize];
        let added = inject(organism, &held, particles, spacing, &mut self.particles);
        fluid.particles.extend(added);
        if nodes > 0 {
            self.widen_gates_for_cells(id);
        }
        Ok(())
    }
}

/// Checks that a membrane with `nodes` more nodes can hold `particles` more cytoplasm below its strain limit, and that they
/// fit into its present area.
fn check_room(organism: &Organism, p: &Particles, spacing: f32, nodes: u32, particles: u32) -> Result<(), Error> {
    let Some(membrane) = organism.body.membrane() else { return Ok(()) };
    let longest = STRAIN_LIMIT * membrane.rest_length * (organism.outline.len() as f32 + nodes as f32);
    let radius = longest / std::f32::consts::TAU - membrane.node_radius;
    let stretched = std::f32::consts::PI * radius * radius;
    let (stretched, crowded) = (stretched / rest_area(1, spacing), MOST_CROWDED * room(organism, p, spacing));
    let most = if stretched < crowded { stretched } else { crowded };
    let count = organism.fluid_particles.len() as f32 + particles as f32;
    let accepted = || format!("at most {} in all with {nodes} new nodes, now", most as u32);
    (count <= most).then_some(()).ok_or_else(|| out_of_range("particles", f64::from(count), accepted()))
}

/// Number of particles of cytoplasm that the present area of a membrane holds at rest.
fn room(organism: &Organism, p: &Particles, spacing: f32) -> f32 {
    signed_area(&organism.outline_positions(p)) / rest_area(1, spacing)
}

/// Puts new cytoplasm near the centroid, but not into cells that it holds, whose outlines are `held`; returns its particles.
fn inject(organism: &mut Organism, held: &[Vec<Vec2>], count: u32, spacing: f32, p: &mut Particles) -> Vec<u32> {
    let outline = organism.outline_positions(p);
    let is_within = |at: Vec2| contains_point(&outline, at) && !held.iter().any(|inner| contains_point(inner, at));
    let Some(centre) = injection_point(organism, &outline, is_within, p) else { return Vec::new() };
    let Some(&first) = organism.fluid_particles.first() else { return Vec::new() };
    let like = Particle { role: Role::GrownCytoplasm as u8, ..p.get(first as usize) };
    let mut added = Vec::new();
    for k in 0..count {
        let mut around = unit_vector(k as f32 * GOLDEN_ANGLE) * (CROWDING * spacing * (k as f32 + 0.5).sqrt());
        // Both: an outline may bulge in between.
        let has_room = |around: Vec2| [1.0, 2.0].iter().all(|&far| is_within(centre + around * far));
        while !has_room(around) {
            around = if around.length_squared() > 1e-4 { around * 0.5 } else { break };
        }
        let around = if is_within(centre + around) { around } else { Vec2::ZERO };
        added.push(p.insert(&Particle { offset: centre + around - like.origin, velocity: Vec2::ZERO, ..like }));
    }
    organism.fluid_particles.extend(&added);
    added
}

fn injection_point(
    organism: &Organism,
    outline: &[Vec2],
    is_within: impl Fn(Vec2) -> bool,
    p: &Particles,
) -> Option<Vec2> {
    let centroid = crate::geometry::polygon::centroid(outline)?;
    if is_within(centroid) {
        return Some(centroid);
    }
    let cytoplasm: Vec<Vec2> = organism.fluid_particles.iter().map(|&i| p.position(i as usize)).collect();
    crate::geometry::ring::nearest_index(&cytoplasm, centroid).map(|k| cytoplasm[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AmoeboidCellSpec, Inputs, Placement, World, WorldConfig};

    #[test]
    fn t22_new_nodes_follow_their_neighbours_in_the_ring() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        for _ in 0..5 {
            world.grow(cell, 3, 8).unwrap();
            world.step(&Inputs::new());
            let ring = &world.organisms.get(cell).unwrap().outline;
            for (k, &node) in ring.iter().enumerate() {
                assert_eq!(world.particles.next_in_ring[node as usize], ring[(k + 1) % ring.len()]);
            }
        }
    }

    #[test]
    fn t15_a_displaced_node_is_pulled_back_by_its_links() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let node = world.organisms.get(cell).unwrap().outline[0] as usize;
        world.particles.x[node] += 3.0;
        (0..60).for_each(|_| world.step(&Inputs::new()));
        assert!(world.quality().edge_stretch_max < 0.02, "{:?}", world.quality());
    }

    #[test]
    fn new_cytoplasm_is_inside_of_a_membrane_with_folds() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        // A star with deep, narrow bays: twice as far from the centre may be in the next ray.
        let ring = world.organisms.get(cell).unwrap().outline.clone();
        let middle = world.centroid(cell).unwrap();
        for &node in ring.iter().step_by(3) {
            let p = &mut world.particles;
            let out = p.position(node as usize) - middle;
            (p.x[node as usize], p.y[node as usize]) = (
                middle.x - p.origin_x[node as usize] + 0.05 * out.x,
                middle.y - p.origin_y[node as usize] + 0.05 * out.y,
            );
        }
        let outline: Vec<_> = world.view().organism(cell).unwrap().outline().collect();
        let added = inject(world.organisms.get_mut(cell).unwrap(), &[], 140, 1.65, &mut world.particles);
        assert!(
            added.len() == 140 && added.iter().all(|&i| contains_point(&outline, world.particles.position(i as usize)))
        );
    }

    #[test]
    fn more_cytoplasm_than_the_membrane_can_hold_is_refused() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let before = world.digest();
        assert_eq!(world.grow(cell, 0, 400).unwrap_err().field(), "particles");
        assert_eq!(world.digest(), before);
        assert_eq!(world.grow(cell, 40, 2000).unwrap_err().field(), "particles", "all at once");
        assert_eq!(world.grow(cell, 60, 0).unwrap_err().field(), "nodes", "they would lie over each other");
        assert_eq!(world.digest(), before);
        for step in 0..300 {
            if step % 60 == 0 {
                world.grow(cell, 8, 80).unwrap();
            }
            world.step(&Inputs::new());
            assert_eq!(world.census().leaks, 0);
        }
    }
}
