//! Quality: errors of constraints and the shape of membranes.

use super::membrane_quality::CrawlQuality;
use crate::capability::phagocytosis::MealPhase;
use crate::organism::Organism;
use crate::solver::constraint::Constraint;
use crate::solver::lanes::ratio;
use crate::solver::membrane::links;
use crate::template::Role;
use crate::world::World;
use crate::world::contacts::NearPair;

/// Errors of constraints at the end of a step. All are 0 when nothing is violated.
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
    /// Largest relative excess of a link of a membrane over its rest length.
    pub membrane_stretch_max: f32,
    /// Largest share of voids within a membrane, see [`crate::MembraneQuality::voids`].
    pub voids_max: f32,
    /// Largest excess turning of a membrane, radians, see [`crate::MembraneQuality::excess_turning`].
    pub excess_turning_max: f32,
    /// Mean of [`CrawlQuality::width_ratio`] over the cells that crawl; 0 when none does.
    pub width_ratio_mean: f32,
    /// Mean of [`CrawlQuality::speed_kept`] over the cells that crawl; 0 when none does.
    pub speed_kept_mean: f32,
    /// Longest time of an ingestion in progress since its conditions began to hold, s.
    pub ingestion_time_max: f32,
    /// Longest time for which an organism has wanted to move but has stayed within a third of its radius, s.
    pub stalled_max: f32,
}

/// Relative errors of the rigid links of all templated outlines.
#[derive(Default)]
struct RingErrors {
    mean: f32,
    max: f32,
    /// Of the links that are too long.
    stretch_max: f32,
}

impl World {
    /// Measures errors of constraints and the shape of membranes. Costs more than a step in worlds with large cells;
    /// [`crate::Measure`] measures one number alone.
    #[must_use]
    pub fn quality(&self) -> Quality {
        let (ring, membrane_stretch_max) = (self.ring_errors(), self.membrane_stretch_max());
        Quality {
            ring_error_mean: ring.mean,
            ring_error_max: ring.max,
            penetration_max: self.penetration_max(),
            edge_stretch_max: larger(ring.stretch_max, membrane_stretch_max),
            anchor_offset_max: self.anchor_offset_max(),
            fluid_compression_mean: self.fluid_compression_mean(),
            membrane_stretch_max,
            voids_max: self.voids_max(),
            excess_turning_max: self.excess_turning_max(),
            width_ratio_mean: self.width_ratio_mean(),
            speed_kept_mean: self.speed_kept_mean(),
            ingestion_time_max: self.ingestion_time_max(),
            stalled_max: self.stalled_max(),
        }
    }

    pub(in crate::world) fn ring_error_mean(&self) -> f32 {
        self.ring_errors().mean
    }

    pub(in crate::world) fn ring_error_max(&self) -> f32 {
        self.ring_errors().max
    }

    pub(in crate::world) fn edge_stretch_max(&self) -> f32 {
        larger(self.ring_errors().stretch_max, self.membrane_stretch_max())
    }

    pub(in crate::world) fn membrane_stretch_max(&self) -> f32 {
        largest(self.organisms.iter().flat_map(|(_, organism)| self.membrane_stretches(organism)))
    }

    pub(in crate::world) fn anchor_offset_max(&self) -> f32 {
        largest(self.organisms.iter().map(|(_, organism)| self.anchor_offset(organism)))
    }

    pub(in crate::world) fn voids_max(&self) -> f32 {
        largest(self.organisms.iter().filter_map(|(_, organism)| self.voids_of(organism)))
    }

    pub(in crate::world) fn excess_turning_max(&self) -> f32 {
        largest(self.organisms.iter().filter_map(|(_, organism)| self.excess_turning_of(organism)))
    }

    pub(in crate::world) fn width_ratio_mean(&self) -> f32 {
        mean(self.crawls().map(|crawl| crawl.width_ratio))
    }

    pub(in crate::world) fn speed_kept_mean(&self) -> f32 {
        mean(self.crawls().map(|crawl| crawl.speed_kept))
    }

    pub(in crate::world) fn ingestion_time_max(&self) -> f32 {
        let engulfers = self.organisms.iter().filter_map(|(_, organism)| organism.engulfer.as_ref());
        largest(engulfers.flat_map(|engulfer| {
            engulfer.meals.iter().map(|meal| match meal.phase {
                MealPhase::Touching(time) => time,
                MealPhase::Ingesting(time) => engulfer.params.hold_time + time,
                MealPhase::Ingested | MealPhase::Digesting(_) => 0.0,
            })
        }))
    }

    pub(in crate::world) fn stalled_max(&self) -> f32 {
        let wanting = self.organisms.iter().filter(|(_, organism)| organism.goal.is_some());
        largest(wanting.map(|(_, organism)| organism.progress.stalled))
    }

    fn crawls(&self) -> impl Iterator<Item = CrawlQuality> + '_ {
        self.organisms.iter().filter_map(|(_, organism)| self.crawl_quality_of(organism))
    }

    fn ring_errors(&self) -> RingErrors {
        let (mut errors, mut sum, mut count) = (RingErrors::default(), 0.0, 0.0);
        for strain in self.organisms.iter().flat_map(|(_, organism)| self.outline_strains(organism)) {
            errors.max = larger(errors.max, strain.abs());
            errors.stretch_max = larger(errors.stretch_max, strain);
            (sum, count) = (sum + strain.abs(), count + 1.0);
        }
        errors.mean = if count > 0.0 { sum / count } else { 0.0 };
        errors
    }

    /// Relative error of each link between neighbours of a templated outline, positive when stretched; not of those that tore.
    fn outline_strains<'a>(&'a self, organism: &'a Organism) -> impl Iterator<Item = f32> + 'a {
        let scale = self.scale_of(organism);
        let is_outline = |node: u32| self.particles.role[organism.body.particle(node) as usize] == Role::Membrane as u8;
        self.constraints_of(organism).iter().zip(0..).filter_map(move |(constraint, k)| {
            let ([node_a, node_b], rest_length) = match constraint {
                Constraint::Distance(c) => ([c.a, c.b], c.rest_length),
                Constraint::ConservativeDistance(c) => ([c.a, c.b], c.rest_length),
                Constraint::YieldingDistance(c) => ([c.a, c.b], c.rest_length),
                _ => return None,
            };
            let (a, b) = (organism.body.particle(node_a) as usize, organism.body.particle(node_b) as usize);
            let is_ring_link = is_outline(node_a) && is_outline(node_b) && rest_length > 0.0;
            let rest_length = || rest_length * scale * self.length_factor(organism, k);
            let rest_length = is_ring_link.then(rest_length).filter(|&rest_length| rest_length > 0.0)?;
            Some(self.particles.between(a, b).length() / rest_length - 1.0)
        })
    }

    /// Relative excess of each link of a membrane over its rest length.
    pub(in crate::world) fn membrane_stretches<'a>(&'a self, organism: &'a Organism) -> impl Iterator<Item = f32> + 'a {
        organism.body.membrane().into_iter().flat_map(move |membrane| {
            let length = |(a, b): (u32, u32)| self.particles.between(a as usize, b as usize).length();
            links(&organism.outline).map(move |link| length(link) / membrane.rest_length - 1.0)
        })
    }

    fn anchor_offset(&self, organism: &Organism) -> f32 {
        largest(self.constraints_of(organism).iter().filter_map(|constraint| {
            let Constraint::Anchor(c) = constraint else { return None };
            let (node, anchor) = (organism.body.particle(c.node) as usize, organism.body.particle(c.anchor) as usize);
            Some(self.particles.between(anchor, node).length() / self.scale_of(organism))
        }))
    }

    pub(in crate::world) fn penetration_max(&self) -> f32 {
        let p = &self.particles;
        let is_apart = |pair: &NearPair| p.owner[pair.i as usize] != p.owner[pair.j as usize];
        let overlap = |pair: NearPair| ratio(-pair.gap, p.smaller_radius(pair.i, pair.j));
        self.near_pairs().filter(is_apart).map(overlap).fold(0.0, larger)
    }

    pub(in crate::world) fn fluid_compression_mean(&self) -> f32 {
        let mut scales = vec![1.0; self.fluids.len()];
        self.organisms.fluid_scales().for_each(|(fluid, scale)| scales[fluid as usize] = scale);
        let fluids = self.fluids.iter().zip(scales).filter(|(fluid, _)| !fluid.particles.is_empty());
        let (sum, count) = fluids.fold((0.0, 0.0), |(sum, count), (fluid, scale)| {
            let share = fluid.particles.len() as f32;
            (sum + fluid.mean_compression(scale, &self.particles, self.period()) * share, count + share)
        });
        if count > 0.0 { sum / count } else { 0.0 }
    }
}

fn largest(numbers: impl Iterator<Item = f32>) -> f32 {
    numbers.fold(0.0, larger)
}

/// The mean; 0 of an empty list.
fn mean(numbers: impl Iterator<Item = f32>) -> f32 {
    let (sum, count) = numbers.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}
