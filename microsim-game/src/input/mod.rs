//! What the player does in one frame, whether by mouse, keyboard and gamepad or from a script.

pub mod gamepad;
pub mod keys;
pub mod script;

use crate::words::Key;
use macroquad::input::KeyCode;
use microsim_core::glam::Vec2;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Something that a key does. Which key, the player decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Action {
    /// Digest what is inside, while held; for players who ask for a key, see the settings.
    Consume,
    /// Look closer, while held.
    ZoomIn,
    /// Look from farther away, while held.
    ZoomOut,
    /// Become two cells, in the food chain.
    Divide,
    /// Crawl faster for a moment, in the game and in the food chain.
    Lunge,
    /// Stop or go on.
    Pause,
    /// One step while stopped.
    Step,
    /// Slower motion.
    Slower,
    /// Faster motion.
    Faster,
    /// Start over.
    Restart,
    /// The next way of looking through the microscope.
    Optics,
    /// Particles, constraints and contacts.
    DebugView,
    /// Curves of the time of a step and the area of the cell.
    Plots,
    /// Hide or show the panel of tools.
    Panel,
    /// The world of before the last tool's act.
    Undo,
    /// Save a picture.
    Screenshot,
    /// Fill the screen, or a window again.
    FullScreen,
}

impl Action {
    /// All of them, in the order of the settings.
    pub const ALL: [Self; 17] = {
        use Action::*;
        [
            Consume, ZoomIn, ZoomOut, Lunge, Divide, Pause, Step, Slower, Faster, Restart, Optics, DebugView, Plots,
            Panel, Undo, Screenshot, FullScreen,
        ]
    };

    /// Its name in scripts.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.word()
    }

    /// What it says in the settings.
    #[must_use]
    pub fn label(self) -> Key {
        match self {
            Self::Consume => Key::ActionConsume,
            Self::ZoomIn => Key::ActionZoomIn,
            Self::ZoomOut => Key::ActionZoomOut,
            Self::Lunge => Key::ActionLunge,
            Self::Divide => Key::ActionDivide,
            Self::Pause => Key::ActionPause,
            Self::Step => Key::ActionStep,
            Self::Slower => Key::ActionSlower,
            Self::Faster => Key::ActionFaster,
            Self::Restart => Key::ActionRestart,
            Self::Optics => Key::ActionOptics,
            Self::DebugView => Key::ActionDebugView,
            Self::Plots => Key::ActionPlots,
            Self::Panel => Key::ActionPanel,
            Self::Undo => Key::ActionUndo,
            Self::Screenshot => Key::ActionScreenshot,
            Self::FullScreen => Key::ActionFullScreen,
        }
    }

    /// Its name in scripts and in the settings.
    fn word(self) -> &'static str {
        match self {
            Self::Consume => "consume",
            Self::ZoomIn => "zoom-in",
            Self::ZoomOut => "zoom-out",
            Self::Lunge => "lunge",
            Self::Divide => "divide",
            Self::Pause => "pause",
            Self::Step => "step",
            Self::Slower => "slower",
            Self::Faster => "faster",
            Self::Restart => "restart",
            Self::Optics => "optics",
            Self::DebugView => "debug-view",
            Self::Plots => "plots",
            Self::Panel => "panel",
            Self::Undo => "undo",
            Self::Screenshot => "screenshot",
            Self::FullScreen => "full-screen",
        }
    }
}

/// A key that moves through menus. These cannot be changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// To the item above.
    Up,
    /// To the item below.
    Down,
    /// A smaller value.
    Left,
    /// A greater value.
    Right,
    /// The first item.
    First,
    /// The last one.
    Last,
    /// Choose it.
    Confirm,
    /// Leave.
    Back,
}

impl Move {
    /// All of them, with their names in scripts.
    pub const ALL: [(Self, &'static str); 8] = [
        (Self::Up, "up"),
        (Self::Down, "down"),
        (Self::Left, "left"),
        (Self::Right, "right"),
        (Self::First, "home"),
        (Self::Last, "end"),
        (Self::Confirm, "enter"),
        (Self::Back, "escape"),
    ];
}

/// The player's input in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// Where the cursor is, drawing units from the upper left corner.
    pub cursor: Vec2,
    /// Whether the cursor has moved since the last frame.
    pub has_moved: bool,
    /// Where the arrow keys that are down point, or a gamepad's stick: of length 1 or 0, downwards positive.
    pub steer: Vec2,
    /// Whether the left button is down, or the right one, with which a cell lunges towards the cursor.
    pub is_held: bool,
    /// Whether the left one went down in this frame.
    pub is_clicked: bool,
    /// Notches of the wheel, away from the player is positive.
    pub wheel: f32,
    /// Actions of which the key is down.
    pub held: Vec<Action>,
    /// Actions of which the key went down in this frame.
    pub pressed: Vec<Action>,
    /// A move through a menu.
    pub step: Option<Move>,
    /// The item of a menu that is pointed at in another way than with the cursor.
    pub item: Option<usize>,
    /// The left, middle or right one of three, by the cross of a gamepad in a scene.
    pub place: Option<usize>,
    /// The key that went down in this frame, whatever it does.
    pub key: Option<KeyCode>,
    /// Files that were dropped on the window.
    pub dropped: Vec<PathBuf>,
    /// Whether the window has lost the keyboard in this frame.
    pub has_lost_focus: bool,
}

impl Input {
    /// Whether the key of an action is down.
    #[must_use]
    pub fn holds(&self, action: Action) -> bool {
        self.held.contains(&action)
    }

    /// Whether the key of an action went down in this frame.
    #[must_use]
    pub fn presses(&self, action: Action) -> bool {
        self.pressed.contains(&action)
    }

    /// Zooming by keys: 1 in, -1 out.
    #[must_use]
    pub fn zoom(&self) -> f32 {
        let one = |action| if self.holds(action) { 1.0 } else { 0.0 };
        one(Action::ZoomIn) - one(Action::ZoomOut)
    }
}
