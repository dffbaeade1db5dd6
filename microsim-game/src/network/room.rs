//! A room: who is there, under which names, who is ready, and the match that they start.

use super::session::{Pacing, Session};
use super::told::Told;
use super::transport::{Member, Notice, Transport};
use crate::rules::round::{MOST_PLAYERS, Round};
use crate::rules::two_players::{self, TwoPlayers};
use microsim_core::Intent;
use microsim_core::scenario::Scenario;
use serde::{Deserialize, Serialize};

/// Changes with every change of a message.
const PROTOCOL: u16 = 1;
/// Longest name, letters.
const LONGEST_NAME: usize = 24;
/// Time between two messages of who is there, and between two calls to start, ms.
const GREETING: u32 = 1000;
const CALLING: u32 = 200;
/// Steps of the run whose digest tells whether two programs compute the same worlds.
const PROBE_STEPS: u32 = 30;

/// What members say to each other.
#[derive(Debug, Serialize, Deserialize)]
enum Message {
    Hello(Hello),
    Start(Start),
    /// A packet of the match of this number.
    Packet(u32, Vec<u8>),
}

/// Who somebody is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Hello {
    program: Program,
    name: String,
    is_ready: bool,
    together: bool,
}

/// What must be equal for a match.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Program {
    protocol: u16,
    version: String,
    /// Of a short run.
    digest: u64,
}

/// A match, as the first member calls it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Start {
    number: u32,
    seed: u64,
    together: bool,
    /// Who plays, in the order of their cells.
    seats: Vec<Member>,
}

/// A match that is on.
#[derive(Debug)]
struct Running {
    start: Start,
    session: Session,
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
    /// Number of the last match.
    number: u32,
    running: Option<Running>,
    closed: Option<String>,
}

impl Room {
    /// A room that is being entered.
    #[must_use]
    pub fn new(transport: Box<dyn Transport>, code: &str, name: &str) -> Self {
        let hello = Hello { program: Program::own(), name: clean(name), is_ready: false, together: false };
        let (own, guests, greeted, running) = (None, Vec::new(), None, None);
        Self { transport, code: code.to_owned(), own, hello, guests, greeted, number: 0, running, closed: None }
    }

    /// Takes in what has come, and says what is to be said. `now` is a clock, ms; `seed` is for a match that begins now.
    pub fn update(&mut self, now: u32, seed: u64) {
        for notice in self.transport.poll() {
            self.take(notice, now);
        }
        if self.greeted.is_none_or(|at| now.wrapping_sub(at) >= GREETING) {
            self.greeted = Some(now);
            self.send_all(&Message::Hello(self.hello.clone()));
        }
        if self.running.is_none() && self.leads() && self.is_complete() {
            let seats = self.members();
            self.begin(Start { number: self.number + 1, seed, together: self.hello.together, seats }, now);
        }
        self.call(now);
    }

    fn take(&mut self, notice: Notice, now: u32) {
        match notice {
            Notice::Welcome { member, others } => {
                self.own = Some(member);
                others.into_iter().for_each(|other| self.meet(other));
            }
            Notice::Joined(member) => self.meet(member),
            Notice::Left(member) => self.part(member),
            Notice::Message { from, bytes } => self.hear(from, &bytes, now),
            Notice::Closed(reason) => self.closed = Some(clean_text(&reason, 200)),
        }
    }

    fn meet(&mut self, member: Member) {
        let is_new = Some(member) != self.own && self.guests.iter().all(|guest| guest.member != member);
        if is_new && self.guests.len() + 1 < MOST_PLAYERS && usize::from(member) < MOST_PLAYERS {
            self.guests.push(Guest { member, hello: None });
            self.guests.sort_by_key(|guest| guest.member);
            self.greeted = None;
        }
    }

    fn part(&mut self, member: Member) {
        self.guests.retain(|guest| guest.member != member);
        if let Some(Running { start, session, .. }) = &mut self.running
            && let Some(seat) = start.seats.iter().position(|&other| other == member)
        {
            session.leave(seat);
        }
    }

    fn hear(&mut self, from: Member, bytes: &[u8], now: u32) {
        let Some(guest) = self.guests.iter_mut().find(|guest| guest.member == from) else { return };
        match postcard::from_bytes(bytes) {
            Ok(Message::Hello(hello)) => guest.hello = Some(Hello { name: clean(&hello.name), ..hello }),
            Ok(Message::Start(start)) if self.first() == Some(from) && self.is_due(&start) => self.begin(start, now),
            Ok(Message::Packet(number, packet)) => {
                if let Some(Running { start, session, heard, .. }) = &mut self.running
                    && start.number == number
                    && let Some(seat) = start.seats.iter().position(|&member| member == from)
                {
                    heard[seat] = true;
                    session.receive(seat, &packet, now);
                }
            }
            Ok(Message::Start(_)) | Err(_) => {}
        }
    }

    /// Whether a call to start is a new one, to those who are here.
    fn is_due(&self, start: &Start) -> bool {
        let members = self.members();
        let are_here = start.seats.iter().all(|member| members.contains(member));
        let is_sound = start.seats.len() >= 2 && start.seats.is_sorted_by(|a, b| a < b) && are_here;
        let is_called = self.own.is_some_and(|own| start.seats.contains(&own));
        self.running.is_none() && self.hello.is_ready && start.number > self.number && is_sound && is_called
    }

    fn begin(&mut self, start: Start, now: u32) {
        let own = start.seats.iter().position(|&member| Some(member) == self.own);
        let (Some(own), Ok(round)) = (own, round_of(start.seats.len(), start.seed)) else { return };
        let (session, heard) = (Session::new(round, own, Pacing::USUAL), vec![false; start.seats.len()]);
        self.number = start.number;
        self.running = Some(Running { start, session, heard, called: now.wrapping_sub(CALLING) });
    }

    /// Calls those who have not begun yet.
    fn call(&mut self, now: u32) {
        let leads = self.leads();
        let Some(running) = self.running.as_mut().filter(|_| leads) else { return };
        if now.wrapping_sub(running.called) < CALLING {
            return;
        }
        running.called = now;
        let start = running.start.clone();
        let late =
            start.seats.iter().zip(&running.heard).filter(|(member, heard)| !**heard && Some(**member) != self.own);
        let late: Vec<Member> = late.map(|(member, _)| *member).collect();
        let bytes = write(&Message::Start(start));
        late.into_iter().for_each(|member| self.transport.send(member, &bytes));
    }

    /// One frame of the match, with what this player tells its cell. Returns whether one was taken.
    pub fn advance(&mut self, intent: Intent, now: u32) -> bool {
        let Some(Running { start, session, .. }) = &mut self.running else { return false };
        let size = session.round().world().config().size;
        let is_taken = session.advance(Told::new(intent, size));
        for (seat, packet) in session.packets(now) {
            self.transport.send(start.seats[seat], &write(&Message::Packet(start.number, packet)));
        }
        is_taken
    }

    /// Ends the match; everybody is asked again whether they are ready. What it came to.
    pub fn finish(&mut self) -> Option<(Session, TwoPlayers)> {
        self.set_ready(false);
        self.guests.iter_mut().filter_map(|guest| guest.hello.as_mut()).for_each(|hello| hello.is_ready = false);
        let Running { start, session, .. } = self.running.take()?;
        Some((session, way(start.together)))
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

    /// The match that is on, and how it is played.
    #[must_use]
    pub fn session(&self) -> Option<(&Session, TwoPlayers)> {
        self.running.as_ref().map(|running| (&running.session, way(running.start.together)))
    }

    /// The seat of this player in the match that is on.
    #[must_use]
    pub fn seat(&self) -> usize {
        let seats = self.running.as_ref().map(|running| &running.start.seats);
        seats.and_then(|seats| seats.iter().position(|&member| Some(member) == self.own)).unwrap_or(0)
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

impl Program {
    /// This program.
    fn own() -> Self {
        let digest = round_of(2, 1).map_or(0, |mut round| {
            let right = Intent::toward(round.world().config().size).unwrap_or(Intent::REST);
            (0..PROBE_STEPS).for_each(|_| round.step_all(&[right, right]));
            round.world().digest()
        });
        Self { protocol: PROTOCOL, version: env!("CARGO_PKG_VERSION").to_owned(), digest }
    }
}

fn way(together: bool) -> TwoPlayers {
    if together { TwoPlayers::Together } else { TwoPlayers::Versus }
}

fn round_of(players: usize, seed: u64) -> Result<Round, String> {
    let mut scenario = Scenario::parse(&two_players::text(players), &[]).map_err(|problems| problems.to_string())?;
    scenario.set_seed(seed);
    Round::new(&scenario)
}

fn write(message: &Message) -> Vec<u8> {
    // Into memory this cannot fail.
    postcard::to_stdvec(message).unwrap_or_default()
}

/// A name as it may be shown: short, and without what controls or reorders letters.
fn clean(name: &str) -> String {
    clean_text(name, LONGEST_NAME)
}

fn clean_text(text: &str, most: usize) -> String {
    let is_plain = |c: &char| matches!(c, '"' | '\'' | '\\') || c.escape_debug().len() == 1;
    text.chars().filter(is_plain).take(most).collect::<String>().trim().to_owned()
}

#[cfg(test)]
#[path = "room_tests.rs"]
mod tests;
