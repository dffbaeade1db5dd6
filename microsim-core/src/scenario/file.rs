//! The whole file: from a tree of values to what a scenario is made of.

use super::diagnostic::Diagnostics;
use super::reader::document::Source;
use super::reader::fields::{Fields, Report};
use super::script::{self, Command};
use super::sections::checks::{self, Checks};
use super::sections::chemical::{self, Chemicals};
use super::sections::controller::{self, Controllers};
use super::sections::field::GridPlan;
use super::sections::game::{self, Game};
use super::sections::obstacle;
use super::sections::output::{self, OutputPlan};
use super::sections::prototype::{self, Prototype};
use super::sections::spawn::{self, Group, Surroundings};
use crate::WorldConfig;
use crate::collision::obstacle::Obstacle;
use crate::error::Error;
use glam::Vec2;
use toml::de::DeTable;

/// Version of the format.
const SCHEMA: u32 = 1;
/// Simulated time of a scenario that does not say, s.
const DURATION: f32 = 10.0;

/// What a file says, checked.
#[derive(Clone, Debug)]
pub(super) struct File {
    pub name: String,
    pub description: String,
    pub duration: f32,
    pub config: WorldConfig,
    pub chemicals: Chemicals,
    pub obstacles: Vec<Obstacle>,
    pub groups: Vec<Group>,
    pub controllers: Controllers,
    pub commands: Vec<Command>,
    pub checks: Checks,
    pub output: OutputPlan,
    pub game: Option<Game>,
}

/// Reads a file. Reports all that is wrong with it, as far as one thing does not follow from another.
pub(super) fn read(table: &DeTable<'_>, source: &Source) -> Result<File, Diagnostics> {
    let report = Report::new(source);
    let file = read_root(table, &report);
    Diagnostics::check(report.found.into_inner())?;
    Ok(file)
}

/// Reads the table of the whole file. What is wrong is in the report.
pub(super) fn read_root(table: &DeTable<'_>, report: &Report<'_>) -> File {
    let mut root = Fields::root(table, report);
    read_schema(&mut root);
    root.table("parameters");
    let (name, description) = (root.or("name", String::new()), root.or("description", String::new()));
    let duration = root.number("duration", DURATION, [0.0, 1e6]);
    let (config, size) = read_config(&mut root);
    let prototypes = prototype::read(&mut root);
    let plans = spawn::read_fields(&mut root, &prototypes);
    let size = size.or_else(|| room_for(&plans, report)).unwrap_or(config.size);
    let config = WorldConfig { size, ..config };
    let obstacles = obstacle::read(&mut root, size);
    let chemicals = chemical::read(&mut root, &config);
    let controllers = controller::read(&mut root, size, &chemicals);
    let around = Surroundings { prototypes: &prototypes, controllers: &controllers, chemicals: &chemicals, size };
    let mut groups = spawn::read_spawns(&mut root, &around);
    groups.extend(lay_out(plans, size, report));
    let commands = script::read(&mut root, &groups, &controllers, duration);
    let checks = checks::read(&mut root);
    let output = output::read(&mut root);
    let game = game::read(&mut root, &groups);
    root.finish();
    spawn::check_size(&groups, config.max_particles, report);
    File {
        name,
        description,
        duration,
        config,
        chemicals,
        obstacles,
        groups,
        controllers,
        commands,
        checks,
        output,
        game,
    }
}

fn read_schema(root: &mut Fields<'_>) {
    if let Some(schema) = root.required::<u32>("schema").filter(|schema| *schema != SCHEMA) {
        let message = format!("version {schema} of the format is not known");
        root.report.refuse("schema", message, SCHEMA.to_string());
    }
}

/// The settings of the world but for its size, and the size if the file has it. What is wrong falls back to the default.
fn read_config(root: &mut Fields<'_>) -> (WorldConfig, Option<Vec2>) {
    let default = WorldConfig::default();
    let seed = root.or("seed", default.seed);
    let (mut step, mut world) = (root.table("step"), root.table("world"));
    let is_sized_by_field = root.has("field") && !world.has("size");
    if !is_sized_by_field {
        world.require("size", "[x, y], two numbers, or a [[field]] that sizes the room");
    }
    let mut size = None;
    let read = || {
        size = world.get::<Vec2>("size");
        let config = WorldConfig {
            size: size.unwrap_or(default.size),
            dt: step.or("dt", default.dt),
            substeps: step.or("substeps", default.substeps),
            gravity: world.or("gravity", default.gravity),
            damping: world.or("damping", default.damping),
            max_speed: world.or("max_speed", default.max_speed),
            seed,
            protects_membranes: world.or("protects_membranes", default.protects_membranes),
            sleeps: world.or("sleeps", default.sleeps),
            max_particles: world.or("max_particles", default.max_particles),
        };
        let table = |error: &Error| if matches!(error.field(), "dt" | "substeps") { "step" } else { "world" };
        config.validate().map(|()| config).map_err(|error| error.clone().within(table(&error)))
    };
    let config = root.report.check_all("", read).unwrap_or_default();
    step.finish();
    world.finish();
    let size = if is_sized_by_field { None } else { Some(config.size) };
    (config, size)
}

/// Size of the room that holds every field.
fn room_for(plans: &[(String, Prototype, GridPlan)], report: &Report<'_>) -> Option<Vec2> {
    let mut room = Vec2::ONE;
    for (path, _, plan) in plans {
        let wanted = plan.room();
        if wanted.cmpgt(Vec2::splat(WorldConfig::MAX_SIZE)).any() {
            let message = format!("needs a room of {:.0} by {:.0}", wanted.x, wanted.y);
            report.refuse(&format!("{path}.count"), message, format!("at most {0} by {0}", WorldConfig::MAX_SIZE));
            return None;
        }
        room = Vec2::select(wanted.cmpgt(room), wanted, room);
    }
    Some(room)
}

fn lay_out(plans: Vec<(String, Prototype, GridPlan)>, size: Vec2, report: &Report<'_>) -> Vec<Group> {
    let mut groups = Vec::new();
    for (path, prototype, plan) in plans {
        let wanted = plan.room();
        match plan.fit(size) {
            Some(grid) => groups.push(Group::on_grid(path, prototype, grid)),
            None => {
                let message = format!("does not fit into the room of {} by {}", size.x, size.y);
                let accepted = format!("a room of about {:.1} by {:.1}, or fewer", wanted.x, wanted.y);
                report.refuse(&format!("{path}.count"), message, accepted);
            }
        }
    }
    groups
}
