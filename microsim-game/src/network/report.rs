//! What a match says of itself.

use super::moment::Tally;
use super::session::Session;
use super::told::Told;
use crate::rules::round::Round;

impl Session {
    /// The step before which the worlds of two players were found to differ.
    #[must_use]
    pub fn desync(&self) -> Option<u64> {
        self.desync.map(|frame| u64::from(frame) * u64::from(self.pacing.steps))
    }

    /// The round at the step of [`Session::desync`], which all can keep; as it is now, if that one is not kept here.
    #[must_use]
    pub fn parted(&self) -> Option<&Round> {
        let frame = self.desync?;
        let is_kept = frame < self.frame && self.frame <= frame.saturating_add(self.pacing.kept());
        let moment = if is_kept { &self.kept[(frame % self.pacing.kept()) as usize] } else { &self.now };
        Some(&moment.round)
    }

    /// Those who are there, by number.
    pub fn present(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.tracks.len()).filter(|&k| !self.tracks[k].has_left)
    }

    /// The longest way to another player and back, ms, and the greatest share of packets that were lost.
    #[must_use]
    pub fn way(&self) -> (Option<u32>, f32) {
        let pings = self.others().filter_map(|k| self.tracks[k].ping);
        (pings.max(), self.others().map(|k| self.tracks[k].loss()).fold(0.0, f32::max))
    }

    /// What going back cost.
    #[must_use]
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// How long so many frames are, s.
    #[must_use]
    pub fn seconds(&self, frames: u32) -> f32 {
        (frames * self.steps()) as f32 * self.round().world().config().dt
    }

    /// Most frames that are predicted on this machine.
    #[must_use]
    pub fn window(&self) -> u32 {
        self.prediction.frames(self.pacing)
    }

    /// Digests of what is final, by frame.
    #[must_use]
    pub fn digests(&self) -> &[(u32, u64)] {
        &self.digests
    }

    /// The number of this player, from 0 on; none if it watches.
    #[must_use]
    pub fn own(&self) -> Option<usize> {
        self.own
    }

    /// What a player told its cell in each frame that is known, and the frame from which on a bot steers.
    #[must_use]
    pub fn told(&self, player: usize) -> (&[Told], Option<u32>) {
        self.tracks.get(player).map_or((&[], None), |track| (track.since(0, usize::MAX), track.end))
    }
}
