//! Sound without files: what happens becomes cues, and a mixer computes samples from them.
//!
//! ```text
//!   events of a step --> Cue --> Mixer --> samples --> platform: Speaker
//! ```

mod cue;
mod mixer;
mod tone;

pub use cue::Cue;
pub use mixer::Mixer;
pub use tone::RATE;
