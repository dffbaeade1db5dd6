//! A tone: a sine and its octave that glide from one pitch to another and fade.

use microsim_core::geometry::unit_vector;
use std::f32::consts::TAU;

/// Samples per second.
pub const RATE: u32 = 48_000;
/// Time in which a tone reaches its loudness, s: shorter clicks.
const ATTACK: f32 = 0.008;
/// Loudness of the octave above, relative to the tone.
const OCTAVE: f32 = 0.25;

/// A tone as data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tone {
    /// Pitch at the beginning and at the end, Hz.
    pitch: [f32; 2],
    /// How long it takes, s.
    time: f32,
    /// Amplitude, 0 to 1.
    loudness: f32,
    /// Silence before it, s.
    delay: f32,
}

impl Tone {
    /// A tone that changes its pitch.
    pub(super) const fn glide(pitch: [f32; 2], time: f32, loudness: f32) -> Self {
        Self { pitch, time, loudness, delay: 0.0 }
    }

    /// A tone that keeps its pitch.
    pub(super) const fn note(pitch: f32, time: f32, loudness: f32) -> Self {
        Self::glide([pitch; 2], time, loudness)
    }

    /// The same a little later.
    pub(super) const fn after(self, delay: f32) -> Self {
        Self { delay, ..self }
    }
}

/// A tone that is played.
#[derive(Clone, Copy, Debug)]
pub(super) struct Voice {
    tone: Tone,
    loudness: f32,
    /// Time since it began, samples; negative before.
    age: i32,
    /// Where in its period it is, 0 to 1.
    phase: f32,
}

impl Voice {
    /// A tone that begins now.
    pub(super) fn new(tone: Tone, loudness: f32) -> Self {
        Self { tone, loudness, age: -((tone.delay * RATE as f32) as i32), phase: 0.0 }
    }

    /// Whether there is nothing more to hear.
    pub(super) fn is_over(&self) -> bool {
        self.age as f32 >= self.tone.time * RATE as f32
    }

    /// Its next sample.
    pub(super) fn next(&mut self) -> f32 {
        let age = self.age;
        self.age += 1;
        if age < 0 || self.is_over() {
            return 0.0;
        }
        let time = age as f32 / RATE as f32;
        let (share, [low, high]) = (time / self.tone.time, self.tone.pitch);
        self.phase += (low + (high - low) * share) / RATE as f32;
        self.phase -= self.phase.floor();
        let wave = unit_vector(TAU * self.phase).y + OCTAVE * unit_vector(2.0 * TAU * self.phase).y;
        let rise = if time < ATTACK { time / ATTACK } else { 1.0 };
        self.loudness * self.tone.loudness * rise * (1.0 - share) * (1.0 - share) * wave
    }
}
