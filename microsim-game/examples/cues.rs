//! Plays three cues, one after the other: `cargo run -p microsim-game --example cues`.

use microsim_game::platform::Speaker;
use microsim_game::sound::Cue;
use std::thread::sleep;
use std::time::Duration;

fn main() {
    let mut speaker = Speaker::default();
    // The first one wakes the device, which may take two seconds.
    speaker.play(Cue::Fuse, 0.0);
    sleep(Duration::from_secs(3));
    for cue in [Cue::Second, Cue::Ingest, Cue::End] {
        speaker.play(cue, 1.0);
        sleep(Duration::from_secs(2));
    }
}
