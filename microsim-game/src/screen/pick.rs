//! The list of scenarios to look at: those that come with the program, and files.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen};
use crate::input::{Input, Move};
use crate::scene_source::SceneSource;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use microsim_core::scenario;

#[derive(Debug)]
pub(super) struct Pick {
    page: MenuPage,
    sources: Vec<(SceneSource, &'static str)>,
}

impl Pick {
    /// The files that the player has named or dropped, and the built-in scenarios.
    pub(super) fn new(context: &AppContext) -> Self {
        let files = context.files.iter().map(|file| (file.clone(), "a file"));
        let builtins =
            scenario::builtins().iter().map(|found| (SceneSource::Builtin(found.name.to_owned()), found.summary));
        let sources: Vec<_> = files.chain(builtins).collect();
        let items = sources.iter().map(|(source, _)| MenuItem::new(source.to_string())).collect();
        Self { page: MenuPage::new("Simulation", items), sources }
    }
}

impl Screen for Pick {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        let Some(MenuChoice::Pick(item)) = self.page.update(input, &context.pen) else { return Next::Stay };
        let stage = context.open(&self.sources[item].0);
        stage.map_or(Next::Stay, |stage| Next::Show(MainScreen::Simulation(Box::new(stage))))
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        let summary = self.sources.get(self.page.menu.focus()).map_or("", |(_, summary)| *summary);
        self.page.draw_note(&mut context.pen, summary);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "scenarios".to_owned()
    }
}
