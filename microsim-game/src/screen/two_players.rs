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
        self.page.draw_note(&mut context.pen, &note(self.page.menu.focus()));
    }

    fn name(&self) -> String {
        "two-players".to_owned()
    }
}

/// What is said of an item of the menu: what it is about, and who steers by what.
fn note(item: usize) -> String {
    let of_two = |what: &str| words::text_with(Key::TwoAbout, &[("what", what.into())]);
    let ways = TwoPlayers::ALL;
    match ways.get(item) {
        Some(TwoPlayers::Bot) => words::text(TwoPlayers::Bot.about()).to_owned(),
        Some(way) => of_two(words::text(way.about())),
        None => {
            let told = SHARED.get(item - ways.len()).and_then(|shared| shared.slide.told());
            told.map_or_else(String::new, |slide| of_two(&slide.task))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::is_seen_whole;
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_item_is_told_by_a_note_of_its_own_that_a_small_window_shows_whole() {
        let count = TwoPlayers::ALL.len() + SHARED.len();
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            let notes: BTreeSet<String> = (0..count).map(note).collect();
            assert_eq!(notes.len(), count, "{notes:?}");
            for note in notes {
                assert!(!note.is_empty() && is_seen_whole(&note), "{}: {note}", language.code);
            }
            assert_eq!(note(count), "", "the item that leads back");
        }
    }
}
