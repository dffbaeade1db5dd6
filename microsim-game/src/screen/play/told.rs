//! What is written over a round: the status, and advice.

use super::super::chain_scene;
use super::super::steer::{first_advice, held_to_crawl, optics_advice};
use super::Play;
use crate::clock::Tempo;
use crate::hud::places::is_before_place;
use crate::hud::{self, Status};
use crate::rules::hint::Hints;
use crate::rules::lesson::FirstDeed;
use crate::rules::two_players::TwoPlayers;
use crate::ui::pen::Pen;
use crate::words::{self, Key};

/// Time for which the player is told the task of a slide, and what to do, s.
const TASK_TIME: f64 = 9.0;
const ADVICE_TIME: f64 = 7.0;
/// Time at the end in which it is said that only what is digested counts, s.
const LAST_TIME: f32 = 8.0;
/// Time for which it is said how a replay is made slower and faster, s.
const TEMPO_TIME: f64 = 6.0;

impl Play {
    pub(super) fn draw_status(&self, pen: &mut Pen, is_calm: bool) {
        let mut note = match (self.round.is_replay(), self.round.mismatch()) {
            (false, _) => String::new(),
            (true, None) => words::text(Key::HudReplay).to_owned(),
            (true, Some(_)) => words::text(Key::HudReplayDiffers).to_owned(),
        };
        if self.tempo != Tempo::default() {
            note = format!("{note}  {}", self.tempo);
        }
        let referee = self.round.referee();
        let of_game = || {
            let of_all = |told| vec![(None, told)];
            let points = || match self.two {
                Some(way) => way.summary(&self.round.scores()),
                None => of_all(words::text_with(Key::HudScore, &[("points", referee.score().into())])),
            };
            let score = self.round.attempt().map_or_else(points, |attempt| of_all(attempt.summary()));
            (score, [referee.time_left(), referee.game().time])
        };
        let life = chain_scene::status(&self.round, self.seen()).or_else(|| self.last_life.clone());
        let life = life.filter(|_| self.two.is_none()).map(|(told, time)| (vec![(None, told)], time));
        let starves = life.is_some();
        let (score, time) = life.unwrap_or_else(of_game);
        hud::draw_status(pen, &Status { score: &score, time, starves, is_calm, note: &note });
    }

    pub(super) fn advice(
        &self,
        hints: &Hints,
        first: Option<FirstDeed>,
        (key, has_buttons): (Option<&str>, bool),
    ) -> Option<String> {
        let (time, left) = (self.round.world().time(), self.round.referee().time_left());
        let of = |key| Some(words::text(key).to_owned());
        if self.round.is_replay() {
            (time < TEMPO_TIME && !has_buttons).then(|| self.tempo_advice())
        } else if !self.has_begun {
            Some(format!("{} {}", self.invitation(has_buttons), words::text(Key::HintBegin)))
        } else if self.round.is_over() && left <= 0.0 {
            of(Key::SlideEndLate)
        } else if self.round.chain().is_some() {
            let of_ghost = || self.ghost.as_ref().and_then(|_| chain_scene::ghost_advice(time));
            chain_scene::advice(time, first, &self.divide_key, has_buttons).or_else(of_ghost)
        } else if self.task.is_some() {
            let of_place = || self.is_before_place().then(|| words::text(Key::HintPlace).to_owned());
            (time < TASK_TIME).then(|| self.invitation(has_buttons)).or_else(of_place)
        } else if let Some(key) = key.filter(|_| hints.can_digest() && self.round.referee().score() == 0) {
            Some(words::text_with(Key::HintDigest, &[("key", key.into())]))
        } else if time < ADVICE_TIME && self.has_two_hands() {
            of(Key::HintTwoPlayers)
        } else if left < LAST_TIME && hints.can_digest() {
            of(Key::HintLast)
        } else {
            let of_optics = || (!has_buttons).then(|| optics_advice(time, &self.optics_key)).flatten();
            first.map(|deed| first_advice(deed, has_buttons)).or_else(of_optics)
        }
    }

    /// The explanation of a mark, or of the lunge.
    pub(super) fn lesson(&self, lesson: Key, has_buttons: bool) -> String {
        let of_key = || words::text_with(Key::HintLungeKey, &[("key", (&self.lunge_key).into())]);
        let what = if has_buttons { words::text(Key::ActionLunge).to_owned() } else { of_key() };
        words::text_with(lesson, &[("what", (&what).into())])
    }

    /// Whether the cell touches a place that its middle has to reach.
    fn is_before_place(&self) -> bool {
        let cell = self.round.world().view().organism(self.seen());
        self.round.attempt().zip(cell).is_some_and(|(attempt, cell)| is_before_place(attempt, cell))
    }

    /// Whether somebody plays the second cell.
    fn has_two_hands(&self) -> bool {
        matches!(self.two, Some(TwoPlayers::Versus | TwoPlayers::Together))
    }

    /// The task of a slide, and how to crawl.
    fn invitation(&self, has_buttons: bool) -> String {
        let both = words::text(Key::HintTwoPlayers);
        match &self.task {
            Some(task) if self.two.is_some() => format!("{task} {both}"),
            Some(task) => {
                let how = held_to_crawl(has_buttons);
                words::text_with(Key::HintTask, &[("task", task.into()), ("what", how.into())])
            }
            None if self.has_two_hands() => both.to_owned(),
            None => first_advice(FirstDeed::Crawl, has_buttons),
        }
    }

    fn tempo_advice(&self) -> String {
        let [slower, faster, stop] = &self.tempo_keys;
        let keys = [("slower", slower.into()), ("faster", faster.into()), ("stop", stop.into())];
        words::text_with(Key::HintTempo, &keys)
    }
}
