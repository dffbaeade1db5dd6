//! A room: who is there, under which names, who is ready, and the match that they start.

use super::contest::{Match, numbered};
use super::message::{Hello, Message, Program, Start, clean, clean_text, write};
use super::plan::Plan;
use super::transport::{Member, Notice, Transport};
use crate::rules::round::MOST_PLAYERS;
use crate::words::Key;
use microsim_core::Intent;

/// Time between two messages of who is there, and between two calls to start, ms.
const GREETING: u32 = 1000;
const CALLING: u32 = 200;

/// Somebody else in the room, as far as it has said who it is.
#[derive(Clone, Debug)]
struct Guest {
    member: Member,
    hello: Option<Hello>,
    /// Whether it was cut and has come back, as the server says.
    is_back: bool,
}

/// One member, as the lobby shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seat {
    /// Its name, clean.
    pub name: String,
    /// Whether it is this player.
    pub is_own: bool,
    /// What is to be said of it.
    pub note: Key,
}

/// A room that this player is in.
#[derive(Debug)]
pub struct Room {
    pub(super) transport: Box<dyn Transport>,
    code: String,
    own: Option<Member>,
    hello: Hello,
    guests: Vec<Guest>,
    greeted: Option<u32>,
    /// Number of the last match, and whether it is on.
    number: u32,
    is_playing: bool,
    closed: Option<String>,
}

impl Room {
    /// A room that is being entered.
    #[must_use]
    pub fn new(transport: Box<dyn Transport>, code: &str, name: &str) -> Self {
        let (program, name) = (Program::own(), clean(name));
        let (plan, seed) = (Plan::default(), None);
        let hello = Hello { program, name, is_ready: false, is_playing: false, plan, seed, number: 0 };
        let (own, guests, greeted, closed) = (None, Vec::new(), None, None);
        Self { transport, code: code.to_owned(), own, hello, guests, greeted, number: 0, is_playing: false, closed }
    }

    /// Takes in what has come, and says what is to be said. `now` is a clock, ms; `seed` is for a match that begins now without a chosen one,
    /// and `current` is the match that is on. Returns one that begins.
    pub fn update(&mut self, now: u32, seed: u64, mut current: Option<&mut Match>) -> Option<Match> {
        let mut begun = None;
        for notice in self.transport.poll() {
            let begins = self.take(notice, now, current.as_deref_mut().or(begun.as_mut()));
            begun = begins.or(begun);
        }
        if self.greeted.is_none_or(|at| now.wrapping_sub(at) >= GREETING) {
            self.greeted = Some(now);
            let (is_ready, is_playing) = (self.hello.is_ready && !self.is_playing, self.is_playing);
            self.send_all(&Message::Hello(Hello { is_ready, is_playing, number: self.number, ..self.hello.clone() }));
            let names = self.guests.iter().map(|guest| (guest.member, self.name_of(guest.member)));
            if let Some(current) = current.as_deref_mut() {
                names.for_each(|(member, name)| current.note_name(member, name));
            }
        }
        if !self.is_playing && self.leads() && self.is_complete() {
            let (number, seats, seed) = (self.next_number(), self.members(), self.hello.seed.unwrap_or(seed));
            begun = self.begin(Start { number, plan: self.hello.plan, seed, seats }, now);
        }
        if let Some(current) = current.or(begun.as_mut()) {
            self.call(current, now);
            self.give_cells(current, now);
        }
        begun
    }

    fn take(&mut self, notice: Notice, now: u32, current: Option<&mut Match>) -> Option<Match> {
        match notice {
            Notice::Welcome { member, others } => {
                self.own = Some(member);
                others.into_iter().for_each(|other| self.meet(other));
            }
            Notice::Joined(member) => self.meet(member),
            Notice::Back(member) => {
                self.part(member, now, current);
                self.meet(member);
                self.guests.iter_mut().filter(|guest| guest.member == member).for_each(|guest| guest.is_back = true);
            }
            Notice::Left(member) => self.part(member, now, current),
            Notice::Message { from, bytes } => return self.hear(from, &bytes, now, current),
            Notice::Closed(reason) => self.closed = Some(clean_text(&reason, 200)),
        }
        None
    }

    fn meet(&mut self, member: Member) {
        let is_new = Some(member) != self.own && self.guests.iter().all(|guest| guest.member != member);
        if is_new && self.guests.len() + 1 < MOST_PLAYERS && usize::from(member) < MOST_PLAYERS {
            self.guests.push(Guest { member, hello: None, is_back: false });
            self.guests.sort_by_key(|guest| guest.member);
            self.greeted = None;
        }
    }

    fn part(&mut self, member: Member, now: u32, current: Option<&mut Match>) {
        self.guests.retain(|guest| guest.member != member);
        if let Some(current) = current {
            current.part(member, now);
        }
    }

    fn hear(&mut self, from: Member, bytes: &[u8], now: u32, current: Option<&mut Match>) -> Option<Match> {
        let guest = self.guests.iter().position(|guest| guest.member == from)?;
        match postcard::from_bytes(bytes).ok()? {
            Message::Hello(hello) => self.guests[guest].hello = Some(Hello { name: clean(&hello.name), ..hello }),
            Message::Start(start) if self.first() == Some(from) && self.is_due(&start) => {
                return self.begin(start, now);
            }
            Message::Invite(start) if self.may_join(from, &start) => return self.join(from, start, now),
            Message::Start(_) | Message::Invite(_) => {}
            Message::Packet(number, packet) => {
                current.filter(|current| current.start.number == number)?.receive(from, &packet, now);
            }
        }
        None
    }

    /// A number that no match has had that anybody here was in.
    fn next_number(&self) -> u32 {
        let others = self.guests.iter().filter_map(|guest| Some(guest.hello.as_ref()?.number));
        others.fold(self.number, u32::max).wrapping_add(1)
    }

    /// Whether a call to start is a new one.
    fn is_due(&self, start: &Start) -> bool {
        let are_seats = start.seats.iter().all(|member| usize::from(*member) < MOST_PLAYERS);
        let is_sound = start.seats.len() >= 2 && start.seats.is_sorted_by(|a, b| a < b) && are_seats;
        let is_called = self.own.is_some_and(|own| start.seats.contains(&own));
        !self.is_playing && self.hello.is_ready && start.number != self.number && is_sound && is_called
    }

    fn may_join(&self, from: Member, start: &Start) -> bool {
        let is_alike = self.hello_of(from).is_some_and(|hello| hello.program == self.hello.program);
        let are_seats = start.seats.iter().all(|member| usize::from(*member) < MOST_PLAYERS);
        is_alike
            && !self.is_playing
            && self.hello.is_ready
            && (2..=MOST_PLAYERS).contains(&start.seats.len())
            && are_seats
    }

    fn begin(&mut self, start: Start, now: u32) -> Option<Match> {
        let own = start.seats.iter().position(|&member| Some(member) == self.own)?;
        self.play(Match::new(start, own, now.wrapping_sub(CALLING))?, now)
    }

    /// Watches a match that is on, until there is a cell to take.
    fn join(&mut self, from: Member, start: Start, now: u32) -> Option<Match> {
        self.play(Match::watch(start, self.own?, from, now)?, now)
    }

    fn play(&mut self, mut game: Match, now: u32) -> Option<Match> {
        // Who has gone since the call.
        let here = self.members();
        let gone: Vec<Member> = game.start.seats.iter().filter(|member| !here.contains(member)).copied().collect();
        gone.into_iter().for_each(|member| game.part(member, now));
        (self.number, self.is_playing, self.greeted) = (game.start.number, true, None);
        here.into_iter().for_each(|member| game.note_name(member, self.name_of(member)));
        Some(game)
    }

    /// Calls those who have not begun yet, and those who have come late or come back.
    fn call(&mut self, current: &mut Match, now: u32) {
        if now.wrapping_sub(current.called) < CALLING {
            return;
        }
        current.called = now;
        let late: Vec<Member> = if self.leads() { current.silent() } else { Vec::new() };
        let bytes = write(&Message::Start(current.start.clone()));
        late.into_iter()
            .filter(|&member| Some(member) != self.own)
            .for_each(|member| self.transport.send(member, &bytes));
        if !current.session.leads() || current.session.round().is_over() {
            return;
        }
        let is_ready = |guest: &&Guest| {
            guest.hello.as_ref().is_some_and(|hello| hello.is_ready && hello.program == self.hello.program)
                && !current.has(guest.member)
        };
        let ready: Vec<Member> = self.guests.iter().filter(is_ready).map(|guest| guest.member).collect();
        let bytes = write(&Message::Invite(Start { seats: current.members(), ..current.start.clone() }));
        ready.into_iter().for_each(|member| self.transport.send(member, &bytes));
    }

    /// One frame of a match, with what this player tells its cell. Returns whether one was taken.
    pub fn advance(&mut self, game: &mut Match, intent: Intent, now: u32) -> bool {
        game.advance(self.transport.as_mut(), intent, now)
    }

    /// Gives cells of bots to those who have caught up.
    fn give_cells(&self, current: &mut Match, now: u32) {
        if current.session.leads() {
            self.guests.iter().for_each(|guest| current.give_cell(guest.member, guest.is_back, now));
        }
    }

    /// Goes into the room again by another way, to go on with the match.
    pub fn reopen(&mut self, transport: Box<dyn Transport>) {
        self.transport = transport;
        (self.own, self.greeted, self.closed, self.is_playing) = (None, None, None, false);
        self.guests.clear();
        self.hello.is_ready = true;
    }

    /// Whether all others here are known, and none of them plays.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        self.own.is_some() && self.guests.iter().all(|guest| guest.hello.is_some()) && !self.has_match()
    }

    /// Whether others here play.
    #[must_use]
    pub fn has_match(&self) -> bool {
        self.guests.iter().any(|guest| guest.hello.as_ref().is_some_and(|hello| hello.is_playing))
    }

    /// Ends the match that is on: everybody is asked again whether they are ready.
    pub fn finish(&mut self) {
        self.is_playing = false;
        self.set_ready(false);
        self.guests.iter_mut().filter_map(|guest| guest.hello.as_mut()).for_each(|hello| hello.is_ready = false);
    }

    fn send_all(&mut self, message: &Message) {
        let bytes = write(message);
        self.guests.iter().for_each(|guest| self.transport.send(guest.member, &bytes));
    }

    /// All who are there, in order.
    fn members(&self) -> Vec<Member> {
        let mut members: Vec<Member> = self.guests.iter().map(|guest| guest.member).chain(self.own).collect();
        members.sort_unstable();
        members
    }

    fn first(&self) -> Option<Member> {
        self.members().first().copied()
    }

    /// Whether this member is the first, who says what is played and when.
    #[must_use]
    pub fn leads(&self) -> bool {
        self.own.is_some() && self.own == self.first()
    }

    fn is_complete(&self) -> bool {
        let is_ready = |guest: &Guest| {
            guest.hello.as_ref().is_some_and(|hello| hello.is_ready && hello.program == self.hello.program)
        };
        self.hello.is_ready && !self.guests.is_empty() && self.guests.iter().all(is_ready)
    }

    /// Says whether this player is ready.
    pub fn set_ready(&mut self, is_ready: bool) {
        self.hello.is_ready = is_ready;
        self.greeted = None;
    }

    /// Whether this player is ready.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        self.hello.is_ready
    }

    /// Says what is played next; it counts if this member is the first.
    pub fn set_plan(&mut self, plan: Plan) {
        self.hello.plan = plan;
        self.greeted = None;
    }

    /// What is played next.
    #[must_use]
    pub fn plan(&self) -> Plan {
        self.hello_of_first().plan
    }

    /// Says the seed of the next match, none for any; it counts if this member is the first.
    pub fn set_seed(&mut self, seed: Option<u64>) {
        self.hello.seed = seed;
        self.greeted = None;
    }

    /// The seed of the next match, if one was chosen.
    #[must_use]
    pub fn seed(&self) -> Option<u64> {
        self.hello_of_first().seed
    }

    fn hello_of_first(&self) -> &Hello {
        let first = self.guests.first().filter(|_| !self.leads()).and_then(|guest| guest.hello.as_ref());
        first.unwrap_or(&self.hello)
    }

    /// Its code.
    #[must_use]
    pub fn code(&self) -> &str {
        &self.code
    }

    /// Whether the room is entered.
    #[must_use]
    pub fn is_entered(&self) -> bool {
        self.own.is_some()
    }

    /// Why it is closed, if it is.
    #[must_use]
    pub fn closed(&self) -> Option<&str> {
        self.closed.as_deref()
    }

    fn hello_of(&self, member: Member) -> Option<&Hello> {
        let guest = self.guests.iter().find(|guest| guest.member == member);
        if Some(member) == self.own { Some(&self.hello) } else { guest?.hello.as_ref() }
    }

    fn name_of(&self, member: Member) -> String {
        let name = self.hello_of(member).map_or("", |hello| &hello.name);
        if name.is_empty() { numbered(member) } else { name.to_owned() }
    }

    /// All members, in order.
    #[must_use]
    pub fn seats(&self) -> Vec<Seat> {
        let seat = |member: Member| {
            let is_own = Some(member) == self.own;
            let note = match self.hello_of(member) {
                None => Key::RoomComing,
                Some(hello) if hello.program != self.hello.program => Key::RoomOtherVersion,
                Some(hello) if hello.is_playing => Key::RoomPlays,
                Some(hello) if hello.is_ready => Key::RoomIsReady,
                Some(_) => Key::RoomNotReady,
            };
            Seat { name: self.name_of(member), is_own, note }
        };
        self.members().into_iter().map(seat).collect()
    }
}

#[cfg(test)]
#[path = "room_tests.rs"]
mod tests;
