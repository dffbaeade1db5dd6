//! `trajectories`: place, speed and area of every organism over time.

use super::Rhythm;
use super::table::{Cell, DataTable};
use crate::failure::Failure;
use crate::summary::{handle, rounded};
use microsim_core::geometry::signed_area;
use microsim_core::glam::Vec2;
use microsim_core::{OrganismId, OrganismView, World};

/// One row per organism and sample.
pub(super) const COLUMNS: [&str; 9] = ["step", "time", "organism", "kind", "name", "x", "y", "speed", "area"];

#[derive(Debug)]
pub(super) struct Trajectories {
    pub table: DataTable,
    names: Vec<(String, OrganismId)>,
    rhythm: Rhythm,
}

impl Trajectories {
    pub(super) fn new(table: DataTable, names: &[(String, OrganismId)], rhythm: Rhythm) -> Self {
        Self { table, names: names.to_vec(), rhythm }
    }

    pub(super) fn look_at(&mut self, world: &World) -> Result<(), Failure> {
        if !self.rhythm.is_due(world) {
            return Ok(());
        }
        for organism in world.view().organisms() {
            let id = organism.id();
            let name = self.names.iter().find(|(_, named)| *named == id).map_or("", |(name, _)| name);
            let centre = world.centroid(id).unwrap_or(Vec2::NAN);
            self.table.add(&[
                Cell::Whole(world.step_index()),
                Cell::Double(rounded(world.time())),
                Cell::Text(&handle(id)),
                Cell::Text(organism.kind().name()),
                Cell::Text(name),
                Cell::Single(centre.x),
                Cell::Single(centre.y),
                Cell::Single(speed(organism)),
                Cell::Single(area(organism)),
            ])?;
        }
        Ok(())
    }
}

/// Of its particles' mean velocity, units/s.
fn speed(organism: OrganismView<'_>) -> f32 {
    let (sum, count) = organism.particles().fold((Vec2::ZERO, 0.0), |(sum, count), p| (sum + p.velocity, count + 1.0));
    if count > 0.0 { (sum / count).length() } else { 0.0 }
}

/// The area within its outline; without one, the area at its spawn.
fn area(organism: OrganismView<'_>) -> f32 {
    let outline: Vec<Vec2> = organism.outline().collect();
    if outline.len() < 3 { organism.spawn_area() } else { signed_area(&outline).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{AgarSpec, AmoeboidCellSpec, Inputs, OrganismSpec, Placement, WorldConfig};

    fn alone(spec: OrganismSpec) -> (World, OrganismId) {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&spec, Placement::at(40.0, 40.0)).unwrap();
        (world, id)
    }

    #[test]
    fn the_speed_is_that_of_the_whole_organism() {
        let (mut world, cell) = alone(AmoeboidCellSpec::default().into());
        world.push(cell, Vec2::new(3.0, -4.0)).unwrap();
        let speed = speed(world.view().organism(cell).unwrap());
        assert!((speed - 5.0).abs() < 1e-4, "{speed}");
    }

    #[test]
    fn the_area_is_that_within_the_outline_or_of_the_disc() {
        let (world, food) = alone(AgarSpec { radius: 2.0, ..AgarSpec::default() }.into());
        let disc = area(world.view().organism(food).unwrap());
        assert!((disc - 4.0 * std::f32::consts::PI).abs() < 1e-4, "{disc}");
        let (mut world, cell) = alone(AmoeboidCellSpec::default().into());
        let round = area(world.view().organism(cell).unwrap());
        world.grow(cell, 12, 24).unwrap();
        (0..240).for_each(|_| world.step(&Inputs::new()));
        let grown = area(world.view().organism(cell).unwrap());
        assert!(grown > 1.05 * round, "{grown} after {round}");
    }
}
