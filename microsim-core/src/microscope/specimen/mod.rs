//! The specimen: what there is to see at one moment, as matter with places and sizes, free of pixels and light.

pub(super) mod amoeboid;
pub(super) mod background;
pub(super) mod chamber;
pub(super) mod distance_field;
mod front;
mod hollow;
mod individual;
mod polar_outline;
mod pose;
pub(super) mod round;
mod spline;
pub(super) mod spot;
pub(super) mod thread;
mod uneven_outline;

use super::maths::{bell, larger, mix};
use super::matter::{Matter, MatterRaster};
use super::noise::{HashRng, scramble};
use super::raster::PixelGrid;
use super::recipe::DrawList;
use crate::look::{ImageLook, SpotShape};
use crate::organism::look;
use crate::template::Role;
use crate::world::view::{OrganismView, View};
use amoeboid::AmoeboidBody;
use background::BackgroundMatter;
use chamber::Chamber;
use glam::Vec2;
use round::RoundBody;
use spot::Spot;
use thread::Thread;

/// How far rods are bent, share of their length; how much their width, and how far their ends reach, differ, in radii; share
/// that are about to divide.
const ROD_BEND: f32 = 0.10;
const ROD_WIDTH: f32 = 0.08;
const ROD_ENDS: f32 = 0.8;
const ROD_SEPTA: f32 = 0.3;
/// Radius of the drops that a rod is made of, in its own: they are soft.
const ROD_REACH: f32 = 1.25;
/// Distance of the drops that a rod is made of, in radii.
const ROD_STEP: f32 = 0.4;
/// Farthest that anything of an organism reaches beyond its bounds: share of their longer side, and micrometres. Fibres and
/// cilia do, and outlines that are made uneven.
const BEYOND: [f32; 2] = [0.7, 6.0];
/// Pixels over which small things are spread.
const BLUR: f32 = 3.0;

/// Everything that lies on the slide at one moment.
#[derive(Clone, Debug)]
pub(super) struct Specimen {
    background: BackgroundMatter,
    chamber: Chamber,
    round: Vec<RoundBody>,
    amoeboid: Vec<AmoeboidBody>,
    spots: Vec<Spot>,
    threads: Vec<Thread>,
}

impl Specimen {
    /// What there is to see, for a camera that looks at `camera`, on a grid and on what lies within it.
    pub(super) fn of(view: View<'_>, camera: Vec2, grid: &PixelGrid) -> Self {
        let (world, time) = (view.world(), view.time() as f32);
        let seed = world.config().seed;
        let background = BackgroundMatter { seed: scramble(seed as u32 ^ (seed >> 32) as u32), time, camera };
        let chamber = Chamber {
            size: world.config().size,
            obstacles: world.solid_obstacles().cloned().collect(),
            seed: background.seed,
        };
        let (round, amoeboid, spots, threads) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut specimen = Self { background, chamber, round, amoeboid, spots, threads };
        for organism in view.organisms().filter(|&organism| may_be_on(grid, organism)) {
            specimen.add(organism, view);
        }
        specimen
    }

    fn add(&mut self, organism: OrganismView<'_>, view: View<'_>) {
        let id = organism.id();
        let seed = scramble(self.background.seed ^ scramble(id.index() ^ (id.generation() << 16)));
        let time = self.background.time;
        match look(organism.kind()).image {
            ImageLook::Round(look) => {
                let Some(body) = RoundBody::of(organism, look, [self.background.seed, seed]) else { return };
                self.spots.extend(body.spots(time));
                self.threads.extend(body.threads(time));
                self.round.push(body);
            }
            ImageLook::Amoeboid(look_of) => {
                let node = organism.particles().find(|particle| particle.role == Role::Membrane);
                let look = look_of(node.map_or(0.0, |node| node.radius));
                let Some(mut body) = AmoeboidBody::of(organism, look, [self.background.seed, seed], time) else {
                    return;
                };
                body.swell(meals(organism, view));
                self.spots.extend(body.spots(organism));
                self.threads.extend(body.threads(organism));
                self.spots.extend(phagosomes(&body, organism, view));
                self.amoeboid.push(body);
            }
            ImageLook::Rod(matter) => self.spots.extend(rod(organism, *matter, seed)),
            ImageLook::Drops(matter) => self.spots.extend(drops(organism, *matter)),
        }
    }

    /// Its matter on a grid. Rows may be asked for in any portions: a place always has the same matter.
    pub(super) fn rasterize(&self, grid: PixelGrid) -> MatterRaster {
        let mut raster = MatterRaster::empty(grid);
        self.background.draw(&mut raster);
        self.chamber.draw(&mut raster);
        self.draw_organisms(&mut raster);
        raster
    }

    fn draw_organisms(&self, raster: &mut MatterRaster) {
        self.amoeboid.iter().for_each(|body| body.draw(raster));
        self.round.iter().for_each(|body| body.draw(raster));
        self.threads.iter().for_each(|thread| thread.draw(raster));
        self.spots.iter().for_each(|spot| spot.draw(raster));
    }

    /// The same matter for a graphics card; an empty target holds `bias`.
    pub(super) fn draw_on(&self, draws: &mut DrawList, bias: [f32; 4]) {
        self.background.draw_on(draws, bias);
        self.chamber.draw_on(draws);
        self.amoeboid.iter().for_each(|body| body.draw_on(draws));
        self.round.iter().for_each(|body| body.draw_on(draws));
        self.threads.iter().for_each(|thread| thread.draw_on(draws));
        self.spots.iter().for_each(|spot| spot.draw_on(draws));
    }
}

/// Whether anything of an organism may lie on a grid.
fn may_be_on(grid: &PixelGrid, organism: OrganismView<'_>) -> bool {
    let (low, high) = organism.bounds();
    let beyond = BEYOND[0] * (high - low).max_element() + BEYOND[1] + BLUR * grid.pixel;
    let (lower_left, upper_right) = grid.bounds();
    !((high + beyond).cmplt(lower_left).any() || (low - beyond).cmpgt(upper_right).any())
}

/// Walls around the prey that a cell holds.
fn phagosomes(body: &AmoeboidBody, organism: OrganismView<'_>, view: View<'_>) -> Vec<Spot> {
    let prey = organism.meals().filter_map(|(prey, _)| view.organism(prey));
    // A single disc each.
    let discs = prey.filter_map(|prey| prey.particles().next().filter(|_| prey.particles().nth(1).is_none()));
    discs.filter_map(|disc| body.phagosome(disc.position, disc.radius)).collect()
}

/// Places and seeds of the first few things that a cell holds.
fn meals<'a>(organism: OrganismView<'a>, view: View<'a>) -> impl Iterator<Item = (Vec2, u32)> + 'a {
    let prey = organism.meals().filter_map(move |(prey, _)| view.organism(prey)).take(4);
    prey.filter_map(|prey| Some((prey.particles().next()?.position, scramble(prey.id().index()))))
}

/// A row of drops so close together that they are one; rods differ in length, width, bend, and in what lies at their poles.
fn rod(organism: OrganismView<'_>, matter: Matter, seed: u32) -> Vec<Spot> {
    let ends = organism.particles().next().zip(organism.particles().last());
    let Some((head, tail)) = ends.filter(|(head, _)| head.radius > 0.0) else { return Vec::new() };
    let mut rng = HashRng::new(seed);
    let way = tail.position - head.position;
    let cap = head.radius / larger(way.length(), head.radius);
    let [from, to] = [0.0, 1.0].map(|end| end + ROD_ENDS * cap * rng.range([-1.0, 1.0]));
    let bend = way.perp() * (ROD_BEND * rng.normal());
    let width = head.radius * (ROD_REACH + ROD_WIDTH * rng.range([-1.0, 0.6]));
    let septum = if rng.unit() < ROD_SEPTA { rng.range([0.15, 0.4]) } else { 0.0 };
    let poles = [rng.range([0.75, 1.25]), rng.range([0.75, 1.25])];
    let parts = (way.length() / (ROD_STEP * head.radius)).ceil().clamp(1.0, 64.0);
    // So many of them lie over each other that the rod is as thick as one on its own.
    let spot = |k: u32| {
        let share = mix(from, to, k as f32 / parts);
        let from_middle = 2.0 * share - 1.0;
        let at = head.position + way * share + bend * (1.0 - from_middle * from_middle);
        let narrow = 1.0 - septum * bell(from_middle / 0.2);
        let dense = mix(poles[0], poles[1], share) * narrow;
        Spot { at, radius: width * narrow, matter: matter * (ROD_STEP * 0.75 * dense), shape: SpotShape::Bump }
    };
    (0..=parts as u32).map(spot).collect()
}

/// A soft drop for each particle; wide enough to run into its neighbours.
fn drops(organism: OrganismView<'_>, matter: Matter) -> Vec<Spot> {
    let drop = |at, radius| Spot { at, radius: 1.6 * radius, matter: matter * 0.6, shape: SpotShape::Bump };
    organism.particles().map(|particle| drop(particle.position, particle.radius)).collect()
}

#[cfg(test)]
mod rods {
    use super::*;
    use crate::organism::look;
    use crate::{BacillusSpec, Placement, World, WorldConfig};

    #[test]
    fn rods_differ_in_length_bend_and_septum() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&BacillusSpec::default().into(), Placement::at(60.0, 40.0)).unwrap();
        let bacillus = world.view().organism(id).unwrap();
        let ImageLook::Rod(matter) = look(bacillus.kind()).image else { panic!("it is a rod") };
        let rods: Vec<Vec<Spot>> = (0..100).map(|seed| rod(bacillus, *matter, seed)).collect();
        let length = |rod: &Vec<Spot>| (rod[rod.len() - 1].at - rod[0].at).length();
        let mut lengths: Vec<f32> = rods.iter().map(length).collect();
        lengths.sort_by(f32::total_cmp);
        assert!(lengths[95] > 1.5 * lengths[5], "{} {}", lengths[5], lengths[95]);
        let narrow = |rod: &&Vec<Spot>| rod[rod.len() / 2].radius < 0.93 * rod[0].radius;
        assert!((15..45).contains(&rods.iter().filter(narrow).count()));
    }
}

#[cfg(test)]
#[cfg(feature = "scenario")]
mod tests {
    use super::*;
    use crate::scenario::{Scenario, builtin};

    #[test]
    fn what_is_left_out_would_not_be_seen() {
        let mut left_out = 0;
        for name in ["demo", "hunt", "dam-break"] {
            let scenario = Scenario::parse(builtin(name).unwrap().text, &[]).unwrap();
            let mut world = scenario.build().unwrap().world;
            (0..30).for_each(|_| world.step(&crate::Inputs::new()));
            let (view, size) = (world.view(), world.config().size);
            let small = PixelGrid { corner: Vec2::ZERO, pixel: 0.5, columns: 24, top: 0, rows: 24 };
            for (share, pixel) in [(0.2, 0.5), (0.35, 0.25), (0.5, 0.5), (0.7, 2.0)] {
                let grid = PixelGrid { corner: size * share, pixel, ..small };
                let mut specimen = Specimen::of(view, Vec2::ZERO, &PixelGrid { corner: -10.0 * size, ..small });
                assert!(specimen.round.is_empty() && specimen.spots.is_empty());
                for organism in view.organisms().filter(|&organism| !may_be_on(&grid, organism)) {
                    specimen.add(organism, view);
                    left_out += 1;
                }
                let mut raster = MatterRaster::empty(grid);
                specimen.draw_organisms(&mut raster);
                assert!(raster.matter.iter().all(|matter| *matter == Matter::NONE), "{name} {share}");
            }
        }
        assert!(left_out > 600, "{left_out}");
    }
}
