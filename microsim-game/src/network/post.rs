//! What a player of a match sends.

use super::packet::{LONGEST_HISTORY, LONGEST_RUN, Packet, Run};
use super::session::Session;
use super::track::Track;

impl Session {
    /// What is to be sent now, and to whom. Who watches speaks to one of the players only.
    pub fn packets(&mut self, now: u32) -> Vec<(usize, Vec<u8>)> {
        let host = self.leader();
        let others = (0..self.tracks.len()).filter(|&k| self.is_other(k) && (self.own.is_some() || k == host));
        let packets: Vec<_> = others.map(|to| (to, self.packet(&self.tracks[to], Some(to), now))).collect();
        for (to, packet) in &packets {
            self.tracks[*to].sent += 1;
            self.tally.sent += packet.len() as u64;
        }
        packets
    }

    /// A packet for a player, or for one who watches, of whom `track` is known.
    pub(super) fn packet(&self, track: &Track, to: Option<usize>, now: u32) -> Vec<u8> {
        let run = |(player, other): (usize, &Track)| {
            // One who takes over from a bot soon after it came needs what its cell was told before.
            let is_needed = if to == Some(player) { track.known[player] < other.since } else { other.has_left };
            let is_passed_on = self.own == Some(player) || is_needed && self.own.is_some();
            let most = if to.is_some() { LONGEST_RUN } else { LONGEST_HISTORY };
            let (first, told) = (track.known[player], other.since(track.known[player], most).to_vec());
            let is_sent = (is_passed_on || to.is_none()) && !told.is_empty();
            is_sent.then_some(Run { player: player as u8, first, told })
        };
        let advantage = track.ahead.clamp(i16::MIN.into(), i16::MAX.into()) as i16;
        let packet = Packet {
            number: track.sent,
            frame: self.frame,
            advantage,
            sent: now,
            heard: track.clock(now),
            known: self.tracks.iter().map(Track::count).collect(),
            ends: self.ends(),
            takeovers: self.takeovers.clone(),
            wants: self.wants(),
            runs: self.tracks.iter().enumerate().filter_map(run).collect(),
            digest: self.digests.last().copied(),
        };
        packet.write()
    }

    /// From which frames on bots steer, by player.
    pub(super) fn ends(&self) -> Vec<(u8, u32)> {
        (0..).zip(&self.tracks).filter_map(|(k, track)| Some((k, track.end?))).collect()
    }
}
