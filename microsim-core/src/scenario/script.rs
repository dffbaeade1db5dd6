//! Scripts: commands are done at their time, and spawners bring the organisms that come later.

use super::sections::command::{Action, Command, Goal};
use super::sections::controller::Controllers;
use super::spawner::Spawner;
#[cfg(feature = "snapshot")]
use super::spawner::SpawnerState;
use crate::error::{Error, ErrorKind};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use crate::{Event, Inputs, Intent, World};
use serde::{Deserialize, Serialize};
use std::fmt;

/// The commands of a scenario, and the organisms that come later. Ask it for the inputs before every step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Script {
    commands: Vec<Command>,
    controllers: Controllers,
    named: Vec<(String, OrganismId)>,
    /// Who is to divide, and the names for the daughters.
    dividing: Vec<(OrganismId, String)>,
    orders: Vec<Order>,
    #[serde(skip)]
    spawners: Vec<Spawner>,
    inputs: Inputs,
    refusals: Vec<Refusal>,
}

/// A command that the world refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refusal {
    /// Path of the command in the file, for example `command.2`.
    pub command: String,
    /// Number of steps taken then.
    pub step: u64,
    /// Simulated time then, s.
    pub time: f64,
    /// What the world said.
    pub error: Error,
}

/// What one organism has been told to do until it is told something else.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Order {
    organism: OrganismId,
    goal: Goal,
    digests: bool,
}

impl Script {
    pub(super) fn new(commands: Vec<Command>, controllers: Controllers, named: Vec<(String, OrganismId)>) -> Self {
        Self { commands, controllers, named, ..Self::default() }
    }

    /// The same, with organisms that come later.
    pub(super) fn with_spawners(self, spawners: Vec<Spawner>) -> Self {
        Self { spawners, ..self }
    }

    /// What changes of the organisms that come later; the rest of them is in the file.
    #[cfg(feature = "snapshot")]
    pub(crate) fn spawner_states(&self) -> impl Iterator<Item = &SpawnerState> {
        self.spawners.iter().map(|spawner| &spawner.state)
    }

    /// Takes the organisms that come later from the script as the file has it, in this state; `None` if it does not fit.
    #[cfg(feature = "snapshot")]
    pub(crate) fn with_spawner_states(self, file: Self, states: Vec<SpawnerState>) -> Option<Self> {
        let fits = file.spawners.len() == states.len();
        let mut spawners = file.spawners;
        for (spawner, state) in spawners.iter_mut().zip(states) {
            spawner.state = state;
        }
        fits.then(|| self.with_spawners(spawners))
    }

    /// Whether there is nothing to do.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.commands.is_empty() && self.spawners.is_empty()
    }

    /// Does what is due before the world's next step, and returns the inputs for it. Organisms that have been told where
    /// to go, to rest or to digest no longer follow their controllers.
    pub fn before_step(&mut self, world: &mut World) -> &Inputs {
        // A replay has the script, and so needs no record of what that does.
        let is_recording = world.record_changes(false);
        with_default_float_environment(|| self.do_what_is_due(world));
        world.record_changes(is_recording);
        &self.inputs
    }

    fn do_what_is_due(&mut self, world: &mut World) {
        self.rename(world.events());
        for spawner in &mut self.spawners {
            spawner.before_step(world);
        }
        let commands = std::mem::take(&mut self.commands);
        for command in &commands {
            let due = if command.is_due(world) { &command.actions[..] } else { &[] };
            for action in due {
                if let Err(error) = self.act(command, action, world) {
                    self.refuse(command, world, error);
                }
            }
        }
        self.commands = commands;
        self.inputs.clear();
        for Order { organism, goal, digests } in &self.orders {
            let place = match goal {
                Goal::Rest => None,
                Goal::Point(point) => Some(*point),
                Goal::Organism(name) => {
                    self.organism(name).filter(|&id| is_free(id, world)).and_then(|id| world.centroid(id))
                }
            };
            let way = place.and_then(|place| Intent::toward(place).ok());
            self.inputs.set(*organism, way.unwrap_or(Intent::REST).digesting(*digests));
        }
    }

    /// Names daughters of divisions, and lets those that have fused go by the names of both.
    fn rename(&mut self, events: &[Event]) {
        for event in events {
            match *event {
                Event::Divided { parent, daughter } => {
                    let names = self.dividing.extract_if(.., |(cell, _)| *cell == parent);
                    self.named.extend(names.map(|(_, name)| (name, daughter)));
                }
                Event::Fused { into, from } => {
                    for (_, id) in self.named.iter_mut().filter(|(_, id)| *id == from) {
                        *id = into;
                    }
                }
                _ => {}
            }
        }
    }

    /// What the world refused, the first time for each command.
    #[must_use]
    pub fn refusals(&self) -> &[Refusal] {
        &self.refusals
    }

    fn act(&mut self, command: &Command, action: &Action, world: &mut World) -> Result<(), Error> {
        let id = self.organism(&command.of).filter(|&id| world.kind(id).is_some());
        let id = id.ok_or_else(|| Error::new(ErrorKind::Stale, command.of.clone()))?;
        match action {
            Action::Goal(goal) => self.order(id).goal = goal.clone(),
            Action::Digest(digests) => self.order(id).digests = *digests,
            Action::Grow { nodes, particles } => world.grow(id, *nodes, *particles)?,
            Action::Divide(daughter) => {
                world.divide(id)?;
                self.dividing.retain(|(cell, _)| *cell != id);
                self.dividing.push((id, daughter.clone()));
            }
            Action::Fuse(other) => {
                let with = self.organism(other).ok_or_else(|| Error::new(ErrorKind::Stale, other.clone()))?;
                // They may be one by now.
                if with != id {
                    world.fuse(id, with)?;
                }
            }
            Action::Controller(name) => {
                world.set_controller(id, self.controllers.get(name).cloned().unwrap_or_default())?;
                self.orders.retain(|order| order.organism != id);
            }
        }
        Ok(())
    }

    fn organism(&self, name: &str) -> Option<OrganismId> {
        self.named.iter().rfind(|(known, _)| known == name).map(|(_, id)| *id)
    }

    /// What an organism has been told, to be changed.
    fn order(&mut self, organism: OrganismId) -> &mut Order {
        let known = self.orders.iter().position(|order| order.organism == organism);
        let at = known.unwrap_or_else(|| {
            self.orders.push(Order { organism, goal: Goal::Rest, digests: false });
            self.orders.len() - 1
        });
        &mut self.orders[at]
    }

    fn refuse(&mut self, command: &Command, world: &World, error: Error) {
        if self.refusals.iter().all(|refusal| refusal.command != command.path) {
            let (command, step, time) = (command.path.clone(), world.step_index(), world.time());
            self.refusals.push(Refusal { command, step, time, error });
        }
    }
}

fn is_free(id: OrganismId, world: &World) -> bool {
    world.view().organism(id).is_some_and(|organism| organism.held_by().is_none())
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} was refused before step {} ({:.2} s): {}", self.command, self.step + 1, self.time, self.error)
    }
}
