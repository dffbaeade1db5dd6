//! The speaker of a page: samples are handed to it frame by frame.

use super::host;
use crate::sound::{Cue, Mixer, RATE};

/// Longest time that one frame makes samples for, s.
const LONGEST: f32 = 0.1;

/// Plays cues, if the browser lets it.
#[derive(Debug, Default)]
pub struct Speaker {
    mixer: Mixer,
}

impl Speaker {
    /// Plays a cue, with a loudness of 0 to 1.
    pub fn play(&mut self, cue: Cue, loudness: f32) {
        self.mixer.play(cue, loudness);
    }

    /// Hands over the samples of a frame of `elapsed` seconds.
    pub fn pass(&mut self, elapsed: f32) {
        if self.mixer.is_silent() {
            return;
        }
        let mut samples = vec![0.0; (elapsed.min(LONGEST) * RATE as f32) as usize];
        self.mixer.fill(&mut samples);
        let bytes: Vec<u8> = samples.iter().flat_map(|sample| sample.to_le_bytes()).collect();
        host::tell("sound", &RATE.to_string(), &bytes);
    }
}
