//! Rods that grow and divide.
//!
//! A rod is a template whose one channel is its length, with a cut into two. What it does is a rule of this program: the length of each
//! rod grows exponentially, its mass with it, and a rod that is long enough for two divides.

use microsim_core::prelude::*;
use microsim_core::{Distance, Half, Rng};

/// Half a rod's width, units.
const RADIUS: f32 = 0.5;
/// Discs of a rod; the longest rod has them 1.4 radii apart.
const DISCS: u8 = 8;
/// Distance of the first disc from the last at birth, and at division: the centres of its halves are then as far apart as those of two
/// rods that touch.
const SHORTEST: f32 = 1.8;
const LONGEST: f32 = 1.75 * (SHORTEST + 2.0 * RADIUS);
/// Mass of a rod for each unit of its length.
const DENSITY: f32 = 0.4;
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
    cells: Vec<Cell>,
    rng: Rng,
}

/// A room with one rod in it.
pub(crate) fn colony() -> Result<(World, Colony), Error> {
    let mut world = World::new(WorldConfig { size: Vec2::splat(120.0), damping: 8.0, ..WorldConfig::default() })?;
    let rod = world.add_template(rod()?);
    let mut colony = Colony { cells: Vec::new(), rng: Rng::new(1, 1) };
    colony.begin(world.spawn_template(rod, Placement::at(60.0, 60.0))?);
    Ok((world, colony))
}

impl Colony {
    /// Before each step: those that have divided begin anew, and all grow.
    pub(crate) fn grow(&mut self, world: &mut World, inputs: &mut Inputs) -> Result<(), Error> {
        for event in world.events().to_vec() {
            if let Event::Divided { parent, daughter } = event {
                self.cells.retain(|cell| cell.id != parent);
                [parent, daughter].into_iter().for_each(|id| self.begin(id));
                // Without a nudge all would stay in one line.
                world.push(daughter, Vec2::new(self.rng.range(-0.5, 0.5), self.rng.range(-0.5, 0.5)))?;
            }
        }
        inputs.clear();
        for cell in &mut self.cells {
            cell.length += cell.length * cell.rate * world.config().dt;
            inputs.activate(cell.id, 0, ((cell.length - SHORTEST) / (LONGEST - SHORTEST)).clamp(0.0, 1.0))?;
            world.set_mass(cell.id, DENSITY * cell.length)?;
            if cell.length > LONGEST {
                // Where neighbours press too much it is refused, and asked again in the next step.
                let _ = world.divide(cell.id);
            }
        }
        Ok(())
    }

    fn begin(&mut self, id: OrganismId) {
        let rate = std::f32::consts::LN_2 / DOUBLING * self.rng.range(0.8, 1.2);
        self.cells.push(Cell { id, length: SHORTEST, rate });
    }
}

/// Discs in a line, each linked to the next two and the ends to each other: straight, and as long as its channel says.
fn rod() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let pitch = SHORTEST / f32::from(DISCS - 1);
    let discs: Vec<u32> =
        (0..DISCS).map(|k| builder.node(Node::disc(Vec2::new(pitch * f32::from(k), 0.0), 0.1, RADIUS))).collect();
    let length = builder.channel([1.0, LONGEST / SHORTEST]);
    for apart in [1, 2, discs.len() - 1] {
        for part in discs.windows(apart + 1) {
            let [a, b] = [part[0], part[apart]];
            let rest_length = pitch * apart as f32;
            builder.muscle(length, Distance { a, b, rest_length, compliance: 0.0, damping: 0.0 });
        }
    }
    let (left, right) = discs.split_at(discs.len() / 2);
    builder.cut([left, right].map(|slots| Half::of(slots.iter().copied())));
    builder.build()
}
