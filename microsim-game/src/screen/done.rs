//! What was just done of a slide's task: its note stays for a moment, with a tick.

use crate::rules::attempt::Attempt;

/// Time for which the note stays, s.
const TIME: f32 = 1.5;

/// The note.
#[derive(Debug, Default)]
pub(super) struct DoneNote {
    /// How much is done so far.
    done: u32,
    /// Time for which it is still shown, s.
    left: f32,
}

impl DoneNote {
    /// Lets time pass, s, and looks whether more is done than before.
    pub(super) fn pass(&mut self, attempt: &Attempt, elapsed: f32) {
        let done = attempt.goals().map(|(_, done)| done).sum();
        self.left = if done > self.done { TIME } else { (self.left - elapsed).max(0.0) };
        self.done = done;
    }

    /// Whether it is shown now.
    pub(super) fn is_shown(&self) -> bool {
        self.left > 0.0
    }

    /// What it says: how much is done, or the whole task.
    pub(super) fn text(&self, attempt: &Attempt, task: &str) -> String {
        if attempt.time().is_some() { task.to_owned() } else { attempt.summary() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::glam::Vec2;

    #[test]
    fn what_is_done_is_told_for_a_moment_and_at_the_end_the_whole_task() {
        let slide = crate::slides::find("little-animals").unwrap().read().unwrap();
        let (mut attempt, mut note) = (Attempt::new(slide), DoneNote::default());
        note.pass(&attempt, 0.1);
        assert!(!note.is_shown(), "nothing is done");
        attempt.after_step(1.0, &[], |_| 1);
        note.pass(&attempt, 0.1);
        assert!(note.is_shown());
        assert_eq!(note.text(&attempt, "All"), attempt.summary());
        note.pass(&attempt, 1.4);
        assert!(note.is_shown());
        note.pass(&attempt, 0.2);
        assert!(!note.is_shown());
        attempt.after_step(2.0, &[Vec2::new(80.0, 46.0)], |_| 9);
        let [low, high] = attempt.goals().flat_map(|(goal, _)| crate::rules::attempt::places(goal)).next().unwrap();
        attempt.after_step(3.0, &[0.5 * (low + high)], |_| 9);
        note.pass(&attempt, 0.1);
        assert!(note.is_shown());
        assert_eq!(note.text(&attempt, "All"), "All");
    }
}
