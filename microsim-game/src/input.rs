//! What the player does in one frame, whether by mouse and keyboard or from a script.

use crate::convert;
use macroquad::input::{
    KeyCode, MouseButton, is_key_down, is_key_pressed, is_mouse_button_down, mouse_position, mouse_wheel,
};
use microsim_core::glam::Vec2;

/// The keys of the built-in scenarios.
const DIGITS: [KeyCode; 9] = [
    KeyCode::Key1,
    KeyCode::Key2,
    KeyCode::Key3,
    KeyCode::Key4,
    KeyCode::Key5,
    KeyCode::Key6,
    KeyCode::Key7,
    KeyCode::Key8,
    KeyCode::Key9,
];

/// The player's actions in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Actions {
    /// Where the cell is told to go, picture pixels.
    pub goal: Option<Vec2>,
    /// Digest what is inside.
    pub digest: bool,
    /// Where the cursor is, picture pixels.
    pub cursor: Vec2,
    /// Zooming with a key: 1 in, -1 out.
    pub zoom: f32,
    /// Zooming with the wheel: notches, in is positive.
    pub wheel: f32,
    /// Stop or go on.
    pub pause: bool,
    /// One step while paused.
    pub single_step: bool,
    /// Leave.
    pub quit: bool,
    /// Take a picture.
    pub screenshot: bool,
    /// Show the built-in scenario at this position.
    pub scenario: Option<usize>,
}

/// What mouse and keyboard say in this frame.
#[must_use]
pub fn read() -> Actions {
    let cursor = convert::point(mouse_position());
    let held = |key| if is_key_down(key) { 1.0 } else { 0.0 };
    Actions {
        goal: is_mouse_button_down(MouseButton::Left).then_some(cursor),
        digest: is_key_down(KeyCode::Q),
        cursor,
        zoom: held(KeyCode::D) - held(KeyCode::A),
        // A notch is 1 on some systems and 120 on others.
        wheel: mouse_wheel().1.clamp(-1.0, 1.0),
        pause: is_key_pressed(KeyCode::Space),
        single_step: is_key_pressed(KeyCode::N),
        quit: is_key_pressed(KeyCode::Escape),
        screenshot: is_key_pressed(KeyCode::F12),
        scenario: DIGITS.iter().position(|&digit| is_key_pressed(digit)),
    }
}
