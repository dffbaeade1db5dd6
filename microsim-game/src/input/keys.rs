//! Which key does what.

use super::Action;
use macroquad::input::KeyCode;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Keys that may be given to actions; the others move through menus or mean nothing on some keyboards.
const USABLE: [&[KeyCode]; 2] = {
    use KeyCode::*;
    [
        &[
            A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z, Key0, Key1, Key2, Key3, Key4,
            Key5, Key6, Key7, Key8, Key9, F1, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12, Space, Tab, Comma, Period,
            Minus, Equal, Slash, Semicolon, LeftShift, RightShift, Backspace, Home, End, PageUp, PageDown, Insert,
            Delete, KpAdd, KpSubtract,
        ],
        &[LeftBracket, RightBracket, LeftControl, RightControl],
    ]
};

/// Letters that steer where no action has one of them: up, left, down, right.
pub const LETTERS: [KeyCode; 4] = [KeyCode::W, KeyCode::A, KeyCode::S, KeyCode::D];

/// The keys of all actions; the settings keep them by name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "BTreeMap<String, String>", into = "BTreeMap<Action, String>")]
pub struct Keys(BTreeMap<Action, KeyCode>);

/// Unknown actions and keys, perhaps of another version, are left out, and no key gets two meanings.
impl From<BTreeMap<String, String>> for Keys {
    fn from(names: BTreeMap<String, String>) -> Self {
        let mut keys = Self::default();
        for action in Action::ALL {
            let wanted = names.get(action.name());
            let known = USABLE.concat().into_iter().find(|&key| wanted.is_some_and(|wanted| name(key) == *wanted));
            if let Some(key) = known {
                keys.set(action, key);
            }
        }
        keys
    }
}

impl From<Keys> for BTreeMap<Action, String> {
    fn from(keys: Keys) -> Self {
        keys.0.into_iter().map(|(action, key)| (action, name(key))).collect()
    }
}

impl Default for Keys {
    fn default() -> Self {
        Self(Action::ALL.into_iter().map(|action| (action, usual(action))).collect())
    }
}

impl Keys {
    /// The key of an action.
    #[must_use]
    pub fn of(&self, action: Action) -> KeyCode {
        self.0.get(&action).copied().unwrap_or_else(|| usual(action))
    }

    /// What is written on the key of an action.
    #[must_use]
    pub fn label(&self, action: Action) -> String {
        let name = name(self.of(action));
        name.strip_prefix("Key").unwrap_or(&name).to_owned()
    }

    /// Whether [`LETTERS`] steer.
    #[must_use]
    pub fn letters_steer(&self) -> bool {
        Action::ALL.into_iter().all(|action| !LETTERS.contains(&self.of(action)))
    }

    /// Gives zooming other keys than letters that steer, or its usual ones.
    pub fn change_letters(&mut self) {
        let steers = self.letters_steer();
        for (action, other) in [(Action::ZoomOut, KeyCode::Minus), (Action::ZoomIn, KeyCode::Equal)] {
            self.set(action, if steers { usual(action) } else { other });
        }
    }

    /// Gives a key to an action; the action that had it gets the old key of this one. Returns whether the key can be used.
    pub fn set(&mut self, action: Action, key: KeyCode) -> bool {
        if !USABLE.concat().contains(&key) {
            return false;
        }
        let old = self.of(action);
        if let Some(other) = Action::ALL.into_iter().find(|&other| other != action && self.of(other) == key) {
            self.0.insert(other, old);
        }
        self.0.insert(action, key);
        true
    }
}

fn usual(action: Action) -> KeyCode {
    match action {
        Action::Consume => KeyCode::Q,
        Action::ZoomIn => KeyCode::D,
        Action::ZoomOut => KeyCode::A,
        Action::Lunge => KeyCode::LeftShift,
        Action::Divide => KeyCode::X,
        Action::Pause => KeyCode::Space,
        Action::Step => KeyCode::N,
        Action::Slower => KeyCode::Comma,
        Action::Faster => KeyCode::Period,
        Action::Restart => KeyCode::R,
        Action::Optics => KeyCode::O,
        Action::DebugView => KeyCode::B,
        Action::Plots => KeyCode::P,
        Action::Panel => KeyCode::Tab,
        Action::Undo => KeyCode::Z,
        Action::Screenshot => KeyCode::F12,
        Action::FullScreen => KeyCode::F11,
    }
}

fn name(key: KeyCode) -> String {
    format!("{key:?}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn t73_the_thesis_keys_are_the_usual_ones_and_no_key_has_two_meanings() {
        let keys = Keys::default();
        assert_eq!(keys.of(Action::Consume), KeyCode::Q);
        assert_eq!((keys.of(Action::ZoomOut), keys.of(Action::ZoomIn)), (KeyCode::A, KeyCode::D));
        let all: BTreeSet<_> = Action::ALL.iter().map(|&action| name(keys.of(action))).collect();
        assert_eq!(all.len(), Action::ALL.len());
    }

    #[test]
    fn keys_are_exchanged_and_never_lost() {
        let mut keys = Keys::default();
        assert!(keys.set(Action::Consume, KeyCode::A));
        assert_eq!((keys.of(Action::Consume), keys.of(Action::ZoomOut)), (KeyCode::A, KeyCode::Q));
        assert!(!keys.set(Action::Consume, KeyCode::Escape));
        assert_eq!(keys.label(Action::Consume), "A");
    }

    #[test]
    fn letters_steer_where_zooming_has_other_keys() {
        let mut keys = Keys::default();
        assert!(!keys.letters_steer());
        keys.change_letters();
        assert_eq!((keys.letters_steer(), keys.of(Action::ZoomOut)), (true, KeyCode::Minus));
        keys.set(Action::Plots, KeyCode::W);
        assert!(!keys.letters_steer());
        keys.set(Action::Plots, KeyCode::P);
        keys.change_letters();
        assert_eq!(keys, Keys::default());
    }

    #[test]
    fn unknown_names_fall_back_to_the_usual_key() {
        let keys = Keys::from(BTreeMap::from([("consume".to_owned(), "Nonsense".to_owned())]));
        assert_eq!(keys.of(Action::Consume), KeyCode::Q);
        assert_eq!(keys.of(Action::Pause), KeyCode::Space);
    }
}
