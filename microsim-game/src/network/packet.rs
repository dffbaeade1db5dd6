//! What players send each other in every frame, as bytes.

use super::told::Told;
use super::transport::Member;
use crate::rules::round::MOST_PLAYERS;
use serde::{Deserialize, Serialize};

/// Longest packet, bytes.
const LONGEST: usize = 8192;
/// Most inputs in one run: more are sent when these have arrived. The second is for those who join late.
pub(super) const LONGEST_RUN: usize = 64;
pub(super) const LONGEST_HISTORY: usize = 256;

/// No match is that long, frames: an hour has 216,000 of them at most.
const LAST_FRAME: u32 = 1 << 18;

/// Inputs of one player for frames that follow each other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Run {
    pub player: u8,
    pub first: u32,
    pub told: Vec<Told>,
}

/// A cell that a bot has steered from one frame on, and that a member of the room steers from another one on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Takeover {
    pub player: u8,
    pub member: Member,
    pub end: u32,
    pub since: u32,
}

/// What one player says to another in a frame.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Packet {
    /// Counts the packets to this player.
    pub number: u32,
    /// Frames that the sender has taken, and by how many it believes to be ahead.
    pub frame: u32,
    pub advantage: i16,
    /// The sender's clock, and that of the receiver as the sender heard it last, with the time since then, ms.
    pub sent: u32,
    pub heard: Option<u32>,
    /// For how many frames the sender knows the inputs of each player.
    pub known: Vec<u32>,
    /// From which frame on a bot steers for a player.
    pub ends: Vec<(u8, u32)>,
    /// The last takeover of each cell, in the order of the cells.
    pub takeovers: Vec<Takeover>,
    /// Whether the sender has no cell, and is ready to take one.
    pub wants: bool,
    pub runs: Vec<Run>,
    /// The last frame of which the sender's world is final and was digested.
    pub digest: Option<(u32, u64)>,
}

impl Packet {
    pub(super) fn write(&self) -> Vec<u8> {
        // Into memory this cannot fail.
        postcard::to_stdvec(self).unwrap_or_default()
    }

    /// A packet of a match of so many players; `None` if no player writes such bytes.
    pub(super) fn read(bytes: &[u8], players: usize) -> Option<Self> {
        if bytes.len() > LONGEST {
            return None;
        }
        let (packet, rest): (Self, _) = postcard::take_from_bytes(bytes).ok()?;
        let is_player = |player: u8| usize::from(player) < players;
        let is_run = |run: &Run| {
            is_player(run.player) && run.told.len() <= LONGEST_HISTORY && run.told.iter().all(|told| told.is_sound())
        };
        let is_takeover = |takeover: &Takeover| {
            is_player(takeover.player)
                && usize::from(takeover.member) < MOST_PLAYERS
                && takeover.end < takeover.since
                && takeover.since < LAST_FRAME
        };
        let is_sound = rest.is_empty()
            && packet.frame < LAST_FRAME
            && packet.known.len() == players
            && packet.ends.len() <= players
            && packet.ends.iter().all(|(player, _)| is_player(*player))
            && packet.takeovers.is_sorted_by(|a, b| a.player < b.player)
            && packet.takeovers.iter().all(is_takeover)
            && packet.runs.len() <= players
            && packet.runs.iter().all(is_run);
        is_sound.then_some(packet)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn packet() -> Packet {
        let runs = vec![Run { player: 1, first: 7, told: vec![Told::default(); 3] }];
        let (known, ends, digest) = (vec![9, 7], vec![(0, 4)], Some((30, 5)));
        let (takeovers, wants) = (vec![Takeover { player: 1, member: 3, end: 4, since: 6 }], true);
        Packet {
            number: 1,
            frame: 8,
            advantage: -2,
            sent: 3,
            heard: Some(4),
            known,
            ends,
            takeovers,
            wants,
            runs,
            digest,
        }
    }

    #[test]
    fn a_packet_comes_back_and_nothing_else_does() {
        let bytes = packet().write();
        assert_eq!(Packet::read(&bytes, 2), Some(packet()));
        assert_eq!(Packet::read(&bytes, 3), None, "other players");
        assert_eq!(Packet::read(&[&bytes[..], &[0]].concat(), 2), None, "more than its content");
        (0..bytes.len()).for_each(|end| assert_eq!(Packet::read(&bytes[..end], 2), None, "cut off at {end}"));
        let stranger = Packet { ends: vec![(2, 4)], ..packet() };
        assert_eq!(Packet::read(&stranger.write(), 2), None, "nobody's end");
        for (player, member, end, since) in [(2, 3, 4, 6), (1, 4, 4, 6), (1, 3, 6, 6), (1, 3, 4, LAST_FRAME)] {
            let takeovers = vec![Takeover { player, member, end, since }];
            assert_eq!(Packet::read(&Packet { takeovers, ..packet() }.write(), 2), None, "a takeover that cannot be");
        }
        let twice = vec![Takeover { player: 1, member: 3, end: 4, since: 6 }; 2];
        assert_eq!(Packet::read(&Packet { takeovers: twice, ..packet() }.write(), 2), None, "one cell twice");
        assert_eq!(Packet::read(&Packet { frame: LAST_FRAME, ..packet() }.write(), 2), None, "too late");
        let runs = vec![Run { player: 1, first: 0, told: vec![Told::default(); LONGEST_HISTORY + 1] }];
        assert_eq!(Packet::read(&Packet { runs, ..packet() }.write(), 2), None, "too long a run");
        assert_eq!(Packet::read(&vec![0; LONGEST + 1], 2), None, "too long");
    }
}
