//! Two players in one process: arrows steer one cell, a bot the other one, whose messages arrive a fifth of a second late.
//!
//! The bot is expected to go on as it did last. When a message says otherwise, the world goes back to the step of the message and
//! takes the steps since then again.

use super::{Keys, Scene};
use microsim_core::Rng;
use microsim_core::prelude::*;

/// Steps for which a message is under way.
const DELAY: usize = 12;

/// What both want, as it is known for a step: directions.
type Told = [Vec2; 2];

pub(crate) fn scene() -> Scene {
    let mut world = World::new(WorldConfig { size: Vec2::new(96.0, 54.0), ..WorldConfig::default() })?;
    let mut cell = |x| world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(x, 27.0));
    let cells = [cell(25.0)?, cell(70.0)?];
    let mut past = vec![(world.clone(), Told::default()); DELAY];
    let (mut rng, mut wish, mut sent) = (Rng::new(3, 3), Vec2::NEG_X, [Vec2::ZERO; DELAY]);
    let act = move |world: &mut World, inputs: &mut Inputs, Keys { left, right, jump }: Keys| {
        let now = world.step_index() as usize;
        if rng.next_u32().is_multiple_of(40) {
            wish = Vec2::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
        }
        let arrived = std::mem::replace(&mut sent[now % DELAY], wish);
        if now >= DELAY && past[now % DELAY].1[1] != arrived {
            world.clone_from(&past[now % DELAY].0);
            for step in now - DELAY..now {
                let (before, told) = &mut past[step % DELAY];
                before.clone_from(world);
                told[1] = arrived;
                tell(world, inputs, cells, *told)?;
                world.step(inputs);
            }
        }
        let x = f32::from(u8::from(right)) - f32::from(u8::from(left));
        let told = [Vec2::new(x, f32::from(u8::from(jump))), if now >= DELAY { arrived } else { Vec2::ZERO }];
        let (before, kept) = &mut past[now % DELAY];
        before.clone_from(world);
        *kept = told;
        tell(world, inputs, cells, told)
    };
    Ok((world, Box::new(act)))
}

/// Cells go where they are told from where they are.
fn tell(world: &World, inputs: &mut Inputs, cells: [OrganismId; 2], told: Told) -> Result<(), Error> {
    for (id, direction) in cells.into_iter().zip(told) {
        let goal = world.centroid(id).filter(|_| direction != Vec2::ZERO).map(|at| at + 40.0 * direction);
        inputs.set(id, goal.map_or(Ok(Intent::REST), Intent::toward)?);
    }
    Ok(())
}
