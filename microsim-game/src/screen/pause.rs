//! The menu that stops a scene.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Overlay, Paused, Screen};
use crate::input::{Action, Input, Move};
use crate::slides::{self, BuiltinSlide, SLIDES};
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{Key, Label};

#[derive(Debug)]
pub(super) struct Pause {
    page: MenuPage,
    paused: Paused,
}

impl Pause {
    pub(super) fn new(paused: Paused) -> Self {
        let items = labels(paused).map(MenuItem::new).collect();
        Self { page: MenuPage::new(Key::PauseHeading, items), paused }
    }
}

/// What the menu offers: from a slide and from a round of two also the list that it is of.
fn labels(paused: Paused) -> impl Iterator<Item = Key> {
    let restart = (paused != Paused::Simulation).then_some(Key::PauseRestart);
    let list = list_of(paused).map(|(label, _)| label);
    let first = [Some(Key::PauseGoOn), restart, Some(Key::PausePhoto), Some(Key::Settings)];
    first.into_iter().chain([list, Some(Key::Title)]).flatten()
}

/// The list that something is of, and what it is called.
fn list_of(paused: Paused) -> Option<(Key, Overlay)> {
    match paused {
        Paused::Slide(index) if index < SLIDES.len() => Some((Key::TitleSlides, Overlay::Slides(Some(index)))),
        Paused::Slide(_) | Paused::TwoPlayers(_) => Some((Key::TitleTwoPlayers, Overlay::TwoPlayers)),
        _ => None,
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
            Label::Key(Key::TitleSlides | Key::TitleTwoPlayers) => {
                list_of(self.paused).map_or(Next::Stay, |(_, list)| Next::Open(list))
            }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::two_players::TwoPlayers;

    #[test]
    fn a_pause_leads_back_to_the_list_that_was_chosen_from() {
        assert!(matches!(list_of(Paused::Slide(2)), Some((Key::TitleSlides, Overlay::Slides(Some(2))))));
        for paused in [Paused::Slide(SLIDES.len()), Paused::TwoPlayers(TwoPlayers::Versus)] {
            assert!(matches!(list_of(paused), Some((Key::TitleTwoPlayers, Overlay::TwoPlayers))), "{paused:?}");
        }
        let labels = |paused| labels(paused).collect::<Vec<_>>();
        assert_eq!(labels(Paused::Slide(2))[4..], [Key::TitleSlides, Key::Title]);
        assert_eq!(labels(Paused::Round).len(), 5);
        assert_eq!(labels(Paused::Simulation), [Key::PauseGoOn, Key::PausePhoto, Key::Settings, Key::Title]);
    }
}
