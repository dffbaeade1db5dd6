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

    /// Where a red cell that dried let go of its haemoglobin, which lies around the pit.
    pub(super) fn drying_pits(&self, rng: &mut HashRng) -> Vec<Spot> {
        let count = if rng.unit() < self.pitted { 1 + rng.bits() % 4 } else { 0 };
        let mut at = self.place(rng.direction(), 0.6 * rng.unit());
        let along = rng.direction();
        let pit = |_| {
            let radius = 0.24 * libm::expf(0.40 * rng.normal());
            let dense = rng.range([0.3, 1.3]);
            let clear = Matter { haemoglobin: -1.2 * dense, nucleus: -0.12 * dense, ..Matter::phase(-0.10) };
            let around = Matter { haemoglobin: 0.6 * dense, nucleus: 0.4 * dense, ..Matter::NONE };
            let ring = Spot { at, radius: 0.9 * radius, matter: around, shape: SpotShape::Ring };
            let pit = [Spot { at, radius, matter: clear, shape: SpotShape::Bump }, ring];
            // Some lie in a row or run into each other.
            at += (rng.direction() + along) * radius;
            pit
        };
        (0..count).flat_map(pit).collect()
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
