//! The lobby: who is in the room, who is ready, how the next match is played, and what the last one came to.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen, seed_of_match};
use crate::draw::palette::PLAYERS;
use crate::input::{Input, Move};
use crate::network::plan::{Plan, Way};
use crate::network::room::{Room, Seat};
use crate::platform;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key};

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
        Self { page: MenuPage::new(Key::RoomHeading, Vec::new()), news }
    }

    fn show(&mut self, room: &Room) {
        let how = words::text(room.plan().way.label());
        let way = if room.leads() {
            MenuItem::with(Key::RoomPlay, how)
        } else {
            MenuItem::new(format!("{}: {how}", words::text(Key::RoomPlay)))
        };
        let seats = (1..).zip(PLAYERS).zip(room.seats());
        let seats = seats.map(|((number, (colour, _)), seat)| MenuItem::new(seat_label(number, colour, seat)));
        let items = [MenuItem::switch(Key::RoomReady, room.is_ready()), way, MenuItem::new(Key::RoomLeave)];
        self.page.menu.items = items.into_iter().chain(seats).collect();
        self.page.menu.set_focus(self.page.menu.focus());
    }
}

impl Screen for Lobby {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let seed = seed_of_match(context);
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
                let is_less = choice == Some(MenuChoice::Less(WAY));
                room.set_plan(Plan { way: stepped(room.plan().way, is_less), ..room.plan() });
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
        let of_code = |key| words::text_with(key, &[("code", room.code().into())]);
        let note = match &self.news {
            Some(news) => words::text_with(Key::RoomAgain, &[("news", news.into())]),
            None if room.is_entered() && room.has_match() => of_code(Key::RoomMatchOn),
            None if room.is_entered() => of_code(Key::RoomWaits),
            None => of_code(Key::RoomEntering),
        };
        self.page.draw_note(&mut context.pen, &note);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "lobby".to_owned()
    }

    fn is_at_stake(&self) -> bool {
        true
    }
}

/// The way of playing after this one, or before it.
fn stepped(way: Way, is_less: bool) -> Way {
    let (ways, step) = (Way::ALL.len(), if is_less { Way::ALL.len() - 1 } else { 1 });
    let at = Way::ALL.iter().position(|&other| other == way).unwrap_or(0);
    Way::ALL[(at + step) % ways]
}

/// Who is there, in which colour, and what is to be said of it.
fn seat_label(number: u32, colour: Key, seat: Seat) -> String {
    let own = || words::text_with(Key::RoomOwnName, &[("name", (&seat.name).into())]);
    let name = if seat.is_own { own() } else { seat.name.clone() };
    let said = [("colour", words::text(colour)), ("note", words::text(seat.note)), ("name", name.as_str())];
    let said = said.map(|(variable, text)| (variable, text.into()));
    words::text_with(Key::RoomSeat, &[&said[..], &[("number", number.into())]].concat())
}
