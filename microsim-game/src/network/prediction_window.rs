//! How many frames are predicted at most: as many as this machine can take again in time.

use super::rollback_pacing::Pacing;
use std::time::Duration;

/// Longest time in which frames are taken again at once, s: three pictures of a screen, half of what is felt as a delay (0.1 s:
/// Miller 1968, <https://doi.org/10.1145/1476589.1476628>).
const BUDGET: f32 = 0.05;
/// Weight of a frame in the mean: about a second counts.
const WEIGHT: f32 = 1.0 / 32.0;

/// What the number follows from.
#[derive(Debug, Default)]
pub(super) struct PredictionWindow {
    /// Moving mean of the time of a frame, s.
    mean: f32,
}

impl PredictionWindow {
    /// Notes the time that so many frames took. One that takes longer than the budget counts as that: it may have been the system.
    pub(super) fn note(&mut self, frames: u32, time: Duration) {
        if frames > 0 {
            let each = (time.as_secs_f32() / frames as f32).min(BUDGET);
            self.mean = each + (self.mean - each) * (1.0 - WEIGHT).powi(frames as i32);
        }
    }

    /// Most frames that are predicted.
    pub(super) fn frames(&self, pacing: Pacing) -> u32 {
        ((BUDGET / self.mean) as u32).clamp(pacing.delay + 1, pacing.window)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(window: &mut PredictionWindow, calls: u32, frames: u32, each: f32) -> u32 {
        (0..calls).for_each(|_| window.note(frames, Duration::from_secs_f32(frames as f32 * each)));
        window.frames(Pacing::USUAL)
    }

    #[test]
    fn frames_that_take_long_lower_the_window_and_others_raise_it_again_slowly() {
        let mut window = PredictionWindow::default();
        let windows = [(1, 1, 0.002), (1, 10, 0.025), (9, 10, 0.025), (1, 1, 0.002), (30, 1, 0.002), (90, 1, 0.002)]
            .map(|(calls, frames, each)| after(&mut window, calls, frames, each));
        assert_eq!(windows, [10, 7, 3, 3, 4, 10]);
        assert_eq!(after(&mut window, 1, 1, 9.0), 10, "one long frame is no slow machine");
        assert_eq!(after(&mut window, 1, 0, 9.0), 10, "no frame, no time of one");
    }
}
