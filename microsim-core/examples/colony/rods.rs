//! Rods that grow and divide.
//!
//! A rod is a template whose one channel is its length. What it does is a rule of this program: the length of each rod grows
//! exponentially, and a rod that has become long enough for two is replaced by two, which have its number as their mother's.

use microsim_core::geometry::ring::unit_vector;
use microsim_core::prelude::*;
use microsim_core::{Distance, Rng};

/// Half a rod's width, units.
const RADIUS: f32 = 0.5;
/// Discs of a rod; the longest rod has them 1.3 radii apart.
const DISCS: u8 = 8;
/// Distance of the first disc from the last at birth. Twice that and two radii is the longest: two fit into its place.
const SHORTEST: f32 = 1.8;
const LONGEST: f32 = 2.0 * SHORTEST + 2.0 * RADIUS;
/// Time in which a length doubles, s.
const DOUBLING: f32 = 4.0;
/// Rods of a full colony.
pub(crate) const COLONY: usize = 500;

/// A rod in the program's own books.
struct Cell {
    id: OrganismId,
    length: f32,
    rate: f32,
}

/// The rods of a colony.
pub(crate) struct Colony {
    rod: TemplateId,
    cells: Vec<Cell>,
    births: u128,
    rng: Rng,
}

/// A room with one rod in it.
pub(crate) fn colony() -> Result<(World, Colony), Error> {
    let mut world = World::new(WorldConfig { size: Vec2::splat(120.0), damping: 8.0, ..WorldConfig::default() })?;
    let (rod, mut rng) = (world.add_template(rod()?), Rng::new(1, 1));
    let cells = vec![born(&mut world, rod, Placement::at(60.0, 60.0), 0, &mut rng)?];
    Ok((world, Colony { rod, cells, births: 0, rng }))
}

impl Colony {
    /// Number of rods.
    pub(crate) fn len(&self) -> usize {
        self.cells.len()
    }

    /// Before each step: rods that are long enough divide, and all grow.
    pub(crate) fn grow(&mut self, world: &mut World, inputs: &mut Inputs) -> Result<(), Error> {
        inputs.clear();
        for cell in std::mem::take(&mut self.cells) {
            if cell.length < LONGEST {
                self.cells.push(cell);
                continue;
            }
            self.births += 1;
            self.cells.extend(divide(world, self.rod, &cell, self.births, &mut self.rng)?);
        }
        for cell in &mut self.cells {
            cell.length += cell.length * cell.rate * world.config().dt;
            inputs.activate(cell.id, 0, ((cell.length - SHORTEST) / (LONGEST - SHORTEST)).clamp(0.0, 1.0))?;
        }
        Ok(())
    }
}

/// Discs in a line, each linked to the next two and the ends to each other: straight, and as long as its channel says.
fn rod() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let pitch = SHORTEST / f32::from(DISCS - 1);
    let discs: Vec<u32> = (0..DISCS)
        .map(|k| builder.node(Node::disc(Vec2::new(pitch * f32::from(k) - 0.5 * SHORTEST, 0.0), 0.1, RADIUS)))
        .collect();
    let length = builder.channel([1.0, LONGEST / SHORTEST]);
    let reach = u32::from(DISCS) - 1;
    for apart in [1, 2, reach] {
        for &a in &discs[..discs.len() - apart as usize] {
            let rest_length = pitch * apart as f32;
            builder.muscle(length, Distance { a, b: a + apart, rest_length, compliance: 0.0, damping: 0.0 });
        }
    }
    builder.build()
}

/// A rod of the shortest length, with its mother's number.
fn born(world: &mut World, rod: TemplateId, at: Placement, mother: u128, rng: &mut Rng) -> Result<Cell, Error> {
    let id = world.spawn_template(rod, at)?;
    world.set_user_data(id, mother)?;
    let rate = std::f32::consts::LN_2 / DOUBLING * rng.range(0.8, 1.2);
    Ok(Cell { id, length: SHORTEST, rate })
}

/// Two rods in the place of one. Neighbours that press on it may overlap them at first.
fn divide(world: &mut World, rod: TemplateId, cell: &Cell, number: u128, rng: &mut Rng) -> Result<[Cell; 2], Error> {
    let mother = world.view().organism(cell.id);
    let (centre, angle) = mother.map_or((Vec2::ZERO, 0.0), |rod| (rod.centroid(), rod.angle().unwrap_or(0.0)));
    world.remove(cell.id)?;
    let offset = unit_vector(angle) * (0.5 * SHORTEST + RADIUS);
    let mut daughter = |at: Vec2| {
        let angle = angle + rng.range(-0.02, 0.02);
        born(world, rod, Placement::at(at.x, at.y).turned(angle).overlapping(0.5), number, rng)
    };
    Ok([daughter(centre - offset)?, daughter(centre + offset)?])
}
