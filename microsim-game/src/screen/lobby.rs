//! The lobby: who is in the room, who is ready, how the next match is played, and what the last one came to.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen, new_seed};
use crate::draw::palette::PLAYERS;
use crate::input::{Input, Move};
use crate::network::room::Room;
use crate::platform;
use crate::rules::two_players::TwoPlayers;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words;

/// Items before those who are there.
const READY: usize = 0;
const WAY: usize = 1;
const LEAVE: usize = 2;

#[derive(Debug)]
pub(super) struct Lobby {
    page: MenuPage,
    /// What the last match came to.
    news: Option<String>,
}

/// Enters a room.
///
/// # Errors
/// Says why it cannot be entered.
pub(super) fn enter(code: &str, context: &mut AppContext) -> Result<Lobby, String> {
    context.room = None;
    let transport = platform::open_room(&context.party.server, code, &context.party.key)?;
    context.room = Some(Room::new(transport, code, &context.party.name));
    Ok(Lobby::new(None))
}

/// Time for rooms, ms.
pub(super) fn clock() -> u32 {
    platform::now().as_millis() as u32
}

impl Lobby {
    pub(super) fn new(news: Option<String>) -> Self {
        Self { page: MenuPage::new("The room", Vec::new()), news }
    }

    fn show(&mut self, room: &Room) {
        let way = if room.leads() {
            MenuItem::with("Play", words::text(room.way().label()))
        } else {
            MenuItem::new(format!("Play: {}", words::text(room.way().label())))
        };
        let seats = (1..).zip(PLAYERS).zip(room.seats()).map(|((number, (colour, _)), seat)| {
            let own = if seat.is_own { " (you)" } else { "" };
            MenuItem::new(format!("{number} {}{own}, {colour}: {}", seat.name, seat.note))
        });
        let items = [MenuItem::switch("Ready", room.is_ready()), way, MenuItem::new("Leave")];
        self.page.menu.items = items.into_iter().chain(seats).collect();
        self.page.menu.set_focus(self.page.menu.focus());
    }
}

impl Screen for Lobby {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let seed = new_seed(context);
        let Some(room) = &mut context.room else { return Next::Show(MainScreen::Title) };
        if let Some(game) = room.update(clock(), seed, None) {
            return Next::Show(MainScreen::Contest(Box::new(game)));
        }
        if let Some(reason) = room.closed().map(str::to_owned) {
            context.room = None;
            context.tell(reason);
            return Next::Show(MainScreen::Title);
        }
        self.show(room);
        let choice = self.page.update(input, &context.pen);
        match choice {
            Some(MenuChoice::Pick(READY) | MenuChoice::Less(READY)) => room.set_ready(!room.is_ready()),
            Some(MenuChoice::Pick(WAY) | MenuChoice::Less(WAY)) if room.leads() => {
                let is_together = room.way() == TwoPlayers::Together;
                room.set_way(if is_together { TwoPlayers::Versus } else { TwoPlayers::Together });
            }
            _ if input.step == Some(Move::Back) || choice == Some(MenuChoice::Pick(LEAVE)) => {
                context.room = None;
                return Next::Show(MainScreen::Title);
            }
            _ => {}
        }
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        let Some(room) = &context.room else { return };
        let code = room.code();
        let note = match &self.news {
            Some(news) => format!("{news} Whoever is ready plays again."),
            None if room.is_entered() && room.has_match() => {
                format!("Code {code}. A match is on: whoever is ready takes a cell without a player, or watches.")
            }
            None if room.is_entered() => {
                format!("Code {code}. The match begins when two to four are here and all are ready.")
            }
            None => format!("Code {code}. On the way to the server ..."),
        };
        self.page.draw_note(&mut context.pen, &note);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "lobby".to_owned()
    }
}
