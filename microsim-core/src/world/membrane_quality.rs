//! How well a membrane hugs what it holds, and how a cell moves that has one.

use super::World;
use crate::capability::Locomotion;
use crate::geometry::coverage::Coverage;
use crate::geometry::outline::{excess_turning, quarter_widths};
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::solver::membrane::links;
use glam::Vec2;

/// Distance from a cytoplasm particle, in rest spacings of the cytoplasm, up to which a place is covered by it. In the
/// hexagonal lattice no place is farther than `1 / sqrt(3)` = 0.58 from a particle; an eighth more is for the disorder of
/// a fluid at rest.
const COVERED: f32 = 0.65;
/// Samples per rest spacing.
const SAMPLES: f32 = 6.0;

/// Shape and motion of one organism that has a membrane. All measures are of the present state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MembraneQuality {
    /// Share of the area within the membrane that nothing covers: no cytoplasm within 0.65 of its rest spacing, no prey
    /// that is held, no membrane within its own thickness. Sampled six times per spacing, so exact to about 1e-3.
    pub voids: f32,
    /// How much more the membrane turns than a convex one, radians: the magnitudes of all exterior angles of the polygon
    /// of its nodes less 2 pi. Not smoothed, so every tooth and wrinkle counts.
    pub excess_turning: f32,
    /// Relative excess of the longest link over its rest length; negative if all are shorter.
    pub edge_stretch: f32,
    /// How it crawls; `None` while it is not driven.
    pub crawl: Option<CrawlQuality>,
}

/// How a cell crawls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CrawlQuality {
    /// Width across the direction of motion a quarter of the length behind the front end, over the same before the rear
    /// end: 1 for an ellipse, more for a broad front with a tail.
    pub width_ratio: f32,
    /// Speed of the centre of its particles towards the goal over the speed of the drive. Average it over a while.
    pub speed_kept: f32,
}

impl World {
    /// Measures one membrane. `None` for a stale handle and for what has no membrane around a fluid.
    #[must_use]
    pub fn membrane_quality(&self, id: OrganismId) -> Option<MembraneQuality> {
        self.membrane_quality_of(self.organisms.get(id)?)
    }

    pub(crate) fn membrane_quality_of(&self, organism: &Organism) -> Option<MembraneQuality> {
        let membrane = organism.body.membrane()?;
        let outline = self.outline_of(organism);
        let stretches = links(&organism.outline)
            .map(|(a, b)| self.particles.between(a as usize, b as usize).length() / membrane.rest_length - 1.0);
        Some(MembraneQuality {
            voids: self.voids_of(organism, &outline)?,
            excess_turning: excess_turning(&outline),
            edge_stretch: stretches.fold(-1.0, |most, stretch| if stretch > most { stretch } else { most }),
            crawl: self.crawl_quality_of(organism, &outline),
        })
    }

    fn voids_of(&self, organism: &Organism, outline: &[Vec2]) -> Option<f32> {
        let spacing = self.fluids[organism.fluid? as usize].params.spacing;
        let thickness = organism.body.membrane()?.node_radius;
        let position = |i: u32| self.particles.position(i as usize);
        let mut coverage = Coverage::of(outline, spacing / SAMPLES)?;
        for (a, b) in links(&organism.outline) {
            coverage.cover_capsule(position(a), position(b), thickness);
        }
        for &i in &organism.fluid_particles {
            coverage.cover_disc(position(i), COVERED * spacing);
        }
        let meals = organism.engulfer.iter().flat_map(|engulfer| &engulfer.meals);
        for prey in meals.filter_map(|meal| self.organisms.get(meal.prey)) {
            coverage.cover_polygon(&self.outline_of(prey));
            prey.particles().for_each(|i| coverage.cover_disc(position(i), self.particles.radius[i as usize]));
        }
        Some(coverage.free_share())
    }

    fn crawl_quality_of(&self, organism: &Organism, outline: &[Vec2]) -> Option<CrawlQuality> {
        let goal = organism.goal?;
        if !matches!(organism.locomotion, Locomotion::Crawl { front_centre: Some(_) }) {
            return None;
        }
        let velocity = self.mean_velocity(organism);
        let way = (goal - crate::geometry::polygon::centroid(outline)?).try_normalize()?;
        let drive = organism.present_speed();
        let [front, rear] = quarter_widths(outline, velocity)?;
        let speed_kept = if drive > 0.0 { velocity.dot(way) / drive } else { 0.0 };
        Some(CrawlQuality { width_ratio: front / rear, speed_kept })
    }

    fn mean_velocity(&self, organism: &Organism) -> Vec2 {
        let velocities = organism.particles().map(|i| self.particles.velocity(i as usize));
        let (sum, count) = velocities.fold((Vec2::ZERO, 0.0), |(sum, count), v| (sum + v, count + 1.0));
        sum / count
    }
}
