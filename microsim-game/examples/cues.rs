//! Plays three cues, as the test `sound` does: `cargo run -p microsim-game --example cues`.

#[path = "../tests/common/cues.rs"]
mod cues;

fn main() {
    cues::play();
}
