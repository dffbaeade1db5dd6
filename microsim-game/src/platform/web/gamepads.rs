//! Gamepads of a browser.

use super::lines;
use crate::input::gamepad::{Gamepad, PadButton};
use microsim_core::glam::Vec2;

/// Buttons by their numbers in the browser's usual layout.
const BUTTONS: [(i32, PadButton); 9] = [
    (0, PadButton::South),
    (1, PadButton::East),
    (2, PadButton::West),
    (3, PadButton::West),
    (9, PadButton::Start),
    (12, PadButton::Up),
    (13, PadButton::Down),
    (14, PadButton::Left),
    (15, PadButton::Right),
];

/// All gamepads: the browser knows them.
#[derive(Debug, Default)]
pub struct Gamepads;

impl Gamepads {
    /// What they say now.
    pub fn read(&mut self) -> Vec<Gamepad> {
        lines("gamepads").iter().filter_map(|line| gamepad(line)).collect()
    }
}

/// A line has the stick's two axes in hundredths and the numbers of the buttons that are down.
fn gamepad(line: &str) -> Option<Gamepad> {
    let numbers: Vec<i32> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
    let [x, y, down @ ..] = numbers.as_slice() else { return None };
    let known = BUTTONS.into_iter().filter(|(number, _)| down.contains(number));
    Some(Gamepad { stick: 0.01 * Vec2::new(*x as f32, *y as f32), down: known.map(|(_, button)| button).collect() })
}
