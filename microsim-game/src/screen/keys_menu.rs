//! Which key does what: choose an action, then press its new key.

use super::context::AppContext;
use super::page::MenuPage;
use super::{Next, Screen};
use crate::input::keys::Keys;
use crate::input::{Action, Input, Move};
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key};

/// The item for the usual keys: behind those of actions and of the letters that steer.
const USUAL: usize = Action::ALL.len() + 1;

/// The menu of keys.
#[derive(Debug)]
pub(super) struct KeysMenu {
    page: MenuPage,
    /// The action that waits for its key.
    waiting: Option<Action>,
}

impl KeysMenu {
    pub(super) fn new(context: &AppContext) -> Self {
        Self { page: MenuPage::new(Key::SettingsKeys, items(&context.settings.keys, None)), waiting: None }
    }

    fn assign(&mut self, action: Action, input: &Input, context: &mut AppContext) {
        if input.step == Some(Move::Back) {
            self.waiting = None;
            return;
        }
        let Some(key) = input.key else { return };
        if context.settings.keys.set(action, key) {
            self.waiting = None;
            context.save_settings();
        } else {
            context.tell(words::text(Key::KeysRefused));
        }
    }
}

fn items(keys: &Keys, waiting: Option<Action>) -> Vec<MenuItem> {
    let label =
        |action| if waiting == Some(action) { words::text(Key::KeysPress).to_owned() } else { keys.label(action) };
    let actions = Action::ALL.into_iter().map(|action| MenuItem::with(action.label(), label(action)));
    let letters = MenuItem::switch(Key::KeysLetters, keys.letters_steer());
    actions.chain([letters, MenuItem::new(Key::KeysUsual), MenuItem::new(Key::Back)]).collect()
}

impl Screen for KeysMenu {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if let Some(action) = self.waiting {
            self.assign(action, input, context);
        } else if input.step == Some(Move::Back) {
            return Next::Back;
        } else if let Some(MenuChoice::Pick(item) | MenuChoice::Less(item)) = self.page.update(input, &context.pen) {
            match Action::ALL.get(item) {
                Some(&action) => self.waiting = Some(action),
                None if item > USUAL => return Next::Back,
                None if item == USUAL => context.settings.keys = Keys::default(),
                None => context.settings.keys.change_letters(),
            }
            if self.waiting.is_none() {
                context.save_settings();
            }
        }
        self.page.menu.items = items(&context.settings.keys, self.waiting);
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "keys".to_owned()
    }

    fn waits_for_key(&self) -> bool {
        self.waiting.is_some()
    }
}
