//! What is known of one player of a match: its inputs, when it left, and how well its packets come through.

use super::packet::{Packet, Takeover};
use super::told::Told;
use super::transport::Member;

/// What is known of a player.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    /// Its inputs from the first frame on, as far as they are known.
    told: Vec<Told>,
    /// What its cell was told in the frames that were taken: where these differ from the inputs, frames are taken again.
    acted: Vec<Told>,
    /// Whether it has left, and the frame from which on a bot steers.
    pub has_left: bool,
    pub end: Option<u32>,
    /// The frame from which on it steers: not the first if it took over from a bot.
    pub since: u32,
    /// Frames that it had taken by its newest packet.
    pub frame: u32,
    /// For how many frames it knows the inputs of each player.
    pub known: Vec<u32>,
    /// Its last digest of a frame.
    pub digest: Option<(u32, u64)>,
    /// How far this player was ahead of it when its newest packet came, and by how many frames it believes to be ahead.
    pub ahead: i32,
    pub advantage: i32,
    /// Its clock in the newest packet, and when that came, ms.
    heard: Option<(u32, u32)>,
    /// Time to it and back, ms.
    pub ping: Option<u32>,
    /// The number of its newest packet, and how many came.
    newest: u32,
    came: u32,
    /// Packets that were sent to it.
    pub sent: u32,
}

/// Who watches, as one of the players knows it.
#[derive(Debug)]
pub(super) struct Guest {
    pub member: Member,
    pub track: Track,
    /// Whether it would take over from a bot now.
    pub wants: bool,
}

impl Track {
    /// A player whose inputs begin after the delay; before, its cell rests.
    pub(super) fn new(players: usize, delay: u32) -> Self {
        let told = vec![Told::default(); delay as usize];
        Self { told, known: vec![delay; players], ..Self::default() }
    }

    /// For how many frames its inputs are known.
    pub(super) fn count(&self) -> u32 {
        self.told.len() as u32
    }

    /// For how many frames it is known what its cell is told: all that will ever be, once a bot steers.
    pub(super) fn certain(&self) -> u32 {
        if self.end.is_some_and(|end| end <= self.count()) { u32::MAX } else { self.count() }
    }

    /// Its inputs from a frame on, at most so many.
    pub(super) fn since(&self, first: u32, most: usize) -> &[Told] {
        let rest = self.told.get(first as usize..).unwrap_or_default();
        &rest[..rest.len().min(most)]
    }

    /// What it wants from now on counts in a frame; until then a bot steers what it has not said.
    pub(super) fn push(&mut self, frame: u32, told: Told) {
        while self.count() < frame {
            self.told.push(Told::BOT);
        }
        if self.count() == frame {
            self.told.push(told);
        }
    }

    /// Takes over what is new of a run of inputs; the first frame in which its cell was told something else.
    pub(super) fn extend(&mut self, first: u32, run: &[Told]) -> Option<u32> {
        let from = self.count();
        // A gap is closed by a later packet.
        let fresh = run.get(from.checked_sub(first)? as usize..).unwrap_or_default();
        let room = self.end.map_or(fresh.len(), |end| fresh.len().min(end.saturating_sub(from) as usize));
        self.told.extend(&fresh[..room]);
        (from..self.count())
            .find(|&frame| self.acted.get(frame as usize).is_some_and(|acted| *acted != self.told[frame as usize]))
    }

    /// A bot steers from a frame on.
    pub(super) fn finish(&mut self, end: u32) {
        self.end = Some(end);
        self.told.truncate(end as usize);
    }

    /// A player takes over from the bot: who was there before is forgotten, but for what its cell was told.
    pub(super) fn take_over(&mut self, takeover: &Takeover, delay: u32) {
        // Else the rest comes in packets.
        if self.end == Some(self.count()) {
            self.told.resize(takeover.since as usize, Told::BOT);
        }
        let (told, acted) = (std::mem::take(&mut self.told), std::mem::take(&mut self.acted));
        let known = vec![delay; self.known.len()];
        *self = Self { told, acted, known, since: takeover.since, ..Self::default() };
    }

    /// What its cell is told in a frame: what is known, or the same as in the last frame that is known, but for what is done once.
    pub(super) fn act(&mut self, frame: u32) -> Told {
        let last = || self.told.last().map(|last| last.doing(None));
        let known = self.told.get(frame as usize).copied().or_else(last).unwrap_or_default();
        let told = if self.end.is_some_and(|end| frame >= end) { Told::BOT } else { known };
        self.acted.truncate(frame as usize);
        self.acted.push(told);
        told
    }

    /// Notes what a packet says of its sender. `frame` is that of the receiver.
    pub(super) fn note(&mut self, packet: &Packet, frame: u32, now: u32) {
        self.came += 1;
        for (known, newer) in self.known.iter_mut().zip(&packet.known) {
            *known = (*known).max(*newer);
        }
        if self.heard.is_some() && packet.number <= self.newest {
            return;
        }
        (self.newest, self.frame) = (packet.number, packet.frame);
        self.heard = Some((packet.sent, now));
        self.ahead = frame as i32 - packet.frame as i32;
        self.advantage = packet.advantage.into();
        self.digest = packet.digest.or(self.digest);
        self.ping = packet.heard.map(|heard| now.wrapping_sub(heard)).filter(|ping| *ping < 60_000).or(self.ping);
    }

    /// Its clock as it is heard now, without the way to here.
    pub(super) fn clock(&self, now: u32) -> Option<u32> {
        self.heard.map(|(sent, at)| sent.wrapping_add(now.wrapping_sub(at)))
    }

    /// Time since its newest packet came, ms.
    pub(super) fn silence(&self, now: u32) -> u32 {
        self.heard.map_or(0, |(_, at)| now.wrapping_sub(at))
    }

    /// Share of its packets that were lost, 0 to 1.
    pub(super) fn loss(&self) -> f32 {
        1.0 - (self.came as f32 / self.newest.saturating_add(1) as f32).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::food_chain::Deed;
    use microsim_core::Intent;
    use microsim_core::glam::Vec2;

    #[test]
    fn what_is_done_once_is_not_predicted_again() {
        let mut track = Track::new(2, 2);
        let held = Told::new(Intent::toward(Vec2::ONE).unwrap(), Vec2::splat(9.0));
        track.push(2, held.doing(Some(Deed::Divide)));
        assert_eq!([2, 3, 4].map(|frame| track.act(frame)), [held.doing(Some(Deed::Divide)), held, held]);
    }
}
