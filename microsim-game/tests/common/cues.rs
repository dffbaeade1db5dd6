//! Cues that are played and compared with what is heard.

use microsim_game::platform::Speaker;
use microsim_game::sound::Cue;
use std::thread::sleep;
use std::time::Duration;

pub(crate) const CUES: [Cue; 3] = [Cue::Second, Cue::Ingest, Cue::End];

/// Plays them one after the other.
pub(crate) fn play() {
    let mut speaker = Speaker::default();
    // The first one wakes the device, which may take two seconds.
    speaker.play(Cue::Fuse, 0.0);
    sleep(Duration::from_secs(3));
    for cue in CUES {
        speaker.play(cue, 1.0);
        sleep(Duration::from_secs(2));
    }
}
