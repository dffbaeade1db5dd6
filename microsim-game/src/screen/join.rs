//! The code of a room: whoever types the same one is in the same room.

use super::context::AppContext;
use super::page::draw_heading;
use super::{MainScreen, Next, Screen};
use crate::draw::palette::{HALO, READY};
use crate::input::{Input, Move};
use crate::ui::font::TextSize;
use crate::ui::pen::Align;
use crate::words::{self, Key};
use macroquad::input::KeyCode;
use microsim_core::glam::Vec2;

/// Longest code, letters.
const LONGEST: usize = 12;

#[derive(Debug)]
pub(super) struct Join {
    code: String,
}

impl Join {
    pub(super) fn new(context: &AppContext) -> Self {
        Self { code: context.party.code.clone() }
    }

    fn type_key(&mut self, key: KeyCode) {
        if key == KeyCode::Backspace {
            self.code.pop();
        }
        if self.code.len() < LONGEST {
            self.code.extend(letter(key));
        }
    }
}

/// The letter or digit of a key.
pub(super) fn letter(key: KeyCode) -> Option<char> {
    let name = format!("{key:?}");
    let name = ["Key", "Kp"].into_iter().find_map(|before| name.strip_prefix(before)).unwrap_or(&name);
    name.parse().ok()
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
            self.type_key(key);
        }
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        draw_heading(pen, words::text(Key::TitleNetwork));
        let (middle, line) = (0.5 * pen.screen(), pen.line(TextSize::Body));
        pen.write(middle, TextSize::Large, Align::Centre, READY, &format!("{}_", self.code));
        let told = [words::text(Key::JoinHow), words::text(Key::JoinWho)];
        let told = told.into_iter().flat_map(|text| pen.wrap(TextSize::Small, text, 0.94 * pen.screen().x));
        for (k, text) in told.collect::<Vec<_>>().into_iter().enumerate() {
            let at = middle + Vec2::new(0.0, (2.0 + k as f32) * line);
            pen.write(at, TextSize::Small, Align::Centre, HALO, &text);
        }
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
        let mut join = Join { code: String::new() };
        for key in
            [KeyCode::A, KeyCode::Key7, KeyCode::Space, KeyCode::F1, KeyCode::Kp3, KeyCode::B, KeyCode::Backspace]
        {
            join.type_key(key);
        }
        assert_eq!(join.code, "A73");
        (0..20).for_each(|_| join.type_key(KeyCode::Z));
        assert_eq!(join.code.len(), LONGEST);
    }
}
