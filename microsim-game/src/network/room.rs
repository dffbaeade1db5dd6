//! A room: who is there, under which names, who is ready, and the match that they start.

use super::message::{Hello, Message, Program, Start, clean, clean_text, round_of, write};
use super::pacing::Pacing;
use super::session::Session;
use super::told::Told;
use super::transport::{Member, Notice, Transport};
use crate::rules::round::MOST_PLAYERS;
use crate::rules::two_players::TwoPlayers;
use microsim_core::Intent;

/// Time between two messages of who is there, and between two calls to start, ms.
const GREETING: u32 = 1000;
const CALLING: u32 = 200;

/// A match of a room.
#[derive(Debug)]
pub struct Match {
    start: Start,
    session: Session,
    /// The seat of this player.
    own: usize,
    /// Who has sent a packet of it, by seat.
    heard: Vec<bool>,
    called: u32,
}

/// Somebody else in the room, as far as it has said who it is.
#[derive(Clone, Debug)]
struct Guest {
    member: Member,
    hello: Option<Hello>,
}

/// One member, as the lobby shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seat {
    /// Its name, clean.
    pub name: String,
    /// Whether it is this player.
    pub is_own: bool,
    /// What is to be said of it.
    pub note: &'static str,
}

/// A room that this player is in.
#[derive(Debug)]
pub struct Room {
    transport: Box<dyn Transport>,
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
        let hello = Hello { program: Program::own(), name: clean(name), is_ready: false, together: false, number: 0 };
        let (own, guests, greeted, closed) = (None, Vec::new(), None, None);
        Self { transport, code: code.to_owned(), own, hello, guests, greeted, number: 0, is_playing: false, closed }
    }

    /// Takes in what has come, and says what is to be said. `now` is a clock, ms; `seed` is for a match that begins now, and `current` is
    /// the match that is on. Returns one that begins.
    pub fn update(&mut self, now: u32, seed: u64, mut current: Option<&mut Match>) -> Option<Match> {
        let mut begun = None;
        for notice in self.transport.poll() {
            let begins = self.take(notice, now, current.as_deref_mut().or(begun.as_mut()));
            begun = begins.or(begun);
        }
        if self.greeted.is_none_or(|at| now.wrapping_sub(at) >= GREETING) {
            self.greeted = Some(now);
            let is_ready = self.hello.is_ready && !self.is_playing;
            self.send_all(&Message::Hello(Hello { is_ready, number: self.number, ..self.hello.clone() }));
        }
        if !self.is_playing && self.leads() && self.is_complete() {
            let seats = self.members();
            begun = self.begin(Start { number: self.next_number(), seed, together: self.hello.together, seats }, now);
        }
        if let Some(current) = current.or(begun.as_mut()) {
            self.call(current, now);
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
            Notice::Left(member) => self.part(member, current),
            Notice::Message { from, bytes } => return self.hear(from, &bytes, now, current),
            Notice::Closed(reason) => self.closed = Some(clean_text(&reason, 200)),
        }
        None
    }

    fn meet(&mut self, member: Member) {
        let is_new = Some(member) != self.own && self.guests.iter().all(|guest| guest.member != member);
        if is_new && self.guests.len() + 1 < MOST_PLAYERS && usize::from(member) < MOST_PLAYERS {
            self.guests.push(Guest { member, hello: None });
            self.guests.sort_by_key(|guest| guest.member);
            self.greeted = None;
        }
    }

    fn part(&mut self, member: Member, current: Option<&mut Match>) {
        self.guests.retain(|guest| guest.member != member);
        if let Some(current) = current
            && let Some(seat) = current.seat_of(member)
        {
            current.session.leave(seat);
        }
    }

    fn hear(&mut self, from: Member, bytes: &[u8], now: u32, current: Option<&mut Match>) -> Option<Match> {
        let guest = self.guests.iter_mut().find(|guest| guest.member == from)?;
        match postcard::from_bytes(bytes).ok()? {
            Message::Hello(hello) => guest.hello = Some(Hello { name: clean(&hello.name), ..hello }),
            Message::Start(start) if self.first() == Some(from) && self.is_due(&start) => {
                return self.begin(start, now);
            }
            Message::Start(_) => {}
            Message::Packet(number, packet) => {
                let current = current.filter(|current| current.start.number == number)?;
                let seat = current.seat_of(from)?;
                current.heard[seat] = true;
                current.session.receive(seat, &packet, now);
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

    fn begin(&mut self, start: Start, now: u32) -> Option<Match> {
        let own = start.seats.iter().position(|&member| Some(member) == self.own)?;
        let round = round_of(start.seats.len(), start.seed).ok()?;
        let (mut session, heard) = (Session::new(round, own, Pacing::USUAL), vec![false; start.seats.len()]);
        // Who has gone since the call.
        let here = self.members();
        let gone = start.seats.iter().enumerate().filter(|(_, member)| !here.contains(member));
        gone.for_each(|(seat, _)| session.leave(seat));
        (self.number, self.is_playing, self.greeted) = (start.number, true, None);
        Some(Match { start, session, own, heard, called: now.wrapping_sub(CALLING) })
    }

    /// Calls those who have not begun yet.
    fn call(&mut self, current: &mut Match, now: u32) {
        if !self.leads() || now.wrapping_sub(current.called) < CALLING {
            return;
        }
        current.called = now;
        let bytes = write(&Message::Start(current.start.clone()));
        let present: Vec<usize> = current.session.present().collect();
        let late = current.start.seats.iter().zip(&current.heard).enumerate();
        let late = late.filter(|(seat, (_, heard))| !**heard && present.contains(seat)).map(|(_, (member, _))| *member);
        late.filter(|&member| Some(member) != self.own).for_each(|member| self.transport.send(member, &bytes));
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

    /// Says how the next match is played; it counts if this member is the first.
    pub fn set_way(&mut self, way: TwoPlayers) {
        self.hello.together = way == TwoPlayers::Together;
        self.greeted = None;
    }

    /// How the next match is played.
    #[must_use]
    pub fn way(&self) -> TwoPlayers {
        let first = self.guests.first().filter(|_| !self.leads()).and_then(|guest| guest.hello.as_ref());
        way(first.unwrap_or(&self.hello).together)
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

    /// All members, in order.
    #[must_use]
    pub fn seats(&self) -> Vec<Seat> {
        let name = |member: Member, hello: Option<&Hello>| {
            let name = hello.map_or("", |hello| &hello.name);
            if name.is_empty() { format!("Player {}", member + 1) } else { name.to_owned() }
        };
        let seat = |member: Member| {
            let is_own = Some(member) == self.own;
            let guest = self.guests.iter().find(|guest| guest.member == member);
            let hello = if is_own { Some(&self.hello) } else { guest.and_then(|guest| guest.hello.as_ref()) };
            let note = match hello {
                None => "is coming",
                Some(hello) if hello.program != self.hello.program => "has another version",
                Some(hello) if hello.is_ready => "ready",
                Some(_) => "not ready",
            };
            Seat { name: name(member, hello), is_own, note }
        };
        self.members().into_iter().map(seat).collect()
    }
}

impl Match {
    /// One frame, with what this player tells its cell. Returns whether one was taken.
    pub fn advance(&mut self, room: &mut Room, intent: Intent, now: u32) -> bool {
        let size = self.session.round().world().config().size;
        let is_taken = self.session.advance(Told::new(intent, size));
        for (seat, packet) in self.session.packets(now) {
            room.transport.send(self.start.seats[seat], &write(&Message::Packet(self.start.number, packet)));
        }
        is_taken
    }

    fn seat_of(&self, member: Member) -> Option<usize> {
        self.start.seats.iter().position(|&other| other == member)
    }

    /// What is played.
    #[must_use]
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// How it is played.
    #[must_use]
    pub fn way(&self) -> TwoPlayers {
        way(self.start.together)
    }

    /// The number of this player in it, from 0 on.
    #[must_use]
    pub fn own(&self) -> usize {
        self.own
    }
}

fn way(together: bool) -> TwoPlayers {
    if together { TwoPlayers::Together } else { TwoPlayers::Versus }
}

#[cfg(test)]
#[path = "room_tests.rs"]
mod tests;
