//! What makes the inside of one body differ from that of another of its kind: matter, and where inclusions gather. All of it hangs
//! on the body's seed.

use crate::look::{Inclusion, RoundLook};
use crate::microscope::maths::{larger, smaller};
use crate::microscope::matter::Matter;
use crate::microscope::noise::HashRng;
use glam::Vec2;

/// Regions of a body in which inclusions gather, the share of inclusions that do, and that of regions that are out of focus.
pub(super) const REGIONS: usize = 3;
const GATHERED: f32 = 0.65;
const OUT_OF_FOCUS: f32 = 0.3;

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

/// What red cells of a slide have in common: how it was smeared and dried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Smear {
    /// Share of the cells with drops and bubbles from drying; their size, and how deep they are.
    pub pitted: f32,
    pub drop_size: f32,
    pub drop_depth: f32,
    /// How pale their middles are, 0 to 1.
    pub pale: f32,
    /// By how much waves around the outline decay less, the higher they are: crenated cells.
    pub crenated: f32,
}

impl Smear {
    pub(super) fn of(slide: u32) -> Self {
        let mut rng = HashRng::new(slide ^ 0x5ea7);
        let (pitted, crenated) = (rng.unit(), rng.unit());
        Self {
            // Of some slides hardly any cell.
            pitted: if pitted < 0.4 { 0.06 * pitted } else { 0.9 * (pitted - 0.3) },
            drop_size: libm::expf(0.2 * rng.normal()),
            drop_depth: rng.range([0.5, 1.3]),
            pale: 0.3 + 0.7 * rng.unit(),
            crenated: 1.3 * crenated * crenated * crenated,
        }
    }
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
