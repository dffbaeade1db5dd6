//! Who has no cell in a match: it sees the match from the inputs of all, which one of the players sends it, and takes over from a bot
//! when it has caught up.
//!
//! The round is computed from its beginning: five bytes a frame are less than a snapshot, make no world that cannot be, and leave a record
//! of the whole round.

use super::packet::{Packet, Takeover};
use super::session::Session;
use super::told::Told;
use super::track::{Guest, Track};
use super::transport::Member;

/// Frames that one who watches is behind what it knows, so that packets may be late.
const BEHIND: u32 = 2;
/// Time without a packet after which one who watches is sent none, ms.
const SILENCE: u32 = 5000;

impl Session {
    /// Takes in a packet of a member of the room that has no cell. `now` is a clock, ms.
    pub fn receive_guest(&mut self, member: Member, bytes: &[u8], now: u32) {
        let packet = Packet::read(bytes, self.tracks.len());
        let Some(mut packet) = packet.filter(|packet| self.own.is_some() && packet.runs.is_empty()) else {
            self.tally.refused += 1;
            return;
        };
        // It may know more than this player, from one who has left.
        packet.known.iter_mut().zip(&self.tracks).for_each(|(known, track)| *known = track.count().min(*known));
        self.tally.received += bytes.len() as u64;
        let place = self.guests.iter().position(|guest| guest.member == member).unwrap_or_else(|| {
            let track = Track::new(self.tracks.len(), self.pacing.delay);
            self.guests.push(Guest { member, track, wants: false });
            self.guests.len() - 1
        });
        let guest = &mut self.guests[place];
        guest.track.note(&packet, self.frame, now);
        guest.wants = packet.wants;
    }

    /// What is to be sent to those who watch.
    pub fn guest_packets(&mut self, now: u32) -> Vec<(Member, Vec<u8>)> {
        let is_heard = |guest: &&mut Guest| guest.track.silence(now) < SILENCE;
        let heard = self.guests.iter().filter(|guest| guest.track.silence(now) < SILENCE);
        let packets: Vec<_> = heard.map(|guest| (guest.member, self.packet(&guest.track, None, now))).collect();
        self.guests.iter_mut().filter(is_heard).for_each(|guest| guest.track.sent += 1);
        self.tally.sent += packets.iter().map(|(_, packet)| packet.len() as u64).sum::<u64>();
        packets
    }

    /// A member is gone, or has a cell.
    pub fn forget(&mut self, member: Member) {
        self.guests.retain(|guest| guest.member != member);
    }

    /// Whether a member watches.
    #[must_use]
    pub fn is_watched_by(&self, member: Member) -> bool {
        self.guests.iter().any(|guest| guest.member == member)
    }

    /// Those who would take over from a bot now.
    #[must_use]
    pub fn wanting(&self) -> Vec<Member> {
        let is_near = |guest: &&Guest| guest.track.frame + self.pacing.horizon() >= self.frame;
        self.guests.iter().filter(is_near).filter(|guest| guest.wants).map(|guest| guest.member).collect()
    }

    /// Whether all who watch have what they need to see a frame. Those who are far behind do not count.
    pub(super) fn is_seen(&self, frame: u32) -> bool {
        let is_near = |guest: &&Guest| guest.track.frame + self.pacing.horizon() >= frame;
        self.guests.iter().filter(is_near).all(|guest| guest.track.known.iter().all(|known| *known >= frame))
    }

    /// A member takes over from the bot of a player, from a frame on before which nobody needs its inputs.
    pub fn seat(&mut self, player: usize, member: Member) {
        let Some(end) = self.tracks.get(player).filter(|track| track.has_left).and_then(|track| track.end) else {
            return;
        };
        if self.leads() {
            let since = (self.told_until() + self.pacing.window).max(end + 1);
            self.take_over(Takeover { player: player as u8, member, end, since }, false);
        }
    }

    /// Takes over what the first of the players says of cells that were a bot's; in the past, if one is a bot's again.
    pub(super) fn take_over(&mut self, takeover: Takeover, is_past: bool) {
        let player = usize::from(takeover.player);
        if takeover.since <= self.tracks[player].since || self.own == Some(player) {
            return;
        }
        let is_own = !is_past && self.own.is_none() && self.member == Some(takeover.member);
        self.tracks[player].has_left = true;
        self.finish(player, takeover.end);
        let track = &mut self.tracks[player];
        let is_known = track.end == Some(takeover.end);
        self.desync = self.desync.or(track.end.filter(|_| !is_known));
        // Who only watches may be far behind: all comes by and by.
        let is_due = if is_own { is_known && track.count() == takeover.end } else { self.own.is_none() || is_known };
        if !is_due {
            return;
        }
        track.take_over(&takeover, self.pacing.delay);
        // Packets to it are counted on.
        let guest = self.guests.iter().find(|guest| guest.member == takeover.member);
        track.sent = guest.map_or(0, |guest| guest.track.sent);
        self.own = self.own.or(is_own.then_some(player));
        self.forget(takeover.member);
        self.takeovers.retain(|other| other.player != takeover.player);
        self.takeovers.push(takeover);
        self.takeovers.sort_by_key(|other| other.player);
    }

    /// Who has taken over from the bot of a player.
    #[must_use]
    pub fn successor(&self, player: usize) -> Option<Member> {
        self.takeovers.iter().find(|takeover| usize::from(takeover.player) == player).map(|takeover| takeover.member)
    }

    /// Whether this player has frames to take at once: it watches or has just come, and more is known.
    #[must_use]
    pub fn is_behind(&self) -> bool {
        match self.own {
            None => self.final_frame() > self.frame + BEHIND,
            Some(own) => {
                let newest = self.others().map(|k| self.tracks[k].frame).max().unwrap_or(0);
                self.frame < self.tracks[own].since.min(newest)
            }
        }
    }

    /// One frame to catch up.
    pub fn catch_up(&mut self) -> bool {
        self.advance(Told::BOT)
    }

    /// Whether this player has no cell, and would be in time with one.
    pub(super) fn wants(&self) -> bool {
        let newest = self.tracks[self.leader()].frame;
        self.own.is_none() && newest > 0 && self.frame + self.pacing.window >= newest
    }
}
