//! Measures: what there is, whether anything is where it must not be, and how well constraints hold.

use super::World;
use crate::capability::phagocytosis::MealPhase;
use crate::geometry::polygon::contains_point;
use crate::id::OrganismId;
use crate::organism::{Body, Organism};
use crate::solver::membrane::links;
use crate::solver::{ConstraintSet, Distance};
use crate::template::Role;
use glam::Vec2;

/// Counts of what is in the world, and of what must not happen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Organisms.
    pub organisms: usize,
    /// Dynamic discs that are not fluid: the "dynamic bodies" of the seed's Table 4.1.
    pub bodies: usize,
    /// All live particles: discs, fluid and static points.
    pub particles: usize,
    /// Constraints, without contacts and fluid density.
    pub constraints: usize,
    /// Cytoplasm particles outside their own membrane (ray cast, seed 3.1.3).
    pub leaks: usize,
    /// Prey whose centre is inside an engulfer that has not taken it in (seed, 4.2.2), or outside one that has.
    pub improper_absorptions: usize,
    /// Organisms that are frozen.
    pub quarantined: usize,
}

/// How well the constraints hold at the end of a step. All are 0 when nothing is violated.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Mean relative error of the lengths of the rigid links of soft bodies' outlines.
    pub ring_error_mean: f32,
    /// Largest relative error of one of these links.
    pub ring_error_max: f32,
    /// Deepest overlap of two discs of different organisms, as a share of the smaller radius.
    pub penetration_max: f32,
    /// Largest relative excess of a link of any outline, membranes included, over its rest length.
    pub edge_stretch_max: f32,
    /// Largest distance of a platelet's nucleus from its anchor, as a share of the platelet's outer radius.
    pub anchor_offset_max: f32,
    /// Mean compression of all fluid, over its rest density.
    pub fluid_compression_mean: f32,
}

impl World {
    /// Counts what is in the world. Costs about as much as a substep.
    #[must_use]
    pub fn census(&self) -> Census {
        let p = &self.particles;
        let is_body = |&i: &usize| p.inv_mass[i] > 0.0 && p.fluid[i] == 0;
        let of_body = |organism: &Organism| match organism.body.membrane() {
            Some(_) => organism.outline.len(),
            None => self.constraints_of(organism).map_or(0, ConstraintSet::len),
        };
        let constraints = self.organisms.iter().map(|(_, organism)| of_body(organism)).sum();
        Census {
            organisms: self.organisms.len(),
            bodies: p.live().filter(is_body).count(),
            particles: p.live().count(),
            constraints,
            leaks: self.organisms.iter().map(|(_, organism)| self.leaks_of(organism)).sum(),
            improper_absorptions: self.improper_absorptions(),
            quarantined: self.organisms.iter().filter(|(_, organism)| organism.is_quarantined).count(),
        }
    }

    /// Measures how well the constraints hold.
    #[must_use]
    pub fn quality(&self) -> Quality {
        let mut quality = Quality { penetration_max: self.deepest_overlap(), ..Quality::default() };
        let mut count = 0.0;
        for (_, organism) in self.organisms.iter() {
            let offset = self.anchor_offset(organism);
            quality.anchor_offset_max = larger(quality.anchor_offset_max, offset);
            for error in self.outline_strains(organism) {
                quality.ring_error_mean += error.abs();
                quality.ring_error_max = larger(quality.ring_error_max, error.abs());
                quality.edge_stretch_max = larger(quality.edge_stretch_max, error);
                count += 1.0;
            }
            for stretch in self.membrane_stretches(organism) {
                quality.edge_stretch_max = larger(quality.edge_stretch_max, stretch);
            }
        }
        quality.ring_error_mean /= if count > 0.0 { count } else { 1.0 };
        quality.fluid_compression_mean = self.mean_compression();
        quality
    }

    /// The constraints that hold a templated organism together.
    fn constraints_of(&self, organism: &Organism) -> Option<&ConstraintSet> {
        match organism.body {
            Body::Lane { block, .. } => {
                Some(self.templates[self.blocks[block as usize].template as usize].constraints())
            }
            Body::Loose { .. } => None,
        }
    }

    /// Scale of an organism's constraints.
    pub(crate) fn scale_of(&self, organism: &Organism) -> f32 {
        match organism.body {
            Body::Lane { block, first } => {
                let block = &self.blocks[block as usize];
                block.scale[(first - block.base) as usize]
            }
            Body::Loose { .. } => 1.0,
        }
    }

    fn leaks_of(&self, organism: &Organism) -> usize {
        if organism.outline.is_empty() || organism.fluid_particles.is_empty() {
            return 0;
        }
        let outline = self.outline_of(organism);
        let is_outside = |&&i: &&u32| !contains_point(&outline, self.particles.position(i as usize));
        organism.fluid_particles.iter().filter(is_outside).count()
    }

    /// Prey whose centre is inside an engulfer that does not hold it, or outside one that does.
    fn improper_absorptions(&self) -> usize {
        let engulfers = self.organisms.iter().filter_map(|(_, o)| Some((o.engulfer.as_ref()?, self.outline_of(o))));
        let engulfers: Vec<_> = engulfers.collect();
        let prey = self.organisms.iter().filter(|(_, o)| o.prey.is_some() && !o.is_quarantined);
        let is_improper = |id: OrganismId, organism: &Organism| {
            let centre = self.centre_of(organism);
            engulfers.iter().any(|(engulfer, outline)| {
                let phase = engulfer.meals.iter().find(|meal| meal.prey == id).map(|meal| meal.phase);
                let is_inside = contains_point(outline, centre);
                match phase {
                    Some(MealPhase::Ingesting(_)) => false,
                    Some(MealPhase::Ingested | MealPhase::Digesting(_)) => !is_inside,
                    Some(MealPhase::Touching(_)) | None => is_inside,
                }
            })
        };
        prey.filter(|(id, organism)| is_improper(*id, organism)).count()
    }

    /// Position of the nucleus, or of the first particle.
    fn centre_of(&self, organism: &Organism) -> Vec2 {
        let is_nucleus = |&i: &usize| self.particles.role[i] == Role::Nucleus as u8;
        let mut particles = organism.particles().map(|i| i as usize);
        let first = organism.first_node().map_or(0, |i| i as usize);
        self.particles.position(particles.find(is_nucleus).unwrap_or(first))
    }

    fn outline_of(&self, organism: &Organism) -> Vec<Vec2> {
        organism.outline_particles().map(|i| self.particles.position(i as usize)).collect()
    }

    /// Relative error of each rigid link between neighbours of a templated outline, positive when stretched.
    fn outline_strains<'a>(&'a self, organism: &'a Organism) -> impl Iterator<Item = f32> + 'a {
        let scale = self.scale_of(organism);
        let is_outline = |node: u32| self.particles.role[organism.body.particle(node) as usize] == Role::Membrane as u8;
        let links = self.constraints_of(organism).into_iter().flat_map(|set| &set.distances);
        let links = links.filter(move |c| is_outline(c.a) && is_outline(c.b) && c.rest_length > 0.0);
        links.map(move |c: &Distance| {
            let (a, b) = (organism.body.particle(c.a) as usize, organism.body.particle(c.b) as usize);
            self.particles.between(a, b).length() / (c.rest_length * scale) - 1.0
        })
    }

    /// Relative excess of each link of a membrane over its rest length.
    fn membrane_stretches<'a>(&'a self, organism: &'a Organism) -> impl Iterator<Item = f32> + 'a {
        organism.body.membrane().into_iter().flat_map(move |membrane| {
            let length = |(a, b): (u32, u32)| self.particles.between(a as usize, b as usize).length();
            links(&organism.outline).map(move |link| length(link) / membrane.rest_length - 1.0)
        })
    }

    fn anchor_offset(&self, organism: &Organism) -> f32 {
        let anchors = self.constraints_of(organism).into_iter().flat_map(|set| &set.anchors);
        anchors.fold(0.0, |far, c| {
            let (node, anchor) = (organism.body.particle(c.node) as usize, organism.body.particle(c.anchor) as usize);
            larger(far, self.particles.between(anchor, node).length() / self.scale_of(organism))
        })
    }

    fn deepest_overlap(&self) -> f32 {
        let p = &self.particles;
        self.scratch.broad_phase.contacts.iter().fold(0.0, |deepest, contact| {
            let (i, j) = (contact.i as usize, contact.j as usize);
            if p.owner[i] == p.owner[j] || !p.is_live(i) || !p.is_live(j) {
                return deepest;
            }
            let smaller = if p.radius[i] < p.radius[j] { p.radius[i] } else { p.radius[j] };
            let depth = p.radius[i] + p.radius[j] - p.between(i, j).length();
            larger(deepest, if smaller > 0.0 { depth / smaller } else { 0.0 })
        })
    }

    fn mean_compression(&self) -> f32 {
        let fluids = self.fluids.iter().filter(|fluid| !fluid.particles.is_empty());
        let (sum, count) = fluids.fold((0.0, 0.0), |(sum, count), fluid| {
            let share = fluid.particles.len() as f32;
            (sum + fluid.mean_compression(&self.particles) * share, count + share)
        });
        if count > 0.0 { sum / count } else { 0.0 }
    }
}

fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}
