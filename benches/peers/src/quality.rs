//! How well an engine does its work, measured for all of them alike: from positions alone.

mod crowd;

use crate::scene::{DISCS, DT, FluidBlock, OUTER_RADIUS, Platelet, PlateletField, Pusher, SATELLITES};
use microsim_core::glam::Vec2;
use serde::{Deserialize, Serialize};

pub(crate) use crowd::CrowdQuality;

/// Of a row. What does not apply is left out.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Quality {
    /// Mean relative error of the lengths of ring links.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ring_error_mean: Option<f64>,
    /// Largest of them since the measurement began.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ring_error_max: Option<f64>,
    /// Deepest overlap of satellites of different platelets or of one with a pusher, in satellite radii.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub penetration_max: Option<f64>,
    /// Most satellites at once whose centre lies inside a strange ring.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intruders_max: Option<usize>,
    /// Mean distance of platelets from their anchors, in outer radii, while they are stirred.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub anchor_offset_stirred: Option<f64>,
    /// Mean and largest of the same some seconds after the pushers went back to their holes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub anchor_offset_returned: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub anchor_offset_returned_max: Option<f64>,
    /// Mean compression of the fluid over its rest density, at its largest and in the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compression_max: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compression_end: Option<f64>,
    /// Particles that are outside the tank.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lost: Option<usize>,
    /// Kinetic energy per particle of mass 1 in the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinetic_energy_end: Option<f64>,
    /// All that is measured of a crowd.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crowd: Option<CrowdQuality>,
}

/// Takes the larger; a number that is none counts as infinite.
fn raise(largest: &mut Option<f64>, value: f64) {
    let value = if value.is_nan() { f64::INFINITY } else { value };
    *largest = Some(largest.map_or(value, |old| old.max(value)));
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

impl Quality {
    /// Takes a look at the field while it is stirred.
    pub(crate) fn look_at_field(&mut self, field: &PlateletField, positions: &[Vec2]) {
        let rings = rings(field, positions);
        let errors = link_errors(&rings);
        self.ring_error_mean = Some(mean(&errors));
        raise(&mut self.ring_error_max, errors.iter().copied().fold(0.0, f64::max));
        let pushers = &positions[field.centres.len() * DISCS..];
        let (depth, intruders) = overlaps(&rings, pushers);
        raise(&mut self.penetration_max, depth);
        self.intruders_max = Some(self.intruders_max.unwrap_or(0).max(intruders));
        self.anchor_offset_stirred = Some(mean(&anchor_offsets(field, positions)));
    }

    /// Measures the field after a rest.
    pub(crate) fn look_at_rest(&mut self, field: &PlateletField, positions: &[Vec2]) {
        let offsets = anchor_offsets(field, positions);
        self.anchor_offset_returned = Some(mean(&offsets));
        self.anchor_offset_returned_max = Some(offsets.iter().copied().fold(0.0, f64::max));
    }

    /// Takes a look at the fluid; `before` are the positions of one step ago.
    pub(crate) fn look_at_fluid(&mut self, block: &FluidBlock, before: &[Vec2], positions: &[Vec2]) {
        let compression = compression(positions);
        raise(&mut self.compression_max, compression);
        self.compression_end = Some(compression);
        let inside = |p: &&Vec2| {
            p.cmpge(Vec2::splat(-FluidBlock::SPACING)).all() && p.cmple(block.tank + FluidBlock::SPACING).all()
        };
        self.lost = Some(block.points.len() - positions.iter().filter(inside).count());
        let energy = |(a, b): (&Vec2, &Vec2)| 0.5 * f64::from(((*b - *a) / DT).length_squared());
        let energies: Vec<f64> = before.iter().zip(positions).map(energy).collect();
        self.kinetic_energy_end = Some(mean(&energies));
    }
}

/// The satellites of each platelet.
fn rings<'a>(field: &PlateletField, positions: &'a [Vec2]) -> Vec<&'a [Vec2]> {
    (0..field.centres.len()).map(|k| &positions[k * DISCS + 2..(k + 1) * DISCS]).collect()
}

fn link_errors(rings: &[&[Vec2]]) -> Vec<f64> {
    let rest = f64::from(2.0 * Platelet::satellite_radius());
    let errors = rings.iter().flat_map(|ring| {
        (0..SATELLITES).map(|k| (f64::from(ring[k].distance(ring[(k + 1) % SATELLITES])) / rest - 1.0).abs())
    });
    errors.collect()
}

/// Distances of nuclei from where they started, in outer radii.
fn anchor_offsets(field: &PlateletField, positions: &[Vec2]) -> Vec<f64> {
    let nuclei = positions.iter().step_by(DISCS);
    field.centres.iter().zip(nuclei).map(|(home, at)| f64::from(home.distance(*at) / OUTER_RADIUS)).collect()
}

/// Deepest overlap in satellite radii, and the number of satellites whose centres lie inside another ring.
fn overlaps(rings: &[&[Vec2]], pushers: &[Vec2]) -> (f64, usize) {
    let radius = Platelet::satellite_radius();
    let bounds: Vec<(Vec2, Vec2)> = rings
        .iter()
        .map(|ring| ring.iter().fold((ring[0], ring[0]), |(low, high), p| (low.min(*p), high.max(*p))))
        .map(|(low, high)| (low - radius, high + radius))
        .collect();
    let meet = |a: (Vec2, Vec2), b: (Vec2, Vec2)| a.0.cmple(b.1).all() && b.0.cmple(a.1).all();
    let (mut depth, mut intruders) = (0.0f32, 0);
    for (k, ring) in rings.iter().enumerate() {
        for pusher in pushers {
            let nearest = ring.iter().map(|p| p.distance(*pusher)).fold(f32::INFINITY, f32::min);
            depth = depth.max(radius + Pusher::RADIUS - nearest);
        }
        for j in (0..rings.len()).filter(|&j| j != k && meet(bounds[k], bounds[j])) {
            intruders += ring.iter().filter(|p| contains(rings[j], **p)).count();
            let nearest = |p: &Vec2| rings[j].iter().map(|q| p.distance(*q)).fold(f32::INFINITY, f32::min);
            depth = ring.iter().map(nearest).fold(depth, |depth, distance| depth.max(2.0 * radius - distance));
        }
    }
    (f64::from(depth / radius), intruders)
}

/// Whether a ring goes around a point (crossing number).
fn contains(ring: &[Vec2], point: Vec2) -> bool {
    let crosses = |a: Vec2, b: Vec2| {
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    (0..ring.len()).filter(|&k| crosses(ring[k], ring[(k + 1) % ring.len()])).count() % 2 == 1
}

/// Radius of the kernel `(1 - r / H)^3`.
const SUPPORT: f32 = 2.0 * FluidBlock::SPACING;

/// Mean of `max(0, density / rest density - 1)` over the particles; the rest density is that of the scene's lattice.
fn compression(points: &[Vec2]) -> f64 {
    let cell = |p: Vec2| ((p.x / SUPPORT).floor() as i64, (p.y / SUPPORT).floor() as i64);
    let mut sorted: Vec<((i64, i64), Vec2)> = points.iter().map(|&p| (cell(p), p)).collect();
    sorted.sort_unstable_by_key(|&(cell, _)| cell);
    let near = |(x, y): (i64, i64)| {
        (x - 1..=x + 1).flat_map({
            let sorted = &sorted;
            move |x| {
                let first = sorted.partition_point(|&(cell, _)| cell < (x, y - 1));
                sorted[first..].iter().take_while(move |&&(cell, _)| cell <= (x, y + 1))
            }
        })
    };
    let excess = |&(cell, p): &((i64, i64), Vec2)| {
        let density: f64 = near(cell).map(|&(_, q)| kernel(p.distance(q))).sum();
        (density / lattice_density() - 1.0).max(0.0)
    };
    mean(&sorted.iter().map(excess).collect::<Vec<_>>())
}

fn kernel(distance: f32) -> f64 {
    f64::from((1.0 - distance / SUPPORT).max(0.0)).powi(3)
}

/// Density at a point of the hexagonal lattice: itself, six neighbours at the spacing, six at its root-three-fold.
fn lattice_density() -> f64 {
    kernel(0.0) + 6.0 * kernel(FluidBlock::SPACING) + 6.0 * kernel(FluidBlock::SPACING * 3f32.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_start(field: &PlateletField) -> Vec<Vec2> {
        let platelet = |centre: &Vec2| {
            let centre = *centre;
            [centre; 2].into_iter().chain(Platelet::ring().map(move |offset| centre + offset)).collect::<Vec<_>>()
        };
        field.centres.iter().flat_map(platelet).chain(field.sweeps.iter().map(|sweep| sweep.start())).collect()
    }

    #[test]
    fn field_at_start_is_perfect_and_a_shifted_platelet_is_seen() {
        let field = PlateletField::new(90);
        let mut positions = at_start(&field);
        let mut quality = Quality::default();
        quality.look_at_field(&field, &positions);
        assert!(quality.ring_error_max.unwrap() < 1e-4 && quality.penetration_max.unwrap() == 0.0);
        assert!(quality.anchor_offset_stirred.unwrap() < 1e-6 && quality.intruders_max == Some(0));
        for p in &mut positions[..DISCS] {
            p.x += 1.0;
        }
        quality.look_at_field(&field, &positions);
        quality.look_at_rest(&field, &positions);
        assert!(quality.penetration_max.unwrap() > 0.5 && quality.intruders_max.unwrap() > 0);
        assert!((quality.anchor_offset_returned_max.unwrap() - f64::from(1.0 / OUTER_RADIUS)).abs() < 1e-3);
        positions[2].x += 0.1;
        quality.look_at_field(&field, &positions);
        assert!(quality.ring_error_max.unwrap() > 0.01);
    }

    #[test]
    fn lattice_is_not_compressed_and_a_squeezed_one_is() {
        let block = FluidBlock::new(2500);
        let mut quality = Quality::default();
        quality.look_at_fluid(&block, &block.points, &block.points);
        assert!(quality.compression_max.unwrap() < 1e-4 && quality.lost == Some(0));
        assert_eq!(quality.kinetic_energy_end, Some(0.0));
        let squeezed: Vec<Vec2> = block.points.iter().map(|p| *p * Vec2::new(1.0, 0.8)).collect();
        quality.look_at_fluid(&block, &block.points, &squeezed);
        assert!((0.15..0.3).contains(&quality.compression_end.unwrap()), "{quality:?}");
        let fallen: Vec<Vec2> = block.points.iter().map(|p| *p - Vec2::Y * 3.0).collect();
        quality.look_at_fluid(&block, &block.points, &fallen);
        assert_eq!(quality.lost, Some(100), "the two lowest rows");
    }
}
