//! The menu that stops a scene.

use super::page::Page;
use super::play::Play;
use super::settings::SettingsMenu;
use super::title::Title;
use super::{Change, Context, Screen};
use crate::input::{Action, Input, Move};
use crate::ui::menu::{Choice, Item};

/// What is stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// A round, which can be started over.
    Round,
    /// A round that is watched again, from its beginning if the player likes.
    Replay,
    /// A simulation.
    Simulation,
}

/// The menu that stops a scene.
#[derive(Debug)]
pub struct Pause {
    page: Page,
    over: Over,
}

impl Pause {
    /// Over a scene.
    #[must_use]
    pub fn new(over: Over) -> Self {
        let labels = match over {
            Over::Round | Over::Replay => ["Go on", "Restart", "Settings", "Title"].as_slice(),
            Over::Simulation => &["Go on", "Settings", "Title"],
        };
        Self { page: Page::new("Paused", labels.iter().map(|&label| Item::new(label)).collect()), over }
    }
}

impl Over {
    /// From the beginning.
    pub(super) fn restart(self, context: &mut Context) -> Change {
        match self {
            Self::Round => Play::start(context),
            Self::Replay => Play::replay(context),
            Self::Simulation => Change::Stay,
        }
    }
}

impl Screen for Pause {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        if input.step == Some(Move::Back) || input.presses(Action::Pause) {
            return Change::Pop;
        }
        if input.presses(Action::Restart) {
            return self.over.restart(context);
        }
        let Some(Choice::Pick(item)) = self.page.update(input, &context.pen) else { return Change::Stay };
        match self.page.menu.items[item].label.as_str() {
            "Go on" => Change::Pop,
            "Restart" => self.over.restart(context),
            "Settings" => Change::push(SettingsMenu::new(context)),
            _ => Change::reset(Title::new(context)),
        }
    }

    fn draw(&mut self, context: &mut Context) {
        self.page.draw(&mut context.pen);
    }

    fn name(&self) -> String {
        "pause".to_owned()
    }
}
