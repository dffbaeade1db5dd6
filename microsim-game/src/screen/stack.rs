//! The screens that are open: a main screen, and overlays above it.

use super::article::ArticlePage;
use super::choose::Choose;
use super::contest::Contest;
use super::context::AppContext;
use super::end::End;
use super::food_chain::FoodChainMenu;
use super::food_chain_end::FoodChainEnd;
use super::goals::Goals;
use super::guide::Guide;
use super::join::Join;
use super::keys_menu::KeysMenu;
use super::lobby::{self, Lobby};
use super::name::NameEntry;
use super::pause::Pause;
use super::photo::Photo;
use super::pick::Pick;
use super::play::Play;
use super::quit::Quit;
use super::sandbox::Sandbox;
use super::scores::ScoreList;
use super::settings::SettingsMenu;
use super::slide_end::SlideEnd;
use super::slides::SlideList;
use super::title::Title;
use super::two_players::TwoPlayersMenu;
use super::two_players_end::TwoPlayersEnd;
use super::{MainScreen, Next, Overlay, Paused, Screen};
use crate::input::Input;
use crate::ui::menu::Menu;

/// The open screens, the topmost last.
#[derive(Debug)]
pub struct Stack {
    screens: Vec<Box<dyn Screen>>,
}

impl Stack {
    /// A stack of one main screen; the title where that cannot be shown.
    #[must_use]
    pub fn new(first: MainScreen, context: &mut AppContext) -> Self {
        let mut stack = Self { screens: Vec::new() };
        stack.go(Next::Show(first), context);
        if stack.is_empty() {
            stack.go(Next::Show(MainScreen::Title), context);
        }
        stack
    }

    /// Whether all screens have been left.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.screens.is_empty()
    }

    /// Whether the topmost screen waits for a key.
    #[must_use]
    pub fn waits_for_key(&self) -> bool {
        self.screens.last().is_some_and(|screen| screen.waits_for_key())
    }

    /// Whether the topmost screen shows a scene.
    #[must_use]
    pub fn is_scene(&self) -> bool {
        self.screens.last().is_some_and(|screen| screen.is_scene())
    }

    /// Whether the player can ask its cell to divide, and to lunge.
    #[must_use]
    pub fn deeds(&self) -> [bool; 2] {
        self.screens.last().map_or([false; 2], |screen| screen.deeds())
    }

    /// The menu of the topmost screen, unless that waits for a key.
    #[must_use]
    pub fn menu(&self) -> Option<&Menu> {
        self.screens.last().filter(|screen| !screen.waits_for_key())?.menu()
    }

    /// Whether leaving the screens would lose a round.
    #[must_use]
    pub fn is_at_stake(&self) -> bool {
        self.screens.iter().any(|screen| screen.is_at_stake())
    }

    /// What pictures of the topmost screen are called.
    #[must_use]
    pub fn name(&self) -> String {
        self.screens.last().map_or_else(String::new, |screen| screen.name())
    }

    /// Lets the topmost screen read input, and goes where it says.
    pub fn update(&mut self, input: &Input, context: &mut AppContext) {
        if let Some(screen) = self.screens.last_mut() {
            let next = screen.update(input, context);
            self.go(next, context);
        }
    }

    /// Goes to a screen. One that cannot be shown is told in a message.
    pub fn go(&mut self, next: Next, context: &mut AppContext) {
        if !matches!(next, Next::Stay) {
            context.photo = None;
        }
        match next {
            Next::Stay => {}
            Next::Back => drop(self.screens.pop()),
            Next::Quit => self.screens.clear(),
            Next::Open(overlay) => self.screens.push(open(overlay, context)),
            Next::Leave(overlay) => {
                self.go(Next::Show(MainScreen::Title), context);
                self.go(Next::Open(overlay), context);
            }
            Next::Show(main) => match show(main, context) {
                Ok(screen) => self.screens = vec![screen],
                Err(problem) => context.tell(problem),
            },
        }
    }

    /// Draws the main screen, and the topmost overlay above it.
    pub fn draw(&mut self, context: &mut AppContext) {
        let top = self.screens.len().saturating_sub(1);
        for (k, screen) in self.screens.iter_mut().enumerate().filter(|(k, _)| *k == 0 || *k == top) {
            context.is_top = k == top;
            screen.draw(context);
            context.pen.flush();
        }
    }
}

fn show(main: MainScreen, context: &mut AppContext) -> Result<Box<dyn Screen>, String> {
    context.best_before = context.chain_records.best;
    Ok(match main {
        MainScreen::Title => Box::new(Title::new(context)),
        MainScreen::Round => Box::new(Play::start(Paused::Round, context)?),
        MainScreen::OtherGame => Box::new(Play::start(Paused::OtherGame, context)?),
        MainScreen::Slide(index) => Box::new(Play::slide(index, context)?),
        MainScreen::FoodChain(seed) => Box::new(Play::food_chain(seed, context)?),
        MainScreen::TwoPlayers(way) => Box::new(Play::two_players(way, context)?),
        MainScreen::Lobby(news) => Box::new(Lobby::new(news)),
        MainScreen::Room(code) => Box::new(lobby::enter(&code, context)?),
        MainScreen::Contest(game) => Box::new(Contest::new(*game, context)),
        MainScreen::Replay => Box::new(Play::replay(context)?),
        MainScreen::Simulation(stage) => Box::new(Sandbox::new(*stage, context)),
    })
}

fn open(overlay: Overlay, context: &mut AppContext) -> Box<dyn Screen> {
    match overlay {
        Overlay::Pause(paused) => Box::new(Pause::new(paused)),
        Overlay::Photo => Box::new(Photo::new(context)),
        Overlay::End(result, played) => Box::new(End::new(*result, played, context)),
        Overlay::SlideEnd(result, paused) => Box::new(SlideEnd::new(*result, paused, context)),
        Overlay::FoodChainEnd(result, life, paused) => Box::new(FoodChainEnd::new(*result, life, paused, context)),
        Overlay::TwoPlayersEnd(result, way, paused) => Box::new(TwoPlayersEnd::new(*result, way, paused, context)),
        Overlay::TwoPlayers => Box::new(TwoPlayersMenu::new()),
        Overlay::FoodChain => Box::new(FoodChainMenu::new(context)),
        Overlay::Choose(offer, paused) => Box::new(Choose::new(offer, paused)),
        Overlay::Join => Box::new(Join::new(context)),
        Overlay::Quit => Box::new(Quit::new()),
        Overlay::Slides(focus) => Box::new(SlideList::new(focus, context)),
        Overlay::Pick => Box::new(Pick::new(context)),
        Overlay::Guide => Box::new(Guide::new(context)),
        Overlay::Article(entry) => Box::new(ArticlePage::new(entry)),
        Overlay::Goals => Box::new(Goals::new(context)),
        Overlay::Scores => Box::new(ScoreList::new(context)),
        Overlay::Settings => Box::new(SettingsMenu::new(context)),
        Overlay::Name => Box::new(NameEntry::new(context)),
        Overlay::Keys => Box::new(KeysMenu::new(context)),
    }
}
