//! The menu that stops a scene.

use super::page::Page;
use super::play::Play;
use super::settings::SettingsMenu;
use super::title::Title;
use super::{Change, Context, Screen};
use crate::input::{Action, Input, Move};
use crate::ui::menu::{Choice, Item};

/// The menu that stops a scene.
#[derive(Debug)]
pub struct Pause {
    page: Page,
    is_game: bool,
}

impl Pause {
    /// Over a game, which can be started over, or over a simulation.
    #[must_use]
    pub fn new(is_game: bool) -> Self {
        let labels = if is_game {
            ["Go on", "Restart", "Settings", "Title"].as_slice()
        } else {
            &["Go on", "Settings", "Title"]
        };
        Self { page: Page::new("Paused", labels.iter().map(|&label| Item::new(label)).collect()), is_game }
    }
}

impl Screen for Pause {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        if input.step == Some(Move::Back) || input.presses(Action::Pause) {
            return Change::Pop;
        }
        if self.is_game && input.presses(Action::Restart) {
            return Play::start(context);
        }
        let Some(Choice::Pick(item)) = self.page.update(input, &context.pen) else { return Change::Stay };
        match self.page.menu.items[item].label.as_str() {
            "Go on" => Change::Pop,
            "Restart" => Play::start(context),
            "Settings" => Change::push(SettingsMenu::new(context)),
            _ => Change::reset(Title::new(context)),
        }
    }

    fn draw(&mut self, context: &mut Context) {
        self.page.draw(&mut context.pen);
    }

    fn name(&self) -> String {
        "pause".to_owned()
    }
}
