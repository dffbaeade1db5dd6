//! The nucleus of a crawling cell: lobes that run into each other, and chromatin.

use super::super::distance_field::united;
use super::{AmoeboidBody, SALTS, middle_of, rise};
use crate::geometry::{rotate, unit_vector};
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{bell, larger, mix, smaller, smoothstep};
use crate::microscope::matter::Matter;
use crate::microscope::noise::{HashRng, octaves};
use glam::{Mat2, Vec2};
use std::f32::consts::TAU;

/// Width over which lobes of a nucleus run into each other, in the cell's mean radii.
const NECK: f32 = 0.10;
/// Size of the bends of a nucleus, in the cell's mean radii.
const BENDS: f32 = 0.6;
/// From and to which chromatin is dense, of noise without its sign: where that is nothing pale channels run between clumps.
const CHROMATIN: [f32; 2] = [-0.45, 1.0];
/// Strength of patches of denser chromatin in that, of noise whose lattice is turned and wider.
const PATCHES: f32 = 0.55;
const OTHER_LATTICE: Vec2 = Vec2::new(0.27, 0.36);
/// How much denser chromatin is at the rim of the nucleus, and the width of that band, micrometres.
const CONDENSED: f32 = 0.55;
const CONDENSED_WIDTH: f32 = 0.45;
/// Pale gaps between its finest threads: their lattice, how strong they are, and the noise from and to which they open.
const FINE_LATTICE: Vec2 = Vec2::new(2.1, 1.4);
const GAPS: f32 = 0.5;
const OPEN: [f32; 2] = [0.25, 0.85];
/// Strength of clumps of chromatin relative to the texture of a nucleus.
const CLUMPS: f32 = 1.8;
/// Share of that by which they delay light: it is for the dye that they differ most.
const CLUMPS_DELAY: f32 = 0.4;
/// How much denser its envelope is.
const ENVELOPE: f32 = 0.14;
/// How uneven the edge of a nucleus is, in the cell's mean radii, and half the width over which it fades, micrometres.
const NUCLEUS_UNEVEN: f32 = 0.010;
const NUCLEUS_EDGE: f32 = 0.20;
/// Thickness of a nucleus at its edge, as a share, and the width of its rim, micrometres.
const NUCLEUS_THIN: f32 = 0.72;
const NUCLEUS_RIM: f32 = 3.2;

/// Numbers for the program of the cell.
pub(in crate::microscope) const GLSL: Glsl = Glsl {
    source: "",
    constants: &[
        ("NECK", &[NECK]),
        ("BENDS", &[BENDS]),
        ("CHROMATIN", &CHROMATIN),
        ("PATCHES", &[PATCHES]),
        ("OTHER_LATTICE", &[OTHER_LATTICE.x, OTHER_LATTICE.y]),
        ("CONDENSED", &[CONDENSED]),
        ("CONDENSED_WIDTH", &[CONDENSED_WIDTH]),
        ("FINE_LATTICE", &[FINE_LATTICE.x, FINE_LATTICE.y]),
        ("GAPS", &[GAPS]),
        ("OPEN", &OPEN),
        ("CLUMPS", &[CLUMPS]),
        ("CLUMPS_DELAY", &[CLUMPS_DELAY]),
        ("ENVELOPE", &[ENVELOPE]),
        ("NUCLEUS_UNEVEN", &[NUCLEUS_UNEVEN]),
        ("NUCLEUS_EDGE", &[NUCLEUS_EDGE]),
        ("NUCLEUS_THIN", &[NUCLEUS_THIN]),
        ("NUCLEUS_RIM", &[NUCLEUS_RIM]),
    ],
};

impl AmoeboidBody {
    /// Lobes of one nucleus.
    pub(super) fn lobe_count(&self) -> u32 {
        let [fewest, most] = self.look.nucleus.lobes;
        fewest + HashRng::new(self.nucleus_seed() ^ 0x1ab).bits() % (most - fewest + 1)
    }

    /// Whether its nucleus may part. Then nothing of its shape hangs on the cell's own seed or turn: daughters have others.
    fn parts(&self) -> bool {
        self.look.nucleus.lobes[0] == 1
    }

    /// Seed of the shape of its nucleus.
    pub(super) fn nucleus_seed(&self) -> u32 {
        if self.parts() { self.slide } else { self.seed }
    }

    /// Lobes of the nucleus of a cell of this radius: a chain around its middle, inside whatever shape the cell has.
    pub(super) fn lobes(&self, middle: Vec2, radius: f32, shape: Mat2) -> Vec<(Vec2, f32)> {
        let nucleus = &self.look.nucleus;
        let mut rng = HashRng::new(self.nucleus_seed() ^ 0x1ace);
        let shape = if self.parts() { Mat2::from_diagonal(Vec2::splat(radius)) } else { shape };
        let count = self.lobe_count();
        let first = rng.unit() * TAU;
        // A chain that does not close; the more lobes, the smaller they are.
        let step = smaller(1.35, 4.2 / count as f32);
        let size = radius * (3.0 / count as f32).sqrt().clamp(0.7, 1.0);
        let lobe = |k: u32| {
            let lobe = rng.range(nucleus.radius) * size;
            let angle = first + k as f32 * step + rng.range([-0.15, 0.15]);
            let place = middle + shape * (unit_vector(angle) * (nucleus.spread * rng.range([0.85, 1.15])));
            (self.field.pushed_inside(place, lobe + 0.04 * radius), lobe)
        };
        (0..count).map(lobe).collect()
    }

    /// Doubles the nucleus of a cell that divides: its lobes part as the furrow closes, and end where those of the
    /// daughters, which are as the two halves, will be.
    pub(super) fn part_nucleus(&mut self, outline: &[Vec2]) {
        let Some((i, j)) = narrowest(outline) else { return };
        let waist = 0.5 * (outline[i] - outline[j]).length();
        let parted = smoothstep(0.6 * self.radius, 0.2 * self.radius, waist);
        let halves = [outline[i..=j].to_vec(), [&outline[j..], &outline[..=i]].concat()];
        let halves = halves.iter().filter_map(|half| {
            let (centre, radius) = middle_of(half)?;
            Some(self.lobes(centre, radius, Mat2::from_diagonal(Vec2::splat(radius))))
        });
        // Two lobes in the same place run into each other, too.
        let swelling = 0.25 * NECK * self.radius;
        let part = |(half, whole): (&(Vec2, f32), &(Vec2, f32))| {
            (whole.0.lerp(half.0, parted), mix(whole.1 - swelling, half.1, parted))
        };
        self.lobes = halves.flat_map(|half| half.iter().zip(&self.lobes).map(part).collect::<Vec<_>>()).collect();
    }

    /// Its matter at a place.
    pub(super) fn nucleus_matter(&self, place: Vec2, softness: f32) -> Matter {
        let [nucleus, rim] = self.nucleus_and_rim(place, softness);
        if nucleus <= 0.0 {
            return Matter::NONE;
        }
        let look = &self.look.nucleus;
        let at = self.turned(place) / look.texture.size;
        let patches = PATCHES * octaves(rotate(at, OTHER_LATTICE), 2, self.seed ^ SALTS[4]);
        let noise = octaves(at, 2, self.seed ^ SALTS[2]).abs() + patches + CONDENSED * rim;
        let gaps = GAPS * smoothstep(OPEN[0], OPEN[1], octaves(rotate(at, FINE_LATTICE), 1, self.seed ^ SALTS[0]));
        let dense = 1.60 * smoothstep(CHROMATIN[0], CHROMATIN[1], noise) - gaps;
        let clumps = CLUMPS * look.texture.amount * (dense - 0.95);
        let matter = look.matter * nucleus;
        Matter { phase: matter.phase * (1.0 + CLUMPS_DELAY * clumps), ..matter * (1.0 + clumps) }
    }

    /// How much a place belongs to the nucleus, 0 to 1: the union of the lobes, with necks between neighbours.
    pub(super) fn nucleus(&self, place: Vec2, softness: f32) -> f32 {
        self.nucleus_and_rim(place, softness)[0]
    }

    /// The same, and how much it belongs to its rim.
    fn nucleus_and_rim(&self, place: Vec2, softness: f32) -> [f32; 2] {
        let from_centre = self.turned(place);
        let bent = self.look.nucleus.bent;
        if self.lobes.iter().all(|&(at, radius)| (place - at).length() > radius + (bent + NECK) * self.radius + 0.6) {
            return [0.0; 2];
        }
        let bend = |salt: u32| octaves(from_centre / (BENDS * self.radius), 1, self.seed ^ salt);
        let bend = Vec2::new(bend(SALTS[4]), bend(SALTS[3])) * (bent * self.radius);
        let there = place + rotate(bend, self.turn());
        let inside = |&(at, radius): &(Vec2, f32)| radius - (there - at).length();
        let depth = self.lobes.iter().map(inside).reduce(|a, b| united(a, b, NECK * self.radius));
        let Some(depth) = depth.filter(|&depth| depth > -2.0 * softness - 0.3) else { return [0.0; 2] };
        let uneven = octaves(from_centre / (0.2 * self.radius), 3, self.seed ^ SALTS[4]);
        let edge = larger(softness, NUCLEUS_EDGE);
        let depth = depth + NUCLEUS_UNEVEN * self.radius * uneven;
        let envelope = ENVELOPE * larger(1.0 + uneven, 0.0);
        let thickness = mix(NUCLEUS_THIN, 1.0, rise(depth / NUCLEUS_RIM));
        let rim = bell((depth - 0.3) / CONDENSED_WIDTH) * (1.0 + uneven);
        [smoothstep(-edge, edge, depth) * (thickness + envelope * bell((depth - 0.2) / 0.25)), rim]
    }
}

/// Where an outline is narrowest: two points of it, at least a quarter of it apart.
fn narrowest(outline: &[Vec2]) -> Option<(usize, usize)> {
    let count = outline.len();
    let pairs = (0..count).flat_map(|i| (i + count / 4..count.min(i + 3 * count / 4)).map(move |j| (i, j)));
    let apart = |(i, j): (usize, usize)| (outline[i] - outline[j]).length_squared();
    pairs.min_by(|&a, &b| apart(a).total_cmp(&apart(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::ImageLook;
    use crate::{AmoeboidCellSpec, Placement, World, WorldConfig};

    /// A neutrophil of some seed.
    fn neutrophil(seed: u32) -> AmoeboidBody {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 40.0)).unwrap();
        let cell = world.view().organism(id).unwrap();
        let ImageLook::Amoeboid(look_of) = crate::organism::look(cell.kind()).image else { panic!("it crawls") };
        AmoeboidBody::of(cell, look_of(0.1), [1, seed], 0.0).unwrap()
    }

    #[test]
    fn chromatin_is_condensed_at_the_rim() {
        let (mut rim, mut middle) = ([0.0, 0.0], [0.0, 0.0]);
        for seed in 0..6 {
            let body = neutrophil(seed);
            for k in 0..200 * 200 {
                let place = body.centre + 0.12 * (Vec2::new((k % 200) as f32, (k / 200) as f32) - 100.0);
                let [share, at_rim] = body.nucleus_and_rim(place, 0.05);
                let dense = body.nucleus_matter(place, 0.05).nucleus / share;
                let sum = if at_rim > 0.6 { &mut rim } else { &mut middle };
                if share > 0.5 && !(0.02..=0.6).contains(&at_rim) {
                    *sum = [sum[0] + dense, sum[1] + 1.0];
                }
            }
        }
        let [rim, middle] = [rim, middle].map(|[sum, count]| sum / count);
        assert!(rim > 1.1 * middle, "{rim} {middle}");
    }

    #[test]
    fn filaments_join_neighbouring_lobes() {
        for seed in 0..6 {
            let body = neutrophil(seed);
            let filaments = body.filaments();
            let parts = filaments.len() / (body.lobes.len() - 1);
            for (pair, filament) in body.lobes.windows(2).zip(filaments.chunks(parts)) {
                assert_eq!(filament[0].from, pair[0].0);
                assert!((filament[parts - 1].to - pair[1].0).length() < 0.5 * pair[1].1, "{seed}");
            }
        }
    }
}
