//! What is kept between runs: settings and high scores, in the place that the platform has for them.

pub mod files;
pub mod scores;
pub mod settings;
