//! The menu that stops a scene.

use super::play::Play;
use super::settings::SettingsMenu;
use super::title::Title;
use super::{Change, Context, Screen};
use crate::draw::palette::{HALO, INK, fade};
use crate::input::{Action, Input, Move};
use crate::ui::menu::{Choice, Item, Menu, Place};
use crate::ui::pen::{Align, Pen, Size};
use microsim_core::glam::Vec2;

/// The menu that stops a scene.
#[derive(Debug)]
pub struct Pause {
    menu: Menu,
    is_game: bool,
}

impl Pause {
    /// Over a game, which can be started over, or over a simulation.
    #[must_use]
    pub fn new(is_game: bool) -> Self {
        let labels = if is_game {
            ["Go on", "Restart", "Settings", "Title"].as_slice()
        } else {
            &["Go on", "Settings", "Title"]
        };
        Self { menu: Menu::new(labels.iter().map(|&label| Item::new(label)).collect()), is_game }
    }
}

impl Screen for Pause {
    fn update(&mut self, input: &Input, context: &mut Context) -> Change {
        if input.step == Some(Move::Back) || input.presses(Action::Pause) {
            return Change::Pop;
        }
        if self.is_game && input.presses(Action::Restart) {
            return Play::start(context);
        }
        let Some(Choice::Pick(item)) = self.menu.update(input, &Place::middle(&context.pen, TOP)) else {
            return Change::Stay;
        };
        match self.menu.items[item].label.as_str() {
            "Go on" => Change::Pop,
            "Restart" => Play::start(context),
            "Settings" => Change::push(SettingsMenu::new(context)),
            _ => Change::reset(Title::new(context)),
        }
    }

    fn draw(&mut self, context: &mut Context) {
        draw_heading(&mut context.pen, "Paused");
        let place = Place::middle(&context.pen, TOP);
        self.menu.draw(&mut context.pen, &place);
    }

    fn name(&self) -> String {
        "pause".to_owned()
    }
}

/// Share of the picture's height above a menu with a heading.
pub(super) const TOP: f32 = 0.3;

/// Darkens what lies below, and writes a heading.
pub(super) fn draw_heading(pen: &mut Pen, text: &str) {
    let screen = pen.screen();
    pen.canvas().rectangle(Vec2::ZERO, screen, fade(INK, 0.6));
    let at = Vec2::new(0.5 * screen.x, 0.5 * TOP * screen.y);
    pen.write(at, Size::Large, Align::Centre, HALO, text);
}
