//! Gamepads on Windows and macOS.

use crate::input::gamepad::{Gamepad, PadButton};
use gilrs::{Axis, Button, Gilrs};
use microsim_core::glam::Vec2;

/// Buttons by the system's names.
const BUTTONS: [(Button, PadButton); 9] = [
    (Button::South, PadButton::South),
    (Button::East, PadButton::East),
    (Button::West, PadButton::West),
    (Button::North, PadButton::West),
    (Button::Start, PadButton::Start),
    (Button::DPadUp, PadButton::Up),
    (Button::DPadDown, PadButton::Down),
    (Button::DPadLeft, PadButton::Left),
    (Button::DPadRight, PadButton::Right),
];

/// All gamepads; none where the system has no way to ask.
#[derive(Debug)]
pub struct Gamepads(Option<Gilrs>);

impl Default for Gamepads {
    fn default() -> Self {
        Self(Gilrs::new().ok())
    }
}

impl Gamepads {
    /// What they say now.
    pub fn read(&mut self) -> Vec<Gamepad> {
        let Some(system) = &mut self.0 else { return Vec::new() };
        while system.next_event().is_some() {}
        let read = |pad: gilrs::Gamepad<'_>| Gamepad {
            stick: Vec2::new(pad.value(Axis::LeftStickX), -pad.value(Axis::LeftStickY)),
            down: BUTTONS.into_iter().filter(|(button, _)| pad.is_pressed(*button)).map(|(_, button)| button).collect(),
        };
        system.gamepads().map(|(_, pad)| read(pad)).collect()
    }
}
