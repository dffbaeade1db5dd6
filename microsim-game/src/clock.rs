//! Fixed steps out of frames of any length.

use crate::words;
use std::fmt;

/// Longest frame that counts, s: after a stall the scene goes on where it was.
const LONGEST_FRAME: f64 = 0.1;

/// Turns the time that frames take into whole steps. When the machine is too slow for them the scene runs in slow motion.
#[derive(Clone, Debug)]
pub struct FixedStep {
    dt: f64,
    backlog: f64,
}

impl FixedStep {
    /// A clock of steps of `dt` seconds.
    #[must_use]
    pub fn new(dt: f32) -> Self {
        Self { dt: f64::from(dt), backlog: 0.0 }
    }

    /// Adds the time that a frame took, s.
    pub fn feed(&mut self, elapsed: f32) {
        let elapsed = f64::from(elapsed);
        if elapsed > 0.0 {
            self.backlog += elapsed.min(LONGEST_FRAME);
        }
    }

    /// Whether a step is due; it then counts as taken.
    pub fn take(&mut self) -> bool {
        // A little early is better than a frame without a step when both tick at 60 Hz.
        let is_due = self.backlog >= 0.999 * self.dt;
        if is_due {
            self.backlog = (self.backlog - self.dt).max(0.0);
        }
        is_due
    }

    /// Gives up whole steps that are still due.
    pub fn drop_backlog(&mut self) {
        self.backlog %= self.dt;
    }

    /// How far the present lies between the last two steps, 0 to 1.
    #[must_use]
    pub fn alpha(&self) -> f32 {
        (self.backlog / self.dt).clamp(0.0, 1.0) as f32
    }
}

/// How fast time can pass beside the usual.
const TEMPOS: [f32; 6] = [0.1, 0.25, 0.5, 1.0, 2.0, 4.0];

/// How fast time passes in a simulation or a replay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tempo(usize);

impl Default for Tempo {
    fn default() -> Self {
        Self(3)
    }
}

impl Tempo {
    /// How many times as fast as usual.
    #[must_use]
    pub fn factor(self) -> f32 {
        TEMPOS[self.0]
    }

    /// The next faster or slower one, if there is one.
    #[must_use]
    pub fn changed(self, faster: bool, slower: bool) -> Self {
        Self((self.0 + usize::from(faster)).saturating_sub(usize::from(slower)).min(TEMPOS.len() - 1))
    }

    /// The next one, or the one before, in a circle.
    #[must_use]
    pub fn next(self, is_back: bool) -> Self {
        Self((self.0 + if is_back { TEMPOS.len() - 1 } else { 1 }) % TEMPOS.len())
    }
}

/// What the player reads.
impl fmt::Display for Tempo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x", words::shortest(self.factor()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    fn steps(clock: &mut FixedStep, elapsed: f32) -> usize {
        clock.feed(elapsed);
        std::iter::from_fn(|| clock.take().then_some(())).count()
    }

    #[test]
    fn the_rate_does_not_depend_on_the_frame_rate() {
        for fps in [24.0, 30.0, 59.94, 60.0, 75.0, 144.0, 240.0f32] {
            let mut clock = FixedStep::new(DT);
            let frames = (10.0 * fps) as usize;
            let count: usize = (0..frames).map(|_| steps(&mut clock, 1.0 / fps)).sum();
            assert!(count.abs_diff(600) <= 2, "{fps} fps: {count} steps in 10 s");
        }
    }

    #[test]
    fn sixty_hertz_is_one_step_per_frame() {
        let mut clock = FixedStep::new(DT);
        assert!((0..600).all(|_| steps(&mut clock, DT) == 1));
    }

    #[test]
    fn a_stall_costs_a_few_steps_at_most() {
        let mut clock = FixedStep::new(DT);
        assert_eq!(steps(&mut clock, 30.0), 6);
        clock.feed(0.09);
        clock.drop_backlog();
        assert!(!clock.take());
    }

    #[test]
    fn alpha_is_the_rest() {
        let mut clock = FixedStep::new(DT);
        steps(&mut clock, 1.5 * DT);
        assert!((clock.alpha() - 0.5).abs() < 1e-3);
        clock.feed(f32::NAN);
        clock.feed(-1.0);
        assert!((clock.alpha() - 0.5).abs() < 1e-3);
    }

    #[test]
    fn tempos_end_where_keys_change_them_and_go_round_where_a_menu_does() {
        let usual = Tempo::default();
        assert_eq!((usual.factor(), usual.to_string()), (1.0, "1 x".to_owned()));
        let by_keys = |faster| (0..9).fold(usual, |tempo, _| tempo.changed(faster, !faster)).factor();
        assert_eq!([true, false].map(by_keys), [4.0, 0.1]);
        let all = (0..TEMPOS.len()).fold(usual, |tempo, _| tempo.next(false));
        assert_eq!((all, usual.next(false).next(true)), (usual, usual));
    }
}
