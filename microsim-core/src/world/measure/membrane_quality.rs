//! Shape of a membrane around its content, and motion of its cell.

use crate::geometry::coverage::Coverage;
use crate::geometry::outline::{excess_turning, quarter_widths};
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::solver::membrane::links;
use crate::world::World;
use glam::Vec2;

/// Distance from a cytoplasm particle, in rest spacings of the cytoplasm, up to which it covers a point. In the
/// hexagonal lattice no point is farther than `1 / sqrt(3)` = 0.58 from a particle; an eighth more is for the disorder of
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
    /// Measures one membrane. `None` for a stale handle and for an organism without a membrane around a fluid.
    #[must_use]
    pub fn membrane_quality(&self, id: OrganismId) -> Option<MembraneQuality> {
        let organism = self.organisms.get(id)?;
        let chunks = self.membrane_stretches(organism);
        Some(MembraneQuality {
            voids: self.voids_of(organism)?,
            excess_turning: self.excess_turning_of(organism)?,
            edge_stretch: chunks.fold(-1.0, |most, stretch| if stretch > most { stretch } else { most }),
            crawl: self.crawl_quality_of(organism),
        })
    }

    pub(in crate::world) fn voids_of(&self, organism: &Organism) -> Option<f32> {
        let spacing = organism.fluid_spacing(&self.fluids)?;
        let thickness = organism.body.membrane()?.node_radius;
        let position = |i: u32| self.particles.position(i as usize);
        let mut coverage = Coverage::of(&self.outline_of(organism), spacing / SAMPLES)?;
        for (a, b) in links(&organism.outline) {
            coverage.cover_capsule(position(a), position(b), thickness);
        }
        for &i in &organism.fluid_particles {
            coverage.cover_disc(position(i), COVERED * spacing);
        }
        for prey in organism.meals().iter().filter_map(|meal| self.organisms.get(meal.prey)) {
            coverage.cover_polygon(&self.outline_of(prey));
            prey.particles().for_each(|i| coverage.cover_disc(position(i), self.particles.radius[i as usize]));
        }
        Some(coverage.free_share())
    }

    pub(in crate::world) fn excess_turning_of(&self, organism: &Organism) -> Option<f32> {
        organism.body.membrane()?;
        Some(excess_turning(&self.outline_of(organism)))
    }

    pub(in crate::world) fn crawl_quality_of(&self, organism: &Organism) -> Option<CrawlQuality> {
        let goal = organism.goal.filter(|_| organism.crawls())?;
        let outline = self.outline_of(organism);
        let velocity = self.mean_velocity(organism);
        let way = (goal - crate::geometry::polygon::centroid(&outline)?).try_normalize()?;
        let [front, rear] = quarter_widths(&outline, velocity)?;
        let drive = organism.present_speed();
        let speed_kept = if drive > 0.0 { velocity.dot(way) / drive } else { 0.0 };
        Some(CrawlQuality { width_ratio: front / rear, speed_kept })
    }

    fn mean_velocity(&self, organism: &Organism) -> Vec2 {
        let velocities = organism.particles().map(|i| self.particles.velocity(i as usize));
        let (sum, count) = velocities.fold((Vec2::ZERO, 0.0), |(sum, count), v| (sum + v, count + 1.0));
        sum / count
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::polygon::signed_area;
    use crate::{AmoeboidCellSpec, Inputs, Intent, Placement, WorldConfig};

    fn rested_cell() -> (World, OrganismId) {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(50.0, 45.0)).unwrap();
        (0..120).for_each(|_| world.step(&Inputs::new()));
        (world, cell)
    }

    #[test]
    fn a_cell_at_rest_is_full_and_round_and_does_not_crawl() {
        let (world, cell) = rested_cell();
        let quality = world.membrane_quality(cell).unwrap();
        assert!(quality.voids < 0.01 && quality.excess_turning < 0.1 && quality.crawl.is_none(), "{quality:?}");
    }

    #[test]
    fn a_hole_in_the_cytoplasm_is_a_void_of_its_size() {
        let (mut world, cell) = rested_cell();
        let centre = world.centroid(cell).unwrap();
        let hole = 5.0;
        let World { organisms, particles, fluids, .. } = &mut world;
        let organism = organisms.get_mut(cell).unwrap();
        organism.fluid_particles.retain(|&i| (particles.position(i as usize) - centre).length() > hole);
        let spacing = fluids[organism.fluid.unwrap() as usize].params.spacing;
        let area = signed_area(&world.outline_of(world.organisms.get(cell).unwrap()));
        let voids = world.membrane_quality(cell).unwrap().voids * area;
        let radius = (voids / std::f32::consts::PI).sqrt();
        // The nearest particles left stand between no and one spacing beyond the edge of the hole.
        assert!(radius > hole - COVERED * spacing && radius < hole + (1.0 - COVERED) * spacing, "radius {radius}");
    }

    #[test]
    fn a_crawling_cell_keeps_its_speed_and_a_stuck_one_does_not() {
        let (mut world, cell) = rested_cell();
        let mut inputs = Inputs::new();
        inputs.set(cell, Intent::toward(Vec2::new(1000.0, 45.0)).unwrap());
        (0..120).for_each(|_| world.step(&inputs));
        let crawl = world.membrane_quality(cell).unwrap().crawl.unwrap();
        assert!((0.8..1.1).contains(&crawl.speed_kept) && crawl.width_ratio > 0.5, "{crawl:?}");
        assert_eq!(world.quality().speed_kept_mean, crawl.speed_kept);
        (0..1200).for_each(|_| world.step(&inputs));
        let against_the_wall = world.membrane_quality(cell).unwrap().crawl.unwrap();
        assert!(against_the_wall.speed_kept < 0.2, "{against_the_wall:?}");
    }

    #[test]
    fn only_membranes_around_a_fluid_are_measured() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let agar = world.spawn(&crate::AgarSpec::default().into(), Placement::at(50.0, 45.0)).unwrap();
        assert!(world.membrane_quality(agar).is_none());
        assert_eq!((world.quality().voids_max, world.quality().width_ratio_mean), (0.0, 0.0));
    }
}
