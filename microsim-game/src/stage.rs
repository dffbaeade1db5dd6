//! The scene that is running: a scenario's world, its player, and what is needed to draw between two steps.

use crate::args::Scene;
use crate::picture::Picture;
use microsim_core::scenario::{self, Scenario, Script};
use microsim_core::{Census, Intent, Kind, OrganismId, World};

/// Steps between two counts of what is in the world.
const CENSUS_INTERVAL: u64 = 60;

/// A running scene.
#[derive(Debug)]
pub struct Stage {
    name: String,
    world: World,
    player: Option<OrganismId>,
    /// What the scenario tells its organisms.
    script: Script,
    /// What the player tells its cell.
    orders: Option<Intent>,
    census: Census,
    before: Picture,
    now: Picture,
}

impl Stage {
    /// Sets up a scene.
    ///
    /// # Errors
    /// Says what is wrong with it, for the user to read.
    pub fn open(scene: &Scene) -> Result<Self, String> {
        match scene {
            Scene::Builtin(name) => Self::builtin(name),
            Scene::File(path) => {
                let shown = path.display();
                let text = std::fs::read_to_string(path).map_err(|error| format!("cannot read {shown}: {error}"))?;
                Self::parse(&text).map_err(|problem| format!("{shown}:\n{problem}"))
            }
        }
    }

    /// Sets up the built-in scenario at a position of the list, if the list is that long.
    #[must_use]
    pub fn numbered(position: usize) -> Option<Result<Self, String>> {
        scenario::builtins().get(position).map(|found| Self::builtin(found.name))
    }

    fn builtin(name: &str) -> Result<Self, String> {
        let Some(found) = scenario::builtin(name) else {
            let names: Vec<&str> = scenario::builtins().iter().map(|builtin| builtin.name).collect();
            let list = names.join(", ");
            return Err(format!("no built-in scenario {name:?}; there are: {list}; a file ends in .toml"));
        };
        Self::parse(found.text)
    }

    fn parse(text: &str) -> Result<Self, String> {
        let scenario = Scenario::parse(text, &[]).map_err(|diagnostics| diagnostics.to_string())?;
        let built = scenario.build().map_err(|diagnostics| diagnostics.to_string())?;
        let stage = Self::new(scenario.name().to_owned(), built.world, built.player);
        Ok(Self { script: built.script, ..stage })
    }

    /// A scene of this world. Without a named player, the first amoeboid cell is the player.
    #[must_use]
    pub fn new(name: String, world: World, player: Option<OrganismId>) -> Self {
        let is_amoeboid = |&id: &OrganismId| world.kind(id) == Some(Kind::AmoeboidCell);
        let player = player.or_else(|| world.organisms().find(is_amoeboid));
        let now = Picture::of(&world);
        Self {
            name,
            census: world.census(),
            before: now.clone(),
            now,
            world,
            player,
            script: Script::default(),
            orders: None,
        }
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

    /// The cell that the player steers.
    #[must_use]
    pub fn player(&self) -> Option<OrganismId> {
        self.player
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
        self.player.zip(self.orders).into_iter().for_each(|(player, intent)| inputs.set(player, intent));
        self.world.step(&inputs);
        self.before = std::mem::replace(&mut self.now, Picture::of(&self.world));
        if self.world.step_index().is_multiple_of(CENSUS_INTERVAL) {
            self.census = self.world.census();
        }
    }

    /// What there is to see `alpha` of the way from the last step but one to the last.
    #[must_use]
    pub fn picture(&self, alpha: f32) -> Picture {
        self.now.since(&self.before, alpha)
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
        let known = |position| Stage::numbered(position).map(|stage| stage.map(|stage| stage.census()));
        let mut opened = (0..).map_while(known);
        assert!(opened.all(|stage| stage.is_ok()));
        let problem = Stage::open(&Scene::Builtin("nonsense".to_owned())).unwrap_err();
        assert!(problem.contains("demo"), "{problem}");
    }
}
