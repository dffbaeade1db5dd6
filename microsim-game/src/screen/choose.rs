//! The choice between three changes of the body, while the food chain waits.

use super::context::AppContext;
use super::page::MenuPage;
use super::{Next, Overlay, Paused, Screen};
use crate::input::{Input, Move};
use crate::rules::food_chain::change::Change;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key};

/// Time for which the menu does not answer, s: it opens under a hand that steers.
const DELAY: f32 = 0.5;

#[derive(Debug)]
pub(super) struct Choose {
    page: MenuPage,
    offer: [Change; 3],
    played: Paused,
    since: f32,
    has_let_go: bool,
}

impl Choose {
    pub(super) fn new(offer: [Change; 3], played: Paused) -> Self {
        let items = offer.map(|change| MenuItem::new(change.words().map(words::text).join(": ")));
        Self { page: MenuPage::new(Key::ChangeHeading, items.into()), offer, played, since: 0.0, has_let_go: false }
    }
}

impl Screen for Choose {
    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        self.since += context.pace.elapsed;
        self.has_let_go |= !input.is_held;
        let is_late = self.since >= DELAY;
        // Buttons of a gamepad that digest and divide in the scene confirm and lead back here.
        let step = input.step.filter(|_| is_late);
        let input = Input { is_clicked: input.is_clicked && is_late && self.has_let_go, step, ..input.clone() };
        if input.step == Some(Move::Back) {
            return Next::Open(Overlay::Pause(self.played));
        }
        if let Some(MenuChoice::Pick(item)) = self.page.update(&input, &context.pen) {
            context.chosen = Some(self.offer[item]);
            return Next::Back;
        }
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
    }

    fn name(&self) -> String {
        "choose".to_owned()
    }

    fn is_at_stake(&self) -> bool {
        true
    }
}
