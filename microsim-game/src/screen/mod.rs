//! Screens: each is a file with one type that reads input and draws. They lie on a stack; menus lie over what they
//! belong to.

pub mod end;
pub mod keys;
mod page;
pub mod pause;
pub mod pick;
pub mod play;
pub mod sandbox;
pub mod scores;
pub mod settings;
pub mod title;

use crate::args::Scene;
use crate::draw::Frame;
use crate::input::Input;
use crate::scenery::{Scenery, Sight};
use crate::store::files::Store;
use crate::store::scores::Scores;
use crate::store::settings::{self as kept, Settings};
use crate::ui::pen::{Align, Pen, Size};
use crate::viewer::Pace;
use microsim_core::glam::Vec2;
use std::fmt;

/// File of the last round that was played to its end: a replay, which `microsim replay` reads too.
const LAST_GAME: &str = "last-game.replay";
/// How long a message is shown, s.
const MESSAGE_TIME: f32 = 4.0;

/// What the program is showing.
pub trait Screen: fmt::Debug {
    /// Reads the input of a frame and lets time pass. Only the topmost screen is asked.
    fn update(&mut self, input: &Input, context: &mut Context) -> Change;

    /// Draws.
    fn draw(&mut self, context: &mut Context);

    /// Whether the screen below is still seen.
    fn is_overlay(&self) -> bool {
        true
    }

    /// What pictures of it are called.
    fn name(&self) -> String;
}

/// What happens to the stack of screens.
#[derive(Debug)]
pub enum Change {
    /// Nothing.
    Stay,
    /// This one comes on top.
    Push(Box<dyn Screen>),
    /// The topmost one goes.
    Pop,
    /// This one comes in place of all.
    Reset(Box<dyn Screen>),
    /// The program ends.
    Quit,
}

impl Change {
    /// A screen on top.
    pub fn push(screen: impl Screen + 'static) -> Self {
        Self::Push(Box::new(screen))
    }

    /// A screen in place of all.
    pub fn reset(screen: impl Screen + 'static) -> Self {
        Self::Reset(Box::new(screen))
    }
}

/// What a game is played by.
#[derive(Clone, Debug, PartialEq)]
pub struct GameChoice {
    /// The scenario.
    pub scene: Scene,
    /// Values of it that were changed on the command line.
    pub overrides: Vec<(String, String)>,
    /// Seed of every round; a new one for each unless given.
    pub seed: Option<u64>,
}

/// What all screens share.
#[derive(Debug)]
pub struct Context {
    /// Draws the scene.
    pub scenery: Scenery,
    /// Draws above it.
    pub pen: Pen,
    /// Where settings and scores are kept.
    pub store: Store,
    /// What the player has chosen.
    pub settings: Settings,
    /// High scores.
    pub scores: Scores,
    /// How time passes in this frame.
    pub pace: Pace,
    /// Time since the program began, s.
    pub time: f32,
    /// What a game is played by.
    pub game: GameChoice,
    /// Scenario files that the player has named or dropped, for the list.
    pub files: Vec<Scene>,
    /// The last round that was played to its end, as a replay.
    pub last_game: Option<Vec<u8>>,
    /// Whether the screen that draws has nothing above it.
    pub is_top: bool,
    /// Whether a picture is wanted.
    pub wants_picture: bool,
    message: Option<(String, f32)>,
}

impl Context {
    /// What screens share at first. Needs an open window.
    #[must_use]
    pub fn new(store: Store, game: GameChoice, files: Vec<Scene>) -> Self {
        let (settings, problem) = store.load::<Settings>(kept::FILE);
        let (scores, other_problem) = Scores::load(&store);
        let last_game = store.read(LAST_GAME);
        let mut context = Self {
            scenery: Scenery::new(),
            pen: Pen::new(),
            store,
            settings,
            scores,
            pace: Pace { elapsed: 0.0, is_exact: false },
            time: 0.0,
            game,
            files,
            last_game,
            is_top: true,
            wants_picture: false,
            message: None,
        };
        problem.or(other_problem).into_iter().for_each(|problem| context.tell(problem));
        context
    }

    /// Shows a message for a while.
    pub fn tell(&mut self, text: impl Into<String>) {
        self.message = Some((text.into(), self.time + MESSAGE_TIME));
    }

    /// Keeps the settings.
    pub fn save_settings(&mut self) {
        if let Err(error) = self.store.save(kept::FILE, &self.settings) {
            self.tell(format!("cannot keep the settings: {error}"));
        }
    }

    /// Draws a scene as the player wants to see it.
    pub fn paint(&mut self, frame: &Frame<'_>) {
        self.scenery.paint(frame, Sight::named(&self.settings.sight), self.settings.effort);
    }

    /// Another way of looking.
    pub fn change_sight(&mut self, is_back: bool) {
        let sight = Sight::named(&self.settings.sight).next(is_back);
        sight.name().clone_into(&mut self.settings.sight);
        self.save_settings();
        self.tell(sight.name());
    }

    /// Time for what moves in marks; `None` if the player wants less motion.
    #[must_use]
    pub fn motion(&self) -> Option<f32> {
        (!self.settings.reduced_motion).then_some(self.time)
    }

    /// Draws the message, if there is one.
    pub(crate) fn draw_message(&mut self) {
        let Some((text, _)) = self.message.as_ref().filter(|(_, until)| self.time < *until) else { return };
        let (screen, line) = (self.pen.screen(), self.pen.line(Size::Small));
        for (k, text) in text.lines().take(8).enumerate() {
            let at = Vec2::new(0.5 * screen.x, 0.8 * screen.y + 1.25 * line * k as f32);
            self.pen.label(at, Size::Small, Align::Centre, crate::draw::palette::HALO, text);
        }
    }
}
