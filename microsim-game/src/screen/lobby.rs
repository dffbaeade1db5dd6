//! The lobby: who is in the room, who is ready, how the next match is played, and what the last one came to.

use super::context::AppContext;
use super::join::letter;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen, new_seed};
use crate::draw::palette::PLAYERS;
use crate::input::{Input, Move};
use crate::network::plan::{Plan, Way};
use crate::network::room::{Room, Seat};
use crate::platform;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key};
use macroquad::input::KeyCode;

/// Items before those who are there: the first member has one for each choice, others one for all, which does nothing.
const READY: usize = 0;
const WAY: usize = 1;
const RATE: usize = 2;
const SEED: usize = 3;
/// Greatest seed that can be typed; greater ones come from the command line.
const GREATEST_SEED: u64 = 999_999;

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
    let name = [&context.party.name, &context.settings.name].into_iter().find(|name| !name.is_empty());
    let mut room = Room::new(transport, code, name.map_or("", String::as_str));
    room.set_seed(context.game.seed);
    context.room = Some(room);
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
        let (plan, seed) = (room.plan(), room.seed());
        let rate = format!("{}/s", 60 / plan.rate.pacing().steps);
        let choices = if room.leads() {
            let seed = seed.map_or_else(|| words::text(Key::RoomAnySeed).to_owned(), |seed| seed.to_string());
            let all = [(Key::RoomPlay, plan.way.label()), (Key::RoomRate, rate), (Key::RoomSeed, seed)];
            all.map(|(key, value)| MenuItem::with(key, value)).to_vec()
        } else {
            let seed = seed.map(|seed| format!(", {} {seed}", words::text(Key::RoomSeed))).unwrap_or_default();
            vec![MenuItem::new(format!("{}, {rate}{seed}", plan.way.label()))]
        };
        let seats = (1..).zip(PLAYERS).zip(room.seats());
        let seats = seats.map(|((number, (colour, _)), seat)| MenuItem::new(seat_label(number, colour, seat)));
        let items = [MenuItem::switch(Key::RoomReady, room.is_ready())].into_iter().chain(choices);
        self.page.menu.items = items.chain([MenuItem::new(Key::RoomLeave)]).chain(seats).collect();
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
            Some(choice) if room.leads() && change(room, choice) => {}
            _ if input.step == Some(Move::Back) || choice == Some(MenuChoice::Pick(leave_at(room))) => {
                context.room = None;
                return Next::Show(MainScreen::Title);
            }
            _ if room.leads() && self.page.menu.focus() == SEED => {
                let seed = input.key.map_or(room.seed(), |key| typed(room.seed(), key));
                if seed != room.seed() {
                    room.set_seed(seed);
                }
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

/// The item after those of what is played.
fn leave_at(room: &Room) -> usize {
    if room.leads() { SEED + 1 } else { WAY + 1 }
}

/// Changes what is played next, as the menu says. Returns whether the item was one of those.
fn change(room: &mut Room, choice: MenuChoice) -> bool {
    let (plan, seed) = (room.plan(), room.seed());
    match choice {
        MenuChoice::Pick(WAY) => room.set_plan(Plan { way: stepped(plan.way, 1), ..plan }),
        MenuChoice::Less(WAY) => room.set_plan(Plan { way: stepped(plan.way, Way::ALL.len() - 1), ..plan }),
        MenuChoice::Pick(RATE) | MenuChoice::Less(RATE) => {
            room.set_plan(Plan { rate: plan.rate.other(), ..plan });
        }
        MenuChoice::Pick(SEED) => room.set_seed(Some(seed.map_or(0, |seed| seed.saturating_add(1)))),
        MenuChoice::Less(SEED) => room.set_seed(seed.and_then(|seed| seed.checked_sub(1))),
        _ => return false,
    }
    true
}

/// The way of playing so many places after this one.
fn stepped(way: Way, places: usize) -> Way {
    let at = Way::ALL.iter().position(|&other| other == way).unwrap_or(0);
    Way::ALL[(at + places) % Way::ALL.len()]
}

/// A seed after one more key: none is any.
fn typed(seed: Option<u64>, key: KeyCode) -> Option<u64> {
    if key == KeyCode::Backspace {
        return seed.map(|seed| seed / 10).filter(|&seed| seed > 0);
    }
    let digit = letter(key).and_then(|letter| letter.to_digit(10));
    let longer = digit.and_then(|digit| seed.unwrap_or(0).checked_mul(10)?.checked_add(digit.into()));
    longer.filter(|&longer| longer <= GREATEST_SEED).or(seed)
}

/// Who is there, in which colour, and what is to be said of it.
fn seat_label(number: u32, colour: Key, seat: Seat) -> String {
    let own = || words::text_with(Key::RoomOwnName, &[("name", (&seat.name).into())]);
    let name = if seat.is_own { own() } else { seat.name.clone() };
    let said = [("colour", words::text(colour)), ("note", words::text(seat.note)), ("name", name.as_str())];
    let said = said.map(|(variable, text)| (variable, text.into()));
    words::text_with(Key::RoomSeat, &[&said[..], &[("number", number.into())]].concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::plan::FrameRate;
    use crate::network::transport::{Member, Notice, Transport};

    #[test]
    fn digits_make_a_seed_and_without_digits_it_is_any() {
        let keys = |seed, keys: &[KeyCode]| keys.iter().fold(seed, |seed, &key| typed(seed, key));
        assert_eq!(keys(None, &[KeyCode::Key4, KeyCode::A, KeyCode::Kp2, KeyCode::F1]), Some(42));
        assert_eq!(keys(Some(42), &[KeyCode::Backspace]), Some(4));
        assert_eq!(keys(Some(42), &[KeyCode::Backspace; 3]), None);
        assert_eq!(keys(None, &[KeyCode::Key9; 8]), Some(GREATEST_SEED));
        assert_eq!(keys(Some(u64::MAX), &[KeyCode::Key9]), Some(u64::MAX));
    }

    /// A way into a room as its member of this number, after those before it.
    #[derive(Debug)]
    struct Entered(Member);

    impl Transport for Entered {
        fn poll(&mut self) -> Vec<Notice> {
            vec![Notice::Welcome { member: self.0, others: (0..self.0).collect() }]
        }

        fn send(&mut self, _: Member, _: &[u8]) {}
    }

    #[test]
    fn the_menu_of_the_first_member_changes_what_is_played() {
        let mut room = Room::new(Box::new(Entered(0)), "ABCD", "Ada");
        assert!(room.update(0, 7, None).is_none() && room.leads());
        let mut after = |choices: &[MenuChoice]| {
            assert!(choices.iter().all(|&choice| change(&mut room, choice)));
            (room.plan(), room.seed())
        };
        let quick = Plan { way: Way::Versus, rate: FrameRate::Quick };
        assert_eq!(after(&[MenuChoice::Pick(RATE)]), (quick, None));
        assert_eq!(after(&[MenuChoice::Less(WAY)]).0.way, Way::ALL[Way::ALL.len() - 1]);
        assert_eq!(after(&[MenuChoice::Pick(WAY), MenuChoice::Less(SEED)]), (quick, None));
        assert_eq!(after(&[MenuChoice::Pick(SEED); 3]).1, Some(2));
        assert_eq!(after(&[MenuChoice::Less(SEED)]).1, Some(1));
        assert_eq!(after(&[MenuChoice::Less(SEED); 2]), (quick, None));
        let leave = leave_at(&room);
        assert!(!change(&mut room, MenuChoice::Pick(leave)));
    }

    #[test]
    fn the_first_member_has_a_row_for_each_choice_and_others_one_for_all() {
        for (member, rows) in [(0, 5), (2, 3)] {
            let mut room = Room::new(Box::new(Entered(member)), "ABCD", "Ada");
            assert!(room.update(0, 7, None).is_none());
            let mut lobby = Lobby::new(None);
            lobby.show(&room);
            let items = &lobby.page.menu.items;
            assert_eq!(items.len(), rows + usize::from(member) + 1, "rows, and members");
            assert_eq!(items[leave_at(&room)].label, MenuItem::new(Key::RoomLeave).label);
        }
    }
}
