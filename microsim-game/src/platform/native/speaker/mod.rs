//! The speaker of a desktop: on Linux by the protocol of PulseAudio, which PipeWire speaks too; elsewhere by the system's own way. Where
//! nothing can play it is silent.

#[cfg(target_os = "linux")]
mod pulse;
#[cfg(any(windows, target_os = "macos"))]
mod system;

use crate::sound::{Cue, Mixer};
#[cfg(target_os = "linux")]
use pulse::play;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
#[cfg(any(windows, target_os = "macos"))]
use system::play;

/// Plays cues.
#[derive(Debug, Default)]
pub struct Speaker {
    /// To the thread that feeds the device; it begins with the first cue.
    cues: Option<Sender<(Cue, f32)>>,
}

impl Speaker {
    /// Plays a cue, with a loudness of 0 to 1.
    pub fn play(&mut self, cue: Cue, loudness: f32) {
        // Refused where there is no device: then it is silent.
        let _ = self.cues.get_or_insert_with(begin).send((cue, loudness));
    }

    /// Nothing: the device asks for samples by itself.
    pub fn pass(&mut self, _: f32) {}
}

/// Begins to play what is sent, until the sender is dropped.
fn begin() -> Sender<(Cue, f32)> {
    let (sender, cues) = channel();
    let feed = Feed { cues, mixer: Mixer::default() };
    // Without a thread, as without a device, what is sent is refused.
    let _ = std::thread::Builder::new().name("sound".to_owned()).spawn(move || {
        // A player without a device knows; others need no message in the middle of a round.
        let _ = play(feed);
    });
    sender
}

/// What a device takes its samples from.
struct Feed {
    cues: Receiver<(Cue, f32)>,
    mixer: Mixer,
}

impl Feed {
    /// Fills samples of one channel; false when no cue can come any more.
    fn fill(&mut self, samples: &mut [f32]) -> bool {
        loop {
            match self.cues.try_recv() {
                Ok((cue, loudness)) => self.mixer.play(cue, loudness),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => return false,
            }
        }
        self.mixer.fill(samples);
        true
    }
}
