//! The code of a room: whoever types the same one is in the same room.

use super::context::AppContext;
use super::page::draw_heading;
use super::{MainScreen, Next, Screen};
use crate::draw::palette::{HALO, INK, READY, fade};
use crate::input::{Input, Move};
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use macroquad::input::KeyCode;
use microsim_core::glam::Vec2;

/// Longest code or name, letters.
pub(super) const LONGEST: usize = 12;

#[derive(Debug)]
pub(super) struct Join {
    code: String,
}

impl Join {
    pub(super) fn new(context: &AppContext) -> Self {
        Self { code: context.party.code.clone() }
    }
}

/// Types a key at the end of a line.
pub(super) fn type_key(line: &mut String, key: KeyCode) {
    if key == KeyCode::Backspace {
        line.pop();
    }
    if line.len() < LONGEST {
        line.extend(letter(key));
    }
}

/// The letter or digit of a key.
pub(super) fn letter(key: KeyCode) -> Option<char> {
    let name = format!("{key:?}");
    let name = ["Key", "Kp"].into_iter().find_map(|before| name.strip_prefix(before)).unwrap_or(&name);
    name.parse().ok()
}

/// Draws what is typed in a frame, below a heading and above what is said of it.
pub(super) fn draw_typed(pen: &mut Pen, heading: Key, typed: &str, told: &[Key]) {
    draw_heading(pen, words::text(heading));
    let (middle, line) = (0.5 * pen.screen(), pen.line(TextSize::Body));
    let half = Vec2::new((7.5 * line).min(middle.x), line);
    let radius = pen.rounding();
    pen.canvas().rounded(middle - half, middle + half, radius, fade(HALO, 0.5));
    let inner = half - Vec2::splat(0.1 * line);
    pen.canvas().rounded(middle - inner, middle + inner, radius, fade(INK, 0.9));
    pen.write(middle, TextSize::Large, Align::Centre, READY, &format!("{typed}_"));
    let told = told.iter().flat_map(|key| pen.wrap(TextSize::Small, words::text(*key), 0.94 * pen.screen().x));
    for (k, text) in told.collect::<Vec<_>>().into_iter().enumerate() {
        let at = middle + Vec2::new(0.0, (2.0 + k as f32) * line);
        pen.write(at, TextSize::Small, Align::Centre, HALO, &text);
    }
}

impl Screen for Join {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        match input.step {
            Some(Move::Back) => return Next::Back,
            Some(Move::Confirm) => {
                context.party.code.clone_from(&self.code);
                return Next::Show(MainScreen::Room(self.code.clone()));
            }
            _ => {}
        }
        if let Some(key) = input.key {
            type_key(&mut self.code, key);
        }
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        draw_typed(&mut context.pen, Key::TitleNetwork, &self.code, &[Key::JoinHow, Key::JoinWho]);
    }

    fn waits_for_key(&self) -> bool {
        true
    }

    fn name(&self) -> String {
        "join".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_and_digits_make_a_code() {
        let mut code = String::new();
        for key in
            [KeyCode::A, KeyCode::Key7, KeyCode::Space, KeyCode::F1, KeyCode::Kp3, KeyCode::B, KeyCode::Backspace]
        {
            type_key(&mut code, key);
        }
        assert_eq!(code, "A73");
        (0..20).for_each(|_| type_key(&mut code, KeyCode::Z));
        assert_eq!(code.len(), LONGEST);
    }
}
