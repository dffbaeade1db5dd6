//! The scene that is running: a scenario's world, and who is followed in it.

use crate::scene_source::SceneSource;
use crate::words::{self, Key};
use microsim_core::scenario::{Scenario, Script};
use microsim_core::{Census, Intent, Kind, OrganismId, World};

/// Steps between two counts of what is in the world.
const CENSUS_INTERVAL: u64 = 60;

/// A running scene.
#[derive(Clone, Debug)]
pub struct Stage {
    name: String,
    world: World,
    player: Option<OrganismId>,
    /// What the scenario tells its organisms.
    script: Script,
    /// What the player tells its cell.
    orders: Option<Intent>,
    census: Census,
    /// To start over; `None` for a world that was made in code.
    scenario: Option<Scenario>,
}

impl Stage {
    /// Sets up a scene, with values changed as `key=value` pairs say.
    ///
    /// # Errors
    /// Says what is wrong with it, for the user to read.
    pub fn open(source: &SceneSource, overrides: &[(String, String)]) -> Result<Self, String> {
        let text = source.text()?;
        let opened = Scenario::parse(&text, overrides).map_err(|diagnostics| diagnostics.to_string());
        opened.and_then(Self::of).map_err(|problem| match source {
            SceneSource::Builtin(_) => problem,
            SceneSource::File(path) => {
                let (file, problem) = (path.display().to_string(), format!("\n{problem}"));
                words::text_with(Key::FileUnfit, &[("file", (&file).into()), ("problem", (&problem).into())])
            }
        })
    }

    /// Sets up a built-in scenario.
    #[must_use]
    pub fn builtin(name: &str) -> Option<Self> {
        Self::open(&SceneSource::Builtin(name.to_owned()), &[]).ok()
    }

    fn of(scenario: Scenario) -> Result<Self, String> {
        let built = scenario.build().map_err(|diagnostics| diagnostics.to_string())?;
        let stage = Self::new(scenario.name().to_owned(), built.world, built.player);
        Ok(Self { script: built.script, scenario: Some(scenario), ..stage })
    }

    /// The same scene from its beginning.
    ///
    /// # Errors
    /// When it was made in code.
    pub fn again(&self) -> Result<Self, String> {
        let scenario = self.scenario.clone().ok_or("this scene has no beginning to go back to")?;
        Self::of(scenario)
    }

    /// A scene of this world. Without a named player, the first amoeboid cell is the player.
    #[must_use]
    pub fn new(name: String, world: World, player: Option<OrganismId>) -> Self {
        let is_amoeboid = |&id: &OrganismId| world.kind(id) == Some(Kind::AmoeboidCell);
        let player = player.or_else(|| world.organisms().find(is_amoeboid));
        let (census, script) = (world.census(), Script::default());
        Self { name, census, world, player, script, orders: None, scenario: None }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its world.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Its world, to meddle with.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }

    /// Who is followed, and steered by the player.
    #[must_use]
    pub fn player(&self) -> Option<OrganismId> {
        self.player
    }

    /// Follows somebody else, or nobody.
    pub fn set_player(&mut self, player: Option<OrganismId>) {
        (self.player, self.orders) = (player, None);
    }

    /// What there is, counted now and then.
    #[must_use]
    pub fn census(&self) -> Census {
        self.census
    }

    /// Tells the player what to do. Until it is told something for the first time it does what the scenario tells it, or
    /// follows its own controller.
    pub fn steer(&mut self, intent: Intent) {
        if intent != Intent::REST || self.orders.is_some() {
            self.orders = Some(intent);
        }
    }

    /// One step.
    pub fn step(&mut self) {
        let mut inputs = self.script.before_step(&mut self.world).clone();
        if let Some((player, intent)) = self.player.zip(self.orders) {
            inputs.set(player, intent);
        }
        self.world.step(&inputs);
        if self.world.step_index().is_multiple_of(CENSUS_INTERVAL) {
            self.census = self.world.census();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::glam::Vec2;
    use microsim_core::{AmoeboidCellSpec, Placement, ProbeSpec, WorldConfig};

    fn stage() -> Stage {
        let mut world = World::new(WorldConfig::default()).unwrap();
        world.spawn(&ProbeSpec::default().into(), Placement::at(20.0, 70.0)).unwrap();
        world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        Stage::new("test".to_owned(), world, None)
    }

    #[test]
    fn the_first_amoeboid_cell_is_the_player_and_obeys() {
        let mut stage = stage();
        let player = stage.player().unwrap();
        let start = stage.world().centroid(player).unwrap();
        stage.steer(Intent::toward(Vec2::new(120.0, 40.0)).unwrap());
        (0..90).for_each(|_| stage.step());
        let there = stage.world().centroid(player).unwrap();
        assert!(there.x > start.x + 3.0, "{start} -> {there}");
    }

    #[test]
    fn the_player_follows_its_own_controller_until_it_is_steered() {
        let mut stage = stage();
        stage.steer(Intent::REST);
        assert_eq!(stage.orders, None);
        stage.steer(Intent::toward(Vec2::ONE).unwrap());
        stage.steer(Intent::REST);
        assert_eq!(stage.orders, Some(Intent::REST));
    }

    #[test]
    fn a_scenario_commands_its_cell_until_the_player_does() {
        let start = |stage: &Stage| stage.world().centroid(stage.player().unwrap()).unwrap();
        let mut stage = Stage::builtin("squeeze").unwrap();
        let before = start(&stage);
        (0..120).for_each(|_| stage.step());
        let commanded = start(&stage);
        assert!(commanded.x > before.x + 4.0, "{before} -> {commanded}");
        stage.steer(Intent::toward(Vec2::new(5.0, commanded.y)).unwrap());
        (0..180).for_each(|_| stage.step());
        assert!(start(&stage).x < commanded.x - 4.0, "{commanded} -> {}", start(&stage));
    }

    #[test]
    fn every_builtin_opens_and_unknown_names_are_answered_with_the_list() {
        for found in microsim_core::scenario::builtins() {
            assert!(Stage::builtin(found.name).is_some_and(|stage| stage.again().is_ok()), "{}", found.name);
        }
        let problem = Stage::open(&SceneSource::Builtin("nonsense".to_owned()), &[]).unwrap_err();
        assert!(problem.contains("demo"), "{problem}");
    }
}
