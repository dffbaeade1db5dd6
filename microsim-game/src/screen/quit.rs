//! Asks before the program ends.

use super::context::AppContext;
use super::page::MenuPage;
use super::{Next, Screen};
use crate::input::{Input, Move};
use crate::ui::menu::{MenuChoice, MenuItem};
use crate::words::Key;

#[derive(Debug)]
pub(super) struct Quit {
    page: MenuPage,
}

impl Quit {
    pub(super) fn new() -> Self {
        Self { page: MenuPage::new(Key::QuitHeading, [Key::QuitStay, Key::TitleQuit].map(MenuItem::new).into()) }
    }
}

impl Screen for Quit {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        match self.page.update(input, &context.pen) {
            Some(MenuChoice::Pick(1)) => Next::Quit,
            Some(_) => Next::Back,
            None => Next::Stay,
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
    }

    fn name(&self) -> String {
        "quit".to_owned()
    }
}
