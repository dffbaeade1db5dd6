//! Gamepads: what one says in a frame, whoever reads it, and what that means.

use super::{Action, Input, Move};
use microsim_core::glam::Vec2;

/// How far a stick has to be moved to count, share of its way.
const LEAST: f32 = 0.35;

/// A button, by its place on the usual layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PadButton {
    /// The lower one of four at the right: A.
    South,
    /// The right one of them: B.
    East,
    /// The left and the upper one of them: X and Y, which systems name differently.
    West,
    /// The right one of two in the middle.
    Start,
    /// Of the cross.
    Up,
    /// Of the cross.
    Down,
    /// Of the cross.
    Left,
    /// Of the cross.
    Right,
}

/// A gamepad in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gamepad {
    /// Where the left stick points, -1 to 1 in each direction, downwards positive.
    pub stick: Vec2,
    /// Buttons that are down.
    pub down: Vec<PadButton>,
}

/// What all gamepads together mean.
#[derive(Clone, Debug, Default)]
pub struct Hand {
    /// What was down in the last frame.
    before: Vec<PadButton>,
}

impl Hand {
    /// Adds what they say to the input of a frame. In a scene the right button does not lead back: it divides; and the
    /// cross names a place.
    pub fn add(&mut self, pads: &[Gamepad], is_scene: bool, input: &mut Input) {
        let farthest = pads.iter().map(|pad| pad.stick).max_by(|a, b| a.length().total_cmp(&b.length()));
        let stick = farthest.filter(|stick| stick.length() >= LEAST).map_or(Vec2::ZERO, Vec2::normalize_or_zero);
        if input.steer == Vec2::ZERO {
            input.steer = stick;
        }
        let down: Vec<PadButton> = pads.iter().flat_map(|pad| pad.down.iter().copied()).collect();
        let before = std::mem::replace(&mut self.before, down.clone());
        if down.contains(&PadButton::South) {
            input.held.push(Action::Consume);
        }
        for button in down.into_iter().filter(|button| !before.contains(button)) {
            input.pressed.extend(action(button));
            input.step = input.step.or(step(button, is_scene));
            input.place = input.place.or(place(button)).filter(|_| is_scene);
        }
    }
}

fn action(button: PadButton) -> Option<Action> {
    match button {
        PadButton::East => Some(Action::Divide),
        PadButton::West => Some(Action::Lunge),
        PadButton::Start => Some(Action::Pause),
        _ => None,
    }
}

fn step(button: PadButton, is_scene: bool) -> Option<Move> {
    match button {
        PadButton::South => Some(Move::Confirm),
        PadButton::East => (!is_scene).then_some(Move::Back),
        PadButton::Start | PadButton::West => None,
        PadButton::Up => Some(Move::Up),
        PadButton::Down => Some(Move::Down),
        PadButton::Left => Some(Move::Left),
        PadButton::Right => Some(Move::Right),
    }
}

fn place(button: PadButton) -> Option<usize> {
    [PadButton::Left, PadButton::Up, PadButton::Right].iter().position(|&other| other == button)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(hand: &mut Hand, stick: Vec2, down: &[PadButton], is_scene: bool) -> Input {
        let mut input = Input::default();
        hand.add(&[Gamepad::default(), Gamepad { stick, down: down.to_vec() }], is_scene, &mut input);
        input
    }

    #[test]
    fn the_stick_steers_beyond_its_middle_unless_keys_do() {
        let mut hand = Hand::default();
        assert_eq!(read(&mut hand, Vec2::new(0.2, 0.2), &[], true).steer, Vec2::ZERO);
        assert!((read(&mut hand, Vec2::new(0.3, 0.4), &[], true).steer - Vec2::new(0.6, 0.8)).length() < 1e-6);
        let mut input = Input { steer: -Vec2::X, ..Input::default() };
        hand.add(&[Gamepad { stick: Vec2::Y, down: Vec::new() }], true, &mut input);
        assert_eq!(input.steer, -Vec2::X);
        assert_eq!(
            {
                hand.add(&[], true, &mut input);
                input.steer
            },
            -Vec2::X,
            "no gamepad"
        );
    }

    #[test]
    fn buttons_count_once_and_b_divides_in_a_scene_but_leads_back_in_a_menu() {
        use PadButton::{East, Right, South, Start, Up, West};
        let mut hand = Hand::default();
        let first = read(&mut hand, Vec2::ZERO, &[South, Start], true);
        assert!(first.holds(Action::Consume) && first.presses(Action::Pause) && first.step == Some(Move::Confirm));
        let second = read(&mut hand, Vec2::ZERO, &[South, Start, East, West], true);
        assert!(second.holds(Action::Consume) && !second.presses(Action::Pause));
        assert!(second.presses(Action::Divide) && second.presses(Action::Lunge) && second.step.is_none());
        assert_eq!(read(&mut hand, Vec2::ZERO, &[], false), Input::default());
        assert_eq!(read(&mut hand, Vec2::ZERO, &[East], false).step, Some(Move::Back));
        assert_eq!(read(&mut hand, Vec2::ZERO, &[East, Up], false).step, Some(Move::Up));
        assert_eq!(read(&mut hand, Vec2::ZERO, &[Right], false).step, Some(Move::Right));
    }

    #[test]
    fn the_cross_names_one_of_three_places_in_a_scene_once() {
        use PadButton::{Down, Left, Right, South, Up};
        let place = |hand: &mut Hand, button, is_scene| read(hand, Vec2::ZERO, &[button], is_scene).place;
        let mut hand = Hand::default();
        let named = [Left, Left, Up, Right, Down, South].map(|button| place(&mut hand, button, true));
        assert_eq!(named, [Some(0), None, Some(1), Some(2), None, None]);
        assert_eq!(place(&mut hand, Up, false), None, "it moves through a menu");
    }
}
