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
