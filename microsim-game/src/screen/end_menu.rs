//! The menu at an end: it opens under a hand that may still be steering, and waits until that has let go.

use super::context::AppContext;
use super::join::LONGEST;
use super::page::draw_shade;
use super::{MainScreen, Next, today};
use crate::input::{Action, Input, Move};
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuChoice, MenuItem, MenuLayout};
use crate::ui::pen::Pen;
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// Time for which the menu does not answer, s.
const DELAY: f32 = 0.7;
/// Time in which the scene below gets dark, s.
const FADING: f32 = 0.4;

/// The menu.
#[derive(Debug)]
pub(super) struct EndMenu {
    pub menu: Menu,
    since: f32,
    /// Whether the hand that steered has let go since, and then moved: before that a click picks nothing.
    has_let_go: bool,
    has_moved: bool,
}

/// What the player wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EndChoice {
    /// The same again.
    Again,
    /// To leave.
    Leave,
    /// This item of the menu.
    Pick(usize),
}

impl EndMenu {
    pub(super) fn new(labels: &[Key]) -> Self {
        let menu = Menu::new(labels.iter().map(|&label| MenuItem::new(label)).collect());
        Self { menu, since: 0.0, has_let_go: false, has_moved: false }
    }

    /// Where the player's choice leads: the first item again, the next ones to `others`, all else to the title.
    pub(super) fn lead(
        &mut self,
        input: &Input,
        context: &AppContext,
        top: f32,
        again: impl FnOnce() -> Next,
        others: &[fn(&AppContext) -> Next],
    ) -> Next {
        match self.update(input, context, &MenuLayout::middle(&context.pen, top)) {
            Some(EndChoice::Again | EndChoice::Pick(0)) => again(),
            Some(EndChoice::Pick(item)) if item <= others.len() => others[item - 1](context),
            Some(_) => Next::Show(MainScreen::Title),
            None => Next::Stay,
        }
    }

    /// Darkens the scene, more and more.
    pub(super) fn draw_shade(&self, pen: &mut Pen) {
        draw_shade(pen, (self.since / FADING).min(1.0));
    }

    /// Draws a panel behind text of this width, from one height to another.
    pub(super) fn draw_panel(pen: &mut Pen, width: f32, [top, bottom]: [f32; 2]) {
        let (middle, line) = (0.5 * pen.screen().x, pen.line(TextSize::Body));
        let half = (0.5 * width + 0.8 * line).min(middle - 0.2 * line);
        pen.panel(Vec2::new(middle - half, (top - 0.4 * line).max(0.0)), Vec2::new(middle + half, bottom + 0.2 * line));
    }

    pub(super) fn update(&mut self, input: &Input, context: &AppContext, layout: &MenuLayout) -> Option<EndChoice> {
        self.since += context.pace.elapsed;
        self.has_let_go |= !input.is_held && input.steer == Vec2::ZERO;
        self.has_moved |= self.has_let_go && input.has_moved;
        if self.since < DELAY {
            return None;
        }
        // Keys that steered move nothing until they are let go.
        let step = input.step.filter(|_| self.has_let_go);
        let input = &Input { is_clicked: input.is_clicked && self.has_moved, step, ..input.clone() };
        if input.presses(Action::Restart) {
            return Some(EndChoice::Again);
        }
        if input.step == Some(Move::Back) {
            return Some(EndChoice::Leave);
        }
        match self.menu.update(input, layout) {
            Some(MenuChoice::Pick(item)) => Some(EndChoice::Pick(item)),
            _ => None,
        }
    }
}

/// What is said of a place among the best, from 0 on.
pub(super) fn rank(place: usize) -> String {
    if place == 0 {
        words::text(Key::EndBest).to_owned()
    } else {
        words::text_with(Key::EndRank, &[("place", (place as u32 + 1).into())])
    }
}

/// Who played, and on which day since 1970; none in pictures that must come out the same.
pub(super) fn signature(context: &AppContext) -> (String, u32) {
    (context.settings.name.chars().take(LONGEST).collect(), today(context).unwrap_or_default())
}

/// A heading, and a doubt about a replay that went otherwise.
pub(super) fn doubted(heading: String, is_mismatch: bool) -> String {
    if is_mismatch { heading + words::text(Key::EndDoubt) } else { heading }
}
