//! The way to two cells on one slide.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen};
use crate::input::Input;
use crate::rules::two_players::TwoPlayers;
use crate::ui::menu::{Menu, MenuItem};
use crate::words::{self, Key};

#[derive(Debug)]
pub(super) struct TwoPlayersMenu {
    page: MenuPage,
}

impl TwoPlayersMenu {
    pub(super) fn new() -> Self {
        let ways = TwoPlayers::ALL.map(TwoPlayers::label);
        let items = ways.into_iter().chain([Key::Back]).map(MenuItem::new).collect();
        Self { page: MenuPage::new(Key::TitleTwoPlayers, items) }
    }
}

impl Screen for TwoPlayersMenu {
    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        self.page.choose(input, &context.pen, |item| Next::Show(MainScreen::TwoPlayers(TwoPlayers::ALL[item])))
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        self.page.draw_note(&mut context.pen, words::text(Key::TwoAbout));
    }

    fn name(&self) -> String {
        "two-players".to_owned()
    }
}
