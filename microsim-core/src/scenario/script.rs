//! Scripts: the `[[command]]` tables, what is done to organisms and when.

use super::reader::document::{NAME, Value, is_name, unknown};
use super::reader::fields::{Fields, Read, Report};
use super::reader::value_type::Shape;
use super::sections::controller::{self, Controllers};
use super::sections::spawn::Group;
use super::supply::Supply;
#[cfg(feature = "snapshot")]
use super::supply::SupplyState;
use crate::error::{Error, ErrorKind};
use crate::id::OrganismId;
use crate::{Event, Inputs, Intent, World};
use glam::Vec2;
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
    supplies: Vec<Supply>,
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

/// One table.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Command {
    path: String,
    of: String,
    at: f32,
    /// Time from one repetition to the next, s.
    every: Option<f32>,
    until: f32,
    actions: Vec<Action>,
}

/// What is done to an organism.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum Action {
    Goal(Goal),
    Digest(bool),
    Grow {
        nodes: u32,
        particles: u32,
    },
    /// The daughter goes by this name.
    Divide(String),
    /// With the one of this name.
    Fuse(String),
    /// To do as the controller of this name says, in place of all that it was told.
    Controller(String),
}

/// Organisms that commands may name.
type Named<'a> = Vec<(String, &'a Group)>;

/// Where an organism is to go.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum Goal {
    Rest,
    Point(Vec2),
    /// Wherever this one is, until somebody takes it in.
    Organism(String),
}

/// What one organism has been told to do until it is told something else.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Order {
    organism: OrganismId,
    goal: Goal,
    digests: bool,
}

type ReadAction = fn(&mut Fields<'_>) -> Option<Action>;

/// The fields that are actions and how they are read.
const ACTIONS: [(&str, ReadAction); 8] = [
    ("goal", |fields| fields.get("goal").map(Goal::Point).map(Action::Goal)),
    ("follow", |fields| fields.get("follow").map(Goal::Organism).map(Action::Goal)),
    ("rest", |fields| fields.get("rest").map(|Always| Action::Goal(Goal::Rest))),
    ("digest", |fields| fields.get("digest").map(Action::Digest)),
    ("grow", grow),
    ("divide", |fields| fields.get("divide").map(Action::Divide)),
    ("fuse", |fields| fields.get("fuse").map(Action::Fuse)),
    ("controller", |fields| fields.get("controller").map(Action::Controller)),
];

impl Script {
    pub(super) fn new(commands: Vec<Command>, controllers: Controllers, named: Vec<(String, OrganismId)>) -> Self {
        Self { commands, controllers, named, ..Self::default() }
    }

    /// The same, with organisms that come later.
    pub(super) fn with_supplies(self, supplies: Vec<Supply>) -> Self {
        Self { supplies, ..self }
    }

    /// What changes of the organisms that come later; the rest of them is in the file.
    #[cfg(feature = "snapshot")]
    pub(crate) fn supply_states(&self) -> impl Iterator<Item = &SupplyState> {
        self.supplies.iter().map(|supply| &supply.state)
    }

    /// Takes the organisms that come later from the script as the file has it, in this state; `None` if it does not fit.
    #[cfg(feature = "snapshot")]
    pub(crate) fn supplied_by(self, file: Self, states: Vec<SupplyState>) -> Option<Self> {
        let fits = file.supplies.len() == states.len();
        let mut supplies = file.supplies;
        supplies.iter_mut().zip(states).for_each(|(supply, state)| supply.state = state);
        fits.then(|| self.with_supplies(supplies))
    }

    /// Whether there is nothing to do.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.commands.is_empty() && self.supplies.is_empty()
    }

    /// Does what is due before the world's next step, and returns the inputs for it. Organisms that have been told where
    /// to go, to rest or to digest no longer follow their controllers.
    pub fn before_step(&mut self, world: &mut World) -> &Inputs {
        self.rename(world.events());
        self.supplies.iter_mut().for_each(|supply| supply.before_step(world));
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
        &self.inputs
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
                    self.named.iter_mut().filter(|(_, id)| *id == from).for_each(|(_, id)| *id = into);
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

impl Command {
    /// Whether it is to be done before the world's next step.
    fn is_due(&self, world: &World) -> bool {
        let steps = |time: f32| (f64::from(time) / f64::from(world.config().dt)).round() as u64;
        let Some(since) = world.step_index().checked_sub(steps(self.at)) else { return false };
        match self.every.map(|every| steps(every).max(1)) {
            Some(every) => since.is_multiple_of(every) && world.step_index() <= steps(self.until),
            None => since == 0,
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} was refused before step {} ({:.2} s): {}", self.command, self.step + 1, self.time, self.error)
    }
}

/// Reads the `[[command]]` tables.
pub(super) fn read(root: &mut Fields<'_>, groups: &[Group], controllers: &Controllers, duration: f32) -> Vec<Command> {
    let mut named: Named<'_> = groups.iter().filter_map(|group| Some((group.name.clone()?, group))).collect();
    let mut commands = Vec::new();
    for mut fields in root.list("command") {
        let command = read_command(&mut fields, &named, duration);
        controller::read_named(&mut fields, "controller", controllers);
        fields.finish();
        let daughter = command.as_ref().and_then(|command| daughter(command, &named));
        named.extend(daughter);
        commands.extend(command);
    }
    commands
}

/// The daughter that a command makes: later ones may name it.
fn daughter<'a>(command: &Command, named: &Named<'a>) -> Option<(String, &'a Group)> {
    let name = command.actions.iter().find_map(|action| match action {
        Action::Divide(name) => Some(name.clone()),
        _ => None,
    });
    Some((name?, find(&command.of, named)?))
}

fn find<'a>(name: &str, named: &Named<'a>) -> Option<&'a Group> {
    named.iter().find(|(known, _)| known == name).map(|(_, group)| *group)
}

fn read_command(fields: &mut Fields<'_>, named: &Named<'_>, duration: f32) -> Option<Command> {
    let at = fields.number("at", 0.0, [0.0, 1e6]);
    let of = fields.required::<String>("of");
    let every = fields.get("every").filter(|&every| fields.is_within("every", every, [0.001, 1e6]));
    let until = fields.get("until").filter(|&until| fields.is_within("until", until, [at, 1e6]));
    let until = until.unwrap_or(if duration > at { duration } else { at });
    let path = fields.path.clone();
    let actions: Vec<Action> = ACTIONS.into_iter().filter_map(|(_, read)| read(fields)).collect();
    if !ACTIONS.iter().any(|(field, _)| fields.has(field)) {
        let known = ACTIONS.map(|(field, _)| field).join(", ");
        fields.report.refuse(&fields.path, "does nothing", format!("at least one of {known}"));
    }
    let refuse = |field: &str, (message, accepted): (String, String)| {
        fields.report.refuse(&fields.at(field), message, accepted);
    };
    if fields.has("until") && !fields.has("every") {
        refuse("until", ("does nothing by itself".to_owned(), "`until` with `every`".to_owned()));
    }
    let names: Vec<&str> = named.iter().map(|(name, _)| name.as_str()).collect();
    let of = of?;
    match find(&of, named) {
        None => refuse("of", unknown("organism", &of, &names)),
        Some(group) => check_actions(fields, &actions, group),
    }
    for action in &actions {
        match action {
            Action::Goal(Goal::Organism(name)) if !names.contains(&name.as_str()) => {
                refuse("follow", unknown("organism", name, &names));
            }
            Action::Fuse(name) if !names.contains(&name.as_str()) => refuse("fuse", unknown("organism", name, &names)),
            Action::Divide(name) if !is_name(name) => {
                refuse("divide", ("not a usable name".to_owned(), NAME.to_owned()));
            }
            Action::Divide(name) if names.contains(&name.as_str()) => {
                let accepted = "a name for the daughter that no other organism has".to_owned();
                refuse("divide", (format!("the name `{name}` is taken"), accepted));
            }
            _ => {}
        }
    }
    Some(Command { path, of, at, every, until, actions })
}

/// Checks that an organism can do what is asked of it.
fn check_actions(fields: &Fields<'_>, actions: &[Action], group: &Group) {
    let refuse = |field: &str, what: &str, accepted: &str| {
        let message = format!("`{}` cannot {what}", group.prototype.name);
        fields.report.refuse(&fields.at(field), message, accepted);
    };
    for action in actions {
        match action {
            Action::Goal(_) | Action::Controller(_) if !group.prototype.can_move() => {
                let field = ["goal", "follow", "rest", "controller"].into_iter().find(|field| fields.has(field));
                refuse(field.unwrap_or_default(), "move", "an amoeboid_cell, a rigid_cell or a probe");
            }
            Action::Digest(_) if !group.prototype.can_grow() => refuse("digest", "digest", "an amoeboid_cell"),
            Action::Grow { .. } if !group.prototype.can_grow() => refuse("grow", "grow", "an amoeboid_cell"),
            Action::Divide(_) if !group.prototype.can_grow() => refuse("divide", "divide", "an amoeboid_cell"),
            Action::Fuse(_) if !group.prototype.can_grow() => refuse("fuse", "fuse", "an amoeboid_cell"),
            _ => {}
        }
    }
}

fn grow(fields: &mut Fields<'_>) -> Option<Action> {
    let is_asked = fields.has("grow");
    let mut amount = fields.table("grow");
    let (nodes, particles) = (amount.or("nodes", 0), amount.or("particles", 0));
    amount.finish();
    is_asked.then_some(Action::Grow { nodes, particles })
}

/// `true`, the only value of a field that stands for an action without more to say.
struct Always;

impl Read for Always {
    fn accepted() -> String {
        "true".to_owned()
    }

    fn shape() -> Shape {
        Shape::Boolean
    }

    fn written(&self) -> String {
        "true".to_owned()
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        match value.get_ref().as_bool() {
            Some(true) => Some(Self),
            _ => super::reader::fields::mismatch(value, path, report),
        }
    }
}
