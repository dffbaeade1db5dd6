//! How long the parts of a frame take.

use std::fmt;
use std::time::Duration;

/// Frames of which the times are kept: the last ones.
const KEPT: usize = 4096;

/// Times of the last frames: steps and input, working out what is to be drawn, and telling the graphics card, with waiting
/// for it.
#[derive(Clone, Debug, Default)]
pub struct Timings {
    frames: usize,
    parts: [Vec<f32>; 3],
}

impl Timings {
    /// Adds a frame: times of its update, of its drawing and of waiting for the next one. `submitting` is what commands to the
    /// graphics card took, while it was drawn or, for pictures, while it was updated.
    pub fn add(&mut self, [update, draw, wait]: [Duration; 3], submitting: Duration) {
        let parts = [update, draw.saturating_sub(submitting), wait + submitting];
        for (times, part) in self.parts.iter_mut().zip(parts) {
            let milliseconds = part.as_secs_f32() * 1000.0;
            match times.get_mut(self.frames % KEPT) {
                Some(time) => *time = milliseconds,
                None => times.push(milliseconds),
            }
        }
        self.frames += 1;
    }
}

impl fmt::Display for Timings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} frames; least, median and 95 % ms:", self.frames)?;
        for (name, times) in ["step", "view", "submit"].into_iter().zip(&self.parts) {
            let mut sorted = times.clone();
            sorted.sort_by(f32::total_cmp);
            let at = |share: f32| sorted.get((share * sorted.len() as f32) as usize).copied().unwrap_or(0.0);
            write!(f, " {name} {:.2} {:.2} {:.2}", at(0.0), at(0.5), at(0.95))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_of_the_last_frames() {
        let mut timings = Timings::default();
        for k in 0..10_000 {
            timings.add([Duration::from_millis(if k < 5000 { 1 } else { 3 }); 3], Duration::ZERO);
        }
        let text = timings.to_string();
        assert!(text.contains("10000 frames") && text.contains("step 3.00 3.00"), "{text}");
    }

    #[test]
    fn a_picture_that_is_taken_in_an_update_may_take_longer_than_the_drawing() {
        let mut timings = Timings::default();
        timings.add([40, 2, 1].map(Duration::from_millis), Duration::from_millis(30));
        assert!(timings.to_string().contains("view 0.00 0.00 0.00 submit 31.00"), "{timings}");
    }
}
