//! Commands: the tables `[[command]]`, what is done to organisms and when.

use crate::World;
use crate::scenario::reader::{Fields, NAME, Read, ReadContext, SpannedValue, ValueType, is_name, mismatch};
use crate::scenario::sections::controller::{self, Controllers};
use crate::scenario::sections::group::Group;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One table.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Command {
    pub path: String,
    pub of: String,
    pub at: f32,
    /// Time from one repetition to the next, s.
    pub every: Option<f32>,
    pub until: f32,
    pub actions: Vec<Action>,
}

/// What is done to an organism.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Action {
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

/// Where an organism is to go.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Goal {
    Rest,
    Point(Vec2),
    /// Wherever this one is, until somebody takes it in.
    Organism(String),
}

/// Organisms that commands may name.
type Named<'a> = BTreeMap<String, &'a Group>;

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

impl Command {
    /// Whether it is to be done before the world's next step.
    pub(crate) fn is_due(&self, world: &World) -> bool {
        let steps = |time: f32| (f64::from(time) / f64::from(world.config().dt)).round() as u64;
        let Some(since) = world.step_index().checked_sub(steps(self.at)) else { return false };
        match self.every.map(|every| steps(every).max(1)) {
            Some(every) => since.is_multiple_of(every) && world.step_index() <= steps(self.until),
            None => since == 0,
        }
    }
}

/// Reads the `[[command]]` tables.
pub(crate) fn read(root: &mut Fields<'_>, groups: &[Group], controllers: &Controllers, duration: f32) -> Vec<Command> {
    let mut named = Named::new();
    for group in groups {
        group.name.iter().for_each(|name| _ = named.entry(name.clone()).or_insert(group));
    }
    let mut commands = Vec::new();
    for mut fields in root.list("command") {
        let command = read_command(&mut fields, &named, duration);
        controller::read_named(&mut fields, "controller", controllers);
        fields.finish();
        if let Some((name, group)) = command.as_ref().and_then(|command| daughter(command, &named)) {
            named.entry(name).or_insert(group);
        }
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
    named.get(name).copied()
}

fn read_command(fields: &mut Fields<'_>, named: &Named<'_>, duration: f32) -> Option<Command> {
    let at = fields.number("at", 0.0, [0.0, 1e6]);
    let of = fields.required::<String>("of");
    let every = fields.number_within("every", [0.001, 1e6]);
    let until = fields.number_within("until", [at, 1e6]).unwrap_or(if duration > at { duration } else { at });
    let path = fields.path.clone();
    let actions: Vec<Action> = ACTIONS.into_iter().filter_map(|(_, read)| read(fields)).collect();
    if !ACTIONS.iter().any(|(field, _)| fields.has(field)) {
        let known = ACTIONS.map(|(field, _)| field).join(", ");
        fields.context.refuse(&fields.path, "does nothing", format!("at least one of {known}"));
    }
    if fields.has("until") && !fields.has("every") {
        fields.refuse("until", "does nothing by itself", "`until` with `every`");
    }
    let of = of?;
    match find(&of, named) {
        None => refuse_unknown(fields, "of", &of, named),
        Some(group) => check_actions(fields, &actions, group),
    }
    check_names(fields, &actions, named);
    Some(Command { path, of, at, every, until, actions })
}

/// Checks the names of other organisms in what is to be done.
fn check_names(fields: &Fields<'_>, actions: &[Action], named: &Named<'_>) {
    for action in actions {
        match action {
            Action::Goal(Goal::Organism(name)) if find(name, named).is_none() => {
                refuse_unknown(fields, "follow", name, named);
            }
            Action::Fuse(name) if find(name, named).is_none() => refuse_unknown(fields, "fuse", name, named),
            Action::Divide(name) if !is_name(name) => fields.refuse("divide", "not a usable name", NAME),
            Action::Divide(name) if find(name, named).is_some() => {
                let accepted = "a name for the daughter that no other organism has";
                fields.refuse("divide", format!("the name `{name}` is taken"), accepted);
            }
            _ => {}
        }
    }
}

fn refuse_unknown(fields: &Fields<'_>, field: &str, name: &str, named: &Named<'_>) {
    fields.refuse_unknown(field, "organism", name, named.keys().map(String::as_str));
}

/// Checks that an organism can do what is asked of it.
fn check_actions(fields: &Fields<'_>, actions: &[Action], group: &Group) {
    let refuse = |field: &str, what: &str, accepted: &str| {
        let message = format!("`{}` cannot {what}", group.prototype.name);
        fields.refuse(field, message, accepted);
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

    fn value_type() -> ValueType {
        ValueType::Boolean
    }

    fn written(&self) -> String {
        "true".to_owned()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        match value.get_ref().as_bool() {
            Some(true) => Some(Self),
            _ => mismatch(value, path, context),
        }
    }
}
