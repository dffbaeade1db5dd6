//! The list of scenarios to look at: those that come with the program, and files.

use super::page::Page;
use super::sandbox::Sandbox;
use super::{Change, Context, Screen};
use crate::args::Scene;
use crate::input::{Input, Move};
use crate::ui::menu::{Choice, Item};
use microsim_core::scenario;

/// The list of scenarios.
#[derive(Debug)]
pub struct Pick {
    page: Page,
    scenes: Vec<(Scene, &'static str)>,
}

impl Pick {
    /// The files that the player has named or dropped, and the built-in scenarios.
    #[must_use]
    pub fn new(context: &Context) -> Self {
        let files = context.files.iter().map(|file| (file.clone(), "a file"));
        let builtins = scenario::builtins().iter().map(|found| (Scene::Builtin(found.name.to_owned()), found.summary));
        let scenes: Vec<_> = files.chain(builtins).collect();
        let items = scenes.iter().map(|(scene, _)| Item::new(scene.to_string())).collect();
        Self { page: Page::new("Simulation", items), scenes }
    }
}

impl Screen for Pick {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        if input.step == Some(Move::Back) {
            return Change::Pop;
        }
        let Some(Choice::Pick(item)) = self.page.update(input, &context.pen) else { return Change::Stay };
        Sandbox::open(&self.scenes[item].0, context)
    }

    fn draw(&mut self, context: &mut Context) {
        self.page.draw(&mut context.pen);
        let summary = self.scenes.get(self.page.menu.focus()).map_or("", |(_, summary)| *summary);
        self.page.draw_note(&mut context.pen, summary);
    }

    fn name(&self) -> String {
        "scenarios".to_owned()
    }
}
