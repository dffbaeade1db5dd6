//! Scenarios: worlds described in TOML files.
//!
//! ```
//! use microsim_core::{Inputs, scenario::Scenario};
//!
//! let text = r#"
//!     schema = 1
//!     name = "two pellets"
//!     [parameters]
//!     count = 2
//!     [world]
//!     size = [40.0, 20.0]
//!     [agar.pellet]
//!     radius = 1.0
//!     [[spawn]]
//!     of = "pellet"
//!     count = "$count"
//! "#;
//! let scenario = Scenario::parse(text, &[("count".into(), "5".into())])?;
//! let mut world = scenario.build()?.world;
//! world.step(&Inputs::new());
//! assert_eq!(world.organisms().count(), 5);
//!
//! let wrong = text.replace("radius = 1.0", "radius = -1.0");
//! let diagnostics = Scenario::parse(&wrong, &[]).unwrap_err();
//! assert!(diagnostics.to_string().ends_with("agar.pellet.radius: -1 is out of range (accepted: 0.1 to 20)"));
//! # Ok::<(), microsim_core::scenario::Diagnostics>(())
//! ```
//!
//! # Format
//!
//! Lengths are in micrometres, times in seconds, angles in degrees. An unknown field is an error, as is a value out of
//! range. A field without a default below is required. The fields of prototypes are those of the specs, with their ranges
//! and defaults.
//!
//! | table | fields |
//! |---|---|
//! | top level | `schema = 1`, `name = ""`, `description = ""`, `seed = 0`, `duration = 10.0` |
//! | `[parameters]` | any names with a number, string or boolean each. Elsewhere the string `"$name"` stands for the value |
//! | `[step]` | `dt`, `substeps` of [`WorldConfig`] |
//! | `[world]` | `size` (may be left out when a `[[field]]` sizes the room), `gravity`, `damping`, `max_speed`, `protects_membranes`, `sleeps`, `max_particles` of [`WorldConfig`] |
//! | `[medium]` | `temperature = 20.0` °C, `viscosity = 1.0` mPa s, `time_lapse = 1.0`: if the table is there, its molecules kick what is small ([`FieldKind::Thermal`](crate::FieldKind)) |
//! | `[rigid_cell.NAME]` | [`RigidCellSpec`](crate::RigidCellSpec); `radii` is required |
//! | `[amoeboid_cell.NAME]` | [`AmoeboidCellSpec`](crate::AmoeboidCellSpec); `radii` is required |
//! | `[platelet.NAME]` | [`PlateletSpec`](crate::PlateletSpec); `radius` is required |
//! | `[agar.NAME]` | [`AgarSpec`](crate::AgarSpec); `radius` is required |
//! | `[probe.NAME]` | [`ProbeSpec`](crate::ProbeSpec); `radius` is required |
//! | `[red_cell.NAME]` | [`RedCellSpec`](crate::RedCellSpec); `radius` is required |
//! | `[coccus.NAME]` | [`CoccusSpec`](crate::CoccusSpec); `radius` is required |
//! | `[bacillus.NAME]` | [`BacillusSpec`](crate::BacillusSpec); `radius` is required |
//! | `[fluid.NAME]` | `size`, and `spacing`, `particle_mass`, `viscosity`, `mode` (`"density"` or `"granular"`) of [`FluidParams`](crate::FluidParams) |
//! | `[wander.NAME]` | `interval = [shortest, longest]`, `rest = 0.0` (see [`Controller::Wander`](crate::Controller)) |
//! | `[patrol.NAME]` | `through = [[x, y], ...]`, `repeats = false`, `in = "units"` or `"room"`: fractions of the room |
//! | `[thrash.NAME]` | `interval`, `reversal = 1.0` (see [`Controller::Thrash`](crate::Controller)) |
//! | `[ram.NAME]` | `charge`, `retreat`, `distance` (see [`Controller::Ram`](crate::Controller)) |
//! | `[persistent_walk.NAME]` | [`PersistentWalkParams`](crate::PersistentWalkParams) |
//! | `[chemotaxis.NAME]` | [`ChemotaxisParams`](crate::ChemotaxisParams); `chemical`, a name, is required |
//! | `[run_and_tumble.NAME]` | [`RunAndTumbleParams`](crate::RunAndTumbleParams) |
//! | `[brownian.NAME]` | [`BrownianParams`](crate::BrownianParams) |
//! | `[avoidance.NAME]` | [`AvoidanceParams`](crate::AvoidanceParams) |
//! | `[pursue.NAME]` | [`PursueParams`](crate::PursueParams); `otherwise`: a controller of a kind above, or it rests |
//! | `[flee.NAME]` | [`FleeParams`](crate::FleeParams); `otherwise`: the same |
//! | `[chemical.NAME]` | [`ChemicalSpec`](crate::ChemicalSpec) |
//! | `[[spawn]]` | `of`; `at = [x, y]`, or `count = 1`, `within = [[x0, y0], [x1, y1]]` (the room), `gap = 0.0`; `angle = 0.0` or `"random"`; `tier`, 0 to 31: they pass over those in other tiers; `linear_damping = 0.0` and `angular_damping = 0.0`, 1/s, besides the medium's; `scale = 1.0` or `[smallest, largest]`; `controller`; `name`; `player = false`; `from = 0.0`: when they come; `respawn`: time after which one that is gone or taken in is replaced, at another random place |
//! | `[[field]]` | a grid: `of`, `count`, `pitch`, `jitter = 0.0`, `margin = 0.0` |
//! | `[[wall]]` | `from`, `to`, `thickness`, `friction = 0.2` |
//! | `[[block]]` | `at`, `size`, `angle = 0.0`, `friction = 0.2` |
//! | `[[disc]]` | `at`, `radius`, `friction = 0.2` |
//! | `[[polygon]]` | `points`, `friction = 0.2` |
//! | `[[command]]` | `of`: an organism's `name`; `at = 0.0`, and `every`, `until` (the duration) to repeat it; one or more of: `goal = [x, y]`, `follow = "NAME"`, `rest = true`, `digest` (a boolean), `grow = { nodes = 0, particles = 0 }`, `divide = "NAME"` (of the daughter, for later commands), `fuse = "NAME"` (with the one of that name, if they touch; it has both names then), `controller = "NAME"` (in place of all that it was told) |
//! | `[game]` | `time = 90.0`, `[game.points.KIND]` for `agar`, `coccus`, `bacillus`, `rigid_cell`: `each = 0.0`, `per_area = 0.0` (see [`Game`]) |
//! | `[slide]` | `title`, `task`, `fact`, `source`, `time`, `stars = [for 3, for 2]`, all required (see [`Slide`]); does not go with `[game]` |
//! | `[[slide.goal]]` | `reach = [[x0, y0], [x1, y1]]`; or `together = [BOX, BOX]`, two such boxes for two players; or `digested = "KIND"`, a kind of `[game.points]`, and `count = 1` |
//! | `[invariants]` | any of the [measures](crate::Measure::ALL), or of the [kinds of events](crate::Event::NAMES), which are counted: the most that it may be after any step, or `[least, most]` |
//! | `[output]` | what is written while it runs: `events = true`, `pictures = true`, `snapshots = [times]`, `checkpoint_every = 0` steps |
//! | `[output.measures]`, `[output.trajectories]` | `formats = ["csv"]`, `every = 0.1` (0: each step); for measures also `of = [names]` |
//! | `[output.frames]` | `at = [times]`, `every = 0.0`, `width = 1280` |
//! | `[[expect]]` | `measure`: a measure or a kind of events; `min`: what it must reach at least once, `by`: so many seconds |
//!
//! Commands are done in the order of the file. An organism obeys a command until the next one, in place of its controller.
//! A follower rests when the organism that it follows is taken in.
//!
//! Organisms are spawned in this order: `[[spawn]]` tables, then `[[field]]` tables, each in the order of the file.

mod build;
mod builtin;
mod describe;
mod diagnostic;
mod explanations;
mod file;
mod grid;
mod nearby;
mod origin;
mod placing;
mod reader;
mod script;
mod sections;
pub(crate) mod spawner;

pub use build::Built;
pub use builtin::{Builtin, builtin, builtins};
pub use describe::{Description, describe};
pub use diagnostic::{Diagnostic, Diagnostics, LeftOut};
pub use origin::Origin;
pub use reader::{Entry, ValueType};
pub use script::{Refusal, Script};
pub use sections::checks::{Checks, Violation};
pub use sections::game::{Game, Points};
pub use sections::output::{FramePlan, OutputPlan, TableFormat, TablePlan};
pub use sections::slide::{Goal, Slide};

use crate::config::WorldConfig;
use crate::float_environment::with_default_float_environment;
use file::File;
use reader::Document;

/// A scenario, read and checked.
#[derive(Clone, Debug)]
pub struct Scenario {
    file: File,
    document: Document,
    effective: toml::Table,
}

impl Scenario {
    /// Reads a scenario from the text of a file.
    ///
    /// `overrides` are `key=value` pairs that are applied first. A key is the name of a parameter, one of the fields
    /// `name`, `description`, `seed` and `duration`, or a dotted path to a value such as `world.damping` or
    /// `spawn.0.count`. A value is TOML text; bare words become strings.
    ///
    /// # Errors
    /// All errors in the text and the overrides, each with its place. [`Scenario::build`] reports those that depend on the
    /// seed, and overlaps of organisms.
    pub fn parse(text: &str, overrides: &[(String, String)]) -> Result<Self, Diagnostics> {
        with_default_float_environment(|| {
            let (table, document) = Document::read(text, overrides)?;
            let file = file::read(&table, &document)?;
            Ok(Self { file, document, effective: reader::without_spans(&table) })
        })
    }

    /// Its name; empty if the file has none.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.file.name
    }

    /// What it shows; empty if the file does not say.
    #[must_use]
    pub fn description(&self) -> &str {
        &self.file.description
    }

    /// Seed of all its random numbers.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.file.config.seed
    }

    /// Changes the seed.
    pub fn set_seed(&mut self, seed: u64) {
        self.file.config.seed = seed;
    }

    /// Simulated time that it is meant to run, s.
    #[must_use]
    pub fn duration(&self) -> f32 {
        self.file.duration
    }

    /// What makes a game of it, if anything does.
    #[must_use]
    pub fn game(&self) -> Option<&Game> {
        self.file.game.as_ref()
    }

    /// What makes a slide of it, if anything does.
    #[must_use]
    pub fn slide(&self) -> Option<&Slide> {
        self.file.slide.as_ref()
    }

    /// Settings of its world.
    #[must_use]
    pub fn config(&self) -> &WorldConfig {
        &self.file.config
    }

    /// What it was read from.
    #[must_use]
    pub fn origin(&self) -> Origin {
        let Document { text, overrides, .. } = &self.document;
        Origin { text: text.clone(), overrides: overrides.clone(), seed: self.seed() }
    }

    /// What is to be written while it runs.
    #[must_use]
    pub fn output(&self) -> &OutputPlan {
        &self.file.output
    }

    /// The scenario as it is run: a file with overrides, parameters and seed put in and sorted keys. Scenarios that differ
    /// only in how they are written have equal texts.
    #[must_use]
    pub fn effective(&self) -> String {
        let mut table = self.effective.clone();
        let seed = i64::try_from(self.seed()).unwrap_or(i64::MAX);
        table.insert("seed".to_owned(), toml::Value::Integer(seed));
        table.to_string()
    }
}

#[cfg(test)]
mod tests;
