//! Pages: a heading and a menu, over what lies below, darkened.

use super::Next;
use crate::draw::palette::{HALO, INK, fade};
use crate::input::{Input, Move};
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuChoice, MenuItem, MenuLayout, ROW};
use crate::ui::pen::{Align, Pen};
use crate::words::Label;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu, and above the middle of the heading.
const TOP: f32 = 0.3;
const HEADING: f32 = 0.15;
/// Height of an item that has room for a picture, lines.
const TALL: f32 = 2.6;
/// How dark what lies below gets.
const SHADE: f32 = 0.76;

/// A heading and a menu.
#[derive(Debug)]
pub(super) struct MenuPage {
    heading: Label,
    pub menu: Menu,
    /// Height of an item, lines.
    rows: f32,
}

impl MenuPage {
    pub(super) fn new(heading: impl Into<Label>, items: Vec<MenuItem>) -> Self {
        Self { heading: heading.into(), menu: Menu::new(items), rows: ROW }
    }

    /// The same with items that have room for pictures.
    pub(super) fn tall(self) -> Self {
        Self { rows: TALL, ..self }
    }

    /// Where the menu lies.
    pub(super) fn layout(&self, pen: &Pen) -> MenuLayout {
        MenuLayout::rows(pen, TOP, self.rows)
    }

    /// Moves through the menu.
    pub(super) fn update(&mut self, input: &Input, pen: &Pen) -> Option<MenuChoice> {
        let layout = self.layout(pen);
        self.menu.update(input, &layout)
    }

    /// Moves through a menu of which the last item leads back, the others where `lead` says.
    pub(super) fn choose(&mut self, input: &Input, pen: &Pen, lead: impl FnOnce(usize) -> Next) -> Next {
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        match self.update(input, pen) {
            Some(MenuChoice::Pick(item)) if item + 1 < self.menu.items.len() => lead(item),
            Some(MenuChoice::Pick(_)) => Next::Back,
            _ => Next::Stay,
        }
    }

    pub(super) fn draw(&self, pen: &mut Pen) {
        draw_heading(pen, self.heading.text());
        self.menu.draw(pen, &self.layout(pen));
    }

    /// Writes a note between the heading and the menu, as much of it as there is room for.
    pub(super) fn draw_note(&self, pen: &mut Pen, text: &str) {
        let (screen, line) = (pen.screen(), pen.line(TextSize::Small));
        let mut lines = pen.wrap(TextSize::Small, text, 0.9 * screen.x);
        let room = (TOP - HEADING) * screen.y - 0.5 * pen.line(TextSize::Large);
        let most = (room / line) as usize;
        if most < lines.len() {
            lines.truncate(most);
            if let Some(last) = lines.last_mut() {
                last.push_str(" ...");
            }
        }
        for (k, text) in lines.iter().rev().enumerate() {
            let at = Vec2::new(0.5 * screen.x, TOP * screen.y - (k as f32 + 0.7) * line);
            pen.write(at, TextSize::Small, Align::Centre, HALO, text);
        }
    }
}

/// Darkens what lies below.
pub(super) fn draw_shade(pen: &mut Pen) {
    let screen = pen.screen();
    pen.canvas().rectangle(Vec2::ZERO, screen, fade(INK, SHADE));
}

/// Darkens what lies below, and writes a heading.
pub(super) fn draw_heading(pen: &mut Pen, text: &str) {
    draw_shade(pen);
    let at = Vec2::new(0.5, HEADING) * pen.screen();
    let fits = |size: &TextSize| pen.width(*size, text) <= 0.96 * pen.screen().x;
    let size = [TextSize::Large, TextSize::Body].into_iter().find(fits).unwrap_or(TextSize::Small);
    pen.write(at, size, Align::Centre, HALO, text);
}
