//! Playing together.

pub mod relay;
pub mod transport;
