//! Screens: each is a file with one type that reads input and draws. A screen says as data what comes [`Next`]; the
//! [`stack`] builds it.

mod article;
mod chain_scene;
mod choose;
mod contest;
pub mod context;
mod done;
mod end;
mod end_menu;
mod follow;
mod food_chain;
mod food_chain_end;
mod goals;
mod guide;
mod hearing;
mod join;
mod keys_menu;
mod lobby;
mod name;
mod offer;
mod page;
mod parted;
mod pause;
mod photo;
mod photo_view;
mod pick;
mod play;
mod quit;
mod sandbox;
mod scores;
mod settings;
mod slide_end;
mod slides;
pub mod stack;
mod steer;
mod title;
mod two_players;
mod two_players_end;

use crate::guide::Entry;
use crate::input::Input;
use crate::network::contest::Match;
use crate::rules::food_chain::Life;
use crate::rules::food_chain::change::Change;
use crate::rules::round::RoundResult;
use crate::rules::two_players::TwoPlayers;
use crate::stage::Stage;
use crate::ui::menu::Menu;
use context::AppContext;
use macroquad::miniquad;
use std::fmt;

/// What the program is showing.
pub trait Screen: fmt::Debug {
    /// Reads the input of a frame and lets time pass. Only the topmost screen is asked.
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next;

    /// Draws.
    fn draw(&mut self, context: &mut AppContext);

    /// What pictures of it are called.
    fn name(&self) -> String;

    /// The menu that it shows.
    fn menu(&self) -> Option<&Menu> {
        None
    }

    /// Whether it waits for a key, which then does nothing else.
    fn waits_for_key(&self) -> bool {
        false
    }

    /// Whether it shows a scene that keys act on, and not a menu.
    fn is_scene(&self) -> bool {
        false
    }

    /// Whether the player can ask its cell to divide, and to lunge.
    fn deeds(&self) -> [bool; 2] {
        [false; 2]
    }

    /// Whether leaving it would lose something: a round that is being played, or the place in a room.
    fn is_at_stake(&self) -> bool {
        false
    }
}

/// What is shown next.
#[derive(Debug)]
pub enum Next {
    /// The same screen.
    Stay,
    /// The screen below this one.
    Back,
    /// An overlay above this screen.
    Open(Overlay),
    /// A main screen in place of all screens.
    Show(MainScreen),
    /// An overlay above the title, in place of all screens.
    Leave(Overlay),
    /// Nothing: the program ends.
    Quit,
}

/// A screen that lies below all others.
#[derive(Debug)]
pub enum MainScreen {
    /// The title.
    Title,
    /// A new round of the game.
    Round,
    /// A new round of a game that was opened beside it, a file or one of the list of simulations.
    OtherGame,
    /// A slide, by its place among all, those for two behind the others.
    Slide(usize),
    /// The food chain, with a seed.
    FoodChain(u64),
    /// Two cells on one slide.
    TwoPlayers(TwoPlayers),
    /// The room of the context, and what is to be said of the last match.
    Lobby(Option<String>),
    /// The room of this code, which is entered.
    Room(String),
    /// A match of the room.
    Contest(Box<Match>),
    /// The last round of the game again.
    Replay,
    /// A simulation.
    Simulation(Box<Stage>),
}

/// A screen that lies over a main screen.
#[derive(Debug)]
pub enum Overlay {
    /// The menu that stops a main screen.
    Pause(Paused),
    /// The end of a round, and what was played.
    End(Box<RoundResult>, Paused),
    /// The end of a slide: the result, and what was played.
    SlideEnd(Box<RoundResult>, Paused),
    /// The end of a food chain: the result, how long it was, and what was played.
    FoodChainEnd(Box<RoundResult>, Life, Paused),
    /// The end of a round of two cells: the result, how they played, and what was played.
    TwoPlayersEnd(Box<RoundResult>, TwoPlayers, Paused),
    /// The scene that a menu stops, to take pictures of.
    Photo,
    /// The way into the food chain.
    FoodChain,
    /// The ways in which two cells play.
    TwoPlayers,
    /// The code of a room to enter.
    Join,
    /// The choice of a change of the body, and what is played.
    Choose([Change; 3], Paused),
    /// Whether to end the program.
    Quit,
    /// The list of slides, with the focus on this one, or on the first that has no star yet.
    Slides(Option<usize>),
    /// The list of simulations.
    Pick,
    /// The field guide.
    Guide,
    /// An article of the field guide.
    Article(&'static Entry),
    /// The goals of the food chain.
    Goals,
    /// High scores.
    Scores,
    /// Settings.
    Settings,
    /// Which key does what.
    Keys,
    /// What the player is called.
    Name,
}

/// What the pause menu stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paused {
    /// A round that is played.
    Round,
    /// A round of the game beside it.
    OtherGame,
    /// A slide, by its place in the list.
    Slide(usize),
    /// The food chain, with its seed.
    FoodChain(u64),
    /// Two cells on one slide.
    TwoPlayers(TwoPlayers),
    /// A replay.
    Replay,
    /// A simulation.
    Simulation,
}

impl Paused {
    /// The same from its beginning; the pause menu of a simulation has no such item.
    fn restart(self) -> Next {
        match self {
            Self::Round => Next::Show(MainScreen::Round),
            Self::OtherGame => Next::Show(MainScreen::OtherGame),
            Self::Slide(index) => Next::Show(MainScreen::Slide(index)),
            Self::FoodChain(seed) => Next::Show(MainScreen::FoodChain(seed)),
            Self::TwoPlayers(way) => Next::Show(MainScreen::TwoPlayers(way)),
            Self::Replay => Next::Show(MainScreen::Replay),
            Self::Simulation => Next::Stay,
        }
    }
}

/// Length of a day, s.
const DAY: f64 = 86400.0;

/// Days since 1 January 1970; none in pictures that must come out the same.
fn today(context: &AppContext) -> Option<u32> {
    (!context.pace.is_exact).then(|| (miniquad::date::now() / DAY) as u32)
}

/// Every round has a seed of its own, except for pictures that must come out the same.
fn new_seed(context: &AppContext) -> u64 {
    let milliseconds = 1000.0 * miniquad::date::now();
    if context.pace.is_exact { 1 } else { milliseconds as u64 }
}
