//! What makes one body differ from another of its kind: outline, matter, where inclusions gather, the hollow of a red cell.
//! All of it hangs on the body's seed. Shares and spreads are those of red cells in stained smears.

use super::polar_outline::PolarOutline;
use super::pose::Pose;
use crate::geometry::{rotate, unit_vector};
use crate::look::{Inclusion, OutlineLook, RoundLook};
use crate::microscope::maths::{bell, larger, smaller};
use crate::microscope::matter::Matter;
use crate::microscope::noise::HashRng;
use glam::{Mat2, Vec2};
use std::f32::consts::TAU;

/// Highest order of the waves around an outline.
const ORDERS: usize = 12;
/// Most tails, bites and spikes of a body together.
const MOST_BUMPS: usize = 12;
/// Shares of red cells without a hollow, with a hollow that is a slit, and with a knob in it (targets).
const FLAT: f32 = 0.13;
const SLIT: f32 = 0.05;
const TARGET: f32 = 0.05;
/// Inverse square of the radius of that knob, in radii of the hollow.
pub(super) const KNOB: f32 = 6.0;

/// Regions of a body in which inclusions gather, the share of inclusions that do, and that of regions that are out of focus.
pub(super) const REGIONS: usize = 3;
const GATHERED: f32 = 0.65;
const OUT_OF_FOCUS: f32 = 0.3;

/// A bump of an outline: direction, height in radii, width in radians.
type Bump = (Vec2, f32, f32);

/// Gives an outline its own size, waves, tail, bites and spikes, which turn with the body.
pub(super) fn reshape(polar: &mut PolarOutline, facing: Vec2, look: &OutlineLook, rng: &mut HashRng) {
    if look.waves[0] <= 0.0 {
        return;
    }
    let size = libm::expf(look.size * rng.normal());
    let is_oval = rng.unit() < look.ovals;
    let mut wave = |k: usize| {
        let order = (k + 2) as f32;
        let decay = if k == 0 { look.waves[0] } else { look.waves[1] * libm::powf(3.0 / order, look.decay) };
        let oval = if k == 0 && is_oval { rng.range([0.10, 0.20]) } else { 0.0 };
        unit_vector(TAU * rng.unit()) * larger(oval, decay * libm::expf(look.spread * rng.normal()))
    };
    let waves: [Vec2; ORDERS - 1] = std::array::from_fn(&mut wave);
    let bumps = bumps(look, rng);
    let back = Vec2::new(facing.x, -facing.y);
    polar.reshape(|direction| {
        let own = rotate(direction, back);
        let mut turned = own;
        let mut factor = 1.0;
        for wave in waves {
            turned = rotate(turned, own);
            factor += wave.dot(turned);
        }
        for &(at, height, width) in &bumps {
            factor += height * bell((own - at).length() / width);
        }
        size * larger(factor, 0.3)
    });
}

fn bumps(look: &OutlineLook, rng: &mut HashRng) -> Vec<Bump> {
    let mut bumps = Vec::new();
    if rng.unit() < look.tails {
        bumps.push((rng.direction(), rng.range([0.35, 0.85]), rng.range([0.18, 0.34])));
    }
    if rng.unit() < look.bites {
        let width = rng.range([0.12, 0.30]);
        bumps.push((rng.direction(), -0.6 * width, width));
    }
    let [fewest, most] = look.spikes;
    let count = (fewest + rng.bits() % (most - fewest + 1)) as usize;
    bumps.extend(
        (0..count.min(MOST_BUMPS)).map(|_| (rng.direction(), rng.range([0.05, 0.22]), rng.range([0.10, 0.25]))),
    );
    bumps
}

/// The hollow of a red cell. In the living cell it is part of the biconcave disc; when the cell dries on the glass, its
/// edge spreads and its middle sinks in, each in its own way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hollow {
    /// From the body's frame, in radii, to that of the hollow, in which it has the radius 1; where the centre goes.
    to_hollow: Mat2,
    pub centre: Vec2,
    /// Square of its radius, in the body's.
    pub area: f32,
    /// How a dried cell looks: how sharp and how steep its edge is, how deep and how flat its hollow, 0 to 1; the depth is
    /// negative where there is a knob in it.
    pub dried: [f32; 4],
}

impl Hollow {
    /// None.
    pub(super) const NONE: Self = Self { to_hollow: Mat2::IDENTITY, centre: Vec2::ZERO, area: 1.0, dried: [0.0; 4] };

    pub(super) fn of(pose: Pose, rng: &mut HashRng) -> Self {
        let kind = rng.unit();
        let (is_flat, is_slit) = (kind < FLAT, kind > 1.0 - SLIT);
        let is_target = (FLAT..FLAT + TARGET).contains(&kind);
        let radius = if is_slit { rng.range([0.24, 0.34]) } else { rng.range([0.38, 0.76]) };
        let stretch = if is_slit { rng.range([1.35, 1.75]) } else { libm::expf(0.13 * rng.normal().abs()) };
        let direction = rng.direction();
        let turn = Mat2::from_cols(Vec2::new(direction.x, -direction.y), Vec2::new(direction.y, direction.x));
        let to_hollow = Mat2::from_diagonal(Vec2::new(1.0 / stretch, stretch) / radius) * turn;
        let at = rng.direction() * (0.13 * rng.normal()) + pose.hollow();
        let to_hollow = to_hollow * pose.to_face();
        let share = rng.unit();
        let depth = if is_flat {
            0.25 * share
        } else if is_slit {
            0.7 + 0.3 * share
        } else if is_target {
            -0.6 - 0.4 * share
        } else {
            1.0 - (1.0 - share) * (1.0 - share) * (1.0 - share)
        };
        let dried = [rng.unit(), 0.8 * rng.unit(), depth * (1.0 - pose.steepness()), rng.range([0.4, 1.0])];
        Self { to_hollow, centre: to_hollow * at, area: radius * radius, dried }
    }

    /// A direction of the body's frame, in radii, in the hollow's.
    pub(super) fn turned(&self, own: Vec2) -> Vec2 {
        self.to_hollow * own
    }

    /// Thickness of the dried cell at a distance from its centre, in radii, and from that of the hollow; 1 without one.
    pub(super) fn dried(&self, rho: f32, from_hollow: Vec2) -> f32 {
        let [sharp, steep, depth, flat] = self.dried;
        let square = rho * rho;
        if square >= 1.0 {
            return 0.0;
        }
        let fourth = square * square;
        let inside = 1.0 - (fourth + sharp * (fourth * fourth - fourth));
        let edge = inside.sqrt();
        let apart = from_hollow.length_squared();
        let knob = if depth < 0.0 { libm::expf(-KNOB * apart) } else { 0.0 };
        let depth = depth.abs();
        let sunk = depth * (libm::expf(-(apart + flat * (apart * apart - apart))) - knob);
        let from_rim = (rho - 0.80) / 0.24;
        let bulge = larger(1.0 - from_rim * from_rim, 0.0);
        (edge + steep * (inside - edge)) * (1.0 - sunk) * (1.0 + 0.22 * depth * bulge * bulge)
    }
}

/// Matter of an individual where it is thickest: red cells differ more in haemoglobin than in thickness, and young ones
/// take up some of the basic dye.
pub(super) fn matter(look: &RoundLook, rng: &mut HashRng) -> Matter {
    let mut matter = look.matter * libm::expf(look.variation * rng.normal().clamp(-2.0, 2.0));
    if matter.haemoglobin > 0.0 {
        matter.haemoglobin *= libm::expf(0.9 * look.variation * rng.normal());
        matter.cytoplasm += 0.07 * larger(rng.normal(), 0.0);
    }
    matter
}

/// A part of a body where inclusions gather, alike in size and density.
pub(super) struct Region {
    /// In the frame in which the body is a disc of radius 1.
    pub at: Vec2,
    pub spread: f32,
    pub size: f32,
    pub dense: f32,
    /// Chirp of the rings around what lies out of focus there; 0 in focus.
    pub chirp: f32,
}

impl Region {
    pub(super) fn of(inclusion: &Inclusion, rng: &mut HashRng) -> Self {
        let at = rng.direction() * (inclusion.place[1] * rng.unit().sqrt());
        // One or two things are what they are said to be.
        let many = if inclusion.count[1] > 3 { 1.0 } else { 0.0 };
        let mut own = |spread: f32| libm::expf(many * spread * rng.normal());
        let (spread, size, dense) = (0.3 * many * own(0.4), own(0.25), smaller(own(0.25), 1.0));
        let chirp = if rng.unit() < OUT_OF_FOCUS * many { rng.range([2.0, 5.0]) } else { 0.0 };
        Self { at, spread, size, dense, chirp }
    }

    /// A place within bounds: most are near the middle of some region.
    pub(super) fn place(regions: &[Self], [nearest, farthest]: [f32; 2], rng: &mut HashRng) -> Vec2 {
        let region = &regions[rng.bits() as usize % regions.len()];
        let near = region.at + rng.direction() * (region.spread * rng.normal());
        let anywhere = rng.direction() * rng.range([nearest * nearest, farthest * farthest]).sqrt();
        let is_near = rng.unit() < GATHERED && (nearest..farthest).contains(&near.length());
        if is_near { near } else { anywhere }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dried_cells_end_at_their_rim_and_differ_in_their_middle() {
        let flat = |rng: &mut HashRng| Hollow::of(Pose::of(None, rng), rng);
        let hollows: Vec<Hollow> = (0..200).map(|seed| flat(&mut HashRng::new(seed))).collect();

        let middle = |hollow: &Hollow| hollow.dried(0.0, Vec2::ZERO);
        assert!(hollows.iter().all(|hollow| hollow.dried(1.0, Vec2::ONE) == 0.0));
        assert!(hollows.iter().all(|hollow| (0.0..=1.0).contains(&middle(hollow))));
        let pale = hollows.iter().filter(|hollow| middle(hollow) < 0.3).count();
        let full = hollows.iter().filter(|hollow| middle(hollow) > 0.75).count();
        assert!((40..160).contains(&pale) && (20..100).contains(&full), "{pale} {full}");
    }

    #[test]
    fn outlines_of_individuals_differ_and_keep_a_radius() {
        let look = OutlineLook { size: 0.1, spikes: [2, 6], tails: 0.5, bites: 0.5, ..OutlineLook::uneven(0.1) };
        let radii = |seed| {
            let mut polar = PolarOutline::disc(Vec2::ZERO, 1.0).unwrap();
            reshape(&mut polar, Vec2::X, &look, &mut HashRng::new(seed));
            (0..32).map(|k| polar.radius(unit_vector(TAU * k as f32 / 32.0))).collect::<Vec<_>>()
        };
        assert!((0..50).all(|seed| radii(seed).iter().all(|radius| (0.2..4.0).contains(radius))));
        assert!((0..50).all(|seed| radii(seed) == radii(seed) && radii(seed) != radii(seed + 1)));
    }
}
