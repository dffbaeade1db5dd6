//! A match: everybody computes the same round from the inputs of all. What is not known yet is predicted to stay as it was; where
//! that was wrong, the round goes back to the frame and is taken again.
//!
//! Inputs of a match are kept from its first frame on (five bytes each), so there is no input that could be too old to be sent.

use super::moment::{Moment, Tally};
use super::packet::{Packet, Run, Takeover};
use super::prediction_window::PredictionWindow;
use super::rollback_pacing::Pacing;
use super::told::Told;
use super::track::{Guest, Track};
use super::transport::Member;
use crate::rules::referee::Gain;
use crate::rules::round::Round;
use crate::sound::Cue;
use std::time::Duration;

/// Frames in which one frame may be left out to wait for a slower player.
const WAIT_INTERVAL: u32 = 8;
/// By how many frames a player is ahead when it waits.
const AHEAD: i32 = 2;
/// How many inputs ahead one who watches takes.
const LONGEST_STORE: u32 = 1024;

/// A match, as one of its players takes part.
#[derive(Debug)]
pub struct Session {
    pub(super) pacing: Pacing,
    /// The number of this player; none if it watches.
    pub(super) own: Option<usize>,
    /// Its number in the room, if it has come to watch.
    pub(super) member: Option<Member>,
    pub(super) now: Moment,
    pub(super) frame: u32,
    /// Moments before the last frames, by frame.
    pub(super) kept: Vec<Moment>,
    pub(super) tracks: Vec<Track>,
    /// Those who watch, and the last takeover of each cell.
    pub(super) guests: Vec<Guest>,
    pub(super) takeovers: Vec<Takeover>,
    /// The first frame that was taken with a wrong prediction.
    wrong_from: Option<u32>,
    /// The frame after which the round was over.
    over_at: Option<u32>,
    /// The frame in which this player waited last.
    waited: u32,
    pub(super) digests: Vec<(u32, u64)>,
    pub(super) desync: Option<u32>,
    pub(super) tally: Tally,
    /// Frames that the last call took, those that were taken again too.
    pub(super) taken: u32,
    pub(super) prediction: PredictionWindow,
    /// What was heard and earned in the last frame, if one was taken.
    heard: Vec<Cue>,
    gains: Vec<Gain>,
}

impl Session {
    /// A match from a round at its beginning, which is the same for all. `own` is the number of this player.
    #[must_use]
    pub fn new(round: Round, own: usize, pacing: Pacing) -> Self {
        Self::begin(round, Some(own), None, pacing)
    }

    /// The same match as a member of the room sees it that has no cell yet. `round` is that of its beginning.
    #[must_use]
    pub fn watch(round: Round, member: Member, pacing: Pacing) -> Self {
        Self::begin(round, None, Some(member), pacing)
    }

    fn begin(round: Round, own: Option<usize>, member: Option<Member>, pacing: Pacing) -> Self {
        let players = round.players().count();
        let now = Moment::new(round);
        Self {
            pacing,
            own,
            member,
            kept: vec![now.clone(); pacing.kept() as usize],
            now,
            frame: 0,
            tracks: vec![Track::new(players, pacing.delay); players],
            guests: Vec::new(),
            takeovers: Vec::new(),
            wrong_from: None,
            over_at: None,
            waited: 0,
            digests: Vec::new(),
            desync: None,
            tally: Tally::default(),
            taken: 0,
            prediction: PredictionWindow::default(),
            heard: Vec::new(),
            gains: Vec::new(),
        }
    }

    /// Takes in a packet of another player. One that no player sends is counted and changes nothing. `now` is a clock, ms.
    pub fn receive(&mut self, from: usize, bytes: &[u8], now: u32) {
        let is_other = Some(from) != self.own && self.tracks.get(from).is_some_and(|track| !track.has_left);
        let packet = Packet::read(bytes, self.tracks.len()).filter(|packet| is_other && self.is_possible(from, packet));
        let Some(packet) = packet else {
            self.tally.refused += 1;
            return;
        };
        self.tally.received += bytes.len() as u64;
        let leads = self.leader() == from;
        for takeover in packet.takeovers.iter().filter(|_| leads) {
            let is_past = packet.ends.iter().any(|(player, _)| *player == takeover.player);
            self.take_over(*takeover, is_past);
        }
        let agree = packet.ends == self.ends() && packet.takeovers == self.takeovers;
        // Of one who came back since, the end is an old one.
        let news = |&&(player, end): &&(u8, u32)| end >= self.tracks[usize::from(player)].since;
        let ends: Vec<(u8, u32)> = packet.ends.iter().filter(news).copied().collect();
        // A bot has steered from one frame on here and from another one there.
        let differs = |&(player, end): &(u8, u32)| self.tracks[usize::from(player)].end.is_some_and(|own| own != end);
        self.desync = self.desync.or(ends.iter().copied().find(differs).map(|(_, end)| end));
        let track = &mut self.tracks[from];
        track.note(&packet, self.frame, now);
        // Before both know from where on bots steer, their worlds may differ.
        track.digest = track.digest.filter(|_| agree);
        for &(player, end) in ends.iter().filter(|_| leads) {
            self.tracks[usize::from(player)].has_left |= self.own.is_none();
            self.finish(player.into(), end);
        }
        for Run { player, first, told } in &packet.runs {
            let (is_guest, track) = (self.own.is_none(), &mut self.tracks[usize::from(*player)]);
            // What one who left has told is passed on by the others, and all to one who watches.
            let is_meant = usize::from(*player) == from || ((track.has_left || is_guest) && leads);
            let wrong = if is_meant { track.extend(*first, told) } else { None };
            self.note_wrong(wrong);
        }
    }

    fn is_possible(&self, from: usize, packet: &Packet) -> bool {
        let Some(own) = self.own else {
            let is_near =
                |run: &Run| u64::from(run.first) + run.told.len() as u64 <= u64::from(self.frame + LONGEST_STORE);
            return packet.runs.iter().all(is_near);
        };
        let most = self.frame + self.pacing.horizon();
        // What is passed on has come to somebody who may be ahead.
        let passed_on = |run: &Run| if usize::from(run.player) == from { 0 } else { self.pacing.horizon() };
        let is_near = |run: &Run| u64::from(run.first) + run.told.len() as u64 <= u64::from(most + passed_on(run));
        let is_soon = |takeover: &Takeover| takeover.since <= most + self.pacing.horizon();
        packet.frame <= most
            && packet.takeovers.iter().all(is_soon)
            && packet.runs.iter().all(is_near)
            && packet.known[own] <= self.tracks[own].count()
    }

    /// A player has left: from now on a bot steers, from the same frame on for all, which the first of the others says.
    pub fn leave(&mut self, player: usize) {
        if Some(player) == self.own || player >= self.tracks.len() {
            return;
        }
        self.tracks[player].has_left = true;
        if self.leads() {
            let open = |track: &Track| track.has_left && track.end.is_none();
            let left: Vec<usize> = (0..self.tracks.len()).filter(|&k| open(&self.tracks[k])).collect();
            for player in left {
                self.finish(player, self.tracks[player].count());
            }
        }
    }

    /// The first of those who are there longest.
    pub(super) fn leader(&self) -> usize {
        let there = self.tracks.iter().enumerate().filter(|(_, track)| !track.has_left);
        there.min_by_key(|(k, track)| (track.since, *k)).map_or(self.own.unwrap_or(0), |(k, _)| k)
    }

    /// Whether this player says what becomes of those who come and go.
    #[must_use]
    pub fn leads(&self) -> bool {
        self.own == Some(self.leader())
    }

    pub(super) fn finish(&mut self, player: usize, end: u32) {
        let track = &mut self.tracks[player];
        let is_kept =
            self.frame < end.saturating_add(self.pacing.kept()) && end <= self.frame + 2 * self.pacing.horizon();
        if !track.has_left || track.end.is_some() || !is_kept {
            return;
        }
        track.finish(end);
        self.note_wrong(Some(end));
        self.digests.retain(|(frame, _)| *frame <= end);
        self.tracks.iter_mut().for_each(|track| track.digest = None);
    }

    /// Has the frames from this one on taken again; one of which no round is kept, as only a false packet asks for, makes a draw.
    fn note_wrong(&mut self, frame: Option<u32>) {
        let frame = frame.filter(|&frame| frame < self.frame);
        let is_kept = |frame: &u32| self.frame <= frame.saturating_add(self.pacing.kept());
        self.desync = self.desync.or(frame.filter(|frame| !is_kept(frame)));
        let frame = frame.filter(is_kept);
        self.wrong_from = self.wrong_from.into_iter().chain(frame).min();
    }

    /// One frame, if others are not too far behind, with what this player wants to tell its cell from now on. Returns whether a frame
    /// was taken. `now` is a clock, ms.
    pub fn advance(&mut self, wanted: Told) -> bool {
        self.taken = 0;
        if let Some(wrong) = self.wrong_from.take() {
            self.go_back(wrong);
        }
        self.check();
        self.heard.clear();
        self.gains.clear();
        if self.desync.is_some() {
            return false;
        }
        let most = if self.own.is_some() { self.window() } else { 0 };
        if self.frame >= self.final_frame().saturating_add(most) || self.is_ahead() {
            self.tally.waits += 1;
            return false;
        }
        if let Some(own) = self.own {
            self.tracks[own].push(self.frame + self.pacing.delay, wanted);
        }
        self.take_frame();
        true
    }

    /// Notes how long the last call of [`Session::advance`] took. Where frames take long, fewer are predicted, so that going back takes
    /// no longer than it may; the worlds are the same.
    pub fn note_time(&mut self, time: Duration) {
        self.prediction.note(self.taken, time);
    }

    fn go_back(&mut self, to: u32) {
        let until = self.frame;
        self.now.clone_from(&self.kept[(to % self.pacing.kept()) as usize]);
        self.frame = to;
        self.over_at = self.over_at.filter(|&frame| frame <= to);
        while self.frame < until {
            self.take_frame();
        }
        self.tally.rollbacks += 1;
        self.tally.repeated += until - to;
        self.tally.deepest = self.tally.deepest.max(until - to);
    }

    fn take_frame(&mut self) {
        let Self { now, tracks, frame, heard, gains, .. } = self;
        heard.clear();
        gains.clear();
        self.kept[(*frame % self.pacing.kept()) as usize].clone_from(now);
        let told: Vec<Told> = tracks.iter_mut().map(|track| track.act(*frame)).collect();
        now.take(&told, self.pacing.steps, |round| {
            heard.extend(round.heard());
            gains.extend(round.gains());
        });
        *frame += 1;
        self.taken += 1;
        if now.round.is_over() {
            self.over_at.get_or_insert(*frame);
        }
    }

    /// Digests what has become final, and compares it with what others say.
    fn check(&mut self) {
        let due = (self.digests.len() as u32 + 1) * self.pacing.interval;
        if due < self.frame && due <= self.final_frame() {
            let moment = &self.kept[(due % self.pacing.kept()) as usize];
            self.digests.push((due, moment.round.world().digest()));
        }
        let differs = |&(frame, digest): &(u32, u64)| self.digests.iter().any(|own| own.0 == frame && own.1 != digest);
        let others = self.tracks.iter().filter_map(|track| track.digest);
        self.desync = self.desync.or(others.filter(differs).map(|(frame, _)| frame).min());
    }

    /// Whether this player is ahead of one who is slower: then it waits, a frame at a time.
    fn is_ahead(&mut self) -> bool {
        if self.own.is_none() || self.is_behind() {
            return false;
        }
        let others = self.others().map(|k| (self.tracks[k].ahead - self.tracks[k].advantage) / 2);
        let is_ahead = others.max().unwrap_or(0) >= AHEAD && self.frame >= self.waited + WAIT_INTERVAL;
        if is_ahead {
            self.waited = self.frame;
        }
        is_ahead
    }

    pub(super) fn is_other(&self, player: usize) -> bool {
        Some(player) != self.own && !self.tracks[player].has_left
    }

    pub(super) fn others(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.tracks.len()).filter(|&k| self.is_other(k))
    }

    /// For how many frames the own inputs are told.
    pub(super) fn told_until(&self) -> u32 {
        self.own.map_or(0, |own| self.tracks[own].count())
    }

    /// The frame before which nothing changes any more: the inputs of all are known.
    #[must_use]
    pub fn final_frame(&self) -> u32 {
        let known =
            self.tracks.iter().enumerate().filter(|(k, _)| self.own != Some(*k)).map(|(_, track)| track.certain());
        let known = known.min().unwrap_or(u32::MAX);
        if self.own.is_none() && known < u32::MAX { known } else { known.min(self.frame.max(self.told_until())) }
    }

    /// Steps of the world in a frame.
    #[must_use]
    pub fn steps(&self) -> u32 {
        self.pacing.steps
    }

    /// What was heard in the last frame.
    #[must_use]
    pub fn heard(&self) -> &[Cue] {
        &self.heard
    }

    /// What was earned in the last frame.
    #[must_use]
    pub fn gains(&self) -> &[Gain] {
        &self.gains
    }

    /// Frames that were taken.
    #[must_use]
    pub fn frame(&self) -> u32 {
        self.frame
    }

    /// The round as it is believed to be now.
    #[must_use]
    pub fn round(&self) -> &Round {
        &self.now.round
    }

    /// Whether the round is over, its end is final, and all others know all of it that they need.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.wrong_from.is_none()
            && self.over_at.is_some_and(|end| {
                let is_known = |own: usize| self.others().all(|k| self.tracks[k].known[own] >= end);
                self.final_frame() >= end && self.own.is_none_or(is_known) && self.is_seen(end)
            })
    }

    /// Frames since the round was over, as far as is known now.
    #[must_use]
    pub fn frames_over(&self) -> u32 {
        self.over_at.map_or(0, |end| self.frame - end)
    }
}

#[cfg(test)]
#[path = "session_tests.rs"]
mod tests;
