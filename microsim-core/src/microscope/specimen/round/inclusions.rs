//! What lies inside bodies that are described from their centre outwards, and keeps its place there.

use super::super::individual::{REGIONS, Region};
use super::super::spot::Spot;
use super::{RoundBody, oral_groove};
use crate::geometry::rotate;
use crate::look::{Inclusion, SpotShape};
use crate::microscope::matter::Matter;
use crate::microscope::noise::HashRng;
use glam::Vec2;

/// Share of many inclusions that have no edge.
const SOFT: f32 = 0.5;
/// Largest radius of an inclusion whose rings are seen where it is out of focus, micrometres.
const RINGED: f32 = 0.3;

impl RoundBody {
    pub(super) fn include(&self, inclusion: &Inclusion, rng: &mut HashRng) -> Vec<Spot> {
        let [fewest, most] = inclusion.count;
        let count = fewest + rng.bits() % (most - fewest + 1);
        let regions: [Region; REGIONS] = std::array::from_fn(|_| Region::of(inclusion, rng));
        let spot = |_| {
            let at = Region::place(&regions, inclusion.place, rng);
            let apart = |region: &&Region| (region.at - at).length_squared();
            let region = regions.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(&regions[0]);
            let share = rng.unit();
            let radius = inclusion.radius[0] + (inclusion.radius[1] - inclusion.radius[0]) * share * share;
            let at = self.place(at.normalize_or_zero(), at.length());
            // The groove is clear.
            let own = rotate(at - self.polar.centre, Vec2::new(self.facing.x, -self.facing.y)) / self.axes;
            let clear = self.look.pellicle.map_or(0.0, |_| oral_groove(own)[0]);
            let matter = inclusion.matter * (rng.range([0.6, 1.3]) * region.dense * (1.0 - 0.9 * clear));
            let is_soft = most > 3 && rng.unit() < SOFT;
            let shape = if is_soft { SpotShape::Bump } else { inclusion.shape };
            let spot = Spot { at, radius: radius * region.size * self.polar.mean, matter, shape };
            let spot = if region.chirp > 0.0 && spot.radius < RINGED { spot.out_of_focus(region.chirp) } else { spot };
            std::iter::once(spot).chain(grains(spot, inclusion.grains, rng)).collect::<Vec<_>>()
        };
        (0..count).flat_map(spot).collect()
    }

    /// Drops and bubbles in a red cell that dried: a few together, long or round, of which some run into each other; they lie
    /// in paler surroundings, deep ones bright and shallow ones dark.
    pub(super) fn drying_drops(&self, rng: &mut HashRng) -> Vec<Spot> {
        let many = rng.unit();
        let count = if rng.unit() < self.smear.pitted { 1 + (4.0 * many * many) as u32 } else { 0 };
        let mut at = self.place(rng.direction(), 0.8 * rng.unit().sqrt());
        let along = rng.direction();
        let drop = |_| {
            let radius = 0.36 * self.smear.drop_size * libm::expf(0.38 * rng.normal());
            let deep = self.smear.drop_depth * rng.range([0.35, 1.2]);
            let clear = Matter { haemoglobin: -0.3 * deep, ..Matter::NONE };
            let lack = Matter { haemoglobin: -2.2 * deep, nucleus: 0.10, ..Matter::phase(-0.05) };
            let long = along * (radius * rng.range([0.0, 0.55]));
            let around = Spot { at, radius: 2.1 * radius, matter: clear, shape: SpotShape::Bump };
            let half = |at| Spot { at, radius, matter: lack * 0.7, shape: SpotShape::Bump };
            let drop = [around, half(at + long), half(at - long)];
            at += (rng.direction() * 1.6 + along * rng.range([0.5, 3.0])) * radius;
            drop
        };
        (0..count).flat_map(drop).collect()
    }
}

/// Soft grains inside a spot.
fn grains(spot: Spot, [fewest, most]: [u32; 2], rng: &mut HashRng) -> Vec<Spot> {
    let count = fewest + rng.bits() % (most - fewest + 1);
    let grain = |_| {
        let at = spot.at + rng.direction() * (0.95 * spot.radius * rng.unit().sqrt());
        let radius = spot.radius * rng.range([0.05, 0.40]);
        Spot { at, radius, matter: spot.matter * rng.range([0.1, 0.35]), shape: SpotShape::Bump }
    };
    (0..count).map(grain).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::ImageLook;
    use crate::{Placement, RedCellSpec, World, WorldConfig};

    #[test]
    fn drops_are_caught_in_many_cells_of_some_slides_and_in_hardly_any_of_others() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&RedCellSpec::default().into(), Placement::at(60.0, 40.0)).unwrap();
        let cell = world.view().organism(id).unwrap();
        let ImageLook::Round(look) = crate::organism::look(cell.kind()).image else { panic!("red cells are round") };
        let has_drops = |slide: u32, seed: u32| {
            let body = RoundBody::of(cell, look, [slide, seed]).unwrap();
            let drops = body.drying_drops(&mut HashRng::new(seed));
            drops.iter().any(|spot| spot.matter.haemoglobin < -0.3)
        };
        let cells = |slide: u32| (0..60).filter(|&seed| has_drops(slide, seed)).count();
        let slides: Vec<usize> = (0..30).map(cells).collect();
        let clean = slides.iter().filter(|count| **count <= 4).count();
        let full = slides.iter().filter(|count| **count >= 10).count();
        assert!((6..20).contains(&clean) && (8..25).contains(&full), "{slides:?}");
    }
}
