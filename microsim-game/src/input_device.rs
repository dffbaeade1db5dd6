//! Mouse, keyboard and gamepads.

use crate::input::gamepad::Hand;
use crate::input::keys::{Keys, LETTERS};
use crate::input::{Action, Input, Move};
use crate::{convert, platform};
use macroquad::input::{
    KeyCode, MouseButton, get_last_key_pressed, is_key_down, is_key_pressed, is_mouse_button_down,
    is_mouse_button_pressed, mouse_position, mouse_wheel, utils,
};
use macroquad::miniquad;
use microsim_core::glam::Vec2;
use std::collections::VecDeque;

/// Reads mouse and keyboard of the open window, and gamepads.
#[derive(Debug)]
pub struct Device {
    /// Number under which macroquad repeats the window's events.
    subscriber: usize,
    cursor: Vec2,
    gamepads: platform::Gamepads,
    hand: Hand,
    steps: Steps,
}

impl Device {
    /// Listens to the window. Needs an open one.
    #[must_use]
    pub fn new() -> Self {
        let (gamepads, hand) = (platform::Gamepads::default(), Hand::default());
        Self {
            subscriber: utils::register_input_subscriber(),
            cursor: Vec2::ZERO,
            gamepads,
            hand,
            steps: Steps::default(),
        }
    }

    /// What they say in this frame, in a scene or in a menu.
    pub fn read(&mut self, keys: &Keys, is_scene: bool) -> Input {
        let cursor = convert::point(mouse_position());
        let has_moved = std::mem::replace(&mut self.cursor, cursor) != cursor;
        let all = || Action::ALL.into_iter();
        let buttons = platform::screen_buttons();
        let is_in = |names: &[String], name: &str| names.iter().any(|other| other == name);
        let button_step = Move::ALL.into_iter().find(|(_, name)| is_in(&buttons.pressed, name)).map(|(step, _)| step);
        utils::repeat_all_miniquad_input(&mut self.steps, self.subscriber);
        let mut input = Input {
            cursor,
            has_moved,
            steer: steer(is_key_down, keys.letters_steer()),
            is_held: is_mouse_button_down(MouseButton::Left) || is_mouse_button_down(MouseButton::Right),
            is_clicked: is_mouse_button_pressed(MouseButton::Left),
            // A notch is 1 on some systems and 120 on others.
            wheel: mouse_wheel().1.clamp(-1.0, 1.0),
            held: all().filter(|&action| is_key_down(keys.of(action)) || is_in(&buttons.held, action.name())).collect(),
            pressed: all()
                .filter(|&action| is_key_pressed(keys.of(action)) || is_in(&buttons.pressed, action.name()))
                .collect(),
            step: self.steps.next().or(button_step),
            item: buttons.item,
            place: None,
            key: get_last_key_pressed(),
            dropped: platform::dropped_files(),
            has_lost_focus: std::mem::take(&mut self.steps.has_lost_focus),
        };
        if is_mouse_button_pressed(MouseButton::Right) {
            input.pressed.push(Action::Lunge);
        }
        self.hand.add(&self.gamepads.read(), is_scene, &mut input);
        input
    }
}

impl Default for Device {
    fn default() -> Self {
        Self::new()
    }
}

/// Keys that move through menus.
const MOVES: [(KeyCode, Move); 9] = [
    (KeyCode::Up, Move::Up),
    (KeyCode::Down, Move::Down),
    (KeyCode::Left, Move::Left),
    (KeyCode::Right, Move::Right),
    (KeyCode::Home, Move::First),
    (KeyCode::End, Move::Last),
    (KeyCode::Enter, Move::Confirm),
    (KeyCode::KpEnter, Move::Confirm),
    (KeyCode::Escape, Move::Back),
];

/// How many moves wait for their frames at most.
const MOST_WAITING: usize = 8;

/// Where the arrow keys point that are down, and letters where they steer.
fn steer(is_down: impl Fn(KeyCode) -> bool, by_letters: bool) -> Vec2 {
    let arrows = [KeyCode::Up, KeyCode::Left, KeyCode::Down, KeyCode::Right];
    let ways = [-Vec2::Y, -Vec2::X, Vec2::Y, Vec2::X];
    let is_held = |k: usize| is_down(arrows[k]) || by_letters && is_down(LETTERS[k]);
    (0..ways.len()).filter(|&k| is_held(k)).map(|k| ways[k]).sum::<Vec2>().normalize_or_zero()
}

/// Moves by keys that went down, in their order: each frame takes one, so that none is lost of those that come within a frame. Listens
/// for the loss of the keyboard, too, which miniquad reports as being minimised.
#[derive(Debug, Default)]
struct Steps {
    waiting: VecDeque<Move>,
    has_lost_focus: bool,
}

impl Steps {
    fn next(&mut self) -> Option<Move> {
        self.waiting.pop_front()
    }
}

impl miniquad::EventHandler for Steps {
    fn update(&mut self) {}

    fn draw(&mut self) {}

    fn key_down_event(&mut self, key: KeyCode, _: miniquad::KeyMods, is_repeated: bool) {
        let step = MOVES.into_iter().find(|(known, _)| *known == key && !is_repeated);
        self.waiting.extend(step.map(|(_, step)| step).filter(|_| self.waiting.len() < MOST_WAITING));
    }

    fn window_minimized_event(&mut self) {
        self.has_lost_focus = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use macroquad::miniquad::EventHandler;

    #[test]
    fn of_keys_that_go_down_within_a_frame_each_is_a_move_in_a_frame_of_its_own() {
        let mut steps = Steps::default();
        for (key, is_repeated) in [
            (KeyCode::Down, false),
            (KeyCode::Down, false),
            (KeyCode::Down, true),
            (KeyCode::Q, false),
            (KeyCode::Enter, false),
        ] {
            steps.key_down_event(key, miniquad::KeyMods::default(), is_repeated);
        }
        let taken: Vec<Option<Move>> = (0..4).map(|_| steps.next()).collect();
        assert_eq!(taken, [Some(Move::Down), Some(Move::Down), Some(Move::Confirm), None]);
    }

    #[test]
    fn arrow_keys_steer_in_eight_directions_and_opposite_ones_cancel() {
        let held = |keys: &'static [KeyCode]| steer(|key| keys.contains(&key), false);
        assert_eq!(held(&[]), Vec2::ZERO);
        assert_eq!(held(&[KeyCode::Left]), -Vec2::X);
        assert!((held(&[KeyCode::Up, KeyCode::Right]) - Vec2::new(0.5_f32.sqrt(), -(0.5_f32.sqrt()))).length() < 1e-6);
        assert_eq!(held(&[KeyCode::Up, KeyCode::Down]), Vec2::ZERO);
        let letters = |by_letters| LETTERS.map(|letter| steer(|key| key == letter, by_letters));
        assert_eq!(letters(false), [Vec2::ZERO; 4]);
        assert_eq!(letters(true), [-Vec2::Y, -Vec2::X, Vec2::Y, Vec2::X]);
    }
}
