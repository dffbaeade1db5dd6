//! The least that an embedder needs: a world, a cell, something to go to, and a loop.
//!
//! `cargo run -p microsim-core --example embed_minimal`

use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Error, Event, Inputs, Intent, Placement, World, WorldConfig, glam::Vec2,
};

fn main() -> Result<(), Error> {
    let mut world = World::new(WorldConfig { size: Vec2::new(100.0, 60.0), seed: 7, ..WorldConfig::default() })?;
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(25.0, 30.0))?;
    let agar = world.spawn(&AgarSpec::default().into(), Placement::at(75.0, 35.0))?;

    let mut inputs = Inputs::new();
    while !has_met(&world) {
        // The cell follows the agar.
        let goal = world.centroid(agar).unwrap_or(Vec2::ZERO);
        inputs.set(cell, Intent::toward(goal)?);
        world.step(&inputs);
        assert!(world.time() < 20.0, "the cell does not get there");
    }
    let front = world.view().organism(cell).and_then(|cell| cell.front());
    println!("contact after {:.2} s, front at {front:?}", world.time());
    println!("digest {:016x}", world.digest());
    Ok(())
}

/// Whether the last step reported that two organisms began to touch.
fn has_met(world: &World) -> bool {
    world.events().iter().any(|event| matches!(event, Event::ContactBegan { .. }))
}
