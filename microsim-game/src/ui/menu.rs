//! Menus: a column of items, for the mouse and for the keyboard.

use super::font::TextSize;
use super::pen::{Align, Pen};
use super::stars::{draw_stars, stars_width};
use crate::draw::palette::{HALO, INK, READY, fade};
use crate::input::{Input, Move};
use crate::words::{self, Key, Label};
use microsim_core::glam::Vec2;

/// One line of a menu.
#[derive(Clone, Debug, PartialEq)]
pub struct MenuItem {
    /// What it says.
    pub label: Label,
    /// What it is set to, changed with left and right.
    pub value: Option<String>,
    /// Stars that were got for it.
    pub stars: Option<u32>,
    /// Whether it is nothing to choose, but says what the next ones are about.
    pub is_heading: bool,
}

impl MenuItem {
    /// Something to choose.
    #[must_use]
    pub fn new(label: impl Into<Label>) -> Self {
        Self { label: label.into(), value: None, stars: None, is_heading: false }
    }

    /// What the next items are about.
    #[must_use]
    pub fn heading(label: impl Into<Label>) -> Self {
        Self { is_heading: true, ..Self::new(label) }
    }

    /// Something to set.
    #[must_use]
    pub fn with(label: impl Into<Label>, value: impl Into<String>) -> Self {
        Self { value: Some(value.into()), ..Self::new(label) }
    }

    /// Something to choose for which there are stars.
    #[must_use]
    pub fn rated(label: impl Into<Label>, stars: u32) -> Self {
        Self { stars: Some(stars), ..Self::new(label) }
    }

    /// Something that is on or off.
    #[must_use]
    pub fn switch(label: impl Into<Label>, is_on: bool) -> Self {
        Self::with(label, words::text(if is_on { Key::MenuOn } else { Key::MenuOff }))
    }
}

/// What the player did with a menu.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MenuChoice {
    /// Chose the item, or its next value.
    Pick(usize),
    /// Asked for the value before.
    Less(usize),
}

/// Where the arrow that steps back is, and where the place for it begins and ends: shares of an item's width.
const BACK: f32 = 0.56;
const BACK_PLACE: std::ops::Range<f32> = 0.5..0.62;

/// Height of an item, lines.
pub const ROW: f32 = 1.55;

/// Where a menu lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MenuLayout {
    /// Upper left corner, drawing units.
    pub corner: Vec2,
    /// Width, and height of one item.
    pub item: Vec2,
    /// As many items are seen at once.
    pub visible: usize,
    /// Size of the text.
    pub size: TextSize,
}

impl MenuLayout {
    /// In the middle of the picture, from `top` (share of its height) down.
    #[must_use]
    pub fn middle(pen: &Pen, top: f32) -> Self {
        Self::rows(pen, top, ROW)
    }

    /// The same with items that are so many lines high.
    #[must_use]
    pub fn rows(pen: &Pen, top: f32, lines: f32) -> Self {
        let screen = pen.screen();
        let (line, bottom) = (pen.line(TextSize::Body), 0.95 * screen.y);
        let item = Vec2::new((18.0 * line).min(0.86 * screen.x), lines * line);
        // Where two items have room.
        let top = (top * screen.y).min(bottom - 2.0 * item.y).max(0.0);
        Self::of_height(Vec2::new(0.5 * (screen.x - item.x), top), item, bottom, TextSize::Body)
    }

    /// As many items as there is room for above `bottom`, but some in any case.
    fn of_height(corner: Vec2, item: Vec2, bottom: f32, size: TextSize) -> Self {
        let visible = (((bottom - corner.y) / item.y) as usize).max(2);
        Self { corner, item, visible, size }
    }

    /// Below the title.
    #[must_use]
    pub fn title(pen: &Pen) -> Self {
        let line = pen.line(TextSize::Body);
        let (item, bottom) = (Vec2::new(11.5 * line, ROW * line), 0.95 * pen.screen().y);
        // Below the title, but where two items have room.
        let top = (0.32 * pen.screen().y).max(title_lines(pen)[2]).min(bottom - 2.0 * item.y).max(0.0);
        Self::of_height(Vec2::new(0.06 * pen.screen().x, top), item, bottom, TextSize::Body)
    }

    /// At the left edge.
    #[must_use]
    pub fn side(pen: &Pen, top: f32) -> Self {
        let high = 1.25 * pen.line(TextSize::Small);
        let item = Vec2::new((12.5 * pen.line(TextSize::Small)).min(pen.screen().x - high), high);
        let corner = Vec2::new(0.5 * item.y, top);
        Self::of_height(corner, item, pen.screen().y - 0.3 * item.y, TextSize::Small)
    }

    /// The item at a point, counted from the first that is seen.
    fn row(&self, point: Vec2) -> Option<usize> {
        let from = point - self.corner;
        let is_beside = from.x < 0.0 || from.x >= self.item.x || from.y < 0.0;
        let row = (from.y / self.item.y) as usize;
        (!is_beside && row < self.visible).then_some(row)
    }
}

/// Where the title and the line below it are, and where they end, drawing units from the upper edge.
pub fn title_lines(pen: &Pen) -> [f32; 3] {
    let (top, line) = (0.13 * pen.screen().y, pen.line(TextSize::Huge));
    [top + 0.3 * line, top + 0.95 * line, top + 0.95 * line + 0.6 * pen.line(TextSize::Body)]
}

/// A menu.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Menu {
    /// Its items.
    pub items: Vec<MenuItem>,
    /// Whether the first item is seen however far it is scrolled.
    pub keeps_first: bool,
    focus: usize,
    first: usize,
}

impl Menu {
    /// A menu of these items.
    #[must_use]
    pub fn new(items: Vec<MenuItem>) -> Self {
        Self { items, keeps_first: false, focus: 0, first: 0 }
    }

    /// The item that the keyboard acts on.
    #[must_use]
    pub fn focus(&self) -> usize {
        self.focus
    }

    /// Moves the focus to an item, or to the last one.
    pub fn set_focus(&mut self, item: usize) {
        self.focus = item.min(self.items.len().saturating_sub(1));
    }

    /// Whether a point lies on it.
    #[must_use]
    pub fn contains(&self, point: Vec2, layout: &MenuLayout) -> bool {
        layout.row(point).is_some_and(|row| row < self.items.len())
    }

    /// What is read aloud: the number of the item in focus, then a line for each item.
    #[must_use]
    pub fn lines(&self) -> String {
        let line = |item: &MenuItem| {
            let value = item.value.iter().map(|value| format!(": {value}"));
            let stars = item
                .stars
                .iter()
                .map(|&stars| format!(", {}", words::text_with(Key::MenuStars, &[("stars", stars.into())])));
            value.chain(stars).fold(format!("\n{}", item.label.text()), |line, part| line + &part)
        };
        self.items.iter().fold(self.focus.to_string(), |lines, item| lines + &line(item))
    }

    /// Moves through the menu by mouse and keyboard.
    pub fn update(&mut self, input: &Input, layout: &MenuLayout) -> Option<MenuChoice> {
        if let Some(item) = input.item {
            self.set_focus(item);
        }
        let choice = self.click(input, layout).or_else(|| self.walk(input));
        if input.wheel.abs() >= 1.0 && self.contains(input.cursor, layout) {
            let (next, is_down) = (self.next(input.wheel < 0.0), input.wheel < 0.0);
            // Not round the ends.
            self.focus = if (next > self.focus) == is_down { next } else { self.focus };
        }
        let last_first = self.items.len().saturating_sub(layout.visible);
        let highest = self.focus.saturating_sub(usize::from(self.keeps_first));
        self.first = self.first.clamp((self.focus + 1).saturating_sub(layout.visible), highest).min(last_first);
        choice
    }

    /// The item in a row, counted from the first that is seen.
    fn in_row(&self, row: usize) -> usize {
        if self.keeps_first && row == 0 { 0 } else { self.first + row }
    }

    fn click(&mut self, input: &Input, layout: &MenuLayout) -> Option<MenuChoice> {
        let item = self.in_row(layout.row(input.cursor)?);
        let is_choice = self.items.get(item).is_some_and(|item| !item.is_heading);
        if !is_choice || !(input.has_moved || input.is_clicked) {
            return None;
        }
        self.focus = item;
        // The left arrow steps back; everything else steps forward.
        let from = (input.cursor.x - layout.corner.x) / layout.item.x;
        let is_back = self.items[item].value.is_some() && BACK_PLACE.contains(&from);
        let pick = if is_back { MenuChoice::Less(item) } else { MenuChoice::Pick(item) };
        input.is_clicked.then_some(pick)
    }

    /// The next item that can be chosen, or the one before, round the ends.
    fn next(&self, is_down: bool) -> usize {
        let count = self.items.len();
        let places = (1..=count).map(|k| (self.focus + if is_down { k } else { count - k }) % count);
        places.into_iter().find(|&item| !self.items[item].is_heading).unwrap_or(self.focus)
    }

    /// The first item that can be chosen, or the last one.
    fn end(&self, is_last: bool) -> usize {
        let mut items = (0..self.items.len()).filter(|&item| !self.items[item].is_heading);
        if is_last { items.next_back() } else { items.next() }.unwrap_or(self.focus)
    }

    fn walk(&mut self, input: &Input) -> Option<MenuChoice> {
        let focus = self.items.get(self.focus)?;
        let (has_value, is_choice) = (focus.value.is_some(), !focus.is_heading);
        match input.step? {
            Move::Up => self.focus = self.next(false),
            Move::Down => self.focus = self.next(true),
            Move::First => self.focus = self.end(false),
            Move::Last => self.focus = self.end(true),
            Move::Left if has_value => return Some(MenuChoice::Less(self.focus)),
            Move::Right if has_value => return Some(MenuChoice::Pick(self.focus)),
            Move::Confirm if is_choice => return Some(MenuChoice::Pick(self.focus)),
            _ => {}
        }
        None
    }

    /// The items that are seen, each with its upper left corner.
    pub fn shown<'a>(&'a self, layout: &MenuLayout) -> impl Iterator<Item = (usize, Vec2)> + use<'a> {
        let (corner, height) = (layout.corner, layout.item.y);
        let rows = 0..layout.visible.min(self.items.len() - self.first);
        rows.map(move |row| (self.in_row(row), corner + Vec2::new(0.0, row as f32 * height)))
    }

    /// Draws it.
    pub fn draw(&self, pen: &mut Pen, layout: &MenuLayout) {
        for (index, low) in self.shown(layout) {
            self.draw_item(pen, layout, low, &self.items[index], index == self.focus);
        }
        let (above, below) = (self.first > 0, self.first + layout.visible < self.items.len());
        let end = layout.corner.y + layout.item.y * layout.visible.min(self.items.len()) as f32;
        let half = 0.5 * layout.item.y;
        for (is_more, y) in [(above, layout.corner.y + half), (below, end - half)] {
            if is_more {
                // Beside the menu: what is written above it is not covered.
                let at = Vec2::new(layout.corner.x + layout.item.x + 0.9 * pen.line(TextSize::Small), y);
                pen.label(at, TextSize::Small, Align::Centre, HALO, "...");
            }
        }
    }

    fn draw_item(&self, pen: &mut Pen, layout: &MenuLayout, low: Vec2, item: &MenuItem, has_focus: bool) {
        if item.is_heading {
            let at = low + Vec2::new(0.0, 0.5 * layout.item.y);
            pen.label(at, layout.size, Align::Left, READY, item.label.text());
            return;
        }
        let high = low + layout.item - Vec2::new(0.0, 2.0);
        let (back, ink) = if has_focus { (fade(HALO, 0.94), INK) } else { (fade(INK, 0.76), HALO) };
        let radius = 0.6 * pen.rounding();
        pen.canvas().rounded(low, high, radius, back);
        let middle = 0.5 * (low.y + high.y);
        let inset = 0.4 * layout.item.y.min(ROW * pen.line(layout.size));
        // The item in focus is marked by shape as well.
        let mark = if has_focus { "> " } else { "  " };
        let label = format!("{mark}{}", item.label.text());
        let width = pen.width(layout.size, &label) + 2.0 * inset;
        let size = if width > layout.item.x { TextSize::Small } else { layout.size };
        pen.write(Vec2::new(low.x + inset, middle), size, Align::Left, ink, &label);
        if let Some(stars) = item.stars {
            let radius = 0.24 * layout.item.y;
            draw_stars(pen, Vec2::new(high.x - inset - 0.5 * stars_width(radius), middle), radius, stars, ink);
        }
        if let Some(value) = &item.value {
            let text = if has_focus { format!("{value} >") } else { value.clone() };
            pen.write(Vec2::new(high.x - inset, middle), layout.size, Align::Right, ink, &text);
            if has_focus {
                pen.write(Vec2::new(low.x + BACK * layout.item.x, middle), layout.size, Align::Centre, ink, "<");
            }
        }
    }
}

#[cfg(test)]
mod tests;
