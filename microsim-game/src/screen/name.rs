//! What the player is called in the list of scores, and in rooms.

use super::context::AppContext;
use super::join::{draw_typed, type_key};
use super::{Next, Screen};
use crate::input::{Input, Move};
use crate::words::Key;

#[derive(Debug)]
pub(super) struct NameEntry {
    name: String,
}

impl NameEntry {
    pub(super) fn new(context: &AppContext) -> Self {
        Self { name: context.settings.name.clone() }
    }
}

impl Screen for NameEntry {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        match input.step {
            Some(Move::Back) => return Next::Back,
            Some(Move::Confirm) => {
                context.settings.name.clone_from(&self.name);
                return Next::Back;
            }
            _ => {}
        }
        if let Some(key) = input.key {
            type_key(&mut self.name, key);
        }
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        draw_typed(&mut context.pen, Key::SettingsName, &self.name, &[Key::NameHow]);
    }

    fn waits_for_key(&self) -> bool {
        true
    }

    fn name(&self) -> String {
        "name".to_owned()
    }
}
