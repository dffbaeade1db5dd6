//! Granules of a crawling cell, which its cytoplasm carries.

use super::super::spot::Spot;
use super::{AmoeboidBody, SALTS};
use crate::geometry::rotate;
use crate::look::{GranuleLook, SpotShape};
use crate::microscope::maths::{bell, larger, mix, smaller, smoothstep};
use crate::microscope::matter::Matter;
use crate::microscope::noise::{HashRng, octaves, wobble};
use crate::template::Role;
use crate::world::view::{OrganismView, ParticleView};
use glam::Vec2;

/// Brownian motion of a granule of 0.2 micrometres: how far it gets, micrometres, and how often it turns back, 1/s.
const JIGGLE: f32 = 0.09;
const JIGGLE_RATE: f32 = 3.0;
/// How far around the nucleus granules gather, and the size of the patches in which they do elsewhere, in the cell's mean
/// radii.
const AROUND: f32 = 0.32;
const PATCHES: f32 = 0.40;
/// A nucleolus: dense, of RNA and protein; and the chromatin that it takes the place of.
const NUCLEOLUS: Matter = Matter { phase: 0.24, haemoglobin: 0.0, cytoplasm: 0.3, nucleus: 0.0 };
const DISPLACED: Matter = Matter { phase: -0.02, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: -0.22 };
/// Condensed chromatin around it.
const AROUND_NUCLEOLUS: Matter = Matter { phase: 0.02, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.14 };
/// Fewest lumps that a nucleolus is made of, how many more there may be, and how far the outer ones lie along it, in its radii.
const LUMPS: [u32; 2] = [2, 3];
const LUMPS_APART: f32 = 0.9;
/// Share of the regions of granules that are out of focus.
const OUT_OF_FOCUS: f32 = 0.3;
/// Particles of cytoplasm in a row that carry granules of a kind: they lie side by side when a cell is made.
const REGION: u32 = 16;

impl AmoeboidBody {
    /// Granules, each on the particle of cytoplasm that carries it.
    pub(in super::super) fn spots(&self, organism: OrganismView<'_>) -> Vec<Spot> {
        let carriers = organism.particles().filter(|particle| particle.role == Role::Cytoplasm);
        let mut spots = Vec::new();
        carriers.for_each(|carrier| self.granules_on(&carrier, &mut spots));
        self.nucleoli(&mut spots);
        spots
    }

    fn granules_on(&self, carrier: &ParticleView, spots: &mut Vec<Spot>) {
        // Not of the cell: in a division a particle becomes another cell's.
        let mut rng = HashRng::new(carrier.index);
        let spacing = 2.0 * carrier.radius;
        let mut region = HashRng::new(carrier.index / REGION);
        let mut slides = HashRng::new(self.slide ^ 0x57ed);
        for look in self.look.granules {
            // Particles of a fluid at rest lie on a hexagonal lattice.
            let mut own = |spread: f32| libm::expf(spread * region.normal());
            let mut slide = |spread: f32| libm::expf(spread * slides.normal());
            let (many, size) = (0.55 * own(1.1) * slide(0.6), own(0.3) * slide(0.2));
            let focus = if region.unit() < OUT_OF_FOCUS { region.range([2.0, 5.0]) } else { 0.0 };
            let expected = look.density * 0.866 * spacing * spacing * many;
            let count = (expected + rng.unit()) as u32;
            for _ in 0..count.min(16) {
                let granule = self.granule(look, (carrier.position, spacing), (size, focus), &mut rng);
                spots.extend(granule);
                spots.extend(granule.into_iter().flat_map(|granule| companions(granule, look.companions)));
            }
        }
    }

    /// How much granules gather at a place, 0 to 1: around the nucleus, and in patches elsewhere.
    pub(super) fn crowd(&self, place: Vec2) -> f32 {
        let apart = |&(lobe, radius): &(Vec2, f32)| (place - lobe).length() - radius;
        let nearest = self.lobes.iter().map(apart).fold(f32::INFINITY, smaller);
        let around = bell(larger(nearest, 0.0) / (AROUND * self.radius));
        let own = self.from_shape * (place - self.centre);
        let patch = smoothstep(-0.2, 0.7, octaves(own / (PATCHES * self.radius), 2, self.seed ^ SALTS[2]));
        mix(0.5 * patch, 1.0, around)
    }

    /// Nucleoli, in their places in the nucleus. Of a cell that divides the lobes lie over each other at first.
    fn nucleoli(&self, spots: &mut Vec<Spot>) {
        let [fewest, most] = self.look.nucleus.nucleoli;
        for (k, &(lobe, size)) in self.lobes.iter().enumerate() {
            // Alike in both halves of a nucleus that parts.
            let number = k as u32 % self.lobe_count();
            let mut rng = HashRng::new(self.nucleus_seed() ^ 0x0c1e ^ number);
            let near = |&(other, _): &(Vec2, f32)| bell((other - lobe).length() / (0.5 * size));
            let share = 1.0 / self.lobes.iter().map(near).sum::<f32>();
            for _ in 0..(fewest + rng.bits() % (most - fewest + 1)) >> number {
                let at = lobe + rotate(rng.direction() * (0.55 * size * rng.unit()), self.turn());
                let radius = size * 0.20 * libm::expf(0.4 * rng.normal());
                spots.extend(nucleolus(&mut rng).map(|part| Spot {
                    at: at + rotate(part.at * radius, self.turn()),
                    radius: part.radius * radius,
                    matter: part.matter * share,
                    ..part
                }));
            }
        }
    }

    /// A granule of a region where they are larger by a factor, and out of focus by some chirp.
    fn granule(
        &self,
        look: &GranuleLook,
        (carrier, spacing): (Vec2, f32),
        (size, focus): (f32, f32),
        rng: &mut HashRng,
    ) -> Option<Spot> {
        let offset = Vec2::new(rng.range([-0.5, 0.5]), rng.range([-0.5, 0.5])) * spacing;
        let radius = look.radius * size * libm::expf(look.spread * rng.normal());
        let radius = radius.clamp(look.limits[0], look.limits[1]);
        // Few are dense, and most have no edge.
        let share = rng.unit();
        let dense = 0.2 + 1.2 * share * share;
        let shape = if rng.unit() < 0.7 { SpotShape::Bump } else { look.shape };
        let threshold = rng.unit();
        let seed = rng.bits();
        let now = self.time * JIGGLE_RATE;
        let jitter = Vec2::new(wobble(now, seed), wobble(now, seed ^ 1)) * (JIGGLE * (0.2 / radius).sqrt());
        let at = self.field.pushed_inside(carrier + offset + jitter, radius + 0.1);
        let clear = self.look.ectoplasm * self.rim_share(self.from_shape * (at - self.centre));
        let room = smoothstep(0.0, 0.5, self.field.at(at) - 0.6 * radius - clear);
        let share = room * (1.0 - 0.93 * self.lamella(at)) * (1.0 - 0.8 * self.nucleus(at, 0.1));
        let share = share * smoothstep(threshold - 0.1, threshold + 0.1, 1.05 - look.gathered * (1.0 - self.crowd(at)));
        let matter = look.matter * (2.0 * radius * share * dense);
        let spot = Spot { at, radius, matter, shape };
        let shown = if focus > 0.0 && radius < 0.3 { spot.out_of_focus(focus) } else { spot };
        (share > 0.02).then_some(shown)
    }
}

/// A nucleolus of radius 1: lumps of different density along a way, in focus or not, and chromatin around the first.
fn nucleolus(rng: &mut HashRng) -> impl Iterator<Item = Spot> {
    let (way, dense, blur) = (rng.direction(), libm::expf(0.45 * rng.normal()), rng.range([0.9, 1.6]));
    let count = LUMPS[0] + rng.bits() % LUMPS[1];
    let lumps: Vec<Spot> = (0..count)
        .flat_map(|_| {
            let at = way * rng.range([-LUMPS_APART, LUMPS_APART]) + rng.direction() * 0.25;
            let share = dense * rng.range([0.25, 0.95]) / (blur * blur);
            let radius = blur * rng.range([0.4, 0.85]);
            [NUCLEOLUS, DISPLACED].map(|matter| Spot { at, radius, matter: matter * share, shape: SpotShape::Bump })
        })
        .collect();
    let ring = Spot { radius: 1.0, matter: AROUND_NUCLEOLUS, shape: SpotShape::Ring, ..lumps[0] };
    lumps.into_iter().chain([ring])
}

/// Smaller granules that lie over the edge of one, at most so many, by its size: what is grown together is no ball.
fn companions(granule: Spot, most: u32) -> impl Iterator<Item = Spot> {
    let Spot { at, radius, matter, shape } = granule;
    let mut rng = HashRng::new(radius.to_bits());
    let count = rng.bits() % (most + 1);
    (0..count).map(move |_| {
        let share = rng.range([0.4, 0.85]);
        Spot {
            at: at + rng.direction() * (radius * rng.range([0.6, 1.1])),
            radius: radius * share,
            matter: matter * share,
            shape,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Root of the ratio of the largest moment of a nucleolus to its smallest: 1 of a round one.
    fn shape_of(seed: u32) -> f32 {
        let lumps: Vec<Spot> = nucleolus(&mut HashRng::new(seed))
            .filter(|spot| spot.matter.phase > 0.0 && spot.shape == SpotShape::Bump)
            .collect();
        let weight = |spot: &Spot| spot.matter.phase * spot.radius * spot.radius;
        let sum = |of: &dyn Fn(&Spot) -> f32| lumps.iter().map(|spot| weight(spot) * of(spot)).sum::<f32>();
        let total = sum(&|_| 1.0);
        let middle = Vec2::new(sum(&|spot| spot.at.x), sum(&|spot| spot.at.y)) / total;
        let moment = |i: usize, j: usize| {
            let own = |spot: &Spot| if i == j { 0.2 * spot.radius * spot.radius } else { 0.0 };
            sum(&|spot| (spot.at - middle)[i] * (spot.at - middle)[j] + own(spot)) / total
        };
        let (mean, half) = (0.5 * (moment(0, 0) + moment(1, 1)), 0.5 * (moment(0, 0) - moment(1, 1)));
        let apart = (half * half + moment(0, 1) * moment(0, 1)).sqrt();
        ((mean + apart) / (mean - apart)).sqrt()
    }

    #[test]
    fn nucleoli_are_not_round() {
        let mut shapes: Vec<f32> = (0..200).map(shape_of).collect();
        shapes.sort_by(f32::total_cmp);
        assert!(shapes[100] > 1.25, "{}", shapes[100]);
    }
}
