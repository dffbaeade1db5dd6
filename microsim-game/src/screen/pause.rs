//! The menu that stops a scene.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Overlay, Paused, Screen};
use crate::input::{Action, Input, Move};
use crate::slides::{self, BuiltinSlide};
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{Key, Label};

#[derive(Debug)]
pub(super) struct Pause {
    page: MenuPage,
    paused: Paused,
}

impl Pause {
    pub(super) fn new(paused: Paused) -> Self {
        let labels = match paused {
            Paused::Simulation => [Key::PauseGoOn, Key::PausePhoto, Key::Settings, Key::Title].as_slice(),
            _ => &[Key::PauseGoOn, Key::PauseRestart, Key::PausePhoto, Key::Settings, Key::Title],
        };
        Self {
            page: MenuPage::new(Key::PauseHeading, labels.iter().map(|&label| MenuItem::new(label)).collect()),
            paused,
        }
    }
}

impl Screen for Pause {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) || input.presses(Action::Pause) {
            return Next::Back;
        }
        if input.presses(Action::Restart) {
            return self.paused.restart();
        }
        let Some(MenuChoice::Pick(item)) = self.page.update(input, &context.pen) else { return Next::Stay };
        match self.page.menu.items[item].label {
            Label::Key(Key::PauseGoOn) => Next::Back,
            Label::Key(Key::PauseRestart) => self.paused.restart(),
            Label::Key(Key::PausePhoto) => Next::Open(Overlay::Photo),
            Label::Key(Key::Settings) => Next::Open(Overlay::Settings),
            _ => Next::Show(MainScreen::Title),
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        if let Paused::Slide(index) = self.paused {
            let task = slides::all().nth(index).and_then(BuiltinSlide::told).map(|slide| slide.task);
            self.page.draw_note(&mut context.pen, &task.unwrap_or_default());
        }
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "pause".to_owned()
    }
}
