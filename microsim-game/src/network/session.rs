//! A match: everybody computes the same round from the inputs of all. What is not known yet is predicted to stay as it was; where
//! that was wrong, the round goes back to the frame and is taken again.
//!
//! Inputs of a match are kept from its first frame on (five bytes each), so there is no input that could be too old to be sent.

use super::pacing::Pacing;
use super::packet::{LONGEST_RUN, Packet, Run};
use super::told::Told;
use super::track::Track;
use crate::rules::bot::{Bot, Policy};
use crate::rules::referee::Gain;
use crate::rules::round::Round;
use crate::sound::Cue;
use microsim_core::Intent;

/// Frames in which one frame may be left out to wait for a slower player.
const WAIT_INTERVAL: u32 = 8;
/// By how many frames a player is ahead when it waits.
const AHEAD: i32 = 2;

/// What going back cost, and what was sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Frames in which the round went back, and frames that were taken again.
    pub rollbacks: u32,
    /// See above.
    pub repeated: u32,
    /// Most frames that were taken again at once.
    pub deepest: u32,
    /// Frames that were left out: others were too far behind, or slower.
    pub waits: u32,
    /// Bytes of packets.
    pub sent: u64,
    /// See above.
    pub received: u64,
    /// Packets that no player of this version sends.
    pub refused: u32,
}

/// A moment of the match, to go back to.
#[derive(Debug)]
struct Moment {
    round: Round,
    bots: Vec<Bot>,
}

impl Clone for Moment {
    fn clone(&self) -> Self {
        Self { round: self.round.clone(), bots: self.bots.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        self.round.clone_from(&source.round);
        self.bots.clone_from(&source.bots);
    }
}

/// A match, as one of its players takes part.
#[derive(Debug)]
pub struct Session {
    pacing: Pacing,
    /// The number of this player.
    own: usize,
    now: Moment,
    frame: u32,
    /// Moments before the last frames, by frame.
    kept: Vec<Moment>,
    tracks: Vec<Track>,
    /// The first frame that was taken with a wrong prediction.
    wrong_from: Option<u32>,
    /// The frame after which the round was over.
    over_at: Option<u32>,
    /// The frame in which this player waited last.
    waited: u32,
    digests: Vec<(u32, u64)>,
    desync: Option<u32>,
    tally: Tally,
    /// What was heard and earned in the last frame, if one was taken.
    heard: Vec<Cue>,
    gains: Vec<Gain>,
}

impl Session {
    /// A match from a round at its beginning, which is the same for all. `own` is the number of this player.
    #[must_use]
    pub fn new(round: Round, own: usize, pacing: Pacing) -> Self {
        let players = round.players().count();
        let bots = (0..players).map(|k| Bot::new(Policy::Greedy, k as u64)).collect();
        let now = Moment { round, bots };
        Self {
            pacing,
            own,
            kept: vec![now.clone(); pacing.kept() as usize],
            now,
            frame: 0,
            tracks: vec![Track::new(players, pacing.delay); players],
            wrong_from: None,
            over_at: None,
            waited: 0,
            digests: Vec::new(),
            desync: None,
            tally: Tally::default(),
            heard: Vec::new(),
            gains: Vec::new(),
        }
    }

    /// Takes in a packet of another player. One that no player sends is counted and changes nothing. `now` is a clock, ms.
    pub fn receive(&mut self, from: usize, bytes: &[u8], now: u32) {
        let is_other = from != self.own && self.tracks.get(from).is_some_and(|track| !track.has_left);
        let packet = Packet::read(bytes, self.tracks.len()).filter(|packet| is_other && self.is_possible(from, packet));
        let Some(packet) = packet else {
            self.tally.refused += 1;
            return;
        };
        self.tally.received += bytes.len() as u64;
        let agree = packet.ends == self.ends();
        // A bot has steered from one frame on here and from another one there.
        let differs = |&(player, end): &(u8, u32)| self.tracks[usize::from(player)].end.is_some_and(|own| own != end);
        self.desync = self.desync.or(packet.ends.iter().copied().find(differs).map(|(_, end)| end));
        let track = &mut self.tracks[from];
        track.note(&packet, self.frame, now);
        // Before both know from where on a bot steers, their worlds may differ.
        track.digest = track.digest.filter(|_| agree);
        let leads = self.leader() == from;
        for &(player, end) in packet.ends.iter().filter(|_| leads) {
            self.finish(player.into(), end);
        }
        for Run { player, first, told } in &packet.runs {
            let track = &mut self.tracks[usize::from(*player)];
            // What one who left has told is passed on by the others.
            let is_meant = usize::from(*player) == from || (track.has_left && leads);
            let wrong = if is_meant { track.extend(*first, told) } else { None };
            self.note_wrong(wrong);
        }
    }

    fn is_possible(&self, from: usize, packet: &Packet) -> bool {
        let most = self.frame + self.pacing.horizon();
        // What is passed on has come to somebody who may be ahead.
        let passed_on = |run: &Run| if usize::from(run.player) == from { 0 } else { self.pacing.horizon() };
        let is_near = |run: &Run| u64::from(run.first) + run.told.len() as u64 <= u64::from(most + passed_on(run));
        packet.frame <= most
            && packet.runs.iter().all(is_near)
            && packet.known[self.own] <= self.tracks[self.own].count()
    }

    /// A player has left: from now on a bot steers, from the same frame on for all, which the first of the others says.
    pub fn leave(&mut self, player: usize) {
        if player == self.own || player >= self.tracks.len() {
            return;
        }
        self.tracks[player].has_left = true;
        if self.leader() == self.own {
            let open = |track: &Track| track.has_left && track.end.is_none();
            let left: Vec<usize> = (0..self.tracks.len()).filter(|&k| open(&self.tracks[k])).collect();
            for player in left {
                self.finish(player, self.tracks[player].count());
            }
        }
    }

    /// The first of those who are there.
    fn leader(&self) -> usize {
        self.tracks.iter().position(|track| !track.has_left).unwrap_or(self.own)
    }

    fn finish(&mut self, player: usize, end: u32) {
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

    fn note_wrong(&mut self, frame: Option<u32>) {
        let frame = frame.filter(|&frame| frame < self.frame);
        self.wrong_from = self.wrong_from.into_iter().chain(frame).min();
    }

    /// One frame, if others are not too far behind, with what this player wants to tell its cell from now on. Returns whether a frame
    /// was taken. `now` is a clock, ms.
    pub fn advance(&mut self, wanted: Told) -> bool {
        if let Some(wrong) = self.wrong_from.take() {
            self.go_back(wrong);
        }
        self.check();
        self.heard.clear();
        self.gains.clear();
        if self.frame >= self.final_frame().saturating_add(self.pacing.window) || self.is_ahead() {
            self.tally.waits += 1;
            return false;
        }
        self.tracks[self.own].push(wanted);
        self.take_frame();
        true
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
        let size = now.round.world().config().size;
        let told: Vec<Option<Told>> = tracks.iter_mut().map(|track| track.act(*frame)).collect();
        let cells: Vec<_> = now.round.players().collect();
        for _ in 0..self.pacing.steps {
            if now.round.is_over() {
                break;
            }
            let world = now.round.world();
            let players = told.iter().zip(&cells).zip(&mut now.bots);
            let intents: Vec<Intent> = players
                .map(|((told, cell), bot)| told.map_or_else(|| bot.intent(world, *cell), |told| told.intent(size)))
                .collect();
            now.round.step_all(&intents);
            heard.extend(now.round.heard());
            gains.extend(now.round.gains());
        }
        *frame += 1;
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
        let others = self.others().map(|k| (self.tracks[k].ahead - self.tracks[k].advantage) / 2);
        let is_ahead = others.max().unwrap_or(0) >= AHEAD && self.frame >= self.waited + WAIT_INTERVAL;
        if is_ahead {
            self.waited = self.frame;
        }
        is_ahead
    }

    /// What is to be sent now, and to whom.
    pub fn packets(&mut self, now: u32) -> Vec<(usize, Vec<u8>)> {
        let others: Vec<usize> = self.others().collect();
        others.into_iter().map(|to| (to, self.packet(to, now))).collect()
    }

    fn packet(&mut self, to: usize, now: u32) -> Vec<u8> {
        let known = self.tracks.iter().map(Track::count).collect();
        let run = |(player, track): (usize, &Track)| {
            let is_passed_on = player == self.own || (track.has_left && player != to);
            let first = self.tracks[to].known[player];
            let told = track.since(first, LONGEST_RUN).to_vec();
            (is_passed_on && !told.is_empty()).then_some(Run { player: player as u8, first, told })
        };
        let runs = self.tracks.iter().enumerate().filter_map(run).collect();
        let (frame, ends, digest) = (self.frame, self.ends(), self.digests.last().copied());
        let track = &mut self.tracks[to];
        let advantage = track.ahead.clamp(i16::MIN.into(), i16::MAX.into()) as i16;
        let (number, heard) = (track.sent, track.clock(now));
        track.sent += 1;
        let packet = Packet { number, frame, advantage, sent: now, heard, known, ends, runs, digest }.write();
        self.tally.sent += packet.len() as u64;
        packet
    }

    /// From which frames on bots steer, by player.
    fn ends(&self) -> Vec<(u8, u32)> {
        (0..).zip(&self.tracks).filter_map(|(k, track)| Some((k, track.end?))).collect()
    }

    fn others(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.tracks.len()).filter(|&k| k != self.own && !self.tracks[k].has_left)
    }

    /// The frame before which nothing changes any more: the inputs of all are known.
    #[must_use]
    pub fn final_frame(&self) -> u32 {
        let known = self.tracks.iter().enumerate().filter(|(k, _)| *k != self.own).map(|(_, track)| track.certain());
        known.min().unwrap_or(u32::MAX).min(self.frame.max(self.tracks[self.own].count()))
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
                let is_known = |k: usize| self.tracks[k].known[self.own] >= end;
                self.final_frame() >= end && self.others().all(is_known)
            })
    }

    /// Frames since the round was over, as far as is known now.
    #[must_use]
    pub fn frames_over(&self) -> u32 {
        self.over_at.map_or(0, |end| self.frame - end)
    }

    /// The step before which the worlds of two players were found to differ.
    #[must_use]
    pub fn desync(&self) -> Option<u64> {
        self.desync.map(|frame| u64::from(frame) * u64::from(self.pacing.steps))
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

    /// Digests of what is final, by frame.
    #[must_use]
    pub fn digests(&self) -> &[(u32, u64)] {
        &self.digests
    }

    /// What a player told its cell in each frame that is known, and the frame from which on a bot steers.
    #[must_use]
    pub fn told(&self, player: usize) -> (&[Told], Option<u32>) {
        self.tracks.get(player).map_or((&[], None), |track| (track.since(0, usize::MAX), track.end))
    }
}

#[cfg(test)]
#[path = "session_tests.rs"]
mod tests;
