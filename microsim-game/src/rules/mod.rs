//! The rules of the game (thesis, 3.3.2), over the core's worlds and events alone: no window, no clock, no drawing.
//!
//! ```text
//!   mouse or bot --> Intent --> Round: world, record --> events --> Referee: score, time, gains; Attempt: goals, stars
//!                                 ^        |    \-----------------> hints: what the player should be shown
//!                                 \- Replay <-/
//! ```

pub mod aim;
pub mod attempt;
pub mod bot;
pub mod brake;
pub mod chain_bot;
mod course;
pub mod end_advice;
pub mod flight;
pub mod food_chain;
pub mod ghost;
pub mod hint;
pub mod lesson;
pub mod lunge;
pub mod news;
pub mod path;
pub mod prey_class;
pub mod referee;
pub mod round;
pub mod seating;
pub mod slide_bot;
pub mod threat;
pub mod two_players;
pub mod verdict;

#[cfg(test)]
mod tests;
