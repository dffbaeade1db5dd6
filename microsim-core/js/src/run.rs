//! One run of a scenario.

use microsim_core::glam::Vec2;
use microsim_core::scenario::{self, Built, Scenario};
use microsim_core::{Inputs, Intent, OrganismId, OrganismView, World};

/// A scenario that runs, and what its organisms are told.
pub(crate) struct Run {
    built: Built,
    inputs: Inputs,
}

/// Names of the built-in scenarios, a line each.
pub(crate) fn builtins() -> String {
    scenario::builtins().iter().map(|found| found.name).collect::<Vec<_>>().join("\n")
}

impl Run {
    /// Opens a built-in scenario by its name, or a scenario by its text.
    pub(crate) fn open(text: &str, seed: Option<u64>) -> Result<Self, String> {
        let builtin = scenario::builtin(text.trim());
        if builtin.is_none() && !text.contains('\n') {
            return Err(format!("no built-in scenario {:?}; there are:\n{}", text.trim(), builtins()));
        }
        let text = builtin.map_or(text, |found| found.text);
        let mut scenario = Scenario::parse(text, &[]).map_err(|diagnostics| diagnostics.to_string())?;
        seed.into_iter().for_each(|seed| scenario.set_seed(seed));
        let built = scenario.build().map_err(|diagnostics| diagnostics.to_string())?;
        Ok(Self { built, inputs: Inputs::new() })
    }

    pub(crate) fn step(&mut self) {
        self.built.step(&self.inputs);
    }

    /// Tells an organism to go somewhere, or to stay; whether it lives and the goal is one.
    pub(crate) fn steer(&mut self, index: u32, goal: Option<[f32; 2]>, digests: bool) -> bool {
        let intent = goal.map_or(Ok(Intent::REST), |goal| Intent::toward(Vec2::from(goal)));
        match (self.named(index), intent) {
            (Some(organism), Ok(intent)) => {
                self.inputs.set(organism, intent.digesting(digests));
                true
            }
            _ => false,
        }
    }

    fn named(&self, index: u32) -> Option<OrganismId> {
        self.world().organisms().find(|id| id.index() == index)
    }

    pub(crate) fn player(&self) -> Option<u32> {
        self.built.player.map(OrganismId::index)
    }

    pub(crate) fn world(&self) -> &World {
        &self.built.world
    }

    /// All organisms as numbers, see [`crate::organisms`].
    pub(crate) fn organisms(&self) -> Vec<f32> {
        let mut words = Vec::new();
        for organism in self.world().view().organisms() {
            write(&mut words, organism);
        }
        words
    }
}

fn write(words: &mut Vec<f32>, organism: OrganismView<'_>) {
    let surface = organism.surface();
    let kind = u8::from(organism.kind());
    words.extend([organism.id().index() as f32, f32::from(kind), surface.len() as f32]);
    if surface.is_empty() {
        let (low, high) = organism.bounds();
        let at = organism.centroid();
        words.extend([at.x, at.y, 0.5 * (high - low).max_element()]);
    }
    words.extend(surface.iter().flat_map(|point| point.to_array()));
}
