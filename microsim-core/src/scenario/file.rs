//! The whole file: the order in which its sections are read.

use super::diagnostic::Diagnostics;
use super::reader::{Document, Fields, ReadContext};
use super::sections::checks::{self, Checks};
use super::sections::chemical::{self, Chemicals};
use super::sections::command::{self, Command};
use super::sections::controller::{self, Controllers};
use super::sections::game::{self, Game};
use super::sections::group::{self, Group};
use super::sections::medium;
use super::sections::output::{self, OutputPlan};
use super::sections::slide::{self, Slide};
use super::sections::spawn::{self, Definitions};
use super::sections::supply::{self, Supplies};
use super::sections::{field, obstacle, prototype, world};
use crate::collision::obstacle::Obstacle;
use crate::{ForceField, WorldConfig};
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
    pub medium: Option<ForceField>,
    pub chemicals: Chemicals,
    pub obstacles: Vec<Obstacle>,
    pub groups: Vec<Group>,
    pub supplies: Supplies,
    pub controllers: Controllers,
    pub commands: Vec<Command>,
    pub checks: Checks,
    pub output: OutputPlan,
    pub game: Option<Game>,
    pub slide: Option<Slide>,
}

/// Reads a file. Reports every error that does not follow from another one.
pub(super) fn read(table: &DeTable<'_>, document: &Document) -> Result<File, Diagnostics> {
    let context = ReadContext::new(document);
    let file = read_root(table, &context);
    context.finish()?;
    Ok(file)
}

/// Reads the table of the whole file. What is wrong is in the context.
pub(super) fn read_root(table: &DeTable<'_>, context: &ReadContext<'_>) -> File {
    let mut root = Fields::root(table, context);
    read_schema(&mut root);
    root.table("parameters");
    let (name, description) = (root.or("name", String::new()), root.or("description", String::new()));
    let duration = root.number("duration", DURATION, [0.0, 1e6]);
    let (config, size) = world::read(&mut root);
    let prototypes = prototype::read(&mut root);
    let plans = field::read(&mut root, &prototypes);
    let size = size.or_else(|| field::room_for(&plans, context)).unwrap_or(config.size);
    let config = WorldConfig { size, ..config };
    let obstacles = obstacle::read(&mut root, size);
    let medium = medium::read(&mut root);
    let chemicals = chemical::read(&mut root, &config, &obstacles);
    let controllers = controller::read(&mut root, size, &chemicals);
    let definitions = Definitions {
        prototypes: &prototypes,
        controllers: &controllers,
        chemicals: &chemicals,
        config: &config,
        size,
    };
    let mut groups = spawn::read(&mut root, &definitions);
    groups.extend(field::lay_out(plans, size, context));
    let supplies = supply::read(&mut root, &definitions);
    let commands = command::read(&mut root, &groups, &controllers, duration);
    let checks = checks::read(&mut root);
    let output = output::read(&mut root);
    let game = game::read(&mut root, &groups);
    let slide = slide::read(&mut root, &groups, size);
    root.finish();
    group::check_size(&groups, config.max_particles, context);
    File {
        name,
        description,
        duration,
        config,
        medium,
        chemicals,
        obstacles,
        groups,
        supplies,
        controllers,
        commands,
        checks,
        output,
        game,
        slide,
    }
}

fn read_schema(root: &mut Fields<'_>) {
    if let Some(schema) = root.required::<u32>("schema").filter(|schema| *schema != SCHEMA) {
        root.refuse("schema", format!("version {schema} of the format is not known"), SCHEMA.to_string());
    }
}
