//! A match of a room: which member has which cell.

use super::message::{Message, Start, write};
use super::plan::{Plan, round_of};
use super::session::Session;
use super::told::Told;
use super::transport::{Member, Transport};
use crate::rules::food_chain::Deed;
use crate::words::{self, Key};
use microsim_core::Intent;
use std::time::Duration;

/// Time for which a cell is kept for who was cut, ms.
const KEPT: u32 = 30_000;

/// A match of a room.
#[derive(Debug)]
pub struct Match {
    pub(super) start: Start,
    pub(super) session: Session,
    /// By seat: names, who has sent a packet of it, and when its player left, ms.
    names: Vec<String>,
    heard: Vec<bool>,
    left: Vec<Option<u32>>,
    /// What this player does once, in the next frame.
    deed: Option<Deed>,
    /// When others were called last, ms.
    pub(super) called: u32,
}

impl Match {
    pub(super) fn new(start: Start, own: usize, called: u32) -> Option<Self> {
        let round = round_of(start.plan.way, start.seats.len(), start.seed).ok()?;
        let session = Session::new(round, own, start.plan.rate.pacing());
        Some(Self::of(start, session, called))
    }

    /// A match that is on, as a member comes to it who was invited by `from`; none if that one has no cell in it. Who invites
    /// leads: those before it have left, or took over from a bot, as its packets say.
    pub(super) fn watch(start: Start, member: Member, from: Member, now: u32) -> Option<Self> {
        let first = start.seats.iter().rposition(|&seat| seat == from)?;
        let round = round_of(start.plan.way, start.seats.len(), start.seed).ok()?;
        let session = Session::watch(round, member, start.plan.rate.pacing());
        let mut game = Self::of(start, session, now);
        (0..first).for_each(|seat| game.vacate(seat, now));
        game.part(member, now);
        Some(game)
    }

    fn of(start: Start, session: Session, called: u32) -> Self {
        let seats = start.seats.len();
        let names = start.seats.iter().map(|&member| numbered(member)).collect();
        Self { start, session, names, heard: vec![false; seats], left: vec![None; seats], deed: None, called }
    }

    pub(super) fn receive(&mut self, from: Member, packet: &[u8], now: u32) {
        let Some(seat) = self.seat_of(from) else { return self.session.receive_guest(from, packet, now) };
        self.heard[seat] = true;
        self.session.receive(seat, packet, now);
    }

    /// A member has gone.
    pub(super) fn part(&mut self, member: Member, now: u32) {
        self.session.forget(member);
        if let Some(seat) = self.seat_of(member) {
            self.vacate(seat, now);
        }
    }

    fn vacate(&mut self, seat: usize, now: u32) {
        self.session.leave(seat);
        self.left[seat] = Some(now);
    }

    /// Gives a bot's cell to one who has caught up: its own one at once, that of another one who had time to come back.
    pub(super) fn give_cell(&mut self, member: Member, is_back: bool, now: u32) {
        if !self.session.wanting().contains(&member) {
            return;
        }
        let away: Vec<usize> =
            (0..self.left.len()).filter(|&k| self.session.present().all(|there| there != k)).collect();
        let is_own = |seat: &&usize| is_back && self.member(**seat) == member;
        let is_free = |seat: &&usize| self.left[**seat].is_some_and(|at| now.wrapping_sub(at) >= KEPT);
        if let Some(&seat) = away.iter().find(is_own).or(away.iter().find(is_free)) {
            self.session.seat(seat, member);
        }
    }

    /// Whether a member plays or watches.
    pub(super) fn has(&self, member: Member) -> bool {
        self.seat_of(member).is_some() || self.session.is_watched_by(member)
    }

    /// Those of whom no packet has come.
    pub(super) fn silent(&self) -> Vec<Member> {
        self.session.present().filter(|&seat| !self.heard[seat]).map(|seat| self.member(seat)).collect()
    }

    /// Who has each cell, or had it last.
    pub(super) fn members(&self) -> Vec<Member> {
        (0..self.left.len()).map(|seat| self.member(seat)).collect()
    }

    fn member(&self, seat: usize) -> Member {
        self.session.successor(seat).unwrap_or(self.start.seats[seat])
    }

    fn seat_of(&self, member: Member) -> Option<usize> {
        self.session.present().find(|&seat| self.member(seat) == member)
    }

    pub(super) fn note_name(&mut self, member: Member, name: String) {
        if let Some(seat) = self.seat_of(member) {
            self.names[seat] = name;
        }
    }

    /// What this player does in the next frame beside what it tells its cell.
    pub fn act(&mut self, deed: Deed) {
        self.deed = Some(deed);
    }

    /// One frame, with what this player tells its cell. Returns whether one was taken.
    pub(super) fn advance(&mut self, transport: &mut dyn Transport, intent: Intent, now: u32) -> bool {
        let size = self.session.round().world().config().size;
        let is_taken = self.session.advance(Told::new(intent, size).doing(self.deed));
        self.deed = self.deed.filter(|_| !is_taken);
        let to_players = self.session.packets(now);
        let mut packets = self.session.guest_packets(now);
        packets.extend(to_players.into_iter().map(|(seat, packet)| (self.member(seat), packet)));
        for (member, packet) in packets {
            transport.send(member, &write(&Message::Packet(self.start.number, packet)));
        }
        is_taken
    }

    /// One frame more, for one who has come late. Returns whether one was taken.
    pub fn catch_up(&mut self) -> bool {
        self.session.is_behind() && self.session.catch_up()
    }

    /// Notes how long the last frame took.
    pub fn note_time(&mut self, time: Duration) {
        self.session.note_time(time);
    }

    /// What is played.
    #[must_use]
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Names of those who play, in the order of their cells.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// What is played, and how fast.
    #[must_use]
    pub fn plan(&self) -> Plan {
        self.start.plan
    }

    /// The number of this player in it, from 0 on; none if it watches.
    #[must_use]
    pub fn own(&self) -> Option<usize> {
        self.session.own()
    }
}

/// What somebody without a name is called.
pub(super) fn numbered(member: Member) -> String {
    words::text_with(Key::TwoPlayer, &[("number", (u32::from(member) + 1).into())])
}
