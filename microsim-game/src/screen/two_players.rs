//! The way to two cells on one slide.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen};
use crate::input::{Input, Move};
use crate::rules::two_players::TwoPlayers;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};

const ABOUT: &str = "Two cells share one slide for 90 seconds. Player 1 steers by mouse, player 2 by the arrow keys.";

#[derive(Debug)]
pub(super) struct TwoPlayersMenu {
    page: MenuPage,
}

impl TwoPlayersMenu {
    pub(super) fn new() -> Self {
        let ways = TwoPlayers::ALL.map(TwoPlayers::label);
        let items = ways.into_iter().chain(["Back"]).map(MenuItem::new).collect();
        Self { page: MenuPage::new("Two players", items) }
    }
}

impl Screen for TwoPlayersMenu {
    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        let Some(MenuChoice::Pick(item)) = self.page.update(input, &context.pen) else { return Next::Stay };
        TwoPlayers::ALL.get(item).map_or(Next::Back, |&way| Next::Show(MainScreen::TwoPlayers(way)))
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        self.page.draw_note(&mut context.pen, ABOUT);
    }

    fn name(&self) -> String {
        "two-players".to_owned()
    }
}
