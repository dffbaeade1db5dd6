//! A narrowed vessel: emitters at its left end, an open side at its right one, and a field that drives what is in it.

use microsim_core::prelude::*;
use microsim_core::{FieldKind, Region, Side, Sides};

const SIZE: Vec2 = Vec2::new(128.0, 40.0);

/// The vessel, empty, and from now on blood flows into it: red cells, and among them small discs as platelets at rest are.
pub(crate) fn vessel() -> Result<World, Error> {
    let sides = Sides { right: Side::Open, ..Sides::default() };
    let mut world = World::new(WorldConfig { size: SIZE, damping: 1.0, sides, ..WorldConfig::default() })?;
    for y in [-10.0, SIZE.y + 10.0] {
        let bulge = SharedShape::ball(21.0);
        world.add_obstacle(Obstacle::new(bulge, Pose::translation(0.5 * SIZE.x, y)))?;
    }
    let acceleration = Vec2::new(40.0, 0.0);
    world.add_field(ForceField { region: Region::All, kind: FieldKind::Uniform { acceleration } })?;
    let inlet = Region::Box { low: Vec2::new(5.0, 5.0), high: Vec2::new(10.0, SIZE.y - 5.0) };
    let disc = AgarSpec { radius: 1.0, ..AgarSpec::default() };
    for (what, rate) in [(OrganismSpec::from(RedCellSpec::default()), 4.0), (disc.into(), 2.0)] {
        let emitter = Emitter::new(inlet, Recipe::Organism(what), rate);
        world.add_emitter(Emitter { velocity: Vec2::new(8.0, 0.0), ..emitter })?;
    }
    Ok(world)
}
