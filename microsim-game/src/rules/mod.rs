//! The rules of the game (seed, 3.3.2), over the core's worlds and events alone: no window, no clock, no drawing.
//!
//! ```text
//!   mouse, bot or replay --> Intent --> Round: script, world --> events --> Referee: score, time, gains
//!                                                    \---------> hints: what the player should be shown
//! ```

pub mod bot;
pub mod hint;
pub mod recording;
pub mod referee;
pub mod round;

#[cfg(test)]
mod tests;
