//! The way of the thesis to draw (3.2): meshes with textures that stretch with the body, particles blurred into a fluid, and
//! things that drift in the background. No light is involved.
//!
//! - Soft bodies: vertices are the ring's bodies pushed outwards by their radius, the kernel is the hub of the triangles,
//!   and the texture's inscribed circle is bound to the ring (3.2.1).
//! - Filled chains: the outline is cut into triangles by ear clipping and filled with one colour; over it lie the
//!   particles, blurred (3.2.2).
//! - Background: sprites at points that wander (3.2.3).

use super::glsl::Glsl;
use super::maths::{mix, smoothstep};
use super::noise::{HashRng, octaves, scramble, shift_of, wobble};
use super::raster::PixelGrid;
use super::recipe::{DrawList, Program, QUAD};
use super::specimen::chamber::obstacle_map;
use crate::bare_text::bare_text;
use crate::collision::obstacle::Obstacle;
use crate::geometry::{centroid, triangulate, unit_vector};
use crate::look::{ImageLook, PaintedLook};
use crate::organism::look;
use crate::template::Role;
use crate::world::view::{OrganismView, ParticleView, View};
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Sprites in the background.
const DRIFTING: u32 = 60;
/// Samples of a pixel along each side.
const SAMPLES: usize = 2;
/// Cytoplasm that growth has added.
const GROWN: Vec3 = Vec3::new(0.88, 0.80, 0.36);
const PAGE: Vec3 = Vec3::new(0.66, 0.76, 0.74);

/// The noise that mottles the page.
const PAGE_SEED: u32 = 1;

pub(super) const GLSL: Glsl =
    Glsl { source: bare_text!("painting.glsl", "//"), constants: &[("PAGE_COLOUR", &[PAGE.x, PAGE.y, PAGE.z])] };

/// A painted picture: primitives that cover each other, the lowest first.
#[derive(Clone, Debug)]
pub(super) struct Painting {
    room: Vec2,
    obstacles: Vec<Obstacle>,
    primitives: Vec<Primitive>,
}

#[derive(Clone, Copy, Debug)]
enum Primitive {
    Triangle { corners: [Vec2; 3], texture: [Vec2; 3], skin: Skin },
    Disc { at: Vec2, radius: f32, colour: Vec3, alpha: f32, softness: f32 },
}

/// A texture: a square with an inscribed circle.
#[derive(Clone, Copy, Debug)]
struct Skin {
    body: Vec3,
    rim: Vec3,
    /// Strength of the mottling.
    mottle: f32,
    seed: u32,
}

impl Painting {
    pub(super) fn of(view: View<'_>) -> Self {
        let world = view.world();
        let room = world.config().size;
        let mut painting = Self { room, obstacles: world.solid_obstacles().cloned().collect(), primitives: Vec::new() };
        painting.background(world.config().seed as u32, view.time() as f32);
        let mut organisms: Vec<OrganismView<'_>> = view.organisms().collect();
        organisms.sort_by_cached_key(|organism| is_filled_chain(*organism));
        for organism in organisms {
            painting.organism(organism);
        }
        painting
    }

    fn background(&mut self, seed: u32, time: f32) {
        for k in 0..DRIFTING {
            let mut rng = HashRng::new(seed ^ scramble(k));
            let walk = Vec2::new(wobble(time * 0.1, rng.bits()), wobble(time * 0.1, rng.bits())) * 6.0;
            let at = Vec2::new(rng.unit(), rng.unit()) * self.room + walk;
            let colour = PAGE * rng.range([0.82, 1.12]);
            let radius = rng.range([0.01, 0.035]) * self.room.max_element();
            self.primitives.push(Primitive::Disc { at, radius, colour, alpha: 0.5, softness: 0.9 });
        }
    }

    fn organism(&mut self, organism: OrganismView<'_>) {
        let seed = scramble(organism.id().index());
        let shade = 0.92 + 0.16 * HashRng::new(seed).unit();
        let PaintedLook { body, rim, mottle } = look(organism.kind()).painted;
        let skin = Skin { body: body * shade, rim: rim * shade, mottle, seed };
        let surface = organism.surface();
        if surface.len() < 3 {
            let disc = |at, radius| Primitive::Disc { at, radius, colour: skin.body, alpha: 0.95, softness: 0.15 };
            self.primitives.extend(organism.particles().map(|particle| disc(particle.position, particle.radius)));
        } else if is_filled_chain(organism) {
            self.filled_chain(organism, &surface, skin);
        } else {
            self.soft_body(organism, &surface, skin);
        }
    }

    /// A fan of triangles around the kernel.
    fn soft_body(&mut self, organism: OrganismView<'_>, surface: &[Vec2], skin: Skin) {
        let kernel = organism.nucleus();
        let Some(hub) = kernel.map(|kernel| kernel.position).or_else(|| centroid(surface)) else { return };
        let count = surface.len();
        let bound = |k: usize| unit_vector(TAU * k as f32 / count as f32);
        for k in 0..count {
            let corners = [hub, surface[k], surface[(k + 1) % count]];
            self.primitives.push(Primitive::Triangle { corners, texture: [Vec2::ZERO, bound(k), bound(k + 1)], skin });
        }
        let sprite = |at, radius| Primitive::Disc { at, radius, colour: skin.rim * 0.75, alpha: 0.7, softness: 0.4 };
        self.primitives.extend(kernel.map(|kernel| sprite(kernel.position, kernel.radius)));
    }

    /// One colour, and the blurred particles on it.
    fn filled_chain(&mut self, organism: OrganismView<'_>, surface: &[Vec2], skin: Skin) {
        let flat = Skin { mottle: 0.0, rim: skin.body, ..skin };
        for corners in triangulate(surface) {
            let corners = corners.map(|k| surface[k as usize]);
            self.primitives.push(Primitive::Triangle { corners, texture: [Vec2::ZERO; 3], skin: flat });
        }
        let fluid = organism.particles().filter(|p| matches!(p.role, Role::Cytoplasm | Role::GrownCytoplasm));
        self.primitives.extend(fluid.map(|particle| cytoplasm(&particle, &skin)));
        let node = |at, radius| Primitive::Disc { at, radius, colour: skin.rim * 0.8, alpha: 0.8, softness: 0.5 };
        let membrane = organism.particles().filter(|particle| particle.role == Role::Membrane);
        self.primitives.extend(membrane.map(|particle| node(particle.position, particle.radius)));
    }

    /// Colours on a grid, each channel 0 to 1.
    pub(super) fn light(&self, grid: PixelGrid) -> Vec<Vec3> {
        let fine = PixelGrid {
            pixel: grid.pixel / SAMPLES as f32,
            columns: grid.columns * SAMPLES,
            top: grid.top * SAMPLES,
            rows: grid.rows * SAMPLES,
            ..grid
        };
        let place = |k: usize| fine.place(k % fine.columns, k / fine.columns);
        let mut canvas: Vec<Vec3> = (0..fine.len()).map(|k| self.page(place(k))).collect();
        for primitive in &self.primitives {
            primitive.paint(&fine, &mut canvas);
        }
        let mean = |k: usize| {
            let (x, y) = (k % grid.columns * SAMPLES, k / grid.columns * SAMPLES);
            let samples = (0..SAMPLES * SAMPLES).map(|s| canvas[(y + s / SAMPLES) * fine.columns + x + s % SAMPLES]);
            samples.sum::<Vec3>() / (SAMPLES * SAMPLES) as f32
        };
        (0..grid.len()).map(mean).collect()
    }

    /// Its triangles, for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList) {
        let [x, y] = shift_of(PAGE_SEED);
        let room = vec![self.room.x, self.room.y, x, y];
        let corners = [-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0];
        draws.add_apart(Program::Page, &corners, QUAD.to_vec(), room.clone(), None);
        for obstacle in &self.obstacles {
            if let Some((_, map)) = obstacle_map(obstacle, draws, 0.0) {
                draws.add_apart(Program::PageObstacle, &corners, QUAD.to_vec(), room.clone(), Some(map.texture()));
            }
        }
        self.primitives.iter().for_each(|primitive| primitive.draw_on(draws));
    }

    /// The page, darker where the chamber is.
    fn page(&self, place: Vec2) -> Vec3 {
        let is_outside = place.cmplt(Vec2::ZERO).any() || place.cmpgt(self.room).any();
        let is_solid = is_outside || self.obstacles.iter().any(|obstacle| obstacle.contains(place));
        PAGE * (1.0 + 0.03 * octaves(place / 9.0, 2, PAGE_SEED)) * if is_solid { 0.7 } else { 1.0 }
    }
}

impl Primitive {
    fn draw_on(&self, draws: &mut DrawList) {
        match *self {
            Self::Triangle { corners, texture, skin } => {
                let [x, y] = shift_of(skin.seed);
                let colours = [skin.body.x, skin.body.y, skin.body.z, 1.0, skin.rim.x, skin.rim.y, skin.rim.z, 1.0];
                let vertex = |k: usize| [corners[k].to_array(), texture[k].to_array()].concat();
                let vertices = (0..3).map(|k| [&vertex(k)[..], &colours, &[skin.mottle, x, y]].concat());
                draws.add(Program::Painted, false, &vertices.collect::<Vec<_>>().concat(), [0, 1, 2]);
            }
            Self::Disc { at, radius, colour, alpha, softness } => {
                // A negative rim tells discs from triangles.
                let colours = [colour.x, colour.y, colour.z, alpha, 0.0, 0.0, 0.0, -1.0];
                let corners = [Vec2::NEG_ONE, Vec2::new(1.0, -1.0), Vec2::ONE, Vec2::new(-1.0, 1.0)];
                let vertex = |way: Vec2| [(at + way * radius).to_array(), way.to_array()].concat();
                let vertices = corners.map(|way| [&vertex(way)[..], &colours, &[softness, 0.0, 0.0]].concat());
                draws.add(Program::Painted, false, &vertices.concat(), QUAD);
            }
        }
    }

    fn paint(&self, grid: &PixelGrid, canvas: &mut [Vec3]) {
        match *self {
            Self::Triangle { corners: [a, b, c], texture, skin } => {
                let area = (b - a).perp_dot(c - a);
                if area == 0.0 || !area.is_finite() {
                    return;
                }
                grid.each_in(a.min(b).min(c), a.max(b).max(c), |k, p| {
                    let (v, w) = ((p - a).perp_dot(c - a) / area, (b - a).perp_dot(p - a) / area);
                    let u = 1.0 - v - w;
                    if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                        canvas[k] = skin.at(texture[0] * u + texture[1] * v + texture[2] * w);
                    }
                });
            }
            Self::Disc { at, radius, colour, alpha, softness } => {
                grid.each_in(at - Vec2::splat(radius), at + Vec2::splat(radius), |k, p| {
                    let cover = alpha * smoothstep(1.0, 1.0 - softness, (p - at).length() / radius);
                    canvas[k] = mix_colours(canvas[k], colour, cover);
                });
            }
        }
    }
}

impl Skin {
    /// Colour of a place of the texture, (0, 0) in its middle and 1 from there to the inscribed circle.
    fn at(&self, place: Vec2) -> Vec3 {
        let rho = place.length();
        let mottled = 1.0 + self.mottle * octaves(place * 4.0, 3, self.seed);
        mix_colours(self.body * mottled, self.rim, 0.25 * rho + 0.75 * smoothstep(0.80, 0.97, rho))
    }
}

fn is_filled_chain(organism: OrganismView<'_>) -> bool {
    matches!(look(organism.kind()).image, ImageLook::Amoeboid(_))
}

/// A blurred particle; colours and sizes differ, and what growth has added is yellow.
fn cytoplasm(particle: &ParticleView, skin: &Skin) -> Primitive {
    let mut rng = HashRng::new(particle.index);
    let own = mix_colours(skin.rim, skin.body, rng.unit());
    let colour = if particle.role == Role::GrownCytoplasm { mix_colours(own, GROWN, 0.6) } else { own };
    let radius = particle.radius * rng.range([1.6, 2.2]);
    Primitive::Disc { at: particle.position, radius, colour, alpha: 0.55, softness: 1.0 }
}

fn mix_colours(a: Vec3, b: Vec3, share: f32) -> Vec3 {
    Vec3::new(mix(a.x, b.x, share), mix(a.y, b.y, share), mix(a.z, b.z, share))
}

#[cfg(test)]
mod tests {
    use super::super::maths::{larger, smaller};
    use super::*;

    const SKIN: Skin = Skin { body: Vec3::new(0.7, 0.8, 0.5), rim: Vec3::new(0.4, 0.5, 0.3), mottle: 0.0, seed: 0 };

    /// Radius and colour of a particle of cytoplasm.
    fn disc(index: u32, role: Role) -> (f32, Vec3) {
        let particle = ParticleView { index, position: Vec2::ZERO, velocity: Vec2::ZERO, radius: 1.0, role };
        match cytoplasm(&particle, &SKIN) {
            Primitive::Disc { radius, colour, .. } => (radius, colour),
            Primitive::Triangle { .. } => unreachable!("cytoplasm is made of discs"),
        }
    }

    #[test]
    fn t72_grown_cytoplasm_has_another_colour() {
        for index in 0..20 {
            let apart = disc(index, Role::GrownCytoplasm).1 - disc(index, Role::Cytoplasm).1;
            assert!(apart.length() > 0.05, "{index}: {apart}");
        }
    }

    #[test]
    fn t81_cytoplasm_has_different_sizes_and_colours() {
        let discs: Vec<(f32, Vec3)> = (0..50).map(|index| disc(index, Role::Cytoplasm)).collect();
        let spread = |of: fn(&(f32, Vec3)) -> f32| {
            discs.iter().map(of).fold(f32::MIN, larger) - discs.iter().map(of).fold(f32::MAX, smaller)
        };
        assert!(spread(|(radius, _)| *radius) > 0.4 && spread(|(_, colour)| colour.x) > 0.2);
    }
}
