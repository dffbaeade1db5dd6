//! Settings.

use super::keys::KeysMenu;
use super::page::Page;
use super::{Change, Context, Screen};
use crate::input::{Input, Move};
use crate::ui::menu::{Choice, Item};

/// The menu of settings.
#[derive(Debug)]
pub struct SettingsMenu {
    page: Page,
}

const SIGHT: usize = 0;
const EFFORT: usize = 1;
const TEXT: usize = 2;
const MOTION: usize = 3;
const ARROWS: usize = 4;
const FULL_SCREEN: usize = 5;
const KEYS: usize = 6;

impl SettingsMenu {
    /// The present settings.
    #[must_use]
    pub fn new(context: &Context) -> Self {
        Self { page: Page::new("Settings", items(context)) }
    }
}

fn items(context: &Context) -> Vec<Item> {
    let settings = &context.settings;
    vec![
        Item::with("Optics", context.sight().name()),
        Item::with("Quality", context.effort().name()),
        Item::with("Text size", format!("{:.0} %", 100.0 * settings.text_factor())),
        Item::switch("Reduced motion", settings.reduced_motion),
        Item::switch("Classic arrows", settings.classic_arrows),
        Item::switch("Full screen", settings.full_screen),
        Item::new("Keys"),
        Item::new("Back"),
    ]
}

impl Screen for SettingsMenu {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        // Keys change some of them too.
        self.page.menu.items = items(context);
        if input.step == Some(Move::Back) {
            return Change::Pop;
        }
        let Some(choice) = self.page.update(input, &context.pen) else { return Change::Stay };
        let settings = &mut context.settings;
        match choice {
            Choice::Pick(SIGHT) => context.change_sight(false),
            Choice::Less(SIGHT) => context.change_sight(true),
            Choice::Pick(EFFORT) => context.change_effort(false),
            Choice::Less(EFFORT) => context.change_effort(true),
            Choice::Pick(TEXT) => settings.change_text_size(1),
            Choice::Less(TEXT) => settings.change_text_size(-1),
            Choice::Pick(MOTION) | Choice::Less(MOTION) => settings.reduced_motion ^= true,
            Choice::Pick(ARROWS) | Choice::Less(ARROWS) => settings.classic_arrows ^= true,
            Choice::Pick(FULL_SCREEN) | Choice::Less(FULL_SCREEN) => settings.full_screen ^= true,
            Choice::Pick(KEYS) => return Change::push(KeysMenu::new(context)),
            _ => return Change::Pop,
        }
        self.page.menu.items = items(context);
        context.save_settings();
        Change::Stay
    }

    fn draw(&mut self, context: &mut Context) {
        self.page.draw(&mut context.pen);
    }

    fn name(&self) -> String {
        "settings".to_owned()
    }
}
