//! Cells that crawl: a dome with a thin clear front, a nucleus in lobes, and granules that the cytoplasm carries.
//!
//! Nothing here is remembered from picture to picture. What must not jump hangs on what does not: granules on the
//! particles of the cytoplasm, the nucleus on the membrane's own order of nodes, the front on how the cell moves and is
//! shaped.

mod granules;
pub(in crate::microscope) mod nucleus;
mod threads;

use super::distance_field::DistanceField;
use super::front::Front;
use super::spline::smooth;
use super::spot::Spot;
use crate::bare_text::bare_text;
use crate::geometry::{centroid, direction_or, rotate, signed_area, unit_vector};
use crate::look::{AmoeboidLook, SpotShape};
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{bell, larger, mix, smaller, smoothstep};
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::noise::{HashRng, octaves, scramble, shift_of, wobble};
use crate::microscope::recipe::{DrawList, Program, QUAD, box_corners};
use crate::world::view::OrganismView;
use glam::{Mat2, Vec2};
use std::f32::consts::TAU;

/// Cell of the distance map, micrometres.
const STEP: f32 = 0.2;
/// Time that a bleb takes to come and go, s.
const BLEB_PERIOD: f32 = 4.0;
/// Speed at which ruffles run, features per second.
const RUFFLING: f32 = 0.25;

/// Farthest that anything of a cell reaches beyond its membrane, micrometres.
const MARGIN: f32 = 2.0;
/// Width over which a bleb and the body run into each other, micrometres.
const BLEB_NECK: f32 = 0.5;

/// Size of the irregularities of the front's edge, in the cell's mean radii, and strength of its pulse relative to them.
const RAGS: f32 = 0.46;
const PULSE: f32 = 2.0;
/// How ragged the edge is elsewhere, as a share.
const RAGS_BEHIND: f32 = 0.7;
/// The most by which it is ragged, in the cell's mean radii.
const MOST_RAGS: f32 = 0.05;
/// Where the edge is held it stands out in points, by the first of these, and between them it is drawn in, by up to the second.
const POINTS: [f32; 2] = [0.5, 1.9];
/// Thickness of a spread cell at its edge, as a share of that of its middle.
const FLAT: f32 = 0.42;
/// Mean radius of a cell that is as thick as its look says; smaller ones are thinner.
const THICK_FROM: f32 = 18.0;
/// Delay of the thinnest, radians.
const THINNEST: f32 = 0.85;
/// Size of the irregularities of its rims, in the cell's mean radii, and their strength as a share.
const RIM_SIZE: f32 = 0.45;
const RIM_UNEVEN: f32 = 0.85;
/// How much thinner its edge is where the rim is wide, and thicker where it is narrow.
const EDGE_UNEVEN: f32 = 0.6;
/// Spread of the thickness of the cells of a slide, and of how much of the dyes their cytoplasm takes up; the most basic dye.
const SLIDES: f32 = 0.22;
const BASOPHIL: f32 = 0.16;
/// How much more uneven what takes up dye is than what delays light.
const DYED: f32 = 0.2;
/// Most lobes of the nuclei of a cell: two of five while it divides.
pub(in crate::microscope) const LOBES: usize = 10;

pub(in crate::microscope) const GLSL: Glsl = Glsl {
    source: bare_text!("amoeboid.glsl", "//"),
    constants: &[
        ("RAGS", &[RAGS]),
        ("RAGS_BEHIND", &[RAGS_BEHIND]),
        ("POINTS", &POINTS),
        ("FLAT", &[FLAT]),
        ("RIM_SIZE", &[RIM_SIZE]),
        ("RIM_UNEVEN", &[RIM_UNEVEN]),
        ("EDGE_UNEVEN", &[EDGE_UNEVEN]),
        ("DYED", &[DYED]),
    ],
};

/// Seeds of its unevenness, from its own: texture, ruffles, clumps in the nucleus, border of the front, outline of the
/// nucleus.
const SALTS: [u32; 5] = [0, 7, 3, 11, 5];

/// One cell, ready to be drawn.
#[derive(Clone, Debug)]
pub(super) struct AmoeboidBody {
    look: &'static AmoeboidLook,
    field: DistanceField,
    centre: Vec2,
    /// Radius of the disc of equal area, micrometres.
    radius: f32,
    /// Where it is thickest.
    matter: Matter,
    /// From the membrane to a disc of the same radius: how the cell is turned and stretched, undone.
    from_shape: Mat2,
    front: Front,
    lobes: Vec<(Vec2, f32)>,
    seed: u32,
    /// Seed of what all cells of a slide have in common.
    slide: u32,
    time: f32,
}

impl AmoeboidBody {
    /// `None` if there is no area to draw.
    pub(super) fn of(
        organism: OrganismView<'_>,
        look: &'static AmoeboidLook,
        [slide, seed]: [u32; 2],
        time: f32,
    ) -> Option<Self> {
        let surface = organism.surface();
        let (centre, radius) = middle_of(&surface)?;
        let outline = smooth(&surface);
        let shape = stretch(&surface, centre, radius);
        let mut body = Self {
            look,
            field: DistanceField::of(&outline, STEP, MARGIN),
            centre,
            radius,
            matter: matter_of(look, radius, slide),
            from_shape: shape.inverse() * radius,
            front: Front::of(organism, &outline, centre, radius),
            lobes: Vec::new(),
            seed,
            slide,
            time,
        };
        let Front { direction, strength, ahead, behind, .. } = body.front;
        let middle = centre - direction * (look.nucleus.behind * (ahead + behind) * strength);
        body.lobes = body.lobes(middle, radius, shape);
        if organism.dividing_for().is_some() {
            body.part_nucleus(&outline);
        }
        Some(body)
    }

    /// Bulges of the membrane of a cell that holds prey: round ones that come and go at its sides and behind.
    pub(super) fn swell(&mut self, prey: impl Iterator<Item = (Vec2, u32)>) {
        let blebs: Vec<(Vec2, f32)> = prey.filter_map(|(at, seed)| self.bleb(at, seed)).collect();
        blebs.into_iter().for_each(|(at, radius)| self.field.unite(at, radius, BLEB_NECK));
    }

    pub(super) fn draw(&self, raster: &mut MatterRaster) {
        let (low, high) = self.field.bounds();
        let softness = larger(0.7 * raster.grid.pixel, 0.08);
        raster.add(low, high, |p| self.at(p, softness));
    }

    /// A box around it for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList) {
        let (low, high) = self.field.bounds();
        if draws.sees(0.5 * (low + high), (high - low).length()) {
            let corners = box_corners(low, high);
            draws.add_apart(Program::Amoeboid, &corners, QUAD.to_vec(), self.uniforms(), Some(self.field.texture()));
        }
    }

    fn uniforms(&self) -> Vec<f32> {
        let Self { look, front, from_shape: frame, .. } = self;
        let mut uniforms = vec![self.centre.x, self.centre.y, self.radius, self.rim()];
        uniforms.extend([frame.x_axis.x, frame.x_axis.y, frame.y_axis.x, frame.y_axis.y]);
        uniforms.extend([front.direction.x, front.direction.y, front.strength, front.ahead + front.behind]);
        let [from, to] = self.border();
        uniforms.extend([from, to, look.lamella.thickness * self.pulse(), self.time * RUFFLING % 256.0]);
        uniforms.extend([look.lamella.ruffle, look.lamella.ruffle_inset, look.texture.amount, look.texture.size]);
        uniforms.extend(self.matter.to_array());
        uniforms.extend(look.nucleus.matter.to_array());
        uniforms.extend([look.nucleus.texture.amount, look.nucleus.texture.size, look.nucleus.bent]);
        uniforms.extend([self.rags(), PULSE * (self.pulse() - 1.0)]);
        let nowhere = (Vec2::ZERO, -1000.0);
        let lobes = self.lobes.iter().copied().chain(std::iter::repeat(nowhere)).take(LOBES);
        uniforms.extend(lobes.flat_map(|(at, radius)| [at.x, at.y, radius]));
        uniforms.extend(SALTS.iter().flat_map(|salt| shift_of(self.seed ^ salt)));
        uniforms
    }

    /// Width of the rim in which it rises.
    fn rim(&self) -> f32 {
        smaller(self.look.rim, 0.6 * self.radius)
    }

    fn rags(&self) -> f32 {
        smaller(self.look.lamella.rags, MOST_RAGS * self.radius)
    }

    /// How wide its rims are at a place of its own frame, as a share of their width.
    fn rim_share(&self, own: Vec2) -> f32 {
        1.0 + RIM_UNEVEN * octaves(own / (RIM_SIZE * self.radius), 1, self.seed ^ SALTS[3])
    }

    /// Its matter at a place, without what floats in it.
    fn at(&self, place: Vec2, softness: f32) -> Matter {
        let look = self.look;
        let depth = self.field.at(place);
        if depth <= -softness - 2.0 * self.rags() {
            return Matter::NONE;
        }
        let lamella = self.lamella(place);
        let own = self.from_shape * (place - self.centre);
        let rags = octaves(own / (RAGS * self.radius) + Vec2::splat(self.time * RUFFLING), 3, self.seed ^ SALTS[1]);
        let ragged = mix(RAGS_BEHIND, 1.0, lamella) * (POINTS[0] - POINTS[1] * rags.abs());
        let share = self.rim_share(own);
        let depth = depth + self.rags() * (share * ragged + lamella * PULSE * (self.pulse() - 1.0));
        let rim = self.rim() * share;
        let inside = larger(1.0 - own.length_squared() / (self.radius * self.radius), 0.0);
        let high = mix(FLAT * (1.0 - EDGE_UNEVEN * (share - 1.0)), 1.0, inside * inside);
        let dome =
            mix(high * rise(depth / rim), look.lamella.thickness * self.pulse() * rise(depth / (0.25 * rim)), lamella);
        let uneven = octaves(own / look.texture.size, 3, self.seed ^ SALTS[0]);
        let mut matter = self.matter * (dome * (1.0 + look.texture.amount * uneven));
        matter.cytoplasm *= 1.0 + DYED * uneven;
        let ruffle = bell((depth - look.lamella.ruffle_inset) / 0.28) * lamella;
        if ruffle > 0.01 {
            let along = octaves(own * 0.7 + Vec2::splat(self.time * RUFFLING), 2, self.seed ^ SALTS[1]);
            matter += Matter::phase(look.lamella.ruffle * ruffle * smoothstep(-0.3, 0.7, along));
        }
        matter += self.nucleus_matter(place, softness);
        matter * smoothstep(-softness, softness, depth)
    }

    /// How much a place belongs to the clear front, 0 to 1.
    fn lamella(&self, place: Vec2) -> f32 {
        let Front { direction, strength, ahead, behind, .. } = self.front;
        let length = ahead + behind;
        let from_centre = place - self.centre;
        // Its border is uneven, and bends back along the sides.
        let across = from_centre.perp_dot(direction);
        let uneven = 0.05 * length * octaves(from_centre / (0.25 * self.radius), 2, self.seed ^ SALTS[3]);
        let along = from_centre.dot(direction) + 0.15 * across * across / self.radius + uneven;
        let [from, to] = self.border();
        strength * smoothstep(from, to, along)
    }

    /// Where the clear front begins and where it is clear, along its direction.
    fn border(&self) -> [f32; 2] {
        let Front { ahead, behind, .. } = self.front;
        let share = self.look.lamella.length * (0.85 + 0.15 * self.pulse());
        [share + 0.10, share - 0.10].map(|share| ahead - share * (ahead + behind))
    }

    /// The front swells and thins.
    fn pulse(&self) -> f32 {
        let share = self.time / self.look.lamella.pulse + 0.15 * wobble(self.time * 0.2, self.seed);
        1.0 + 0.25 * unit_vector(TAU * share).y
    }

    /// How the cell is turned.
    fn turn(&self) -> Vec2 {
        let (x_axis, y_axis) = (self.from_shape.x_axis, self.from_shape.y_axis);
        direction_or(Vec2::new(x_axis.x + y_axis.y, y_axis.x - x_axis.y), Vec2::X)
    }

    /// A place from the centre, turned with the cell, but not stretched.
    fn turned(&self, place: Vec2) -> Vec2 {
        let turn = self.turn();
        rotate(place - self.centre, Vec2::new(turn.x, -turn.y))
    }

    /// The bright wall around prey that is inside: it grows as the prey goes in.
    pub(super) fn phagosome(&self, prey: Vec2, radius: f32) -> Option<Spot> {
        let share = smoothstep(-0.5 * radius, 4.0 * radius, self.field.at(prey));
        let matter = Matter { cytoplasm: -0.35, ..Matter::phase(-0.34) } * share;
        (share > 0.0).then_some(Spot { at: prey, radius: radius * 1.15, matter, shape: SpotShape::Ring })
    }

    /// Centre and radius of the bleb that prey inside the cell brings about.
    fn bleb(&self, prey: Vec2, seed: u32) -> Option<(Vec2, f32)> {
        let [smallest, largest] = self.look.blebs;
        let cycle = self.time / BLEB_PERIOD + HashRng::new(seed).unit();
        let mut rng = HashRng::new(seed ^ scramble(cycle as u32));
        let direction = rotate(-self.front.direction, unit_vector(rng.range([-1.9, 1.9])));
        let swelling = unit_vector(TAU * 0.5 * cycle.fract()).y;
        let radius = rng.range([smallest, largest]) * swelling * smoothstep(0.0, 1.5, self.field.at(prey));
        let edge = self.field.crossing(self.centre, direction, 0.05 * self.radius)?;
        (radius > 0.05).then_some((self.centre + direction * (edge + 0.3 * radius), radius))
    }
}

/// Matter of a cell of this radius where it is thickest: cells of a slide have in common how thick they are and what they take up.
fn matter_of(look: &AmoeboidLook, radius: f32, slide: u32) -> Matter {
    let thin = smaller(radius / THICK_FROM, 1.0);
    let mut rng = HashRng::new(slide ^ 0xb0d1);
    let mut own = || libm::expf(SLIDES * rng.normal());
    let phase = smaller(look.matter.phase, larger(look.matter.phase * thin, THINNEST)) * own();
    let cytoplasm = look.matter.cytoplasm * own();
    let share = rng.unit();
    Matter { phase, cytoplasm, nucleus: BASOPHIL * share * share, ..look.matter }
}

/// Centroid of an outline and radius of the disc of equal area; nothing if it encloses none.
fn middle_of(outline: &[Vec2]) -> Option<(Vec2, f32)> {
    let centre = centroid(outline).filter(|centre| centre.is_finite())?;
    let radius = (signed_area(outline).abs() / std::f32::consts::PI).sqrt();
    (radius > 0.0 && radius.is_finite()).then_some((centre, radius))
}

/// 0 outside, 1 from a depth of 1 on, steeper at the edge: a dome that ends thin.
fn rise(depth: f32) -> f32 {
    let depth = depth.clamp(0.0, 1.0);
    let root = (depth * (2.0 - depth)).sqrt();
    root * root.sqrt()
}

/// The linear map that takes the disc of radius 1 nearest to an outline: its first Fourier coefficients. Node 0 is where
/// the disc's first direction goes, so that the map turns with the membrane.
fn stretch(outline: &[Vec2], centre: Vec2, radius: f32) -> Mat2 {
    let count = outline.len() as f32;
    let (mut along, mut against) = (Vec2::ZERO, Vec2::ZERO);
    for (k, &node) in outline.iter().enumerate() {
        let turn = unit_vector(TAU * k as f32 / count);
        along += rotate(node - centre, Vec2::new(turn.x, -turn.y)) / count;
        against += rotate(node - centre, turn) / count;
    }
    if along.length() < 0.2 * radius {
        return Mat2::from_diagonal(Vec2::splat(radius));
    }
    // A slender shape would draw texture out into streaks.
    let against = against.clamp_length_max(0.33 * along.length());
    Mat2::from_cols(along + against, (along - against).perp())
}
