//! Pages: a heading and a menu, over what lies below, darkened.

use super::Next;
use crate::draw::palette::{HALO, INK, fade};
use crate::input::{Input, Move};
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuChoice, MenuItem, MenuLayout, ROW};
use crate::ui::pen::{Align, Pen};
use crate::words::Label;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu, and above the middle of the heading, which is higher where a note between them would
/// have no room for so many lines.
const TOP: f32 = 0.3;
const HEADING: f32 = 0.15;
const NOTE: f32 = 3.0;
/// Share of the picture's width that a note takes at most.
const NOTE_WIDTH: f32 = 0.9;
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
        let mut lines = pen.wrap_evenly(TextSize::Small, text, NOTE_WIDTH * screen.x);
        let most = note_lines(pen);
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

/// Middle of the heading.
fn heading_height(pen: &Pen) -> f32 {
    let half = 0.5 * pen.line(TextSize::Large);
    let above_note = TOP * pen.screen().y - NOTE * pen.line(TextSize::Small) - half;
    (HEADING * pen.screen().y).min(above_note).max(half)
}

/// Most lines of a note.
fn note_lines(pen: &Pen) -> usize {
    let room = TOP * pen.screen().y - heading_height(pen) - 0.5 * pen.line(TextSize::Large);
    // Against the rounding of a difference.
    (room / pen.line(TextSize::Small) + 0.01) as usize
}

/// Draws a heading above a panel for all of the page.
pub(super) fn draw_sheet(pen: &mut Pen, heading: &str) {
    draw_heading(pen, heading);
    let (screen, edge) = (pen.screen(), 0.3 * pen.line(TextSize::Body));
    let top = heading_height(pen) + 0.7 * pen.line(TextSize::Large);
    pen.panel(Vec2::new(edge, top), screen - edge);
}

/// Whether a small window shows all of a note with the largest text.
#[cfg(test)]
pub(super) fn is_seen_whole(note: &str) -> bool {
    let (pen, measure) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
    let fits = |line: &str| measure(TextSize::Small, line) <= NOTE_WIDTH * pen.screen().x;
    crate::ui::pen::wrap(note, fits).len() <= note_lines(&pen)
}

/// Darkens what lies below, by a share of how dark it gets.
pub(super) fn draw_shade(pen: &mut Pen, share: f32) {
    let screen = pen.screen();
    pen.canvas().rectangle(Vec2::ZERO, screen, fade(INK, share * SHADE));
}

/// Darkens what lies below, and writes a heading.
pub(super) fn draw_heading(pen: &mut Pen, text: &str) {
    draw_shade(pen, 1.0);
    let at = Vec2::new(0.5 * pen.screen().x, heading_height(pen));
    let fits = |size: &TextSize| pen.width(*size, text) <= 0.96 * pen.screen().x;
    let size = [TextSize::Large, TextSize::Body].into_iter().find(fits).unwrap_or(TextSize::Small);
    pen.write(at, size, Align::Centre, HALO, text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::verdict::chain_verdict;
    use crate::words::{self, Key, text, text_with};

    #[test]
    fn notes_of_the_lobby_are_seen_whole_in_a_small_window_with_the_largest_text() {
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            let of_code = |key| text_with(key, &[("code", "ABCDEF012345".into())]);
            let colour = text(Key::ColourOrange);
            let player = text_with(Key::MatchPlayer, &[("number", 4.into()), ("colour", colour.into())]);
            let verdict = chain_verdict(&[123, 101, 61, 40], &["Bartholomew".to_owned()]);
            let said = [("verdict", (&verdict).into()), ("player", (&player).into())];
            let news = text_with(Key::MatchEnd, &said);
            let mut notes = [Key::RoomWaits, Key::RoomMatchOn, Key::RoomEntering].map(of_code).to_vec();
            notes.push(text_with(Key::RoomAgain, &[("news", (&news).into())]));
            for note in notes {
                assert!(is_seen_whole(&note), "{}: {note}", language.code);
            }
        }
    }

    #[test]
    fn a_heading_is_in_the_picture_and_higher_only_where_a_note_needs_it() {
        let (pen, _) = Pen::measured(Vec2::new(1280.0, 720.0), 1.0);
        assert_eq!(heading_height(&pen), HEADING * pen.screen().y);
        let (pen, _) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
        let (height, half) = (heading_height(&pen), 0.5 * pen.line(TextSize::Large));
        assert!(half <= height && height < HEADING * pen.screen().y, "{half} {height}");
    }
}
