//! What is kept between runs: settings, high scores and best times, in the place that the platform has for them.

pub mod best_life;
pub mod best_times;
pub mod chain_records;
pub mod files;
pub mod found;
pub mod scores;
pub mod settings;
pub mod toml_value;
