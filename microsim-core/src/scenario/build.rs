//! The world that a scenario describes.

use super::Scenario;
use super::diagnostic::{Diagnostics, in_words};
use super::file::File;
use super::placing::{self, Placed};
use super::reader::ReadContext;
use super::script::Script;
use super::sections::checks::Checks;
use super::sections::game::Game;
use super::sections::group::{Group, Positions};
use super::sections::slide::Slide;
use super::spawner::Spawner;
use crate::error::Error;
use crate::float_environment::with_default_float_environment;
use crate::id::{ChemicalId, OrganismId};
use crate::inputs::Inputs;
use crate::world::World;

/// A world made from a scenario. Its `clone_from` is that of its world.
#[derive(Debug)]
#[non_exhaustive]
pub struct Built {
    /// The world, at time 0.
    pub world: World,
    /// The first organism marked `player = true`.
    pub player: Option<OrganismId>,
    /// Organisms that have a `name`, in the order in which they were spawned.
    pub named: Vec<(String, OrganismId)>,
    /// Its chemicals by name, in the order in which the world has them.
    pub chemicals: Vec<(String, ChemicalId)>,
    /// What is done to organisms while the world runs.
    pub script: Script,
    /// What must hold meanwhile.
    pub checks: Checks,
    /// What makes a game of it.
    pub game: Option<Game>,
    /// What makes a slide of it.
    pub slide: Option<Slide>,
}

impl Clone for Built {
    fn clone(&self) -> Self {
        let Self { world, player, named, chemicals, script, checks, game, slide } = self;
        let (world, named, chemicals, script) = (world.clone(), named.clone(), chemicals.clone(), script.clone());
        let (checks, game, slide) = (checks.clone(), game.clone(), slide.clone());
        Self { world, player: *player, named, chemicals, script, checks, game, slide }
    }

    fn clone_from(&mut self, source: &Self) {
        let Self { world, player, named, chemicals, script, checks, game, slide } = source;
        self.world.clone_from(world);
        self.player = *player;
        self.named.clone_from(named);
        self.chemicals.clone_from(chemicals);
        self.script.clone_from(script);
        self.checks.clone_from(checks);
        self.game.clone_from(game);
        self.slide.clone_from(slide);
    }
}

impl Scenario {
    /// Makes the world. Equal text, overrides and seed give equal worlds.
    ///
    /// # Errors
    /// Where organisms overlap, lie outside the walls or find no free place.
    pub fn build(&self) -> Result<Built, Diagnostics> {
        let context = ReadContext::new(&self.document);
        let world = World::new(self.file.config.clone());
        let mut built = Built {
            world: world.map_err(|error| context.refusal("world", &error))?,
            player: None,
            named: Vec::new(),
            chemicals: Vec::new(),
            script: Script::default(),
            checks: self.file.checks.clone(),
            game: self.file.game.clone(),
            slide: self.file.slide.clone(),
        };
        let spawners = with_default_float_environment(|| self.fill(&mut built, &context));
        built.script = Script::new(self.file.commands.clone(), self.file.controllers.clone(), built.named.clone())
            .with_spawners(spawners);
        context.finish()?;
        built.world.record_changes(true);
        Ok(built)
    }

    /// Puts everything into the world that is there from the beginning; returns the spawners of the rest.
    fn fill(&self, built: &mut Built, context: &ReadContext<'_>) -> Vec<Spawner> {
        let File { config, medium, chemicals, obstacles, groups, supplies, .. } = &self.file;
        if let Some(field) = medium {
            context.check("medium", built.world.add_field(field.clone()));
        }
        for (name, spec) in chemicals {
            if let Some(id) = context.check(&format!("chemical.{name}"), built.world.add_chemical(*spec)) {
                built.chemicals.push((name.clone(), id));
            }
        }
        for obstacle in obstacles {
            context.check("", built.world.add_obstacle(obstacle.clone()));
        }
        let placed = placing::place_all(groups, obstacles, config.seed, context);
        let spawners = built.spawn_groups(groups, placed, context);
        for (path, emitter) in &supplies.emitters {
            context.check(path, built.world.add_emitter(emitter.clone()));
        }
        for drain in &supplies.drains {
            context.check("", built.world.add_drain(*drain));
        }
        spawners
    }
}

impl Built {
    /// Takes a step with these inputs, and the script's for organisms without one.
    pub fn step(&mut self, told: &Inputs) {
        let mut inputs = self.script.before_step(&mut self.world).clone();
        inputs.replace_with(told);
        self.world.step(&inputs);
    }

    /// Spawns the organisms that have their places; returns the spawners of the others.
    fn spawn_groups(&mut self, groups: &[Group], placed: Vec<Vec<Placed>>, context: &ReadContext<'_>) -> Vec<Spawner> {
        let mut spawners = Vec::new();
        for (index, (group, placed)) in groups.iter().zip(placed).enumerate() {
            let mut there = Vec::new();
            for Placed { spec, placement, .. } in placed {
                match self.world.spawn(&spec, placement) {
                    Ok(id) => {
                        self.note(group, id);
                        there.push(id);
                    }
                    Err(error) => refuse_spawn(context, group, &error),
                }
            }
            spawners.extend(Spawner::new(index, group, &there, &self.world));
        }
        spawners
    }

    fn note(&mut self, group: &Group, id: OrganismId) {
        for exchange in &group.exchanges {
            // The group's are checked, and the organism is new.
            let _ = self.world.set_exchange(id, *exchange);
        }
        if group.is_player && self.player.is_none() {
            self.player = Some(id);
        }
        if let Some(name) = &group.name {
            self.named.push((name.clone(), id));
        }
    }
}

/// Reports why an organism of a group was not spawned.
fn refuse_spawn(context: &ReadContext<'_>, group: &Group, error: &Error) {
    let (message, accepted) = in_words(error);
    let is_given = matches!(group.positions, Positions::At(_));
    let path = match error.field() {
        field @ ("scale" | "controller") => format!("{}.{field}", group.path),
        at if is_given && at.starts_with("at") => format!("{}.{at}", group.path),
        field if is_of_controller(field) => format!("{}.controller", group.path),
        "substeps" => "step.substeps".to_owned(),
        _ => group.count_path(context),
    };
    let what = if is_of_controller(error.field()) { format!(", {}:", error.field()) } else { String::new() };
    context.refuse(&path, format!("`{}`{what} {message}", group.prototype.name), accepted.unwrap_or_default());
}

/// Whether a field is why an organism cannot follow its controller.
fn is_of_controller(field: &str) -> bool {
    field == "speed" || field.starts_with("controller.")
}
