//! A scene that a program commands: joints of every kind, motors, muscles, lifts, sensors, emitters, fields, and calls between
//! steps that change all of it. More than 8192 particles, so that threads share the work. Numbers are exact or from the core.

mod build;
mod calls;

use microsim_core::{
    Actuation, EmitterId, Error, FieldId, Inputs, Intent, JointId, ObstacleId, OrganismId, World, glam::Vec2,
};

/// The world of the scene, and what its program knows of it.
#[derive(Clone)]
pub(crate) struct Commanded {
    pub world: World,
    inputs: Inputs,
    /// Bodies of a template with a muscle.
    slimes: Vec<OrganismId>,
    /// Balls in pairs, the two of each joined.
    balls: Vec<OrganismId>,
    joints: Vec<JointId>,
    cell: OrganismId,
    swimmer: OrganismId,
    /// A body that divides.
    rod: OrganismId,
    lift: ObstacleId,
    piston: ObstacleId,
    door: ObstacleId,
    wind: FieldId,
    inlet: EmitterId,
}

impl Commanded {
    /// Takes a step, after what the program does before it.
    ///
    /// # Errors
    /// When a call is refused.
    pub(crate) fn step(&mut self) -> Result<(), Error> {
        let step = self.world.step_index();
        self.call(step)?;
        self.tell(step)?;
        self.world.check_inputs(&self.inputs)?;
        self.world.step(&self.inputs);
        Ok(())
    }

    /// Inputs: intents, forces, impulses, torques, targets, activations.
    fn tell(&mut self, step: u64) -> Result<(), Error> {
        let Self { inputs, slimes, balls, cell, swimmer, world, .. } = self;
        inputs.clear();
        let goal = if step % 60 < 30 { Vec2::new(112.0, 60.0) } else { Vec2::new(80.0, 62.0) };
        inputs.set(*cell, Intent::toward(goal)?.digesting(step % 20 < 10));
        inputs.set(*swimmer, Intent::toward(Vec2::new(104.0, 40.0))?);
        let living = slimes.iter().filter(|&&slime| world.kind(slime).is_some());
        for (k, &slime) in (0u64..).zip(living.clone()) {
            inputs.activate(slime, 0, ((step * 7 + k * 13) % 100) as f32 / 100.0)?;
        }
        for (k, &slime) in living.enumerate().take(20) {
            match k % 4 {
                0 => inputs.actuate(slime, Actuation::force(Vec2::new(40.0, 20.0)))?,
                1 => inputs.actuate(slime, Actuation::torque(60.0))?,
                2 => inputs.actuate_node(slime, 3, Actuation::force(Vec2::new(-5.0, 10.0)))?,
                _ if step % 30 == 5 => inputs.actuate(slime, Actuation::impulse(Vec2::new(0.0, 20.0)))?,
                _ => {}
            }
        }
        let aim = Vec2::new(66.0, 62.0 + (step % 10) as f32 * 0.1);
        inputs.actuate(balls[18], Actuation::target(aim))
    }
}
