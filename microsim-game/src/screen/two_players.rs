//! The way to two cells on one slide, for points or for the goals of a slide.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen};
use crate::input::Input;
use crate::rules::two_players::TwoPlayers;
use crate::slides::{SHARED, SLIDES};
use crate::ui::menu::{Menu, MenuItem};
use crate::words::{self, Key};

#[derive(Debug)]
pub(super) struct TwoPlayersMenu {
    page: MenuPage,
}

impl TwoPlayersMenu {
    pub(super) fn new() -> Self {
        let ways = TwoPlayers::ALL.map(|way| MenuItem::new(way.label()));
        let slides = SHARED.iter().map(|shared| MenuItem::new(shared.slide.title()));
        let items = ways.into_iter().chain(slides).chain([MenuItem::new(Key::Back)]).collect();
        Self { page: MenuPage::new(Key::TitleTwoPlayers, items) }
    }
}

impl Screen for TwoPlayersMenu {
    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let ways = TwoPlayers::ALL;
        let slide = |item| MainScreen::Slide(SLIDES.len() + item - ways.len());
        let show = |item| ways.get(item).map_or_else(|| slide(item), |way| MainScreen::TwoPlayers(*way));
        self.page.choose(input, &context.pen, |item| Next::Show(show(item)))
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        self.page.draw_note(&mut context.pen, words::text(Key::TwoAbout));
    }

    fn name(&self) -> String {
        "two-players".to_owned()
    }
}
