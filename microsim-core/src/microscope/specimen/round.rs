//! Bodies that are described from their centre outwards: red cells, platelets, cocci, beads, ciliates.

mod inclusions;
mod processes;

use super::hollow::{Hollow, KNOB};
use super::individual::{self, Smear};
use super::polar_outline::PolarOutline;
use super::pose::Pose;
use super::spline::smooth;
use super::spot::Spot;
use super::thread::Thread;
use super::uneven_outline;
use crate::bare_text::bare_text;
use crate::geometry::{direction_or, rotate, unit_vector};
use crate::look::{OutlineLook, Pellicle, Profile, RoundLook, SpotShape};
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{bell, larger, mix, smaller, smoothstep};
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::noise::{HashRng, octaves, shift_of};
use crate::microscope::recipe::{DrawList, Program};
use crate::world::view::OrganismView;
use glam::Vec2;
use std::f32::consts::TAU;

/// Thickness of a red cell where it is thickest, micrometres.
const THICKEST: f32 = 2.56;
/// Width over which any edge fades, micrometres: what a good lens resolves.
const EDGE: f32 = 0.06;
/// Share by which the edge of a body that is out of focus is wider, at most.
const OUT_OF_FOCUS: f32 = 3.5;
/// Share by which it is wider on one side of a body than in its middle, at most.
const STEEPEST: f32 = 0.9;
/// Micrometres by which an edge is wider for each tier of the slide above the glass.
const ABOVE: f32 = 0.09;
/// How much thicker the middle of a red cell that stands up is, micrometres.
const ON_EDGE: f32 = 1.2;
/// How much more uneven what takes up dye is than what delays light.
const DYED: f32 = 2.0;
/// The oral groove's middle line, `y = GROOVE[0] + GROOVE[1] x + GROOVE[2] x^2` in the frame in which the body is a disc of
/// radius 1 that heads for +x; where it ends at the mouth; half its width at the front, where it is shallow and broad.
const GROOVE: [f32; 3] = [-0.30, 0.0, 0.71];
const GROOVE_END: [f32; 2] = [-0.10, 0.06];
const GROOVE_WIDTH: f32 = 0.30;
/// Fewest and most triangles of a body on a graphics card, and their number where its radius is one pixel.
const SPOKES: [f32; 2] = [24.0, 160.0];
const SPOKES_PER_ROOT: f32 = 10.0;

pub(in crate::microscope) const GLSL: Glsl = Glsl {
    source: bare_text!("round.glsl", "//"),
    constants: &[
        ("TURN", &[TAU]),
        ("EDGE", &[EDGE]),
        ("THICKEST", &[THICKEST]),
        ("KNOB", &[KNOB]),
        ("DYED", &[DYED]),
        ("GROOVE", &GROOVE),
        ("GROOVE_END", &GROOVE_END),
        ("GROOVE_WIDTH", &[GROOVE_WIDTH]),
    ],
};

/// One body, ready to be drawn.
#[derive(Clone, Debug)]
pub(super) struct RoundBody {
    look: &'static RoundLook,
    smear: Smear,
    polar: PolarOutline,
    /// Its own first direction: texture and inclusions turn with it.
    facing: Vec2,
    /// How far it reaches along that direction and square to it, micrometres.
    axes: Vec2,
    seed: u32,
    matter: Matter,
    /// Thickness of a red cell's middle, micrometres.
    middle: f32,
    hollow: Hollow,
    /// Width over which its edge fades, micrometres: it may lie a little above or below the plane of focus; and the way, of a
    /// length below 1, in which it is wider, because the body is not level.
    edge: f32,
    slope: Vec2,
}

impl RoundBody {
    /// `None` if there is no area to draw.
    pub(super) fn of(organism: OrganismView<'_>, look: &'static RoundLook, [slide, seed]: [u32; 2]) -> Option<Self> {
        let surface = organism.surface();
        let polar = if surface.is_empty() {
            let disc = organism.particles().next()?;
            PolarOutline::disc(disc.position, disc.radius)
        } else {
            PolarOutline::around(&smooth(&surface))
        };
        let mut polar = polar?;
        let first = surface.first().map_or(Vec2::X, |&node| node - polar.centre);
        let facing = direction_or(first, Vec2::X);
        let mut rng = HashRng::new(seed);
        let smear = Smear::of(slide);
        let is_red = matches!(look.profile, Profile::Biconcave { .. });
        let decay = look.outline.decay - if is_red { smear.crenated } else { 0.0 };
        uneven_outline::reshape(&mut polar, facing, &OutlineLook { decay, ..look.outline }, &mut rng);
        let axes = Vec2::new(polar.radius(facing), polar.radius(facing.perp()));
        if let Some(pellicle) = look.pellicle {
            make_slipper(&mut polar, facing, axes, pellicle.slipper);
        }
        let mut matter = individual::matter(look, &mut rng);
        let (mut middle, mut hollow) = (0.0, Hollow::NONE);
        let tier = organism.tier();
        if let Profile::Biconcave { c0, .. } = look.profile {
            let pose = Pose::of(tier, &mut rng);
            let back = Vec2::new(facing.x, -facing.y);
            polar.reshape(|direction| pose.foreshortening(rotate(direction, back)));
            middle = rng.range(c0) + ON_EDGE * pose.steepness();
            hollow = Hollow::of(pose, smear.pale, &mut rng);
            matter.phase *= pose.thickness();
            matter.haemoglobin *= pose.thickness().sqrt();
        }
        let blur = rng.unit();
        let edge = EDGE * (1.0 + OUT_OF_FOCUS * blur * blur) + ABOVE * tier.unwrap_or(0) as f32;
        let slope = rotate(rng.direction() * (STEEPEST * rng.unit()), facing);
        Some(Self { look, smear, polar, facing, axes, seed, matter, middle, hollow, edge, slope })
    }

    /// Width over which the edge fades in a direction, micrometres.
    fn edge_at(&self, direction: Vec2) -> f32 {
        self.edge * (1.0 + self.slope.dot(direction))
    }

    pub(super) fn draw(&self, raster: &mut MatterRaster) {
        let extent = Vec2::splat(self.polar.farthest + 2.0 * self.edge + raster.grid.pixel);
        let pixel = raster.grid.pixel;
        raster.add(self.polar.centre - extent, self.polar.centre + extent, |p| self.at(p, pixel));
    }

    /// A fan of triangles for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList) {
        if !draws.sees(self.polar.centre, self.polar.farthest + 1.0) {
            return;
        }
        let mut constant = [self.facing.to_array(), self.hollow.centre.to_array()].concat();
        constant.extend(self.matter.to_array());
        constant.extend(match self.look.profile {
            Profile::Dome(power) => [power, 0.0, 0.0, 0.0],
            Profile::Biconcave { c2, c4, .. } => [0.0, self.middle, c2, c4],
        });
        constant.extend([self.look.texture.amount, self.look.texture.size]);
        constant.extend(shift_of(self.seed));
        constant.extend(self.hollow.dried);
        let back = Vec2::new(self.facing.x, -self.facing.y) / self.polar.mean;
        // So many that chords are hardly apart from arcs: their distance goes by the radius and by the square of the angle.
        let in_pixels = self.polar.farthest / draws.pixel();
        let spokes = (SPOKES_PER_ROOT * in_pixels.sqrt()).clamp(SPOKES[0], SPOKES[1]) as usize;
        let mut vertices = Vec::with_capacity((spokes + 1) * (9 + constant.len()));
        for spoke in 0..=spokes {
            // Even on a disc that is stretched like the body, so that slender ends are round.
            let on_disc = if spoke == spokes { Vec2::ZERO } else { unit_vector(TAU * spoke as f32 / spokes as f32) };
            let direction = rotate(on_disc * self.axes, self.facing).normalize_or_zero();
            let radius = if spoke == spokes { self.polar.mean } else { self.polar.radius(direction) };
            vertices.extend(self.polar.centre.to_array());
            vertices.extend([direction.x * radius, direction.y * radius, radius]);
            vertices.extend_from_slice(&constant);
            let in_hollow = self.hollow.turned(rotate(direction * radius, back));
            vertices.extend([in_hollow.x, in_hollow.y, self.hollow.area, self.edge_at(direction)]);
        }
        let fan = (0..spokes as u16).flat_map(|k| [spokes as u16, k, (k + 1) % spokes as u16]);
        match self.look.pellicle {
            None => draws.add(Program::Round, false, &vertices, fan),
            Some(pellicle) => {
                let [x, y] = shift_of(self.seed);
                let relief = [self.axes.x, self.axes.y, x, y, pellicle.furrows, pellicle.furrow_depth, pellicle.groove];
                draws.add_apart(Program::Ciliate, &vertices, fan.collect(), relief.to_vec(), None);
            }
        }
    }

    /// Its matter at a place.
    fn at(&self, place: Vec2, pixel: f32) -> Matter {
        let direction = place - self.polar.centre;
        let radius = self.polar.radius(direction);
        let rho = direction.length() / radius;
        let softness = larger(0.6 * pixel, self.edge_at(direction / larger(direction.length(), 1e-6)));
        let fade = softness / radius;
        if rho >= 1.0 + fade {
            return Matter::NONE;
        }
        let own = rotate(direction, Vec2::new(self.facing.x, -self.facing.y));
        let thickness = self.thickness(rho / (1.0 + fade), own / self.polar.mean);
        let texture = &self.look.texture;
        let noise = if texture.amount > 0.0 { octaves(own / texture.size, 2, self.seed) } else { 0.0 };
        let relief = self.look.pellicle.map_or(1.0, |pellicle| pellicle.relief(own / self.axes, self.seed));
        let share = smoothstep(1.0 + fade, 1.0 - fade, rho) * relief;
        // A rim is clear.
        let uneven = 1.5 * texture.amount * noise * larger(1.0 - rho * rho, 0.0);
        let matter = self.matter * (thickness[1] * share * (1.0 + DYED * uneven));
        Matter { phase: self.matter.phase * (thickness[0] * share * (1.0 + uneven)), ..matter }
    }

    /// Thickness in the living and in the dried state, 1 where it is thickest.
    fn thickness(&self, rho: f32, own: Vec2) -> [f32; 2] {
        let inside = 1.0 - rho * rho;
        if inside <= 0.0 {
            return [0.0; 2];
        }
        match self.look.profile {
            Profile::Dome(power) => [libm::powf(inside, power); 2],
            Profile::Biconcave { c2, c4, .. } => {
                let from_hollow = self.hollow.turned(own) - self.hollow.centre;
                // Around the hollow in the middle, around the centre at the rim.
                let square = mix(self.hollow.area * from_hollow.length_squared(), rho * rho, 0.4 + 0.6 * rho * rho);
                let living = inside.sqrt() * (self.middle + c2 * square - c4 * square * square) / THICKEST;
                [living, self.hollow.dried(rho, from_hollow)]
            }
        }
    }

    /// A place of the body in the world: a direction in its own frame and a distance from the centre.
    fn place(&self, direction: Vec2, rho: f32) -> Vec2 {
        let way = rotate(direction, self.facing);
        self.polar.centre + way * (rho * self.polar.radius(way))
    }

    /// What is inside.
    pub(super) fn spots(&self, time: f32) -> Vec<Spot> {
        let mut rng = HashRng::new(self.seed ^ 0x51ed);
        let mut spots: Vec<Spot> =
            self.look.inclusions.iter().flat_map(|inclusion| self.include(inclusion, &mut rng)).collect();
        if let Profile::Biconcave { .. } = self.look.profile {
            spots.extend(self.drying_drops(&mut rng));
        }
        if let Some(pellicle) = self.look.pellicle {
            let spot = |(at, radius, _)| Spot { at, radius, matter: pellicle.water(), shape: SpotShape::Ball };
            spots.extend(self.vacuoles(pellicle, time).map(spot));
        }
        spots
    }

    /// Its two contractile vacuoles, each with its radius and how full it is: they fill slowly and empty at once.
    fn vacuoles(&self, pellicle: &Pellicle, time: f32) -> [(Vec2, f32, f32); 2] {
        [(1.0, 0.0), (-1.0, 0.45)].map(|(side, shift)| {
            let filled = (time / pellicle.vacuole_period + shift).rem_euclid(1.0);
            let radius = self.polar.mean * pellicle.vacuole * filled.sqrt() * smoothstep(1.0, 0.93, filled);
            (self.place(Vec2::new(side, 0.25).normalize(), 0.52), radius, filled)
        })
    }

    /// The tube from the mouth, at the end of the groove, into the body.
    fn gullet(&self, pellicle: &Pellicle, threads: &mut Vec<Thread>) {
        let point = |k: usize| {
            let along = k as f32 / 6.0;
            let own = Vec2::new(0.02 - 0.26 * along, GROOVE[0] + 0.02 + 0.34 * along * along) * self.axes;
            self.polar.centre + rotate(own, self.facing)
        };
        let radius = |k: usize| self.polar.mean * (0.05 - 0.005 * k as f32);
        let matter = Matter { cytoplasm: 0.4, ..Matter::phase(pellicle.gullet_phase) };
        let points: [Vec2; 8] = std::array::from_fn(point);
        threads.extend(Thread::curve(&points, radius, matter * 0.6));
    }

    /// Canals that lead to a vacuole; they swell while it is empty.
    fn canals(&self, pellicle: &Pellicle, (at, vacuole, filled): (Vec2, f32, f32)) -> [Thread; 7] {
        let radius = 0.02 * self.polar.mean * (1.0 - 0.6 * filled);
        let mut rng = HashRng::new(self.seed ^ 0xca7a);
        let mut canal = |k: usize| {
            let direction = rotate(unit_vector((k as f32 + 0.7 * rng.unit()) * TAU / 7.0), self.facing);
            let to = at + direction * (vacuole + rng.range([0.05, 0.18]) * self.polar.mean);
            let share = 0.5 * rng.unit() * (1.0 - 0.7 * filled);
            Thread { from: at + direction * vacuole, to, radius, matter: pellicle.water() * share, peak: 0.0 }
        };
        std::array::from_fn(&mut canal)
    }

    /// Its cilia and canals at a time.
    pub(super) fn threads(&self, time: f32) -> Vec<Thread> {
        let mut threads = Vec::new();
        if let Some(cilia) = self.look.cilia {
            let count = smaller(cilia.most, TAU * self.polar.mean / cilia.apart).ceil();
            (0..count as u32).for_each(|k| self.cilium(cilia, k as f32 / count, time, &mut threads));
        }
        if let Some(pellicle) = self.look.pellicle {
            let vacuoles = self.vacuoles(pellicle, time);
            threads.extend(vacuoles.into_iter().flat_map(|vacuole| self.canals(pellicle, vacuole)));
            self.gullet(pellicle, &mut threads);
        }
        self.filopodia(&mut threads);
        threads
    }
}

impl Pellicle {
    /// What fills vacuoles and canals, relative to the cytoplasm that it takes the place of.
    fn water(&self) -> Matter {
        Matter { cytoplasm: -0.7, ..Matter::phase(self.vacuole_phase) }
    }

    /// What furrows and the oral groove leave of the thickness; `own` is the place in the body's frame, scaled so that
    /// the body is a disc of radius 1.
    fn relief(&self, own: Vec2, seed: u32) -> f32 {
        // Rows of cilia run from pole to pole, as meridians do.
        let meridian = own.y / larger(1.0 - own.x * own.x, 0.02).sqrt();
        let uneven = 0.8 * octaves(own * 3.0, 2, seed);
        let furrow = unit_vector(TAU * (0.5 * self.furrows * meridian) + uneven).y;
        let [groove, lip] = oral_groove(own);
        1.0 - self.furrow_depth * (1.0 - furrow) - self.groove * (groove - 0.25 * lip)
    }
}

/// How much a place belongs to the oral groove and to its lips; it runs slanting from the front to the middle.
fn oral_groove(own: Vec2) -> [f32; 2] {
    let along = smoothstep(GROOVE_END[0], GROOVE_END[1], own.x) * smoothstep(1.0, 0.8, own.x);
    let from_middle = own.y - GROOVE[0] - GROOVE[1] * own.x - GROOVE[2] * own.x * own.x;
    let width = GROOVE_WIDTH * (0.5 + 0.5 * smoothstep(0.0, 0.8, own.x));
    [bell(from_middle / width) * along, bell(((from_middle / width).abs() - 1.7) / 0.45) * along]
}

/// Gives an outline the shape of a slipper: blunt in front, pointed behind, and hollow along the oral groove.
fn make_slipper(polar: &mut PolarOutline, facing: Vec2, axes: Vec2, amount: f32) {
    let back = Vec2::new(facing.x, -facing.y);
    polar.reshape(|direction| {
        let own = (rotate(direction, back) / axes).normalize_or_zero();
        let pointed = own.x * own.y * own.y;
        let hollow = if own.y < 0.0 { bell((own.x - 0.45) / 0.35) * own.y * own.y } else { 0.0 };
        1.0 + amount * (1.6 * pointed - hollow)
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look::ImageLook;
    use crate::{Placement, PlateletSpec, World, WorldConfig};

    #[test]
    fn t83_platelets_are_slightly_distorted_each_in_its_own_way() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&PlateletSpec::default().into(), Placement::at(60.0, 40.0)).unwrap();
        let platelet = world.view().organism(id).unwrap();
        let ImageLook::Round(look) = crate::organism::look(platelet.kind()).image else {
            panic!("platelets are round")
        };
        let radii = |seed: u32| {
            let body = RoundBody::of(platelet, look, [0, seed]).unwrap();
            (0..32).map(|k| body.polar.radius(unit_vector(TAU * k as f32 / 32.0))).collect::<Vec<_>>()
        };
        let (one, other) = (radii(1), radii(2));
        let mean = one.iter().sum::<f32>() / one.len() as f32;
        let farthest = one.iter().map(|radius| (radius - mean).abs()).fold(0.0, larger);
        assert!(farthest > 0.02 * mean && farthest < 0.4 * mean, "{farthest} of {mean}");
        let apart = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
        assert!(apart > 0.02 * mean, "{apart} of {mean}");
    }
}
