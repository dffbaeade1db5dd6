//! Playing together over a network.
//!
//! ```text
//!   Transport --> Room: who is there, names, start --> Session: inputs, prediction, going back --> Round
//! ```
//!
//! Nothing here reads a clock or opens a window; all that comes from others is hostile until it is checked.

pub mod contest;
mod guest;
#[cfg(any(test, fuzzing))]
pub mod hostile;
mod message;
mod moment;
mod packet;
pub mod plan;
mod post;
mod prediction_window;
pub mod relay;
mod report;
pub mod rollback_pacing;
pub mod room;
pub mod session;
pub mod told;
mod track;
pub mod transport;
