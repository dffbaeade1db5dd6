//! Cells that are steered towards prey until something happens.

use super::{happens, tell, toward};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, DivisionParams, Event, IngestionWay, Inputs, Intent, MealPhase, OrganismId,
    OrganismSpec, PhagocytosisParams, RigidCellSpec, World,
};

/// A world, a cell in it and its prey.
pub(crate) type Scene = (World, OrganismId, OrganismId);

pub(crate) const WAYS: [IngestionWay; 2] = [IngestionWay::Gate, IngestionWay::Cup];

/// A cell that divides early.
pub(crate) fn cell_of(radius: f32, phagocytosis: PhagocytosisParams) -> AmoeboidCellSpec {
    let division = DivisionParams { least_particles: 12, least_nodes: 8, ..DivisionParams::default() };
    AmoeboidCellSpec { radii: Vec2::splat(radius), phagocytosis, division, ..AmoeboidCellSpec::default() }
}

/// The default parameters but for the way in.
pub(crate) fn by(way: IngestionWay) -> PhagocytosisParams {
    PhagocytosisParams { way, ..PhagocytosisParams::default() }
}

pub(crate) fn agar() -> OrganismSpec {
    AgarSpec::default().into()
}

pub(crate) fn agar_of(radius: f32) -> OrganismSpec {
    AgarSpec { radius, ..AgarSpec::default() }.into()
}

/// Inputs that make a cell rest and digest.
pub(crate) fn digesting(cell: OrganismId) -> Inputs {
    tell(cell, Intent::REST.digesting(true))
}

/// A rigid cell that is small enough.
pub(crate) fn small_rigid() -> OrganismSpec {
    RigidCellSpec { radii: Vec2::new(5.0, 3.2), ..RigidCellSpec::default() }.into()
}

pub(crate) fn phase(world: &World, cell: OrganismId, prey: OrganismId) -> Option<MealPhase> {
    world.view().organism(cell)?.meals().find(|meal| meal.0 == prey).map(|meal| meal.1)
}

/// Steps towards the prey until `done`, at most `limit` steps; checks every step that nothing is lost or half inside.
pub(crate) fn chase(
    world: &mut World,
    cell: OrganismId,
    prey: OrganismId,
    limit: u32,
    done: impl Fn(&World) -> bool,
) -> Option<u32> {
    for step in 0..limit {
        let inputs = world.centroid(prey).map_or_else(Inputs::new, |at| toward(cell, at));
        world.step(&inputs);
        let census = world.census();
        assert_eq!((census.leaks, census.improper_absorptions), (0, 0), "step {step}");
        if done(world) {
            return Some(step);
        }
    }
    None
}

pub(crate) fn begins(world: &World) -> bool {
    happens(world, |event| matches!(event, Event::IngestionBegan { .. }))
}

pub(crate) fn ingests(world: &World) -> bool {
    happens(world, is_ingested)
}

pub(crate) fn is_ingested(event: &Event) -> bool {
    matches!(event, Event::Ingested { .. })
}

pub(crate) fn is_released(event: &Event) -> bool {
    matches!(event, Event::Released { .. })
}

/// Whether an ingestion has ended in the last step.
pub(crate) fn ends(world: &World) -> bool {
    happens(world, |event| is_ingested(event) || is_released(event))
}
