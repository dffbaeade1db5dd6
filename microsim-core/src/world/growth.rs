//! Growth of a filled chain (seed, 3.1.2): new nodes in the membrane, new cytoplasm at the centroid.

use super::World;
use crate::error::{Error, ErrorKind};
use crate::geometry::polygon::contains_point;
use crate::geometry::ring::unit_vector;
use crate::id::OrganismId;
use crate::organism::{Body, Organism};
use crate::particle::{Particle, Particles};
use crate::solver::membrane::links;
use crate::template::Role;
use glam::Vec2;

/// Angle between new particles in turns of the golden ratio, radians (Vogel 1979): they never fall on one line.
const GOLDEN_ANGLE: f32 = 2.399_963_2;
/// New particles lie this share of the spacing from their common centre, times the square root of their number.
const CROWDING: f32 = 0.3;

impl World {
    /// Grows an organism that has a membrane: `nodes` new membrane nodes, each in the middle of the link that is longest
    /// then, and `particles` of new cytoplasm around the centroid of the membrane (around the cytoplasm particle nearest
    /// to it, if the centroid lies outside). New cytoplasm has the role [`Role::GrownCytoplasm`].
    ///
    /// # Errors
    /// When the handle is stale, the organism has no membrane or the world would hold too many particles. Nothing is
    /// changed then.
    pub fn grow(&mut self, id: OrganismId, nodes: u32, particles: u32) -> Result<(), Error> {
        let asked = self.particles.live_count() as u64 + u64::from(nodes) + u64::from(particles);
        let limit = u64::from(self.config.max_particles);
        if asked > limit {
            return Err(Error::new(ErrorKind::TooMany { asked, limit }, "particles"));
        }
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        let (Some(_), Some(fluid)) = (organism.body.membrane(), organism.fluid) else {
            return Err(Error::unsupported("organism", "an organism with a membrane"));
        };
        for _ in 0..nodes {
            insert_node(organism, &mut self.particles);
        }
        let fluid = &mut self.fluids[fluid as usize];
        let added = inject(organism, particles, fluid.params.spacing, &mut self.particles);
        fluid.particles.extend(added);
        Ok(())
    }
}

/// Puts a node like its neighbours into the longest link. The link is replaced by two of the same rest length.
fn insert_node(organism: &mut Organism, p: &mut Particles) {
    let length = |(a, b): (u32, u32)| p.between(a as usize, b as usize).length_squared();
    let longest = links(&organism.outline)
        .enumerate()
        .fold((0, 0.0), |best, (k, link)| if length(link) > best.1 { (k, length(link)) } else { best });
    let k = longest.0;
    let (a, b) = (organism.outline[k] as usize, organism.outline[(k + 1) % organism.outline.len()] as usize);
    let like = p.get(a);
    let node = p.insert(&Particle {
        offset: like.offset + p.between(a, b) * 0.5,
        velocity: (p.velocity(a) + p.velocity(b)) * 0.5,
        ..like
    });
    organism.outline.insert(k + 1, node);
    if let Body::Loose { particles, .. } = &mut organism.body {
        particles.push(node);
    }
    p.link_ring(&organism.outline);
}

/// Puts new cytoplasm near the centroid and returns its particles.
fn inject(organism: &mut Organism, count: u32, spacing: f32, p: &mut Particles) -> Vec<u32> {
    let outline: Vec<Vec2> = organism.outline_particles().map(|i| p.position(i as usize)).collect();
    let Some(centre) = injection_point(organism, &outline, p) else { return Vec::new() };
    let like = Particle { role: Role::GrownCytoplasm as u8, ..p.get(organism.fluid_particles[0] as usize) };
    let mut added = Vec::new();
    for k in 0..count {
        let mut around = unit_vector(k as f32 * GOLDEN_ANGLE) * (CROWDING * spacing * (k as f32 + 0.5).sqrt());
        while !contains_point(&outline, centre + around * 2.0) && around.length_squared() > 1e-4 {
            around *= 0.5;
        }
        added.push(p.insert(&Particle { offset: centre + around - like.origin, velocity: Vec2::ZERO, ..like }));
    }
    organism.fluid_particles.extend(&added);
    added
}

fn injection_point(organism: &Organism, outline: &[Vec2], p: &Particles) -> Option<Vec2> {
    let centroid = crate::geometry::polygon::centroid(outline)?;
    if contains_point(outline, centroid) {
        return Some(centroid);
    }
    let cytoplasm: Vec<Vec2> = organism.fluid_particles.iter().map(|&i| p.position(i as usize)).collect();
    crate::geometry::ring::nearest_index(&cytoplasm, centroid).map(|k| cytoplasm[k])
}
