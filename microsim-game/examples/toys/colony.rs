//! Rods that grow and divide: one becomes 500.

#[path = "../../../microsim-core/examples/colony/rods.rs"]
mod rods;

use super::Scene;
use microsim_core::prelude::*;

pub(crate) fn scene() -> Scene {
    let (world, mut colony) = rods::colony()?;
    let act = move |world: &mut World, inputs: &mut Inputs, _| {
        if world.organisms().count() < rods::COLONY { colony.grow(world, inputs) } else { Ok(()) }
    };
    Ok((world, Box::new(act)))
}
